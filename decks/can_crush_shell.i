$ The can of can_crush.i with shells: both sides of the wall touch at half of its thickness, the folds too.
$ Source      the can crush of the PRONTO3D paper (Attaway et al. 1996); see can_crush.i
$ Run         urto can_crush_shell
$ Look        urto view can_crush_shell.e -v EQPS_T -f front --mirror y -t 1.6e-3, and at 3.2e-3
$ Units       inch, second, pound-force  -> psi, lb s2/in
$ Mesh        meshes/can_crush_shell.mesh: 3952 elements; block 1 can, block 2 plate; node sets 1 symmetry plane, 100 bottom
TITLE
 STEEL CAN OF SHELLS CRUSHED BY A PLATE TILTED 10 DEGREES, HALF MODEL
TERMINATION TIME, 4.3E-3
OUTPUT TIME, 2.E-5
PLOT TIME, 1.E-4
PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT
PLOT ELEMENT, VONMISES
PLOT STATE, EQPS
NO DISPLACEMENT, Y, 1
NO ROTATION, X, 1
NO ROTATION, Z, 1
NO DISPLACEMENT, X, 100
NO DISPLACEMENT, Y, 100
NO DISPLACEMENT, Z, 100
NO ROTATION, X, 100
NO ROTATION, Y, 100
NO ROTATION, Z, 100
SHELL THICKNESS, 1, 0.25
INITIAL VELOCITY MATERIAL, 2, 0., 0., -5000.
CONTACT MATERIAL, 1, 2
MATERIAL, 1, ELASTIC PLASTIC, 7.324E-4
YOUNGS MODULUS = 30.E6
POISSONS RATIO = 0.3
YIELD STRESS = 50.E3
HARDENING MODULUS = 3.E5
BETA = 1.
END
MATERIAL, 2, ELASTIC PLASTIC, 7.324E-4
YOUNGS MODULUS = 30.E6
POISSONS RATIO = 0.3
YIELD STRESS = 50.E3
HARDENING MODULUS = 3.E5
BETA = 1.
END
EXIT
