$ The first of five equal bars in a row has a velocity; only the last flies off.
$ Source      one-dimensional waves: what goes in at one end goes out at the other; see docs/verification.md, V-26
$ Run         urto newtons_cradle      a few seconds
$ Look        colour newtons_cradle.e by VELX: one wave, one bar long, runs through the row
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/newtons_cradle.mesh: five bars of 50 x 1 x 1 hexahedra, 1 x 0.01 x 0.01 m, end to end along x; blocks 1
$             to 5 from left to right
TITLE
 NEWTON'S CRADLE OF FIVE BARS, 5 M/S
TERMINATION TIME, 1.4E-3
OUTPUT TIME, 10.E-6
PLOT TIME, 10.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, MASS, CONTACT
CONTACT MATERIAL
INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 2, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 3, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 4, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
MATERIAL, 5, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
