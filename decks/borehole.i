$ A charge that is lit in a borehole sends a wave into the rock, which leaves through a silent boundary.
$ Source      none: an example of an explosive beside SOIL N FOAMS and SILENT BC. The explosive has constants of the kind
$             that are published for ANFO, the rock simple ones
$ Run         urto borehole            seconds
$ Look        colour borehole.e by PRESSURE: urto view borehole.e --variable PRESSURE --mirror xy; then by EVFRAC, where
$             the rock has been pulled apart
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/borehole.mesh: block 1 the charge, 2 the rock; node sets 1 to 4 the planes that bound the quarter of a
$             slab, side set 500 the cylinder around it
TITLE
 CYLINDRICAL CHARGE IN ROCK
TERMINATION TIME, 0.3E-3
OUTPUT TIME, 5.E-6
PLOT TIME, 15.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, VONMISES, BULKQ, STRETCH, ROTATION
PLOT STATE, BURN, EVFRAC
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3          $ a slab of a long hole
NO DISPLACEMENT, Z, 4
SILENT BC, 500
DETONATION POINT, 0., 0., 0.
TIME STEP SCALE, 0.5
MATERIAL, 1, HYDRODYNAMIC, 800.
PRESSURE CUTOFF = 0.
END
EQUATION OF STATE, 1, JWL
A = 49.46E9
B = 1.891E9
R1 = 3.907
R2 = 1.118
OMEGA = 0.333333
INITIAL ENERGY = 2.484E9
DETONATION VELOCITY = 4160.
END
MATERIAL, 2, SOIL N FOAMS, 2300.
TWO MU = 20.E9
BULK MODULUS = 15.E9
A0 = 20.E6
A1 = 0.9
A2 = 0.
PRESSURE CUTOFF = -2.E6
FUNCTION ID = 1
END
FUNCTION, 1                    $ pressure against volumetric strain: pores close above 45 MPa
0.,    0.
0.003, 45.E6
0.1,   0.9E9
0.3,   3.9E9
END
EXIT
