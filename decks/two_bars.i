$ An elastic bar strikes an equal one at rest and stops; the other flies on.
$ Source      one-dimensional waves: the bars touch for 2 L/c0 = 396.2 microseconds, then the velocities have changed hands;
$             see docs/verification.md, V-21
$ Run         urto two_bars            a second
$ Look        colour two_bars.e by VELX: the second bar takes over the velocity of the first, wave by wave
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/two_bars.mesh: two bars of 50 x 1 x 1 hexahedra, 1 x 0.01 x 0.01 m, end to end along x; block 1 the left
$             one, block 2 the right one
TITLE
 TWO EQUAL BARS, 5 M/S
TERMINATION TIME, 600.E-6
OUTPUT TIME, 1.E-6
PLOT TIME, 1.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, MASS, CONTACT
PLOT ELEMENT, STRESS
CONTACT MATERIAL, 1, 2
INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 2, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
