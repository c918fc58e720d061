# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks have a part of an image of cells each, and filters see no seams; grids of processes, and few cells."""
import os

import all_ranks
import numpy
import plain_euler
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import (vtkCellDataToPointData, vtkContourFilter, vtkMassProperties,
                                       vtkTriangleFilter)
from vtkmodules.vtkParallelCore import vtkCommunicator

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
files = [os.path.join(data, f"euler_{step}.vtk") for step in (1000, 2000, 3000, 4000)]
rank = all_ranks.ranks.GetLocalProcessId()


def own(points, name):
    """Values of points that are no ghosts, which writers of ParaView ask for."""
    values = vtk_to_numpy(points.GetPointData().GetArray(name) if name else points.GetPoints().GetData())
    ghosts = points.GetPointData().GetArray("vtkGhostType")
    return values[vtk_to_numpy(ghosts) == 0] if ghosts else values


def cells_of(proxy):
    """How many there are on all ranks."""
    count = proxy.GetDataInformation().GetNumberOfCells()
    if not all_ranks.symmetric:
        return count
    every = numpy_to_vtk(numpy.zeros(1, dtype="int64"), deep=1)
    all_ranks.ranks.AllReduce(numpy_to_vtk(numpy.array([count]), deep=1), every, vtkCommunicator.SUM_OP)
    return int(every.GetValue(0))


# an image: each cell on one rank, and filters see no seams
series = GranularEulerReader(FileNames=files, Output="ImageData")
series.UpdatePipeline(4000)
assert cells_of(series) == 112
assert all_ranks.symmetric or series.GetDataInformation().GetExtent() == (0, 4, 0, 4, 0, 7)
expected = plain_euler.read(files[3])
centres = CellCenters(Input=series, VertexCells=1)
points = all_ranks.whole(centres, 4000)
order = numpy.lexsort(own(points, None).round(4).T)
assert len(order) == 112
assert numpy.allclose(own(points, None)[order], expected["centres"], rtol=0, atol=1e-6)
for array in plain_euler.ARRAYS:
    assert (own(points, array).reshape(112, -1)[order] == expected[array]).all(), array
sums = IntegrateVariables(Input=series)
sums.UpdatePipeline(4000)
level = Contour(Input=CellDatatoPointData(Input=series), ContourBy=["POINTS", "volumefraction"], Isosurfaces=[0.2])
cut = Slice(Input=series, SliceType="Plane")
vg.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
for proxy in (cut, level):
    proxy.UpdatePipeline(4000)
    assert cells_of(proxy) > 0
area = IntegrateVariables(Input=cut)
area.UpdatePipeline(4000)
surface = IntegrateVariables(Input=level)
surface.UpdatePipeline(4000)
if rank == 0 and not all_ranks.symmetric:
    volume = servermanager.Fetch(sums).GetCellData().GetArray("Volume").GetValue(0)
    assert abs(volume - 0.1 * 0.1 * 0.15) < 1e-7, volume
    total = servermanager.Fetch(area).GetCellData().GetArray("Area").GetValue(0)
    assert abs(total - 0.1 * 0.15) < 1e-6, total
    whole = vg.vtkGranularEulerReader()  # the same on this rank alone
    whole.SetController(None)
    whole.AddFileName(files[3])
    whole.SetOutputType(1)
    whole.Update()
    smooth, contour = vtkCellDataToPointData(), vtkContourFilter()
    triangles, mass = vtkTriangleFilter(), vtkMassProperties()
    smooth.SetInputData(whole.GetOutputDataObject(0))
    contour.SetInputConnection(smooth.GetOutputPort())
    contour.SetInputArrayToProcess(0, 0, 0, 0, "volumefraction")
    contour.SetValue(0, 0.2)
    triangles.SetInputConnection(contour.GetOutputPort())
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    alone = mass.GetSurfaceArea()
    together = servermanager.Fetch(surface).GetCellData().GetArray("Area").GetValue(0)
    assert abs(together - alone) < 1e-9 * alone, (together, alone)  # with ghost cells there is no seam

# a grid a process: each on one rank
parts = plain_euler.grids(([0, 1, 2], [0, 1, 2, 3], [0, 2]), ([2, 3], [3, 4, 1], [5]))
values = plain_euler.cells(numpy.concatenate(parts))
name = os.path.abspath(f"parallel_{rank}_100.vtk" if all_ranks.symmetric else "parallel_0_100.vtk")
with open(name, "w") as file:
    file.write(plain_euler.text(values))
all_ranks.ranks.Barrier() if all_ranks.symmetric else None
blocks = GranularEulerReader(FileNames=[os.path.abspath("parallel_0_100.vtk")], Output="ImageData")
blocks.UpdatePipeline()
assert cells_of(blocks) == len(values["centres"])
points = all_ranks.whole(CellCenters(Input=MergeBlocks(Input=blocks, MergePoints=0), VertexCells=1))
found = numpy.sort(own(points, "pressure"))
assert numpy.allclose(found, numpy.sort(values["pressure"].ravel()), rtol=0, atol=1e-6)
cut = Slice(Input=blocks, SliceType="Plane")
vg.set_properties(cut.SliceType, Origin=[1, 1, 0.3], Normal=[0, 0, 1])
smooth = Contour(Input=CellDatatoPointData(Input=blocks), ContourBy=["POINTS", "pressure"], Isosurfaces=[0])
for proxy in (cut, smooth):
    proxy.UpdatePipeline()
    assert cells_of(proxy) > 0

# more ranks than cells, and no cells
for centres in ([[1, 2, 3]], plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2)), numpy.zeros((0, 3))):
    few = f"few_{len(centres)}_{rank if all_ranks.symmetric else 0}_7.vtk"
    with open(few, "w") as file:
        file.write(plain_euler.text(plain_euler.cells(centres)))
    all_ranks.ranks.Barrier() if all_ranks.symmetric else None
    for output in ("Points",) if len(centres) == 1 else ("Points", "ImageData"):  # of one nobody knows the size
        reader = GranularEulerReader(FileNames=[os.path.abspath(f"few_{len(centres)}_0_7.vtk")], Output=output)
        reader.UpdatePipeline()
        assert cells_of(reader) == len(centres), (output, len(centres))
        Delete(reader)
print("all there")
