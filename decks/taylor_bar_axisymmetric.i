$ Taylor bar in two dimensions: the section of a copper cylinder, which strikes a rigid wall and mushrooms.
$ Source      as taylor_bar.i, of which this is the same body: length 21.4 mm and foot radius 7.2 mm are expected,
$             see docs/verification.md, V-15
$ Run         urto taylor_bar_axisymmetric          16 elements along the radius, as the foot of taylor_bar.i has
$ Look        urto view taylor_bar_axisymmetric.e -v EQPS, and with --revolve 270 as the body that it is
$ Units       kg, m, s  -> N, Pa, J; masses and forces are those of the whole bar
$ Mesh        meshes/taylor_bar_axisymmetric.mesh: x the radius, y the axis; node set 1 is the foot
TITLE
 TAYLOR BAR, COPPER, 227 M/S, AXISYMMETRIC
AXISYMMETRIC                   $ nodes on the axis need no NO DISPLACEMENT
TERMINATION TIME, 80.E-6
OUTPUT TIME, 2.E-6
PLOT TIME, 4.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, VONMISES, ENERGY
PLOT STATE, EQPS
NO DISPLACEMENT, Y, 1          $ the foot slides on the wall and stays on it, as in the published runs
INITIAL VELOCITY MATERIAL, 1, 0., -227.
MATERIAL, 1, ELASTIC PLASTIC, 8930.
YOUNGS MODULUS = 117.E9
POISSONS RATIO = 0.35
YIELD STRESS = 400.E6
HARDENING MODULUS = 100.E6
BETA = 1.0
END
EXIT
