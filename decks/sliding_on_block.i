$ A block slides over a rough plate until friction has taken all its energy; both are elastic.
$ Source      Coulomb friction: deceleration mu g = 294.3 m/s2, stop after v0/(mu g) = 10.19 ms under full gravity; see
$             docs/verification.md, V-25. sliding_block.i is the same block on a rigid plane
$ Run         urto sliding_on_block     half a minute
$ Look        VELX of the block falls on a straight line; colour sliding_on_block.e by CONTZ
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/sliding_on_block.mesh: block 1 the sliding block, 0.1 x 0.1 x 0.05 m in 4 x 4 x 2 hexahedra; block 2 the
$             plate, whose faces are of another size; node set 1 is the underside of the plate
TITLE
 BLOCK SLIDING ON A ROUGH PLATE
TERMINATION TIME, 12.E-3
$ An undamped block squeals: friction feeds its vibrations, and its nodes lose energy where they strike the plate.
HOURGLASS STIFFENING, 0.05, 0.03
OUTPUT TIME, 10.E-6
PLOT TIME, 100.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, MASS, CONTACT
FUNCTION, 1              $ gravity comes slowly: the block must not bounce
0.,      0.
1.E-3,   1.
END
GRAVITY, 0., 0., -981., 1
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
CONTACT MATERIAL, 1, 2
CONTACT DATA, 1, 2, 0.3
INITIAL VELOCITY MATERIAL, 1, 3., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
MATERIAL, 2, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
EXIT
