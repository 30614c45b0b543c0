$ Simple shear to 5 in axes that turn by 3 radians: the spin of second order of hexahedra with one point.
$ Source      Dienes, Acta Mechanica 32 (1979); Green and Naghdi (1965): in axes that turn with the shear, over the shear modulus,
$             the stress ends at SIGXX = -SIGYY = 2.704319, TAUXY = 2.905369 (verification V-07)
$ Run         urto simple_shear        less than a second
$ Look        SIGXX and TAUXY of the last state. In space they are 3.4084 and 2.0340; without the line SPIN they are wrong by up to 0.017
$ Units       none: every node is moved, so that neither density nor time matters
$ Mesh        meshes/simple_shear.mesh: a cube; node sets: its edges along z, 1 at x = y = 0, 2 at x = 1, 3 at y = 1, 4 at both
$ Parameters  {steps = 400} steps, a shear of {shear = 5.}, a turn of {turn = 3.}
TITLE
 SIMPLE SHEAR THAT TURNS
TERMINATION TIME, 1.
TIME STEP MAXIMUM, {1. / steps}
SPIN, SECOND ORDER                      $ large shears and a turn at once
BULK VISCOSITY, 0., 0.
OUTPUT TIME, 0.1
PLOT TIME, 0.1
PLOT NODAL, DISPLACEMENT
PLOT ELEMENT, STRESS, STRAIN
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
NO DISPLACEMENT, Z, 2
NO DISPLACEMENT, Z, 3
NO DISPLACEMENT, Z, 4
FUNCTION, 1                             $ the edge at x = 1 along x and along y
{loop(steps + 1, i)}
{i / steps}, {cos(turn * i / steps) - 1.}
{endloop}
END
FUNCTION, 2
{loop(steps + 1, i)}
{i / steps}, {sin(turn * i / steps)}
{endloop}
END
FUNCTION, 3                             $ the edge at y = 1: the shear moves it along, and it turns
{loop(steps + 1, i)}
{i / steps}, {cos(turn * i / steps) * shear * i / steps - sin(turn * i / steps)}
{endloop}
END
FUNCTION, 4
{loop(steps + 1, i)}
{i / steps}, {sin(turn * i / steps) * shear * i / steps + cos(turn * i / steps) - 1.}
{endloop}
END
FUNCTION, 5                             $ the edge at both: the sum of the two
{loop(steps + 1, i)}
{i / steps}, {cos(turn * i / steps) * (1. + shear * i / steps) - sin(turn * i / steps) - 1.}
{endloop}
END
FUNCTION, 6
{loop(steps + 1, i)}
{i / steps}, {sin(turn * i / steps) * (1. + shear * i / steps) + cos(turn * i / steps) - 1.}
{endloop}
END
PRESCRIBED DISPLACEMENT, X, 2, 1, 1.
PRESCRIBED DISPLACEMENT, Y, 2, 2, 1.
PRESCRIBED DISPLACEMENT, X, 3, 3, 1.
PRESCRIBED DISPLACEMENT, Y, 3, 4, 1.
PRESCRIBED DISPLACEMENT, X, 4, 5, 1.
PRESCRIBED DISPLACEMENT, Y, 4, 6, 1.
MATERIAL, 1, ELASTIC, 1.
YOUNGS MODULUS = 2.5                    $ a shear modulus of 1
POISSONS RATIO = 0.25
END
EXIT
