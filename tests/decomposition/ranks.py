# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks count the same, each shows a part of the subdomains, and all of them together the whole."""
import hashlib
import itertools
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg
from said import said_by

data = os.path.join(os.environ["GRANULAR_DATA"], "good")


def whole(proxy, time):
    return all_ranks.whole(proxy, time, "vtkUnstructuredGrid")


def digest(grid):
    arrays = [grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray()]
    arrays += [grid.GetCellData().GetArray(name) for name in ("nlocal", "proc")
               if grid.GetCellData().HasArray(name)]
    return [hashlib.sha256(vtk_to_numpy(array).astype(float).tobytes()).hexdigest() for array in arrays]


def alone(algorithm, *inputs):
    """The same by the classes, in this process without the others."""
    for each in (algorithm, *inputs):
        each.SetController(None)
    for port, each in enumerate(inputs):
        algorithm.SetInputConnection(port, each.GetOutputPort())
    algorithm.Update()
    return algorithm.GetOutput()


def reader_of(kind, *names):
    reader = kind()
    for name in names:
        reader.AddFileName(os.path.join(data, name))
    return reader


def filter_of(**properties):
    algorithm = vg.vtkGranularDecomposition()
    for name, value in properties.items():
        getattr(algorithm, f"Set{name}")(*value if isinstance(value, tuple) else (value,))
    return algorithm


# the source
source = GranularDecompositionSource(Bounds=[0, 1, 0, 2, 0, 3], ProcessorGrid=[3, 5, 7])
same = vg.vtkGranularDecompositionSource()
same.SetBounds(0, 1, 0, 2, 0, 3)
same.SetProcessorGrid(3, 5, 7)
assert digest(whole(source, 0)) == digest(alone(same))

divided = GranularDecompositionReader(FileNames=[os.path.join(data, "decomposition/all.vtk")])

# the filter: the results of three modes do not depend on the ranks
file = os.path.join(data, "grains_2000.dump")
all_particles = GranularDumpReader(FileNames=[file])
atoms = GranularDumpReader(FileNames=[os.path.join(data, "process_50.dump")])
dumps = vg.vtkGranularDumpReader
for proxy, algorithm, inputs in (
        (GranularDecomposition(Input=all_particles, ProcessorGrid=[3, 4, 5]),
         filter_of(ProcessorGrid=(3, 4, 5)), [reader_of(dumps, "grains_2000.dump")]),
        (GranularDecomposition(Input=atoms, Mode="ProcessArray"),
         filter_of(Mode=1), [reader_of(dumps, "process_50.dump")]),
        (GranularDecomposition(Input=all_particles, Mode="Subdomains", Subdomains=divided),
         filter_of(Mode=2), [reader_of(dumps, "grains_2000.dump"),
                             reader_of(vg.vtkGranularDecompositionReader, "decomposition/all.vtk")])):
    together = whole(proxy, 0)
    by_one = alone(algorithm, *inputs)
    assert digest(together) == digest(by_one)
    fields = [grid.GetFieldData().GetArray("imbalance").GetValue(0) for grid in (together, by_one)]
    assert fields[0] == fields[1] >= 1, fields

# the ranks of this program: a voxel each, with what it has
here = GranularDecomposition(Input=all_particles, Mode="Ranks")
told = said_by(here.GetClientSideObject())
grid = whole(here, 0)
size = all_ranks.ranks.GetNumberOfProcesses()
cells = {name: vtk_to_numpy(grid.GetCellData().GetArray(name)) for name in ("nlocal", "proc")}
assert (cells["proc"] == numpy.arange(size)).all(), cells
assert cells["nlocal"].sum() == 1200 and cells["nlocal"].max() < 1.2 * 1200 / size, cells
imbalance = grid.GetFieldData().GetArray("imbalance").GetValue(0)
assert imbalance == cells["nlocal"].max() * size / 1200
# a dump holds particles in any order: those of the ranks are all over the box, which the first rank tells
boxes = [numpy.array(grid.GetCell(i).GetBounds()).reshape(3, 2) for i in range(size)]
pairs = sum((a[:, 0] < b[:, 1]).all() and (b[:, 0] < a[:, 1]).all() for a, b in itertools.combinations(boxes, 2))
assert (pairs > 0) == (size > 1) and len(told) == (pairs > 0 and all_ranks.ranks.GetLocalProcessId() == 0), told
assert all(f"share no more than faces, got {pairs} pair" in text for text in told), told

# fewer particles than ranks, and none
Delete(here)
few = GranularPackingSource(NumberOfGrains=2)
grid = whole(GranularDecomposition(Input=few, Mode="Ranks"), 0)
assert grid.GetNumberOfCells() == min(size, 2)
assert vtk_to_numpy(grid.GetCellData().GetArray("nlocal")).sum() == 2
none = GranularDumpReader(FileNames=[os.path.join(data, "grains_0.dump")])
grid = whole(GranularDecomposition(Input=none, ProcessorGrid=[2, 2, 2]), 0)
assert grid.GetNumberOfCells() == 8
assert not vtk_to_numpy(grid.GetCellData().GetArray("nlocal")).any()
print("all there")
