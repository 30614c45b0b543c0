$ A blast in a gas at rest: energy 1 in its middle, an eighth of it here; the shock comes to radius 1 at time 1.
$ Source      L. I. Sedov 1946, G. I. Taylor 1950; radius from Kamm and Timmes 2007; verification V-30. There the energy is in a
$             single point; here in a cube that every mesh has in common
$ Run         urto sedov                 half a minute on two cores
$ Look        urto view sedov.e -v DENSITY
$ Units       none
$ Mesh        meshes/sedov.mesh: 27000 cubes; block 1 gas at rest, 2 the hot corner
TITLE
 SEDOV'S BLAST, OCTANT MODEL, GAMMA 1.4
TERMINATION TIME, 1.
OUTPUT TIME, 0.02
PLOT TIME, 0.1
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, PRESSURE, DENSITY, EINT
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 2
NO DISPLACEMENT, Z, 3
MATERIAL, 1, HYDRODYNAMIC, 1.
PRESSURE CUTOFF = 0.
END
EQUATION OF STATE, 1, IDEAL GAS
GAMMA = 1.4
INITIAL ENERGY = 1.E-6
END
MATERIAL, 2, HYDRODYNAMIC, 1.
PRESSURE CUTOFF = 0.
END
EQUATION OF STATE, 2, IDEAL GAS
GAMMA = 1.4
INITIAL ENERGY = {0.125/0.12^3}
END
EXIT
