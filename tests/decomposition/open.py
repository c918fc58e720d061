# SPDX-License-Identifier: BSD-3-Clause
"""Decompositions as ParaView's users meet them: files, source and filter, names, documentation, a picture."""
import os
import shutil

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import granular

data = os.path.join(os.environ["GRANULAR_DATA"], "good")


def check_documentation(proxy, names):
    for name in names:
        text = proxy.SMProxy.GetProperty(name).GetDocumentation()
        assert text and len(text.GetDescription().strip()) > 60, name


# LIGGGHTS-PUBLIC's file of three steps opens as what it is, also under another name
for name in ("all.vtk", "all.decomposition"):
    shutil.copy(os.path.join(data, "decomposition/all.vtk"), name)
    reader = OpenDataFile(os.path.abspath(name))
    assert reader.GetXMLName() == "GranularDecompositionReader", reader
    assert list(reader.TimestepValues) == [0, 1, 2]
    reader.UpdatePipeline(2)
    grid = servermanager.Fetch(reader)
    assert grid.GetNumberOfCells() == 4 and grid.GetNumberOfPoints() == 32
    assert grid.GetCellData().GetNumberOfArrays() == 0  # nobody has counted
    assert grid.GetCell(1).GetBounds() == (0, 0.05, -0.05, 0.05, 0, 0.075)

# one file a step: the step is in the name
names = []
for step in (1000, 2000, 4000):
    names.append(os.path.abspath(f"decomposition_{step}.vtk"))
    shutil.copy(os.path.join(data, "decomposition/own_2000.0.vtk"), names[-1])
series = OpenDataFile(names, TimestepSize=2e-5)
assert series.GetXMLName() == "GranularDecompositionReader"
assert numpy.allclose(series.TimestepValues, [0.02, 0.04, 0.08], rtol=1e-15)
series.UpdatePipeline(0.04)
assert servermanager.Fetch(series).GetFieldData().GetArray("timestep").GetValue(0) == 2000

# one file a process (%): LIGGGHTS leaves all but the first empty
own = [os.path.join(data, f"decomposition/own_2000.{process}.vtk") for process in range(4)]
reader = GranularDecompositionReader(FileNames=own)
reader.UpdatePipeline()
assert servermanager.Fetch(reader).GetNumberOfCells() == 4
assert servermanager.Fetch(reader).GetFieldData().GetArray("timestep").GetValue(0) == 2000

# other files of these names are for ParaView's own readers
SaveData("sphere.vtk", Sphere(), FileType="Ascii")
SaveData("wavelet.vtu", Tetrahedralize(Wavelet()), DataMode="Binary")
SaveData("rectilinear.vtk", Wavelet(), FileType="Ascii")
for name, expected in (("sphere.vtk", "LegacyVTKFileReader"), ("rectilinear.vtk", "LegacyVTKFileReader"),
                       ("wavelet.vtu", "XMLUnstructuredGridReader")):
    assert OpenDataFile(os.path.abspath(name)).GetXMLName() == expected, name

# the source shows something as it is, and more
source = GranularDecompositionSource()
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfCells() == 1
assert list(source.GetDataInformation().GetBounds()) == [0, 1, 0, 1, 0, 1]
granular.set_properties(source, Bounds=[0, 4, 0, 2, 0, 1], ProcessorGrid=[2, 2, 1], XCuts=[3])
source.UpdatePipeline()
grid = servermanager.Fetch(source)
assert grid.GetNumberOfPoints() == 32 and grid.GetNumberOfCells() == 4
assert sorted({grid.GetCell(i).GetBounds()[1] for i in range(4)}) == [3, 4]
assert not vtk_to_numpy(grid.GetCellData().GetArray("nlocal")).any()
source.XCuts = []
source.UpdatePipeline()
assert servermanager.Fetch(source).GetCell(0).GetBounds()[1] == 2
check_documentation(source, ("Bounds", "ProcessorGrid", "NumberOfProcesses", "XCuts", "YCuts", "ZCuts", "Threads"))
assert source.SMProxy.GetHints().FindNestedElementByName("ShowInMenu").GetAttribute("category") == "Granular"

# the filter, on the grains of a run
grains = OpenDataFile(os.path.join(data, "grains.dump"))
divided = GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2])
defaults = {"Mode": "ProcessorGrid", "NumberOfProcesses": 0, "ProcessArray": "proc",
            "Threads": 0, "Subdomains": None}
for name, default in defaults.items():
    assert getattr(divided, name) == default, (name, getattr(divided, name))
check_documentation(divided, ("Input", "Mode", "ProcessorGrid", "Bounds", "ProcessArray", "Subdomains"))
check_documentation(reader, ("FileNames", "TimestepSize", "RepeatedSteps", "RefreshOnUpdate", "CheckOverlap",
                             "CheckGaps", "Threads"))

view = CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
display = Show(divided, view)
assert display.Representation == "Surface With Edges", display.Representation
assert tuple(display.ColorArrayName) == ("CELLS", "nlocal"), display.ColorArrayName[:]
view.ViewTime = 2000
granular.show(grains, view)
granular.set_properties(display, Opacity=0.4)
view.ResetActiveCameraToPositiveY()
GetActiveCamera().Azimuth(30)
GetActiveCamera().Elevation(25)
ResetCamera(view)
SaveScreenshot("counted.png", view)
counts = vtk_to_numpy(servermanager.Fetch(divided).GetCellData().GetArray("nlocal"))
assert counts.sum() == 1200, counts
