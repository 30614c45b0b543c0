$ Taylor bar: a copper cylinder strikes a rigid wall and mushrooms.
$ Source      the copper bar that many codes have run: length 21.4 mm and foot radius 7.2 mm are expected,
$             see docs/verification.md, V-15
$ Run         urto taylor_bar          quarter model, 8 cells along half the radius
$ Look        colour taylor_bar.e by EQPS: urto view taylor_bar.e --variable EQPS --mirror xy
$ See also    taylor_bar_wall.i, where the rim of the foot may leave the wall, and does
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/taylor_bar.mesh: node set 1 is x = 0, 2 is y = 0, 3 the foot
TITLE
 TAYLOR BAR, COPPER, 227 M/S
TERMINATION TIME, 80.E-6
OUTPUT TIME, 2.E-6
PLOT TIME, 4.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, VONMISES, ENERGY
PLOT STATE, EQPS
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3          $ the foot slides on the wall and stays on it, as in the published runs
INITIAL VELOCITY MATERIAL, 1, 0., 0., -227.
MATERIAL, 1, ELASTIC PLASTIC, 8930.
YOUNGS MODULUS = 117.E9
POISSONS RATIO = 0.35
YIELD STRESS = 400.E6
HARDENING MODULUS = 100.E6
BETA = 1.0
END
EXIT
