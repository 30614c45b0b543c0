$ Three strips of sheet, held at one end and bent at the other: by a moment, by a given rotation, by a given rate of rotation.
$ A strip of length l and stiffness E I that is bent by a moment M becomes an arc of the angle M l/(E I): half a circle here
$ (verification S1).
TITLE
 STRIPS OF SHEET, BENT
TERMINATION TIME, 0.4
OUTPUT TIME, 0.02
PLOT TIME, 0.02
PLOT NODAL, DISPLACEMENT, ROTATION, ROTATION RATE
PLOT ELEMENT, STRESS, VONMISES, THICKNESS, RESULTANTS
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
NO ROTATION, X, 1
NO ROTATION, Y, 1
NO ROTATION, Z, 1
FUNCTION, 1                                 $ smooth enough not to ring
0.,    0.
0.02,  0.008
0.06,  0.08
0.18,  0.5
0.30,  0.92
0.34,  0.992
0.36,  1.
END
FUNCTION, 2
0.,    0.
0.1,   1.
0.2,   1.
0.3,   0.
END
PRESCRIBED MOMENT, Y, 11, 1, -1047.19755      $ pi E I/(2 l) at each of two nodes: half a circle
PRESCRIBED ROTATION, Y, 12, 1, -1.5
PRESCRIBED ANGULAR VELOCITY, Y, 13, 2, -7.5
SHELL THICKNESS, 1, 2.E-2
SHELL THICKNESS, 2, 4.E-2
THICKNESS SCALE, 2, 0.5                     $ as thick as the others
SHELL THICKNESS, 3, 2.E-2
INTEGRATION POINTS, 2, 3, LOBATTO
INTEGRATION POINTS, 3, 5, TRAPEZOID
MATERIAL, 1, ELASTIC, 1000.
YOUNGS MODULUS = 1.E10
POISSONS RATIO = 0.
END
MATERIAL, 2, ELASTIC, 1000.
YOUNGS MODULUS = 1.E10
POISSONS RATIO = 0.
END
MATERIAL, 3, PIECEWISE PLASTIC, 1000.
YOUNGS MODULUS = 1.E10
POISSONS RATIO = 0.3
HARDENING FUNCTION = 3
RATE COEFFICIENT = 40.
RATE EXPONENT = 5.
END
FUNCTION, 3                                 $ yield stress over plastic strain
0.,    5.E6
0.01,  8.E6
0.1,   10.E6
END
EXIT
