$ A blunt steel rod goes through a steel plate: the plug is cut out by elements that fail at a plastic strain.
$ Source      Boervik, Langseth, Hopperstad and Malo: ballistic limit 184.5 m/s, residual velocity about 200 m/s at 303.5;
$             verification V-32. A failure strain is a crude law of fracture; see docs/verification.md
$ Run         urto perforation           half a minute on two cores
$ Look        urto view perforation.e -v EQPS
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/perforation.mesh; block 1 middle of the plate, 3 its outer ring, 2 rod
TITLE
 BLUNT ROD THROUGH A 12 MM PLATE, 303.5 M/S
TERMINATION TIME, 300.E-6
OUTPUT TIME, 1.E-6
PLOT TIME, 5.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, VONMISES
PLOT STATE, EQPS
HISTORY, BLOCK, 2                          $ how fast the rod still is: VELZ_BLOCK2
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, X, 3
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, Z, 3
INITIAL VELOCITY MATERIAL, 2, 0., 0., -303.5
CONTACT MATERIAL, 1, 2
DEATH, 1, EQPS, MAX, 1.0
DEATH, 1, VOLUME, MIN, 0.2
MATERIAL, 1, ELASTIC PLASTIC, 7850.        $ Weldox 460 E, at the strain rates of the plug
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.33
YIELD STRESS = 600.E6
HARDENING MODULUS = 400.E6
BETA = 1.
END
MATERIAL, 3, ELASTIC PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.33
YIELD STRESS = 600.E6
HARDENING MODULUS = 400.E6
BETA = 1.
END
MATERIAL, 2, ELASTIC PLASTIC, 7850.        $ hardened rod, HRC 53
YOUNGS MODULUS = 204.E9
POISSONS RATIO = 0.33
YIELD STRESS = 1900.E6
HARDENING MODULUS = 15.E9
BETA = 1.
END
EXIT
