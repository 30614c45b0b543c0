$ Taylor bar against a wall that can only push: the rim of the foot curls up and spreads wider.
$ Source      as taylor_bar.i, on a coarse mesh
$ Run         urto taylor_bar_wall     quarter model, 3 cells along half the radius; a second
$ Look        colour taylor_bar_wall.e by EQPS: urto view taylor_bar_wall.e --variable EQPS --mirror xy
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/taylor_bar_wall.mesh: node set 1 is x = 0, 2 is y = 0; side set 100 is the foot
TITLE
 TAYLOR BAR, COPPER, 227 M/S, WALL THAT ONLY PUSHES
TERMINATION TIME, 80.E-6
OUTPUT TIME, 2.E-6
PLOT TIME, 4.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, VONMISES, ENERGY
PLOT STATE, EQPS
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.
INITIAL VELOCITY MATERIAL, 1, 0., 0., -227.
MATERIAL, 1, ELASTIC PLASTIC, 8930.
YOUNGS MODULUS = 117.E9
POISSONS RATIO = 0.35
YIELD STRESS = 400.E6
HARDENING MODULUS = 100.E6
BETA = 1.0
END
EXIT
