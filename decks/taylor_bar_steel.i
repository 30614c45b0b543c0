$ Taylor bar of steel by Johnson and Cook: strength of strain, strain rate and heat, against published runs.
$ Source      O. Pantale, documentation of the code DynELA 4.0 (2020), "3D Taylor impact", where the bar was also run by
$             Abaqus/Explicit; the material is that of L. Ming and O. Pantale, Mechanics & Industry 19, 308 (2018). Expected:
$             length 26.52 (26.55) mm, foot diameter 11.18 (11.22) mm, hottest element 597 C; see docs/verification.md
$ Run         urto taylor_bar_steel    quarter model, 3 cells along half the radius, as coarse as published
$ Look        colour taylor_bar_steel.e by TEMP: urto view taylor_bar_steel.e --variable TEMP --mirror xy
$ Units       t, mm, s  -> N, MPa, mJ; degrees Celsius
$ Mesh        meshes/taylor_bar_steel.mesh: node set 1 is x = 0, 2 is y = 0, 3 the foot
TITLE
 TAYLOR BAR, 42CRMO4 STEEL, 287 M/S
TERMINATION TIME, 80.E-6
OUTPUT TIME, 2.E-6
PLOT TIME, 4.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, PRESSURE, VONMISES
PLOT STATE, EQPS, TEMP
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3          $ as published: the foot slides without friction and stays on the wall
INITIAL VELOCITY MATERIAL, 1, 0., 0., -287.E3
MATERIAL, 1, JOHNSON COOK, 7.83E-9
YOUNGS MODULUS = 206.9E3
POISSONS RATIO = 0.3
YIELD STRESS = 806.
HARDENING CONSTANT = 614.
HARDENING EXPONENT = 0.168
RATE CONSTANT = 0.0089
REFERENCE RATE = 1.
THERMAL EXPONENT = 1.1
REFERENCE TEMPERATURE = 20.
MELT TEMPERATURE = 1540.
SPECIFIC HEAT = 460.E6
HEAT FRACTION = 0.9
END
EXIT
