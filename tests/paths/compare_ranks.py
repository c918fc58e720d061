# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks find the same to the bit, wherever particles and bonds of either frame are, each for its own."""
import os
import sys

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths")
DUMP = os.path.join(data, "breaking.dump")
BONDS = os.path.join(data, "breaking_bonds.dump")
POINTS = ["id", "change", "displacement", "fragment", "fragment_size", "fragment_mass", "c_fragment_difference"]
CELLS = ["id1", "id2", "btype", "change"]


def content(output, names, points):
    """All that is told of each particle or line, in the order of the ids; those that are lost last."""
    attributes = output.GetPointData() if points else output.GetCellData()
    arrays = [vtk_to_numpy(attributes.GetArray(name)) for name in names]
    places = vtk_to_numpy(output.GetPoints().GetData()).reshape(len(arrays[0]), -1)
    table = numpy.hstack([array.reshape(len(array), -1).astype(float) for array in arrays] + [places])
    return table[numpy.lexsort((table[:, 1], table[:, 0], table[:, names.index("change")]))]


def alone(step, previous):
    """The same by the classes, in this process without the others."""
    reader, bonds, join, compare = (getattr(vg, "vtkGranular" + name)() for name in
                                    ("DumpReader", "LocalReader", "LocalJoin", "Compare"))
    for one in (reader, bonds, join, compare):
        one.SetController(None)
    reader.AddFileName(DUMP)
    bonds.AddFileName(BONDS)
    bonds.SetPreset(3)  # BondTypeIds
    join.SetInputConnection(0, reader.GetOutputPort())
    join.SetInputConnection(1, bonds.GetOutputPort(1))
    compare.SetInputConnection(0, reader.GetOutputPort())
    compare.SetInputConnection(1, join.GetOutputPort())
    compare.SetReference(previous)
    compare.SetDifferences("*")
    compare.UpdateTimeStep(step)
    return compare.GetOutput(), compare.GetLinesOutput()


# particles of a frame on other ranks than those that have read them; a third of them is there at no odd time
SOME = """
def some(given, output):
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkCommonCore import vtkPoints
    step = given.GetFieldData().GetArray("timestep").GetValue(0)
    ids = vtk_to_numpy(given.GetPointData().GetArray("id")) if given.GetNumberOfPoints() else numpy.zeros(0, int)
    keep = (ids % 3 != 0) | (step % 800 == 0)
    made = vtkPolyData()
    if keep.any():
        points = vtkPoints()
        points.SetData(numpy_to_vtk(vtk_to_numpy(given.GetPoints().GetData())[keep].copy(), deep=1))
        made.SetPoints(points)
        for i in range(given.GetPointData().GetNumberOfArrays()):
            array = given.GetPointData().GetArray(i)
            values = numpy_to_vtk(vtk_to_numpy(array)[keep].copy(), deep=1)
            values.SetName(array.GetName())
            made.GetPointData().AddArray(values)
    made.GetFieldData().PassData(given.GetFieldData())
    output.ShallowCopy(made)
some(self.GetInputDataObject(0, 0), self.GetOutputDataObject(0))
"""

all_particles = GranularDumpReader(FileNames=[DUMP])
local = GranularLocalReader(FileNames=[BONDS], Preset="BondTypeIds")
bonds = GranularLocalJoin(Input=all_particles, Lines=OutputPort(local, 1))
compared = GranularCompare(Input=all_particles, Lines=bonds, Differences="*")
for previous, reference in enumerate(("First", "Previous")):
    compared.Reference = reference
    for step in (1200, 0, 400, 800):
        particles, lines = alone(step, previous)
        found = content(all_ranks.whole(compared, step), POINTS, True)
        assert found.tobytes() == content(particles, POINTS, True).tobytes(), (step, reference)
        found = content(all_ranks.whole(OutputPort(compared, 1), step), CELLS, False)
        assert found.tobytes() == content(lines, CELLS, False).tobytes(), (step, reference)

# particles that are lost: those of ids that three divides
fewer = ProgrammableFilter(Input=all_particles, OutputDataSetType="vtkPolyData", Script=SOME)
compared = GranularCompare(Input=fewer, Differences="*")
whole = all_ranks.whole(compared, 400)
change, ids, image = (vtk_to_numpy(whole.GetPointData().GetArray(name)) for name in ("change", "id", "image"))
assert (change == 2).sum() == 33 and (ids[change == 2] % 3 == 0).all() and not (change == 1).any()
assert numpy.isnan(vtk_to_numpy(whole.GetPointData().GetArray("displacement"))[change == 2]).all()
assert whole.GetNumberOfVerts() == len(ids) == 100
compared.Reference = "Previous"
whole = all_ranks.whole(compared, 800)
change, ids = (vtk_to_numpy(whole.GetPointData().GetArray(name)) for name in ("change", "id"))
assert (ids[change == 1] % 3 == 0).all() and (change == 1).sum() == 33 and not (change == 2).any()

# an id that repeats on any rank: an error of all, and none waits
TWICE = """
from vtkmodules.util.numpy_support import vtk_to_numpy
self.GetOutputDataObject(0).DeepCopy(self.GetInputDataObject(0, 0))
array = self.GetOutputDataObject(0).GetPointData().GetArray("id")
if array and array.GetNumberOfTuples():
    vtk_to_numpy(array)[vtk_to_numpy(array) == 93] = 7
"""
twice = ProgrammableFilter(Input=all_particles, OutputDataSetType="vtkPolyData", Script=TWICE)
compared = GranularCompare(Input=twice)
compared.UpdatePipeline(400)
assert compared.GetDataInformation().GetNumberOfPoints() == 0
print("all there", file=sys.stderr)  # behind what was said
