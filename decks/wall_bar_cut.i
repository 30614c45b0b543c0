$ An elastic bar strikes a rigid wall; when all of it is at rest under pressure, its outer half is taken away.
$ Source      one-dimensional waves: the pressure rho c0 v ends at the cut at once, and at the wall L/2 c0 later, so that the
$             bar leaves the wall after 1.5 L/c0 = 297.2 microseconds instead of 2 L/c0; see wall_bar.i
$ Run         urto wall_bar_cut            a second
$ Look        colour wall_bar_cut.e by SIGXX: the bar is relieved from the cut on
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/wall_bar_cut.mesh: a bar of 50 x 1 x 1 hexahedra, 1 x 0.01 x 0.01 m along x; block 2 is its outer half,
$             and side set 100 its end at x = 0
TITLE
 ELASTIC BAR ON A RIGID WALL, CUT IN TWO
TERMINATION TIME, 400.E-6
OUTPUT TIME, 1.E-6
PLOT TIME, 1.E-6
PLOT NODAL, VELOCITY, REACTION
PLOT ELEMENT, STRESS
RIGID SURFACE, 100, 0., 0., 0., 1., 0., 0.
INITIAL VELOCITY MATERIAL, 1, -5., 0., 0.
INITIAL VELOCITY MATERIAL, 2, -5., 0., 0.
DELETE MATERIAL, 2, 198.1E-6
ACTIVE LIMITS, 1, 0., 500.E-6              $ longer than the run
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 2, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
