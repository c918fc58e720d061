# SPDX-License-Identifier: BSD-3-Clause
"""VTK's own filters find in the voxels what is there: volumes, cells, halves, faces, values; and particles of real runs are
counted where the programs had them."""
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkIdList
from vtkmodules.vtkCommonDataModel import (vtkCellLocator, vtkGenericCell, vtkPlane, vtkPolyData,
                                          vtkStaticCellLocator)
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
random = numpy.random.default_rng(7)


def output(algorithm):
    algorithm.SetController(None)
    algorithm.Update()
    assert algorithm.GetErrorCode() == 0
    return algorithm.GetOutput()


def source(bounds, grid, cuts=((), (), ())):
    algorithm = vg.vtkGranularDecompositionSource()
    algorithm.SetBounds(*bounds)
    algorithm.SetProcessorGrid(*grid)
    for axis, positions in zip("XYZ", cuts):
        for position in positions:
            getattr(algorithm, f"Add{axis}Cut")(position)
    return output(algorithm)


def reader(*names):
    algorithm = vg.vtkGranularDecompositionReader()
    algorithm.AddObserver("WarningEvent", lambda *_: None)  # of mirrored voxels
    for name in names:
        algorithm.AddFileName(os.path.join(data, name))
    return output(algorithm)


def counted():
    all_particles = vg.vtkGranularDumpReader()
    all_particles.AddFileName(os.path.join(data, "grains_2000.dump"))
    algorithm = vg.vtkGranularDecomposition()
    algorithm.SetInputConnection(all_particles.GetOutputPort())
    algorithm.SetProcessorGrid(3, 2, 4)
    return output(algorithm)


def sizes(dataset):
    algorithm = vtkCellSizeFilter()
    algorithm.SetInputData(dataset)
    algorithm.Update()
    cells = algorithm.GetOutput().GetCellData()
    return [vtk_to_numpy(cells.GetArray(name)) for name in ("Area", "Volume")]


def bounds_of_cells(grid):
    return numpy.array([grid.GetCell(i).GetBounds() for i in range(grid.GetNumberOfCells())])


def surface(grid):
    algorithm = vtkDataSetSurfaceFilter()
    algorithm.SetInputData(grid)
    algorithm.PassThroughCellIdsOn()
    algorithm.Update()
    return algorithm.GetOutput()


def check(name, grid, omega=None, forms_grid=True):
    omega = numpy.array(omega if omega else grid.GetBounds())
    low, high = omega[::2], omega[1::2]
    whole = (high - low).prod()
    boxes = bounds_of_cells(grid)

    _, volumes = sizes(grid)
    assert (volumes > 0).all(), name
    assert abs(volumes.sum() - whole) <= 1e-12 * whole, (name, volumes.sum(), whole)
    # to what the rounding of the corners allows
    exact = (boxes[:, 1::2] - boxes[:, ::2]).prod(axis=1)
    assert numpy.allclose(volumes, exact, rtol=1e-12, atol=0), name

    points = low + (high - low) * random.random((100_000, 3))
    locator = vtkCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    cell, pcoords, weights = vtkGenericCell(), [0.0] * 3, [0.0] * 8
    found = numpy.array([locator.FindCell(point, 0, cell, mutable(0), pcoords, weights)
                         for point in points])
    assert (found >= 0).all(), name
    inside = (boxes[found, ::2] <= points) & (points <= boxes[found, 1::2])
    assert inside.all(), (name, (~inside).sum())

    probe = vtkProbeFilter()
    places = vtkPoints()
    places.SetDataTypeToDouble()
    for point in points[:2000]:
        places.InsertNextPoint(point)
    cloud = vtkPolyData()
    cloud.SetPoints(places)
    probe.SetInputData(cloud)
    probe.SetSourceData(grid)
    if not forms_grid:  # by itself it walks from corner to corner, and these are not those of neighbours
        probe.SetCellLocatorPrototype(vtkStaticCellLocator())
    probe.Update()
    probed = probe.GetOutput().GetPointData()
    assert vtk_to_numpy(probed.GetArray("vtkValidPointMask")).all(), name
    for array in ("nlocal", "proc"):
        if grid.GetCellData().GetArray(array):
            values = vtk_to_numpy(grid.GetCellData().GetArray(array))[found[:2000]]
            assert (vtk_to_numpy(probed.GetArray(array)) == values).all(), (name, array)

    for axis in range(3):
        plane = vtkPlane()
        plane.SetOrigin((low + high) / 2)
        plane.SetNormal(numpy.eye(3)[axis])
        half = vtkTableBasedClipDataSet()
        half.SetInputData(grid)
        half.SetClipFunction(plane)
        half.Update()
        _, parts = sizes(half.GetOutput())
        assert (parts >= 0).all(), name
        assert abs(parts.sum() - whole / 2) <= 1e-12 * whole, (name, axis, parts.sum())

    faces = surface(grid)
    owners = vtk_to_numpy(faces.GetCellData().GetArray("vtkOriginalCellIds"))
    ids = vtkIdList()
    for face in range(faces.GetNumberOfCells()):
        faces.GetCellPoints(face, ids)
        corners = numpy.array([faces.GetPoint(ids.GetId(i)) for i in range(ids.GetNumberOfIds())])
        normal = numpy.cross(corners[1] - corners[0], corners[2] - corners[1])
        box = boxes[owners[face]]
        outward = corners.mean(axis=0) - (box[::2] + box[1::2]) / 2
        assert normal @ outward > 0, (name, face)


unit = (0, 1, 0, 2, 0, 3)
check("one", source(unit, (1, 1, 1)), unit)
check("grid", source(unit, (3, 4, 5)), unit)
check("cuts", source((-0.05, 0.05, -0.05, 0.05, 0, 0.15), (3, 1, 4), ((-0.04, 0.049), (), (1e-3, 0.01, 0.1))))
far = (1e9, 1e9 + 1, -1e9, -1e9 + 2, 5e8, 5e8 + 4)
check("far", source(far, (4, 2, 3)), far)
check("counted", counted(), (-0.05, 0.05, -0.05, 0.05, 0, 0.15))
check("public", reader("decomposition/all.vtk"), (-0.05, 0.05, -0.05, 0.05, 0, 0.15))
for name in ("inl_42.vtk", "inl_51_binary.vtk", "inl.vtu", "hexahedra_42.vtk", "appended_raw_zlib.vtu"):
    check(name, reader("decomposition/" + name), (-1, 1, 0, 0.5, 0, 2), forms_grid=False)

# ---- particles of real runs ------------------------------------------------------------------------------


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

# LIGGGHTS writes the particles of each process into a file of its own; what has left its process since the last
# neighbour list is still there: at most 8 of 1200 in these frames
for step in (1000, 2000):
    owned = [int(open(os.path.join(data, f"pieces_{step}.{process}.dump")).read().split("\n")[3])
             for process in range(4)]
    all_particles = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")])
    _, cells = fetch(GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 1, 2]), step)
    assert cells["nlocal"].sum() == sum(owned) == 1200
    assert abs(cells["nlocal"] - owned).max() <= 8, (cells["nlocal"], owned)

# whatever the points are, the counts are the same, and the voxels are where the points are
expected = {}
for properties in ({}, {"Coordinates": "Unwrapped"}, {"Coordinates": "Scaled"},
                   {"PointOrigin": [0.5, -2, 1e3]}):
    all_particles = GranularDumpReader(FileNames=[os.path.join(data, "grains_2000.dump")], **properties)
    grid, cells = fetch(GranularDecomposition(Input=all_particles, ProcessorGrid=[3, 4, 5]))
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
all_particles = GranularDumpReader(FileNames=[os.path.join(data, "grains_2000.dump")])
_, cells = fetch(GranularDecomposition(Input=all_particles, ProcessorGrid=[0, 1, 0], **cuts))
points = vtk_to_numpy(servermanager.Fetch(all_particles).GetPoints().GetData())
edges = [numpy.concatenate([[low], cut, [high]]) for low, cut, high in
         zip((-0.05, -0.05, 0), cuts.values(), (0.05, 0.05, 0.15))]
points[:, :2] = (points[:, :2] + 0.05) % 0.1 - 0.05  # periodic in x and y
brute, _ = numpy.histogramdd(points, edges)
assert (cells["nlocal"] == brute.ravel()).all()

# the subdomains of a file that LIGGGHTS wrote, which says nothing of particles
divided = GranularDecompositionReader(FileNames=[os.path.join(data, "decomposition/all.vtk")])
_, cells = fetch(GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 1, 2]))
given = GranularDecomposition(Input=all_particles, Mode="Subdomains", Subdomains=divided)
given.UpdatePipeline()
grid = servermanager.Fetch(given)
assert not grid.GetCellData().HasArray("proc")
counts = vtk_to_numpy(grid.GetCellData().GetArray("nlocal"))
assert (counts == cells["nlocal"].reshape(2, 1, 2).transpose().ravel()).all(), (counts, cells)
