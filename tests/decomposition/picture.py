# SPDX-License-Identifier: BSD-3-Clause
"""Decompositions as ParaView's users meet them: series, source and filter, defaults, a picture."""
import os
import shutil

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")

# the counts of PUBLIC's files are not known
reader = OpenDataFile(os.path.join(data, "decomposition/all.vtk"))
reader.UpdatePipeline(2)
grid = servermanager.Fetch(reader)
assert grid.GetNumberOfCells() == 4 and grid.GetNumberOfPoints() == 32
assert grid.GetCellData().GetNumberOfArrays() == 0
assert grid.GetCell(1).GetBounds() == (0, 0.05, -0.05, 0.05, 0, 0.075)

# one file a step: the step is in the name
names = []
for step in (1000, 2000, 4000):
    names.append(os.path.abspath(f"decomposition_{step}.vtk"))
    shutil.copy(os.path.join(data, "decomposition/own_2000.0.vtk"), names[-1])
series = OpenDataFile(names, TimestepSize=2e-5)
assert numpy.allclose(series.TimestepValues, [0.02, 0.04, 0.08], rtol=1e-15)
series.UpdatePipeline(0.04)
assert servermanager.Fetch(series).GetFieldData().GetArray("timestep").GetValue(0) == 2000

# one file a process (%): LIGGGHTS leaves all but the first empty
own = [os.path.join(data, f"decomposition/own_2000.{process}.vtk") for process in range(4)]
reader = GranularDecompositionReader(FileNames=own)
reader.UpdatePipeline()
assert servermanager.Fetch(reader).GetNumberOfCells() == 4
assert servermanager.Fetch(reader).GetFieldData().GetArray("timestep").GetValue(0) == 2000

# the source shows something as it is, and more
source = GranularDecompositionSource()
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfCells() == 1
assert list(source.GetDataInformation().GetBounds()) == [0, 1, 0, 1, 0, 1]
vg.set_properties(source, Bounds=[0, 4, 0, 2, 0, 1], ProcessorGrid=[2, 2, 1], XCuts=[3])
source.UpdatePipeline()
grid = servermanager.Fetch(source)
assert grid.GetNumberOfPoints() == 32 and grid.GetNumberOfCells() == 4
assert sorted({grid.GetCell(i).GetBounds()[1] for i in range(4)}) == [3, 4]
assert not vtk_to_numpy(grid.GetCellData().GetArray("nlocal")).any()
source.XCuts = []
source.UpdatePipeline()
assert servermanager.Fetch(source).GetCell(0).GetBounds()[1] == 2
assert source.SMProxy.GetHints().FindNestedElementByName("ShowInMenu").GetAttribute("category") == "Granular"

# the filter, on the particles of a run
particles = OpenDataFile(os.path.join(data, "grains.dump"))
divided = GranularDecomposition(Input=particles, ProcessorGrid=[2, 1, 2])
for name, default in {"Mode": "ProcessorGrid", "NumberOfProcesses": 0, "ProcessArray": "proc", "Threads": 0, "Subdomains": None}.items():
    assert getattr(divided, name) == default, (name, getattr(divided, name))

view = CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
display = Show(divided, view)
assert display.Representation == "Surface With Edges", display.Representation
assert tuple(display.ColorArrayName) == ("CELLS", "nlocal"), display.ColorArrayName[:]
view.ViewTime = 2000
vg.show(particles, view)
vg.set_properties(display, Opacity=0.4)
view.ResetActiveCameraToPositiveY()
GetActiveCamera().Azimuth(30)
GetActiveCamera().Elevation(25)
ResetCamera(view)
SaveScreenshot("counted.png", view)
counts = vtk_to_numpy(servermanager.Fetch(divided).GetCellData().GetArray("nlocal"))
assert counts.sum() == 1200, counts
