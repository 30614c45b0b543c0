$ Bent strip: a strip of steel is clamped at one end, and its other end is pushed aside until it has bent for good.
$ Source      none: a slow process with a fast method. A strip that is one element thick yields from its faces inwards
$ Run         urto bent_strip          a few seconds
$ Look        deformed, coloured by EQPS; kinetic energy, a small part of the internal one, in bent_strip.o
$ Units       m, kg, s  -> N, Pa, J
$ Mesh        meshes/bent_strip.mesh: 0.1 x 0.02 x 0.004 m along x; node sets: 1 the plane x = 0, 2 the edge x = 0.1, z = 0.004
TITLE
 STRIP OF STEEL, BENT
TERMINATION TIME, 20.E-3
OUTPUT TIME, 1.E-3
PLOT TIME, 2.E-3
PLOT NODAL, DISPLACEMENT, REACTION
PLOT ELEMENT, STRESS, VONMISES
PLOT STATE, EQPS
ELEMENT, 1, EIGHT POINTS                            $ one element through the thickness bends as it should
TIME STEP ESTIMATE, GLOBAL
MASS SCALING, 1, FACTOR, 4., 3.                     $ half the steps: inertia is of no account in a slow process
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
FUNCTION, 1                                         $ starts and ends gently
{loop(21, i)}
{i / 20 * 20.E-3}, {(1. - cosd(9. * i)) / 2.}
{endloop}
END
PRESCRIBED DISPLACEMENT, Z, 2, 1, -0.025
MATERIAL, 1, ELASTIC PLASTIC, 7850.
YOUNGS MODULUS = 200.E9
POISSONS RATIO = 0.3
YIELD STRESS = 400.E6
HARDENING MODULUS = 1.E9
BETA = 1.0
END
EXIT
