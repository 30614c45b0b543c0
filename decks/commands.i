$ Every command: a bar of two metals meets a floor while it is pushed, pulled, twisted and pressed.
$ Source      none: this deck shows every command that is built, in one problem that makes sense
$ Run         urto commands            less than a second
$ Look        colour commands.e by EQPS; the energy balance in the last lines of commands.o
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/commands.mesh: a bar of 2 x 2 x 8 hexahedra, 0.01 x 0.01 x 0.04 m with a corner at the origin, along
$             z; block 1 is the lower half, block 2 the upper. Node sets: 1 the plane x = 0, 2 the plane y = 0, 3 the
$             bottom, 4 the top, 5 the edge x = y = 0.01. Side sets: 100 the bottom, 200 the top, 300 the face x = 0.01
TITLE
 BAR OF TWO METALS ON A FLOOR - all commands
TERMINATION TIME, 50.E-6
TIME STEP SCALE, 0.9
TIME STEP GROWTH, 1.05
TIME STEP MODULI, ELASTIC
PRECISION, DOUBLE
SPIN, FIRST ORDER
BULK VISCOSITY, 0.06, 1.2
HOURGLASS STIFFENING, 0.05, 0.0
HOURGLASS CONTROL, FLANAGAN BELYTSCHKO

OUTPUT TIME, 1.E-6
STEP LOG, TIME STEP, ENERGY, TO GO, MOMENTUM
WRITE RESTART, 10.E-6, 3                             $ to go on from: READ RESTART, 40.E-6
PLOT TIME, 5.E-6, 0., 50.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION, REACTION
PLOT ELEMENT, STRESS, STRAIN, PRESSURE, VONMISES, *
              ENERGY, DENSITY
PLOT STATE, EQPS
PLOT GLOBAL, BLOCK ENERGY
MATERIAL POINT, 2.E-3, 2.E-3, 1.E-3                 $ near the floor
MATERIAL POINT, 2.E-3, 2.E-3, 39.E-3                $ near the top
HISTORY TIME, 0.5E-6
HISTORY, BLOCK                                      $ both halves as bodies
HISTORY, NODE SET, 4, 5                             $ what moves the top, and the edge that is driven
HISTORY, NODE, 1
HISTORY, CONTACT, 1, 2                              $ what the upper half does to the lower where they touch

FUNCTION, 1              $ a ramp, then constant
0.,      0.
5.E-6,   1.
END
FUNCTION, 2              $ constant
0.,      1.
END
FUNCTION, 3              $ the time itself: a displacement at constant velocity
0.,      0.
1.,      1.
END

MATERIAL, 1, ELASTIC PLASTIC, 8930.       $ copper
YOUNGS MODULUS = 117.E9
POISSONS RATIO = 0.35
YIELD STRESS = 400.E6
HARDENING MODULUS = 100.E6
BETA = 1.0
END
MATERIAL, 2, ELASTIC, 2700.               $ aluminium
YOUNGS MODULUS = 70.E9
POISSONS RATIO = 0.33
END

INITIAL VELOCITY RADIAL, 1, 5., 0., 0., 0., 0., 0., 1.   $ away from the axis; what follows holds instead
INITIAL VELOCITY MATERIAL, 1, 0., 0., -50.
INITIAL VELOCITY MATERIAL, 2, 0., 0., -50.
INITIAL VELOCITY NODESET, 4, 0., 0., -40.
INITIAL VELOCITY ANGULAR, 2, 100., 0., 0., 0., 0., 0., 1.

RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.1      $ the floor, rough
CONTACT MATERIAL, 1, 2                              $ wherever the bar may meet itself
CONTACT DATA, 1, 2, 0.2, 0.5
CONTACT EXCLUSION, 2                                $ the upper half never touches itself
CONTACT SURFACE, 100, 300, 0.1, 0.5
CONTACT NODE SET, 1                                 $ nodes that may be inside a block or on it
CONTACT PASSES, 10, 1.E-6
CONTACT SEARCH, GRID, 10, 0.05
CONTACT EDGES, ON
CONTACT OVERLAP, REMOVE
CONTACT ENERGY LIMIT, 0.05                          $ what contact may make before the run stops
CONTACT DECOMPOSITION, RCB                          $ on many ranks: boxes that follow the bar
NO DISPLACEMENT, Y, 2                               $ plane of symmetry
PRESCRIBED DISPLACEMENT, Z, 4, 3, -40.              $ the top comes down at 40 m/s
PRESCRIBED ACCELERATION, X, 1, 1, 1.E5
PRESCRIBED VELOCITY, Y, 5, 1, 2.
PRESCRIBED FORCE, X, 5, 1, 10.
PRESSURE, 300, 1, 1.E6
SILENT BC, 200                                      $ waves may leave through the top, were it not driven: check says so
GRAVITY, 0., 0., -9.81, 2
EXIT
