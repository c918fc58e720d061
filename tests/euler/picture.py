# SPDX-License-Identifier: BSD-3-Clause
"""Euler cells as ParaView's users meet them: series, slices, contours, a picture."""
import os

import numpy
import plain_euler
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
files = [os.path.join(data, f"euler_{step}.vtk") for step in (1000, 2000, 3000, 4000)]

# ---- a series ----------------------------------------------------------------------------------------------

series = OpenDataFile(files, TimestepSize=2e-5)
assert numpy.allclose(series.TimestepValues, [0.02, 0.04, 0.06, 0.08], rtol=1e-15), series.TimestepValues
series.UpdatePipeline(0.06)
points = servermanager.Fetch(series)
assert points.IsA("vtkPolyData") and points.GetNumberOfVerts() == 112
assert points.GetFieldData().GetArray("timestep").GetValue(0) == 3000

# ---- points become cells, with filters behind ------------------------------------------------------------

expected = plain_euler.read(files[1])
table = Calculator(Input=series, Function="volumefraction*2")
table.UpdatePipeline(0.04)
series.Output = "ImageData"
series.UpdatePipeline(0.04)
image = servermanager.Fetch(series)
assert image.IsA("vtkImageData") and image.GetDimensions() == (5, 5, 8)
assert (vtk_to_numpy(image.GetCellData().GetArray("pressure")) == expected["pressure"].ravel()).all()
averaged = CellDatatoPointData(Input=series)
cut = Slice(Input=series, SliceType="Plane")
vg.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
level = Contour(Input=averaged, ContourBy=["POINTS", "volumefraction"], Isosurfaces=[0.05])
for proxy in (averaged, cut, level):
    proxy.UpdatePipeline(0.04)
assert servermanager.Fetch(cut).GetNumberOfCells() >= 28
assert servermanager.Fetch(level).GetNumberOfCells() > 0
bounds = servermanager.Fetch(cut).GetBounds()
assert numpy.allclose(bounds, [.001, .001, -.05, .05, 0, .15], atol=3e-6), bounds
series.Output = "Points"
series.UpdatePipeline(0.04)
assert servermanager.Fetch(series).IsA("vtkPolyData")

# ---- a grid a process --------------------------------------------------------------------------------------

parts = plain_euler.grids(([0, 1, 2], [0, 1, 2], [0, 2]), ([2, 3], [3, 4], [5]))
cells = plain_euler.cells(numpy.concatenate(parts))
cells["volumefraction"] = cells["centres"][:, 2:]
with open("parallel_100.vtk", "w") as file:
    file.write(plain_euler.text(cells))
blocks = OpenDataFile(os.path.abspath("parallel_100.vtk"), Output="ImageData")
assert blocks.GetXMLName() == "GranularEulerReader"
blocks.UpdatePipeline()
assert blocks.GetDataInformation().GetNumberOfCells() == sum(len(part) for part in parts)
assert numpy.allclose(blocks.GetDataInformation().GetBounds(), [0, 2, 0, 2, 0, 2], atol=1e-5)
cut = Slice(Input=blocks, SliceType="Plane")
vg.set_properties(cut.SliceType, Origin=[1, 1, 0.3], Normal=[0, 0, 1])
level = Contour(Input=CellDatatoPointData(Input=blocks), ContourBy=["POINTS", "volumefraction"], Isosurfaces=[1])
for proxy in (cut, level):
    proxy.UpdatePipeline()
    assert proxy.GetDataInformation().GetNumberOfCells() > 0
assert numpy.allclose(level.GetDataInformation().GetBounds(), [0, 2, 0, 2, 1, 1], atol=1e-5)
sums = IntegrateVariables(Input=MergeBlocks(Input=blocks))
sums.UpdatePipeline()
assert abs(servermanager.Fetch(sums).GetCellData().GetArray("Volume").GetValue(0) - 8) < 1e-4

# ---- a picture -----------------------------------------------------------------------------------------------

view = CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
shown = OpenDataFile(files, Output="ImageData")
display = Show(shown, view)
assert display.Representation == "Surface", display.Representation
display.Representation = "Surface With Edges"
ColorBy(display, ("CELLS", "volumefraction"))
view.ViewTime = 4000
display.RescaleTransferFunctionToDataRange()
view.ResetActiveCameraToPositiveY()
GetActiveCamera().Azimuth(30)
GetActiveCamera().Elevation(25)
ResetCamera(view)
SaveScreenshot("cells.png", view)
Show(blocks, view)
Hide(shown, view)
ResetCamera(view)
SaveScreenshot("blocks.png", view)
