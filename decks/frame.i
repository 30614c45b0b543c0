$ A frame of beams with a roof of sheet: the ground under its posts is moved by an earthquake's pulse, and a heavy thing stands in
$ the middle of the roof. Posts are I beams, the ring is of round tube.
$ Look: urto view frame.e -v VONMISES, in beams the largest stress of a fibre; the posts flow at their feet, where EQPS is not zero.
TITLE
 FRAME OF BEAMS WITH A ROOF OF SHEET
TERMINATION TIME, 0.6
OUTPUT TIME, 0.02
PLOT TIME, 0.02
PLOT NODAL, DISPLACEMENT, VELOCITY, ROTATION
PLOT ELEMENT, STRESS, VONMISES, RESULTANTS
PLOT STATE, EQPS
PLOT GLOBAL, BLOCK ENERGY
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
NO ROTATION, X, 1
NO ROTATION, Y, 1
NO ROTATION, Z, 1
FUNCTION, 1                                     $ velocity of the ground
0.,    0.
0.1,   1.
0.2,  -1.
0.3,   1.
0.4,   0.
END
PRESCRIBED VELOCITY, X, 1, 1, 1.2
GRAVITY, 0., 0., -9.81
POINT MASS, 2, 400., 20.
BEAM SECTION, 1, I, 0.1, 0.06, 0.006, 0.004, 0., 1., 0.
BEAM SECTION, 2, TUBE, 0.04, 0.004
SHELL THICKNESS, 3, 5.E-3
MATERIAL, 1, PIECEWISE PLASTIC, 7850.
YOUNGS MODULUS = 210.E9
POISSONS RATIO = 0.3
HARDENING FUNCTION = 2
END
MATERIAL, 2, PIECEWISE PLASTIC, 7850.
YOUNGS MODULUS = 210.E9
POISSONS RATIO = 0.3
HARDENING FUNCTION = 2
END
MATERIAL, 3, PIECEWISE PLASTIC, 7850.
YOUNGS MODULUS = 210.E9
POISSONS RATIO = 0.3
HARDENING FUNCTION = 2
RATE COEFFICIENT = 40.
RATE EXPONENT = 5.
END
FUNCTION, 2                                     $ yield stress of mild steel over plastic strain
0.,    250.E6
0.02,  260.E6
0.1,   340.E6
0.3,   400.E6
END
EXIT
