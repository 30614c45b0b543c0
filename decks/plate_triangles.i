$ A square plate of triangles, simply supported, on which a pressure sets in at once: its middle swings about the place of rest.
$ Source      Navier's series, Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, article 28, each term swinging by itself
$ Run         urto plate_triangles      a few seconds
$ Look        urto plot plate_triangles.h: DISPLZ of the middle; all terms of the series together come to -1.056E-4 m at 5.08 ms,
$             twice the deflection at rest, half a period of the first
$ Units       kg, m, s  -> N, Pa, J
$ Mesh        meshes/plate_triangles.mesh: 1 x 1 m of 24 x 24 squares in two triangles each; node set 1 the edges, 2 the middle
TITLE
 PLATE OF TRIANGLES UNDER A SUDDEN PRESSURE
TERMINATION TIME, 12.E-3
OUTPUT TIME, 0.5E-3
PLOT TIME, 0.5E-3
PLOT NODAL, DISPLACEMENT, VELOCITY
PLOT ELEMENT, STRESS, RESULTANTS
HISTORY, NODE SET, 2
HISTORY TIME, 20.E-6
NO DISPLACEMENT, X, 1
NO DISPLACEMENT, Y, 1
NO DISPLACEMENT, Z, 1
FUNCTION, 1
0., 1.
1., 1.
END
PRESSURE, 100, 1, 2000.
SHELL THICKNESS, 1, 0.02
INTEGRATION POINTS, 1, 3, GAUSS
MATERIAL, 1, ELASTIC, 7850.
YOUNGS MODULUS = 210.E9
POISSONS RATIO = 0.3
END
EXIT
