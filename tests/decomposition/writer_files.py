# SPDX-License-Identifier: BSD-3-Clause
"""Written decompositions are what VTK's own readers and this library's read back, bit for bit, with right cells."""
import os
import re

import numpy
import plain_dump
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOLegacy import vtkRectilinearGridReader, vtkUnstructuredGridReader, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from writing import check_nothing_left, check_properties, content, enter_empty_folder, good

enter_empty_folder()
WRITER = "GranularDecompositionWriter"


def read(path):
    """By VTK's own reader."""
    reader = vtkXMLUnstructuredGridReader() if path.endswith(".vtu") else vtkUnstructuredGridReader()
    reader.SetFileName(path)
    if not path.endswith(".vtu"):
        reader.ReadAllFieldsOn()
    reader.Update()
    return reader.GetOutput()


def values(grid):
    """All there is, as bytes."""
    cells = grid.GetCellData()
    found = {"points": vtk_to_numpy(grid.GetPoints().GetData()).tobytes(),
             "cells": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).astype("int64").tobytes(),
             "types": {grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())}}
    for i in range(cells.GetNumberOfArrays()):
        found[cells.GetArrayName(i)] = vtk_to_numpy(cells.GetArray(i)).astype("int64").tobytes()
    return found


def volumes(grid):
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))


def data_of(proxy):
    return servermanager.Fetch(proxy)


# ---- what is written is read again -------------------------------------------------------------------

third = 1 / 3
boxes = {
    "a box": ([0, 1, 0, 2, 0, 3], 6),
    "numbers of 17 digits": ([-third, 0.1 + 0.2, third, 1 + third, 0, 1e-3], None),
    "far away": ([1e9, 1e9 + 1, -1e9, -1e9 + 1, 0, 1], 1),
    "small": ([1e-12, 3e-12, 0, 1e-12, 0, 1e-12], None),
}
for name, (bounds, volume) in boxes.items():
    source = GranularDecompositionSource(Bounds=bounds, ProcessorGrid=[3, 5, 7])
    source.UpdatePipeline()
    grid = data_of(source)
    volume = volume or numpy.prod([hi - lo for lo, hi in zip(bounds[::2], bounds[1::2])])
    for file in ("a.vtk", "a.vtu", "a.decomposition"):
        vg.save(source, file, writer=WRITER)
        again = read(file)
        assert again.GetPoints().GetData().GetDataTypeAsString() == "double"
        assert values(again) == values(grid), (name, file)
        assert (volumes(again) > 0).all(), (name, file)
        assert abs(volumes(again).sum() - volume) < 1e-9 * volume, (name, file)
        reader = GranularDecompositionReader(FileNames=[os.path.abspath(file)])
        reader.UpdatePipeline()
        assert values(data_of(reader)) == values(grid), (name, file)
        Delete(reader)

# VTK's writer has the same bytes for the same cells, but for version and title, what it notes of ranges, and the
# type of integers
writer = vtkUnstructuredGridWriter()
source = GranularDecompositionSource(Bounds=[0, 1, -2, 2, 0, 3.5], ProcessorGrid=[4, 8, 7])
source.UpdatePipeline()
writer.SetInputData(data_of(source))
writer.GetInput().GetCellData().SetActiveScalars(None)
writer.GetInput().GetFieldData().Initialize()
writer.SetFileVersion(42)
writer.SetFileName("vtk.vtk")
writer.Write()
vg.save(source, "own.vtk", writer=WRITER)
theirs = re.sub(rb"METADATA\n.*?\n\n", b"", content("vtk.vtk"), flags=re.DOTALL).replace(b"vtktypeint64", b"int")
assert theirs.split(b"\n", 2)[2] == content("own.vtk").split(b"\n", 2)[2]

# no process at all
nothing = ProgrammableSource(OutputDataSetType="vtkUnstructuredGrid", Script="")
for file in ("none.vtk", "none.vtu"):
    vg.save(nothing, file, writer=WRITER)
    assert read(file).GetNumberOfCells() == 0

# ---- counts, times and names -------------------------------------------------------------------------

particles = GranularDumpReader(FileNames=[good("grains.dump")], TimestepSize=2e-5)
domains = GranularDecomposition(Input=particles, ProcessorGrid=[2, 1, 2])
vg.save(domains, "step_*.vtu", WriteTimeSteps=1)
vg.save(domains, "step_*.vtk", WriteTimeSteps=1)
for step, frame in zip((0, 1000, 2000), plain_dump.read(good("grains.dump")), strict=True):
    for file in (f"step_{step}.vtu", f"step_{step}.vtk"):
        grid = read(file)
        counts = grid.GetCellData().GetArray("nlocal")
        assert vtk_to_numpy(counts).sum() == frame.rows, (file, frame.rows)
        assert set(values(grid)) == {"points", "cells", "types", "nlocal", "proc"}
    fields = read(f"step_{step}.vtu").GetFieldData()
    assert fields.GetArray("TimeValue").GetValue(0) == step * 2e-5
assert content("step_1000.vtk") != content("step_2000.vtk")
again = GranularDecompositionReader(FileNames=[os.path.abspath(f"step_{step}.vtk") for step in (0, 1000, 2000)])
assert list(again.TimestepValues) == [0, 1000, 2000], again.TimestepValues

# ---- the bytes of LIGGGHTS-PUBLIC ----------------------------------------------------------------------

divided = GranularDecompositionReader(FileNames=[good("decomposition/all.vtk")])
vg.save(divided, "public.vtk", writer=WRITER, Dialect="PUBLIC", WriteTimeSteps=1)
assert content("public.vtk") == content(good("decomposition/all.vtk"))
single = GranularDecompositionReader(FileNames=[good("decomposition_1000.vtk")])
SaveData("public.decomposition", single, Dialect="PUBLIC")
assert content("public.decomposition") == content(good("decomposition_1000.vtk"))
vg.save(domains, "public_*.vtk", time=2000 * 2e-5, Dialect="PUBLIC")
assert content("public_2000.vtk") == content(good("decomposition_2000.vtk"))
file = vtkRectilinearGridReader()
file.SetFileName("public_2000.vtk")
file.Update()
assert file.GetOutput().GetNumberOfCells() == 4

# ---- properties --------------------------------------------------------------------------------------------

check_properties(WRITER, domains, Dialect="INL", WriteTimeSteps=0)
check_nothing_left()
print("written")
