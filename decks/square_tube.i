$ A square tube that folds: its head is driven down at 10 m/s, its foot stands on a rigid plane. Fold after fold forms, each
$ lies upon the one before, and the force rises and falls about a mean that Wierzbicki and Abramowicz have foretold.
$ Source      width c = 37.07 mm, wall t = 1.152 mm, flow stress 300 MPa (verification V-33): with the effective stroke
$             the mean force is 13.06 x 300 MPa x t^(5/3) c^(1/3) = 16.5 kN, a quarter of which acts here
$ Run         urto square_tube
$ Look        urto view square_tube.e -v VONMISES --mirror xy -t 8.E-3; urto plot square_tube.h
$ Units       metre, second, kilogramme  -> Pa
$ Mesh        meshes/square_tube.mesh: 960 elements; node sets 1 and 2 symmetry planes, 3 head, 11 and 12 where it is pushed;
$             side set 100 all
TITLE
 SQUARE TUBE, PROGRESSIVE FOLDING, QUARTER MODEL
TERMINATION TIME, 9.E-3
OUTPUT TIME, 1.E-4
PLOT TIME, 1.5E-4
PLOT NODAL, DISPLACEMENT, VELOCITY, REACTION, CONTACT
PLOT ELEMENT, VONMISES, THICKNESS
PLOT STATE, EQPS
NO DISPLACEMENT, Y, 1
NO ROTATION, X, 1
NO ROTATION, Z, 1
NO DISPLACEMENT, X, 2
NO ROTATION, Y, 2
NO ROTATION, Z, 2
NO DISPLACEMENT, X, 3
NO DISPLACEMENT, Y, 3
NO ROTATION, X, 3
NO ROTATION, Y, 3
NO ROTATION, Z, 3
FUNCTION, 1                                 $ the head, which comes to its speed in half a millisecond
0.,      0.
0.5E-3,  1.
1.,      1.
END
PRESCRIBED VELOCITY, Z, 3, 1, -10.
FUNCTION, 2                                 $ a push in place of an imperfection: one side inwards, the other outwards
0.,      0.
0.1E-3,  1.
0.5E-3,  1.
0.6E-3,  0.
1.,      0.
END
PRESCRIBED FORCE, X, 11, 2, -20.
PRESCRIBED FORCE, Y, 12, 2, 20.
RIGID SURFACE, 100, 0., 0., -0.576E-3, 0., 0., 1., 0.2
CONTACT MATERIAL, 1
CONTACT DATA, 1, 1, 0.1
CONTACT THICKNESS, 1, 1.                    $ 0.9 would let the folds lie nearer to each other than the wall is thick
SHELL THICKNESS, 1, 1.152E-3
MATERIAL, 1, PIECEWISE PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
HARDENING FUNCTION = 3
END
FUNCTION, 3                                 $ yield stress over plastic strain: the flow stress of the formula
0.,    300.E6
1.,    300.1E6
END
EXIT
