$ The can crush with the plate that the paper's text gives: 22 x 11 x 2.5 inches, with twice the energy of can_crush.
$ Source      the PRONTO3D paper (Attaway et al. 1996). It does not say whether 22 x 11 is the whole plate or the half that
$             is modelled; taken as the half here, like the 16 x 8 of ParaView's can.ex2. Yield stress and hardening were
$             never published and are ours; the density is 0.2833 lb/in3
$ Run         urto can_crush_paper     about a minute on two cores
$ Look        urto view can_crush_paper.e -v EQPS -f front --mirror y -t 1.6e-3
$ Units       inch, second, pound-force  -> psi, lb s2/in
$ Mesh        meshes/can_crush_paper.mesh: 7152 elements; block 1 can, block 2 plate; node sets 1 symmetry plane, 100 bottom
TITLE
 STEEL CAN CRUSHED BY THE 22 X 11 INCH PLATE OF THE PAPER, HALF MODEL
TERMINATION TIME, 3.2E-3
OUTPUT TIME, 2.E-5
PLOT TIME, 1.E-4
PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT
PLOT ELEMENT, VONMISES
PLOT STATE, EQPS
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, X, 100
NO DISPLACEMENT, Y, 100
NO DISPLACEMENT, Z, 100
INITIAL VELOCITY MATERIAL, 2, 0., 0., -5000.
CONTACT MATERIAL, 1, 2
MATERIAL, 1, ELASTIC PLASTIC, 7.34E-4
YOUNGS MODULUS = 30.E6
POISSONS RATIO = 0.3
YIELD STRESS = 50.E3
HARDENING MODULUS = 3.E5
BETA = 1.
END
MATERIAL, 2, ELASTIC PLASTIC, 7.34E-4
YOUNGS MODULUS = 30.E6
POISSONS RATIO = 0.3
YIELD STRESS = 50.E3
HARDENING MODULUS = 3.E5
BETA = 1.
END
EXIT
