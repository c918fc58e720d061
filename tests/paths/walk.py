# SPDX-License-Identifier: BSD-3-Clause
"""Paths against those that LAMMPS has computed itself, on any number of ranks, straight from the files and by a filter in between."""
import os

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg

folder = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths")
STEPS = range(0, 601, 20)


def content(output):
    """The arrays of the points, in the order of ids and frames, as the lines have them."""
    assert output.GetNumberOfVerts() == 0
    points = output.GetPointData()
    return {points.GetArrayName(i): vtk_to_numpy(points.GetArray(i)) for i in range(points.GetNumberOfArrays())}


def whole(proxy):
    data = all_ranks.whole(proxy)
    order = numpy.argsort(vtk_to_numpy(data.GetCellData().GetArray("id")), kind="stable")
    return data, order


walk = vg.reader(os.path.join(folder, "walk.dump.gz"))
between = Calculator(Input=walk, ResultArrayName="twice", Function="2*v")
for source, arrays in ((walk, "v c_shift"), (between, "v c_shift twice")):
    paths = GranularTrajectories(Input=source, Arrays=arrays)
    data, order = whole(paths)
    assert data.GetNumberOfLines() == 30 and data.GetNumberOfPoints() == 30 * len(STEPS)
    assert vtk_to_numpy(data.GetCellData().GetArray("id"))[order].tolist() == list(range(1, 31))
    found = content(data)
    # LAMMPS adds up the same doubles in another order
    assert numpy.abs(found["displacement"] - found["c_shift"]).max() < 1e-12
    assert sorted(set(found["timestep"].tolist())) == list(STEPS)
    assert source is walk or (found["twice"] == 2 * found["v"]).all()
    print("displacements are those of LAMMPS")

# In memory, on each rank by itself: the bits of many ranks are those of one.
reader = vg.vtkGranularDumpReader()
reader.SetController(None)
reader.AddFileName(os.path.join(folder, "walk.dump.gz"))
alone = vg.vtkGranularTrajectories()
alone.SetController(None)
alone.SetInputConnection(reader.GetOutputPort())
alone.SetArrays("v")
alone.Update()
expected = alone.GetOutput()
paths = GranularTrajectories(Input=walk, Arrays="v")
data, order = whole(paths)
ids = [vtk_to_numpy(each.GetCellData().GetArray("id")).tolist() for each in (expected, data)]
assert ids[0] == list(range(1, 31)) == ids[1]
for name, values in content(expected).items():
    assert (content(data)[name] == values).all(), name
assert (vtk_to_numpy(data.GetPoints().GetData()) == vtk_to_numpy(expected.GetPoints().GetData())).all()

print("all there")
