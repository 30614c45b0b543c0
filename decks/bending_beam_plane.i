$ Bending beam in two dimensions: half of a pinned beam in plane strain, suddenly pressed.
$ Source      as bending_beam.i; Timoshenko's series gives a first peak of 4.722E-3 in at 4.254 ms
$             (docs/verification.md, V-11)
$ Run         urto bending_beam_plane          160 elements, 205 nodes
$ Look        urto view bending_beam_plane.e -v SIGXX --magnify 200
$ Units       in, lbf, s; forces and energies are those of one inch of thickness
$ Mesh        meshes/bending_beam_plane.mesh: node sets 1 symmetry plane, 2 pin; side set 100 top
TITLE
 BENDING BEAM, UNIFORM PRESSURE, SYMMETRY PLANE, PINNED END, IN TWO DIMENSIONS
PLANE STRAIN
TERMINATION TIME, 6.5E-3
OUTPUT TIME, 1.E-4
PLOT TIME, 2.5E-4
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, VONMISES
NO DISPLACEMENT, X, 1          $ symmetry
NO DISPLACEMENT, Y, 2          $ pin at mid-depth
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
