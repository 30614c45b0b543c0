$ A plane wave of uniaxial strain in an elastic half space.
$ Source      stress -rho cL v = -459.7 MPa across the front, which runs at cL = 5856.4 m/s; sideways nu/(1 - nu) times
$             that; see docs/verification.md, V-02
$ Run         urto uniaxial_wave       a second
$ Look        colour uniaxial_wave.e by SIGXX; BULK VISCOSITY, 0., 0. shows what the viscosity is good for
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/uniaxial_wave.mesh: a column of 400 cubes, 0.1 m along x; node set 1 is the end x = 0, node sets
$             3 and 4 are the sides
TITLE
 WAVE OF UNIAXIAL STRAIN
TERMINATION TIME, 12.E-6
OUTPUT TIME, 0.1E-6
PLOT TIME, 1.E-6
PLOT ELEMENT, STRESS
FUNCTION, 1
0.,      1.
END
PRESCRIBED VELOCITY, X, 1, 1, 10.
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, Z, 4
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
END
EXIT
