"""Shows how VTK's reader (ParaView's) and netCDF4 see EXODUS files that urto wrote.

    python3 -m venv VENV && VENV/bin/pip install netCDF4 vtk
    VENV/bin/python tests/python/look.py run.e mesh.g ...
"""

import sys

import netCDF4
from vtkmodules.vtkIOExodus import vtkExodusIIReader

KINDS = {
    "blocks": vtkExodusIIReader.ELEM_BLOCK,
    "node sets": vtkExodusIIReader.NODE_SET,
    "side sets": vtkExodusIIReader.SIDE_SET,
}
ARRAYS = {
    "nodal variables": vtkExodusIIReader.NODAL,
    "element variables": vtkExodusIIReader.ELEM_BLOCK,
    "global variables": vtkExodusIIReader.GLOBAL,
}


def look(path):
    print(path)
    with netCDF4.Dataset(path) as file:
        print("  container:", file.data_model, " title:", file.title)
        if "time_whole" in file.variables:
            print("  times (netCDF4):", file["time_whole"][:].tolist())
    reader = vtkExodusIIReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    print("  VTK: nodes", reader.GetNumberOfNodesInFile(), " elements", reader.GetNumberOfElementsInFile(),
          " states", reader.GetNumberOfTimeSteps())
    for name, kind in KINDS.items():
        listed = range(reader.GetNumberOfObjects(kind))
        print(f"  {name}:", [(reader.GetObjectId(kind, i), reader.GetObjectName(kind, i)) for i in listed])
        for i in listed:
            reader.SetObjectStatus(kind, i, 1)
    for name, kind in ARRAYS.items():
        listed = range(reader.GetNumberOfObjectArrays(kind))
        print(f"  {name}:", [reader.GetObjectArrayName(kind, i) for i in listed])
        for i in listed:
            reader.SetObjectArrayStatus(kind, reader.GetObjectArrayName(kind, i), 1)
    if reader.GetNumberOfTimeSteps():
        reader.SetTimeStep(reader.GetNumberOfTimeSteps() - 1)
    reader.Update()
    show(reader.GetOutput(), "  ")


def show(data, indent):
    """Prints a tree of data sets."""
    for i in range(data.GetNumberOfBlocks()):
        part = data.GetBlock(i)
        if part is None:
            continue
        if hasattr(part, "GetNumberOfBlocks"):
            show(part, indent + "  ")
            continue
        print(f"{indent}part: {part.GetNumberOfPoints()} points, {part.GetNumberOfCells()} cells of type "
              f"{part.GetCellType(0) if part.GetNumberOfCells() else None}, bounds {part.GetBounds()}")
        for where, arrays in (("point", part.GetPointData()), ("cell", part.GetCellData()), ("field", part.GetFieldData())):
            for a in range(arrays.GetNumberOfArrays()):
                array = arrays.GetArray(a)
                if array is not None and array.GetNumberOfTuples():
                    print(f"{indent}  {where} {array.GetName()}: {array.GetRange()}")


for argument in sys.argv[1:]:
    look(argument)
