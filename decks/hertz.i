$ Two elastic balls collide: Hertz' contact. A quarter of them, by symmetry.
$ Source      Hertz (1882): largest force 88.16 N, approach 71.3 micrometres a ball, radius of contact 0.844 mm, duration
$             209.8 microseconds; see docs/verification.md, V-24
$ Run         urto hertz               some minutes on two cores
$ Look        urto view hertz.e, coloured by VONMISES at 105 microseconds: the largest stress is below the surface
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/hertz.mesh: two quarter balls of radius 10 mm, block 1 above block 2, which touch at the origin; node sets
$             1 and 2 are the planes x = 0 and y = 0
TITLE
 TWO BALLS, 1 M/S EACH
TERMINATION TIME, 250.E-6
OUTPUT TIME, 1.E-6
PLOT TIME, 5.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT
PLOT ELEMENT, STRESS, VONMISES
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
CONTACT MATERIAL, 1, 2
INITIAL VELOCITY MATERIAL, 1, 0., 0., -1.
INITIAL VELOCITY MATERIAL, 2, 0., 0., 1.
MATERIAL, 1, ELASTIC, 1200.
YOUNGS MODULUS = 1.E9
POISSONS RATIO = 0.3
END
MATERIAL, 2, ELASTIC, 1200.
YOUNGS MODULUS = 1.E9
POISSONS RATIO = 0.3
END
EXIT
