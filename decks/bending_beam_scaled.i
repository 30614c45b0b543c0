$ Bending beam, scaled form: the part of one rank, 6480 elements. Half of a pinned beam in plane strain, suddenly pressed.
$ Source      SAND96-0593C, "Bending Beam", after Flanagan and Belytschko (1982); span 20 in, depth 1 in.
$             Timoshenko's series gives a first peak of 4.722E-3 in at 4.254 ms (docs/verification.md, V-11)
$ Run         urto bending_beam_scaled          6480 elements; urto scale bending_beam_scaled --scaled for more ranks
$ Look        colour bending_beam_scaled.e by SIGXX, displacements magnified: urto view bending_beam_scaled.e -v SIGXX --magnify 200
$ Units       in, lbf, s
$ Mesh        meshes/bending_beam_scaled.mesh: node sets 1 symmetry plane, 2 pin line, 3 front and back; side set 100 top
TITLE
 BENDING BEAM, UNIFORM PRESSURE, SYMMETRY PLANE, PINNED END
TERMINATION TIME, 1.E-3
OUTPUT TIME, 1.E-4
PLOT TIME, 2.5E-4
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, VONMISES
NO DISPLACEMENT, X, 1          $ symmetry
NO DISPLACEMENT, Z, 2          $ pin line at mid-depth
NO DISPLACEMENT, Y, 3          $ plane strain
FUNCTION, 1
0., 1.
1., 1.
END
PRESSURE, 100, 1, 1.
MATERIAL, 1, ELASTIC, 1.E-3
YOUNGS MODULUS = 1.E7
POISSONS RATIO = 0.25
END
EXIT
