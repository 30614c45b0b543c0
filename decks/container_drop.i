$ Container drop: a steel container with cargo in foam falls from 5 m on a punch, as a body of revolution.
$ Source      in the manner of PRONTO2D's problems of 1988; dimensions and materials are our own
$ Run         urto container_drop          1692 quadrilaterals, three pairs of contact surfaces
$ Look        urto view container_drop.e -v EQPS --state t=5.E-3, and with --revolve 270
$ Units       kg, m, s  -> N, Pa, J; masses, forces and energies are those of the whole turn
$ Mesh        meshes/container_drop.mesh: block 1 container, 2 foam, 3 cargo, 4 punch; node set 11 the base of the punch
TITLE
 CONTAINER WITH FOAM AND CARGO, 5 M DROP ON A PUNCH
AXISYMMETRIC
TERMINATION TIME, 7.E-3
OUTPUT TIME, 2.5E-4
PLOT TIME, 5.E-4
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, VONMISES, ENERGY
PLOT STATE, EQPS
HISTORY BLOCK, 1, 3
INITIAL VELOCITY MATERIAL, 1, 0., -9.9
INITIAL VELOCITY MATERIAL, 2, 0., -9.9
INITIAL VELOCITY MATERIAL, 3, 0., -9.9
NO DISPLACEMENT, X, 11
NO DISPLACEMENT, Y, 11
CONTACT SURFACE, 100, 999
CONTACT SURFACE, 200, 300, 0.2, 1.0          $ the container is the master of the foam
CONTACT SURFACE, 400, 500, 0.2, 0.0          $ and so is the cargo
MATERIAL, 1, ELASTIC PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
YIELD STRESS = 250.E6
HARDENING MODULUS = 2.E9
BETA = 0.
END
MATERIAL, 2, LOW DEN FOAM, 110.
YOUNGS MODULUS = 30.E6
A = 0.5E6
B = 0.6E6
C = -0.6
P0 = 1.E5
NAIR = 1.
PHI = 0.1
END
MATERIAL, 3, ELASTIC PLASTIC, 2700.
YOUNGS MODULUS = 70.E9
POISSONS RATIO = 0.3
YIELD STRESS = 300.E6
HARDENING MODULUS = 2.E9
BETA = 1.
END
MATERIAL, 4, ELASTIC PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
YIELD STRESS = 600.E6
HARDENING MODULUS = 2.E9
BETA = 1.
END
EXIT
