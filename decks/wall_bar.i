$ An elastic bar flies against a rigid wall and comes back.
$ Source      one-dimensional waves: contact force rho c0 v A = 19.81 kN for 2 L/c0 = 396.2 microseconds, then the bar
$             leaves at 5 m/s; see docs/verification.md, V-20
$ Run         urto wall_bar            a second
$ Look        colour wall_bar.e by SIGXX: a wave runs to the free end and back
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/wall_bar.mesh: a bar of 50 x 1 x 1 hexahedra, 1 x 0.01 x 0.01 m along x; side set 100 is its end
$             at x = 0
TITLE
 ELASTIC BAR ON A RIGID WALL, 5 M/S
TERMINATION TIME, 600.E-6
OUTPUT TIME, 1.E-6
PLOT TIME, 1.E-6
WRITE RESTART, 200.E-6         $ wall_bar_further.i goes on from the last state
PLOT NODAL, VELOCITY, REACTION
PLOT ELEMENT, STRESS
RIGID SURFACE, 100, 0., 0., 0., 1., 0., 0.
INITIAL VELOCITY MATERIAL, 1, -5., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
