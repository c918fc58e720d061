# SPDX-License-Identifier: BSD-3-Clause
"""Paths, tables and comparisons that two ranks of a server make are those of this process alone, and their errors reach the client."""
import os

import numpy
import plain_paths
import vtkgranular as vg
from paraview.simple import *
from ranks_server import connected
from vtkmodules.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
WALK = os.path.join(data, "paths", "walk.dump.gz")
LAST = 600


def alone(kind, **properties):
    """The same by the classes, here."""
    reader, made = vg.vtkGranularDumpReader(), getattr(vg, f"vtkGranular{kind}")()
    reader.AddFileName(WALK)
    made.SetInputConnection(reader.GetOutputPort())
    for name, value in properties.items():
        getattr(made, f"Set{name}")(value)
    made.UpdateTimeStep(LAST)
    return made.GetOutput()


lines = plain_paths.lines_of(alone("Trajectories", Arrays="v", Ids="3 9-20"))
table = alone("History", Arrays="v", Ids="3 9").GetRowData()
squares = alone("History", OutputType=1, MeanSquareDisplacement=True).GetRowData()
moved = alone("Compare").GetPointData()
rows = [f"{i} 0.{i % 90:02}5 0.5 0.5\n" for i in range(1, 201)]
with open("repeated.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n201\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n")
    file.write("".join(rows) + "17 0.5 0.5 0.5\n")

with connected() as server:
    walk = vg.reader(WALK)
    paths = GranularTrajectories(Input=walk, Arrays="v", Ids="3 9-20")
    paths.UpdatePipeline(LAST)
    found = plain_paths.lines_of(servermanager.Fetch(paths))
    assert plain_paths.same(dict(sorted(found.items())), lines)

    history = vg.history(walk, ids=[3, 9], arrays="v")
    assert history["id"].tolist() == [3, 9] and history["timestep"][-1] == LAST
    for i, number in enumerate((3, 9)):
        for name, values in (("position", history["position"]), ("v", history["v"])):
            assert values[:, i].tobytes() == vtk_to_numpy(table.GetArray(f"{name} (id {number})")).tobytes(), name
    found = vg.fetch(GranularHistory(Input=walk, Output="Statistics", MeanSquareDisplacement=1), time=LAST)
    assert found["msd"].tobytes() == vtk_to_numpy(squares.GetArray("msd")).tobytes()

    compared = vg.fetch(GranularCompare(Input=walk), time=LAST)
    order, expected = numpy.argsort(compared["id"]), numpy.argsort(vtk_to_numpy(moved.GetArray("id")))
    assert compared["displacement"][order].tobytes() == vtk_to_numpy(moved.GetArray("displacement"))[expected].tobytes()

    bad = vg.reader(os.path.abspath("repeated.dump"))
    for kind, properties in ((GranularTrajectories, {"NumberOfSamples": 0}), (GranularHistory, {"NumberOfSamples": 0}), (GranularCompare, {})):
        try:
            vg.update(kind(Input=bad, **properties))
        except RuntimeError as error:
            assert "got id 17 in rows 16 and 200" in str(error), error
        else:
            raise AssertionError("nothing was raised")
    vg.update(paths, LAST)
    assert servermanager.Fetch(paths).GetNumberOfCells() == len(lines)
    for proxy in (walk, bad, paths):
        Delete(proxy)
    del walk, bad, paths
print("served")
