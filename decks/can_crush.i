$ A steel can crushed by a plate that falls on it tilted by 10 degrees; half of it, by symmetry. The wall folds, and the
$ folds touch each other.
$ Source      the can crush of the PRONTO3D paper (Attaway et al. 1996), with the mesh of ParaView's can.ex2; yield stress
$             and hardening were never published and are ours
$ Run         urto can_crush           about a minute on two cores
$ Look        urto view can_crush.e -v EQPS -f front --mirror y -t 1.6e-3, and at 3.2e-3
$ Units       inch, second, pound-force  -> psi, lb s2/in
$ Mesh        meshes/can_crush.mesh: 7152 elements; block 1 can, block 2 plate; node sets 1 symmetry plane, 100 bottom
TITLE
 STEEL CAN CRUSHED BY A PLATE TILTED 10 DEGREES, HALF MODEL
TERMINATION TIME, 4.3E-3
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
