$ A copper plate strikes another one at 2000 m/s: half of it, from the plane of impact, where the wave is.
$ Source      Hugoniot of copper: pressure 48.48 GPa, shock speed 5429 m/s, compression 1.2258;
$             see docs/verification.md, V-30
$ Run         urto flyer            a second
$ Look        colour flyer.e by PRESSURE
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/flyer.mesh: 200 cubes of 0.5 mm in a row; node set 1 is the plane of impact
TITLE
 COPPER ON COPPER, 2000 M/S
TERMINATION TIME, 12.E-6
OUTPUT TIME, 0.1E-6
PLOT TIME, 1.E-6
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, PRESSURE, ENERGY, DENSITY
INITIAL VELOCITY MATERIAL, 1, -1000., 0., 0.
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 3
NO DISPLACEMENT, Z, 4
MATERIAL, 1, HYDRODYNAMIC, 8930.
PRESSURE CUTOFF = -1.E9
END
EQUATION OF STATE, 1, MG US-UP
C0 = 3940.
S = 1.489
GAMMA = 2.02
END
EXIT
