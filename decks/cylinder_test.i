$ Cylinder test: a copper tube filled with TNT that is lit at its middle, as a body of revolution.
$ Source      the test by which equations of state of explosives are fitted: the wall flies at about 1.18 mm/us when it has moved
$             by 6 mm, at 1.40 mm/us by 19 mm (handbook values, as remembered); see docs/verification.md
$ Run         urto cylinder_test          1920 quadrilaterals, some seconds
$ Look        urto view cylinder_test.e -v PRESSURE --mirror x, and with --revolve 270
$ Units       kg, m, s  -> N, Pa, J; masses, forces and energies are those of the whole turn
$ Mesh        meshes/cylinder_test.mesh: block 1 TNT, 2 copper, joined; node sets 1 the wall at 90 mm, 2 the
$             middle of the tube, a plane of symmetry, and its end, closed by a plate on which it slides
TITLE
 COPPER TUBE WITH TNT, LIT AT ITS MIDDLE
AXISYMMETRIC
TERMINATION TIME, 32.E-6
OUTPUT TIME, 0.5E-6
PLOT TIME, 2.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, PRESSURE, VONMISES, ENERGY, DENSITY
PLOT STATE, BURN, EQPS
HISTORY TIME, 0.1E-6
HISTORY NODE SET, 1
NO DISPLACEMENT, Y, 2
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
DETONATION POINT, 0., 0.
MATERIAL, 2, EP HYDRODYNAMIC, 8930.    $ copper, annealed
YOUNGS MODULUS = 117.E9
POISSONS RATIO = 0.35
YIELD STRESS = 100.E6
HARDENING MODULUS = 200.E6
PRESSURE CUTOFF = -1.2E9
END
EQUATION OF STATE, 2, MG US-UP
C0 = 3940.
S = 1.489
GAMMA = 2.0
END
EXIT
