$ Two blocks whose meshes do not match, one on the other under uniform pressure: a patch test of contact.
$ Source      the stress is -100 MPa along z everywhere, and nothing else; see docs/verification.md, V-27
$ Run         urto contact_patch       a second
$ Look        colour contact_patch.e by SIGZZ: one colour, but for what contact leaves
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/contact_patch.mesh: two cubes of 0.1 m, block 1 below in 3 x 3 x 3 hexahedra, block 2 above in 4 x 4 x 4;
$             node sets 1, 2, 3 are the planes x = 0, y = 0, z = 0, side set 100 is the top
TITLE
 PATCH TEST OF CONTACT, 4 X 4 FACES ON 3 X 3
TERMINATION TIME, 4.E-3
HOURGLASS STIFFENING, 0.05, 0.03
OUTPUT TIME, 10.E-6
PLOT TIME, 10.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT
PLOT ELEMENT, STRESS
FUNCTION, 1              $ half a period of a cosine, many times longer than the blocks' own
0.,       0.
0.2E-3,   0.02447
0.4E-3,   0.09549
0.6E-3,   0.20611
0.8E-3,   0.34549
1.0E-3,   0.5
1.2E-3,   0.65451
1.4E-3,   0.79389
1.6E-3,   0.90451
1.8E-3,   0.97553
2.0E-3,   1.
END
PRESSURE, 100, 1, 100.E6
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3
CONTACT MATERIAL, 1, 2
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
MATERIAL, 2, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
EXIT
