$ The elastic bar of wall_bar.i goes on where that run stopped, and flies away from the wall.
$ Source      as wall_bar.i; a run of this length that never stopped has the same bits
$ Run         urto wall_bar && urto wall_bar_further --restart wall_bar.rsout            a second
$ Look        colour wall_bar_further.e by SIGXX: the waves that are left in the bar run to and fro
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/wall_bar_further.mesh, which is that of wall_bar.i
TITLE
 ELASTIC BAR ON A RIGID WALL, 5 M/S, FURTHER
READ RESTART, 600.E-6
TERMINATION TIME, 1000.E-6
OUTPUT TIME, 10.E-6
PLOT TIME, 10.E-6
PLOT NODAL, VELOCITY, REACTION
PLOT ELEMENT, STRESS
RIGID SURFACE, 100, 0., 0., 0., 1., 0., 0.
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.
END
EXIT
