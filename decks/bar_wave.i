$ A wave runs along a bar whose end is set in motion at once, and doubles at the far end, which is fixed.
$ Source      one-dimensional waves: stress -rho c0 v = -39.62 MPa behind a front that runs at c0 = 5047.5 m/s;
$             twice that behind its reflection; see docs/verification.md, V-01
$ Run         urto bar_wave            less than a second
$ Look        colour bar_wave.e by SIGXX
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/bar_wave.mesh: a bar of 200 x 1 x 1 hexahedra, 1 x 0.01 x 0.01 m along x; node set 1 is its end
$             x = 0, node set 2 its end x = 1
TITLE
 WAVE IN A BAR
TERMINATION TIME, 250.E-6
OUTPUT TIME, 5.E-6
PLOT TIME, 5.E-6
PLOT NODAL, VELOCITY
PLOT ELEMENT, STRESS
FUNCTION, 1
0.,      1.
END
PRESCRIBED VELOCITY, X, 1, 1
NO DISPLACEMENT, X, 2
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
