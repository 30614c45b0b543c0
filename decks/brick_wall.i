$ A rod of soft steel hits a stack of 17 bricks that leans on a wall. Everything flies: 19 bodies, each of which may hit
$ any other, and nobody says which.
$ Source      the brick wall of the PRONTO3D paper (Attaway et al. 1996): 17 elastic bricks, elastic-plastic rod and wall,
$             8400 elements; sizes, speed and materials were never published and are ours
$ Run         urto brick_wall           about a minute on two cores
$ Look        urto view brick_wall.e -v none -f 240,20 --animate
$ Units       inch, second, pound-force  -> psi, lb s2/in
$ Mesh        meshes/brick_wall.mesh: block 1 rod, 2 bricks, 3 half bricks, 4 wall; no sets, as nothing is held
TITLE
 ROD INTO A STACK OF 17 BRICKS AND A WALL
TERMINATION TIME, 15.E-3
OUTPUT TIME, 1.E-4
PLOT TIME, 2.5E-4
PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT
PLOT ELEMENT, VONMISES, PRESSURE
PLOT STATE, EQPS
INITIAL VELOCITY MATERIAL, 1, -417.519, 2970.804, 0.    $ 3000 in/s along the rod
CONTACT MATERIAL
MATERIAL, 1, ELASTIC PLASTIC, 7.324E-4                  $ soft steel
YOUNGS MODULUS = 30.E6
POISSONS RATIO = 0.3
YIELD STRESS = 36.E3
HARDENING MODULUS = 2.E5
BETA = 1.
END
MATERIAL, 2, ELASTIC, 2.2E-4                            $ bricks that never break
YOUNGS MODULUS = 3.E6
POISSONS RATIO = 0.2
END
MATERIAL, 3, ELASTIC, 2.2E-4
YOUNGS MODULUS = 3.E6
POISSONS RATIO = 0.2
END
MATERIAL, 4, ELASTIC PLASTIC, 2.5E-4                    $ soft aluminium
YOUNGS MODULUS = 10.E6
POISSONS RATIO = 0.33
YIELD STRESS = 8.E3
HARDENING MODULUS = 1.E5
BETA = 1.
END
EXIT
