$ A block slides over a rough plane until friction has taken all its energy.
$ Source      Coulomb friction: deceleration mu g = 294.3 m/s2; stop after v0/(mu g) = 10.19 ms and v0^2/(2 mu g) =
$             15.29 mm under full gravity; see docs/verification.md, V-25
$ Run         urto sliding_block        a few seconds
$ Look        VELX of any node falls on a straight line; FRICE in sliding_block.o rises to the initial energy
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/sliding_block.mesh: 4 x 4 x 4 hexahedra, a cube of 0.1 m about the origin; side set 100 is its surface
TITLE
 BLOCK SLIDING ON A ROUGH PLANE
TERMINATION TIME, 12.E-3
$ An undamped block squeals: friction feeds its vibrations, and its nodes lose energy where they strike the plane.
HOURGLASS STIFFENING, 0.05, 0.03
OUTPUT TIME, 10.E-6
PLOT TIME, 10.E-6
PLOT NODAL, VELOCITY, REACTION
FUNCTION, 1              $ gravity comes slowly: the block must not bounce
0.,      0.
1.E-3,   1.
END
GRAVITY, 0., 0., -981., 1
RIGID SURFACE, 100, 0., 0., -0.05, 0., 0., 1., 0.3
INITIAL VELOCITY MATERIAL, 1, 3., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
EXIT
