$ A column of TNT is lit at a rigid wall and burns through.
$ Source      parameters published with the JWL equation: front at 6930 m/s, 21.0 GPa behind it, falling towards the wall;
$             see docs/verification.md, V-30
$ Run         urto detonation            a second
$ Look        colour detonation.e by PRESSURE, then by BURN
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/detonation.mesh: 200 cubes of 0.5 mm in a row; node set 1 is the wall
TITLE
 TNT, LIT AT A WALL
TERMINATION TIME, 12.E-6
OUTPUT TIME, 0.1E-6
PLOT TIME, 1.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, PRESSURE, ENERGY, DENSITY
PLOT STATE, BURN, LIGHTING
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, Z, 4
DETONATION POINT, 0., 0.25E-3, 0.25E-3
MATERIAL, 1, HYDRODYNAMIC, 1630.       $ TNT
PRESSURE CUTOFF = 0.
END
EQUATION OF STATE, 1, JWL
A = 371.2E9
B = 3.231E9
R1 = 4.15
R2 = 0.95
OMEGA = 0.30
INITIAL ENERGY = 7.0E9
DETONATION VELOCITY = 6930.
END
EXIT
