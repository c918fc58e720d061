# SPDX-License-Identifier: BSD-3-Clause
"""Paths and mean square displacements against those that LAMMPS has computed itself, on any number of ranks, straight from the files
and by a filter in between."""
import os

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg

folder = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths")
STEPS = range(0, 601, 20)


def table(name):
    """The rows of the log between its header and the loop time."""
    lines = open(os.path.join(folder, name)).read().splitlines()
    first = next(i for i, line in enumerate(lines) if line.split()[:2] == ["Step", "Time"])
    last = next(i for i, line in enumerate(lines) if line.startswith("Loop time"))
    return numpy.array([line.split() for line in lines[first + 1:last]], float)


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

if all_ranks.ranks.GetNumberOfProcesses() == 1:
    log = table("walk_log.txt")
    for source in walk, between:
        history = vg.fetch(GranularHistory(Input=source, Output="Statistics", Arrays="v", MeanSquareDisplacement=1))
        assert (history["timestep"] == STEPS).all() and (history["particles"] == 30).all()
        assert numpy.abs(history["msd"] - log[:, 5]).max() <= 1e-12 * log[:, 5].max()
        assert numpy.abs(history["msd_xyz"] - log[:, 2:5]).max() <= 1e-12 * log[:, 2:5].max()
    # the second run begins with image counts that are not zero, in a box that changes its size
    grown = vg.reader(os.path.join(folder, "grown.dump.gz"))
    found = vg.fetch(GranularTrajectories(Input=grown, Arrays="c_again"))
    assert numpy.abs(found["displacement"] - found["c_again"]).max() < 1e-12
    history = vg.fetch(GranularHistory(Input=grown, Output="Statistics", MeanSquareDisplacement=1))
    assert numpy.abs(history["msd"] - table("grown_log.txt")[:, 5]).max() <= 1e-12 * history["msd"].max()

    # choices
    def ids_of(**properties):
        return vtk_to_numpy(servermanager.Fetch(GranularTrajectories(Input=walk, **properties)).GetCellData().GetArray("id")).tolist()
    assert ids_of(Ids="3, 5-8 20-30:5") == [3, 5, 6, 7, 8, 20, 25, 30]
    assert ids_of(Ids="1-20", EveryNth=7) == [7, 14]
    some = ids_of(NumberOfSamples=5)
    assert len(some) == 5 and some == ids_of(NumberOfSamples=5, Threads=2) != ids_of(NumberOfSamples=5, Seed=1)
    last = vg.fetch(walk, time=walk.TimestepValues[-1])
    inside = sorted(last["id"][last["points"][:, 2] <= 1].tolist())
    assert ids_of(RegionOfInterest=[1, -1, 1, -1, -10, 1]) == inside

    # tails, forwards and back, are those of a new filter
    tail = GranularTrajectories(Input=walk, Tail=3)
    for time in walk.TimestepValues[10], walk.TimestepValues[11], walk.TimestepValues[2], walk.TimestepValues[30]:
        steps = numpy.unique(vg.fetch(tail, time=time)["timestep"])
        current = 20 * list(walk.TimestepValues).index(time)
        assert steps.tolist() == list(range(max(0, current - 60), current + 1, 20)), steps

    # arrays
    history = vg.history(walk, ids=[4, 9], arrays="v")
    assert history["id"].tolist() == [4, 9] and history["v"].shape == (31, 2, 3)
    first = vg.fetch(walk, time=walk.TimestepValues[0])
    assert (history["v"][0, 1] == first["v"][first["id"] == 9][0]).all()

    # what cannot be
    for properties, said in (({"Arrays": "nothing"}, "got none in any frame"), ({"Ids": "5-"}, "got '5-'"),
                             ({"TimeWindow": [1e6, 2e6]}, "TimeWindow"), ({"SelectionFrame": 31, "NumberOfSamples": 1}, "got 31")):
        try:
            vg.update(GranularTrajectories(Input=walk, **properties))
        except RuntimeError as error:
            assert said in str(error), error
        else:
            raise AssertionError(properties)
print("all there")
