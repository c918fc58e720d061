# SPDX-License-Identifier: BSD-3-Clause
"""Particles of real runs are counted where the programs had them."""
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import granular

data = os.path.join(os.environ["GRANULAR_DATA"], "good")


def fetch(proxy, time=None):
    proxy.UpdatePipeline(*([] if time is None else [time]))
    grid = servermanager.Fetch(proxy)
    cells = grid.GetCellData()
    return grid, {name: vtk_to_numpy(cells.GetArray(name)) for name in ("nlocal", "proc")}


# LAMMPS on four processes says in the column proc who owns an atom; at step 0 atoms lie exactly on the faces
# between processes, later some are beyond the periodic faces of the box.
for step in (0, 50):
    path = os.path.join(data, f"process_{step}.dump")
    rows = [line.split() for line in open(path).read().splitlines()[9:]]
    owners = numpy.array([int(row[5]) for row in rows])
    owned = numpy.bincount(owners, minlength=4)
    atoms = GranularDumpReader(FileNames=[path])
    grid, cells = fetch(GranularDecomposition(Input=atoms, ProcessorGrid=[2, 1, 2]))
    assert (cells["proc"] == numpy.arange(4)).all() and cells["proc"].dtype == numpy.int32
    assert (cells["nlocal"] == owned).all() and cells["nlocal"].dtype == numpy.int64, (cells, owned)
    field = grid.GetFieldData()
    assert field.GetArray("outside").GetValue(0) == 0
    assert field.GetArray("imbalance").GetValue(0) == owned.max() * len(owned) / owned.sum()
    assert field.GetArray("timestep").GetValue(0) == step
    # a free grid is the one that LAMMPS chose
    _, free = fetch(GranularDecomposition(Input=atoms, ProcessorGrid=[0, 0, 0], NumberOfProcesses=4))
    assert (free["nlocal"] == owned).all()

    grid, cells = fetch(GranularDecomposition(Input=atoms, Mode="ProcessArray"))
    assert (cells["proc"] == numpy.arange(4)).all() and (cells["nlocal"] == owned).all()
    places = numpy.array([row[2:5] for row in rows], float)
    for process in range(4):
        own = places[owners == process]
        expected = numpy.stack([own.min(axis=0), own.max(axis=0)]).T.ravel()
        assert (numpy.array(grid.GetCell(process).GetBounds()) == expected).all()

# LIGGGHTS writes the grains of each process into a file of its own; what has left its process since the last
# neighbour list is still there: at most 8 of 1200 in these frames
for step in (1000, 2000):
    owned = [int(open(os.path.join(data, f"pieces_{step}.{process}.dump")).read().split("\n")[3])
             for process in range(4)]
    grains = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")])
    _, cells = fetch(GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2]), step)
    assert cells["nlocal"].sum() == sum(owned) == 1200
    assert abs(cells["nlocal"] - owned).max() <= 8, (cells["nlocal"], owned)

# whatever the points are, the counts are the same, and the voxels are where the points are
expected = {}
for properties in ({}, {"Coordinates": "Unwrapped"}, {"Coordinates": "Scaled"},
                   {"PointOrigin": [0.5, -2, 1e3]}):
    grains = GranularDumpReader(FileNames=[os.path.join(data, "grains_2000.dump")], **properties)
    grid, cells = fetch(GranularDecomposition(Input=grains, ProcessorGrid=[3, 4, 5]))
    expected = expected or cells
    assert (cells["nlocal"] == expected["nlocal"]).all(), properties
    assert cells["nlocal"].sum() == 1200
    bounds = numpy.array([-0.05, 0.05, -0.05, 0.05, 0, 0.15])
    if properties.get("Coordinates") == "Scaled":
        bounds = numpy.array([0, 1, 0, 1, 0, 1])
    if "PointOrigin" in properties:
        bounds = bounds - numpy.repeat(properties["PointOrigin"], 2)
    assert numpy.allclose(grid.GetBounds(), bounds, rtol=0, atol=1e-12), (properties, grid.GetBounds())

# brute force, also at cuts that are not even
cuts = {"XCuts": [-0.03, 0.001], "YCuts": [], "ZCuts": [0.004, 0.01, 0.02]}
grains = GranularDumpReader(FileNames=[os.path.join(data, "grains_2000.dump")])
_, cells = fetch(GranularDecomposition(Input=grains, ProcessorGrid=[0, 1, 0], **cuts))
points = vtk_to_numpy(servermanager.Fetch(grains).GetPoints().GetData())
edges = [numpy.concatenate([[low], cut, [high]]) for low, cut, high in
         zip((-0.05, -0.05, 0), cuts.values(), (0.05, 0.05, 0.15))]
points[:, :2] = (points[:, :2] + 0.05) % 0.1 - 0.05  # periodic in x and y
brute, _ = numpy.histogramdd(points, edges)
assert (cells["nlocal"] == brute.ravel()).all()

# the subdomains of a file that LIGGGHTS wrote, which says nothing of grains
divided = GranularDecompositionReader(FileNames=[os.path.join(data, "decomposition/all.vtk")])
_, cells = fetch(GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2]))
given = GranularDecomposition(Input=grains, Mode="Subdomains", Subdomains=divided)
given.UpdatePipeline()
grid = servermanager.Fetch(given)
assert not grid.GetCellData().HasArray("proc")
counts = vtk_to_numpy(grid.GetCellData().GetArray("nlocal"))
assert (counts == cells["nlocal"].reshape(2, 1, 2).transpose().ravel()).all(), (counts, cells)
