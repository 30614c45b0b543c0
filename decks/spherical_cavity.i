$ A cavity in rock is put under pressure at once: its wall overshoots and settles, and a wave runs out.
$ Source      F. G. Blake (1952) gives the motion in closed form; see docs/verification.md, V-06
$ Run         urto spherical_cavity    seconds
$ Look        colour spherical_cavity.e by VELX, or by PRESSURE; spherical_cavity.h holds the histories at two radii
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/spherical_cavity.mesh: node sets 1, 2, 3 the planes of symmetry, side set 100 the wall
TITLE
 SPHERICAL CAVITY UNDER A STEP OF PRESSURE
TERMINATION TIME, 3.9E-3               $ before the wave is back from the outside
OUTPUT TIME, 20.E-6
PLOT TIME, 20.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE
MATERIAL POINT, 1.02, 0.05, 0.05
MATERIAL POINT, 2.0, 0.05, 0.05
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3
FUNCTION, 1
0., 1.
1., 1.
END
PRESSURE, 100, 1, 1.E6
MATERIAL, 1, ELASTIC, 2000.
YOUNGS MODULUS = 62.5E9
POISSONS RATIO = 0.25
END
EXIT
