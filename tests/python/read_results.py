"""Reads an EXODUS file that urto wrote, as another program sees it, and prints what it finds for tests/results/other_programs.rs.

    python3 tests/python/read_results.py netcdf|vtk run.e

Lines are `key: values`, numbers in the shortest form that reads back the same. Exit code 3: the library is not here.
"""

import sys


def say(key, values):
    print(f"{key}:", *(repr(float(v)) if not isinstance(v, str) else v for v in values))


def with_netcdf(path):
    import netCDF4

    def texts(file, name):
        return [netCDF4.chartostring(row).item().strip("\0 ") for row in file[name][:]]

    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        say("times", file["time_whole"][:])
        for axis in "xyz":
            say(f"coordinates {axis}", file[f"coord{axis}"][:])
        blocks = len(file.dimensions["num_el_blk"])
        nodal, element = texts(file, "name_nod_var"), texts(file, "name_elem_var")
        say("nodal names", nodal)
        say("element names", element)
        for state in range(len(file["time_whole"])):
            for n, name in enumerate(nodal, 1):
                say(f"{name} {state}", file[f"vals_nod_var{n}"][state])
            for n, name in enumerate(element, 1):
                parts = [file[f"vals_elem_var{n}eb{b}"][state] for b in range(1, blocks + 1)]
                say(f"{name} {state}", [value for part in parts for value in part])


def with_vtk(path):
    """VTK joins DISPLX, DISPLY, DISPLZ to vectors; here they are taken apart again."""
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOExodus import vtkExodusIIReader

    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    reader.ApplyDisplacementsOff()
    reader.SetSqueezePoints(False)
    for kind in (vtkExodusIIReader.NODAL, vtkExodusIIReader.ELEM_BLOCK):
        for i in range(reader.GetNumberOfObjectArrays(kind)):
            reader.SetObjectArrayStatus(kind, reader.GetObjectArrayName(kind, i), 1)
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    say("times", times)
    for state, _ in enumerate(times):
        reader.SetTimeStep(state)
        reader.Update()
        blocks = [reader.GetOutput().GetBlock(0).GetBlock(b) for b in range(reader.GetNumberOfElementBlockArrays())]
        if state == 0:
            points = [blocks[0].GetPoint(i) for i in range(blocks[0].GetNumberOfPoints())]
            for axis, name in enumerate("xyz"):
                say(f"coordinates {name}", [point[axis] for point in points])
        for array in arrays(blocks[0].GetPointData()):
            for name, column in components(array):
                say(f"{name} {state}", (array.GetComponent(i, column) for i in range(array.GetNumberOfTuples())))
        for array in arrays(blocks[0].GetCellData()):
            parts = [block.GetCellData().GetArray(array.GetName()) for block in blocks]
            for name, column in components(array):
                say(f"{name} {state}", (p.GetComponent(i, column) for p in parts for i in range(p.GetNumberOfTuples())))


def arrays(data):
    found = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return [array for array in found if array is not None and array.GetName() not in ("ObjectId", "GlobalNodeId")]


def components(array):
    count = array.GetNumberOfComponents()
    return [(array.GetName() + ("XYZ"[i] if count > 1 else ""), i) for i in range(min(count, 3))]


try:
    {"netcdf": with_netcdf, "vtk": with_vtk}[sys.argv[1]](sys.argv[2])
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)
