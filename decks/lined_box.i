$ A steel box, lined with foam, falls on a floor with a steel block inside: what does the block feel?
$ Source      ours; docs/tutorial.md goes through it
$ Run         urto lined_box             a few seconds on two cores
$ Look        urto plot lined_box.h -v ACCLZ_BLOCK3 --filter CFC180 --second 1000
$ Units       g, mm, ms  -> N, MPa, mJ
$ Mesh        meshes/lined_box.mesh; block 1 box, 2 foam, 3 block inside; a quarter of it all
TITLE
 LINED BOX DROPS ON A FLOOR
TERMINATION TIME, 8.
PLOT TIME, 0.25
HISTORY TIME, 0.02                         $ a filter needs ten values a period: CFC180 takes one every 0.3 ms
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, VONMISES, PRESSURE, ENERGY
PLOT GLOBAL, BLOCK ENERGY
HISTORY BLOCK, 1, 3                        $ box and block as bodies: velocity, acceleration, energies
HISTORY RIGID SURFACE, 100                 $ the force of the floor
NO DISPLACEMENT, X, 1                      $ planes of symmetry
NO DISPLACEMENT, Y, 2
INITIAL VELOCITY MATERIAL, 1, 0., 0., -{speed = 5.}      $ a fall from 1.27 m
INITIAL VELOCITY MATERIAL, 2, 0., 0., -{speed}
INITIAL VELOCITY MATERIAL, 3, 0., 0., -{speed}
RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.
MATERIAL, 1, ELASTIC PLASTIC, 7.85E-3      $ steel
YOUNGS MODULUS = 210.E3
POISSONS RATIO = 0.3
YIELD STRESS = 300.
HARDENING MODULUS = 1000.
BETA = 1.
END
MATERIAL, 2, LOW DEN FOAM, 0.1E-3          $ foam whose air escapes
YOUNGS MODULUS = 5.
A = 0.
B = {strength = 0.2}                       $ it yields at this pressure, and hardens as it is pressed
C = -2.
NAIR = 0
P0 = 0.1
PHI = 0.09
END
MATERIAL, 3, ELASTIC, 7.85E-3
YOUNGS MODULUS = 210.E3
POISSONS RATIO = 0.3
END
EXIT
