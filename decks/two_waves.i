$ A strong plane wave in steel splits in two: an elastic precursor, and a slower plastic wave behind it.
$ Source      precursor -700 MPa at 5856.4 m/s, plastic wave -3774 MPa at 4619.9 m/s, plastic strain 0.01213;
$             see docs/verification.md, V-03
$ Run         urto two_waves            a second
$ Look        colour two_waves.e by SIGXX, then by EQPS
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/two_waves.mesh: 400 cubes of 0.25 mm in a row, as for uniaxial_wave.i
TITLE
 ELASTIC PRECURSOR AND PLASTIC WAVE
TERMINATION TIME, 12.E-6
OUTPUT TIME, 0.1E-6
PLOT TIME, 1.E-6
PLOT ELEMENT, STRESS
PLOT STATE, EQPS
FUNCTION, 1
0.,      1.
END
PRESCRIBED VELOCITY, X, 1, 1, 100.
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, Z, 4
MATERIAL, 1, ELASTIC PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
YIELD STRESS = 400.E6
HARDENING MODULUS = 2.E9
BETA = 1.0
END
EXIT
