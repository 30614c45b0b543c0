$ A beam on two pins vibrates in its plane after a pressure has been put on it at once; half of it is modelled.
$ Source      Timoshenko series: the middle comes to 4.722E-3 in after 4.254 ms; see docs/verification.md, V-11.
$             One-point hexahedra with weak hourglass control are up to 20 % too soft here
$ Run         urto bending_beam_4      a second
$ Look        DISPLZ of the middle over time
$ Units       pound-force s2/in, in, s  -> pound-force, psi, in pound-force
$ Mesh        meshes/bending_beam_4.mesh: 40 x 1 x 4 hexahedra, 10 x 0.25 x 1 in; node set 1 is the plane of symmetry
$             x = 0, node set 2 the pin, the line x = 10, z = 0.5, node set 3 both sides; side set 100 is the top
TITLE
 VIBRATING BEAM, PLANE STRAIN
TERMINATION TIME, 6.5E-3
OUTPUT TIME, 65.E-6
PLOT TIME, 10.E-6
PLOT NODAL, DISPLACEMENT
FUNCTION, 1
0.,      1.
END
PRESSURE, 100, 1, 1.
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, X, 2
NO DISPLACEMENT, Z, 2
MATERIAL, 1, ELASTIC, 1.E-3
YOUNGS MODULUS = 1.E7
POISSONS RATIO = 0.25
END
EXIT
