$ A pendulum of one truss: half of its mass at the end swings on 1 m by 60 degrees to each side. The period of a rigid pendulum
$ is 4 sqrt(l/g) K(sin 30 degrees) = 2.1529 s (verification B4). The truss is soft enough for large steps and hardly stretched.
TITLE
 PENDULUM OF ONE TRUSS
TERMINATION TIME, 4.4
OUTPUT TIME, 0.1
PLOT TIME, 0.05
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, ENERGY
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
GRAVITY, 0., 0., -9.81
TRUSS AREA, 1, 1.E-4
MATERIAL, 1, ELASTIC, 8000.
YOUNGS MODULUS = 2.E9
POISSONS RATIO = 0.3
END
EXIT
