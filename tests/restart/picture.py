# SPDX-License-Identifier: BSD-3-Clause
"""Restart files as ParaView's users meet them: times, arrays, files that change, grains and tubes in a picture."""
import os
import shutil
import struct

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
samples = os.path.join(os.environ["GRANULAR_DATA"], "..", "..", "samples", "data", "restart")
fibres = os.path.join(data, "restart", "fibres.restart")

# ---- times and arrays ------------------------------------------------------------------------------------

reader = OpenDataFile([os.path.join(samples, f"fibres.{step}.restart") for step in (40000, 10000, 20000)],
                      TimestepSize=1e-6)
assert numpy.allclose(list(reader.TimestepValues), [0.01, 0.02, 0.04], rtol=1e-12)
assert {"id", "mask", "radius", "mol"} <= set(reader.PointArrayStatus[:])
assert {"id1", "id2", "btype", "damage", "torque_tangential"} <= set(reader.CellArrayStatus[:])
for time, low in ((0.01, -0.0006), (0.02, -0.0015), (0.04, -0.0018)):
    reader.UpdatePipeline(time)
    bounds = reader.GetDataInformation().GetBounds()
    assert reader.GetDataInformation().GetNumberOfPoints() == 87
    bonds = OutputPort(reader, "Bonds").GetDataInformation()
    assert bonds.GetNumberOfCells() == 79 and bonds.GetBounds()[4] < 0
    print(f"{time}: {bounds[4]}")
reader.HistoryLayout = "Numbered"
reader.UpdatePipelineInformation()
assert "history14" in reader.CellArrayStatus.Available and "damage" not in reader.CellArrayStatus.Available
reader.HistoryLayout = "FlexibleFibersDamage"
reader.UpdatePipelineInformation()
assert "damage" in reader.CellArrayStatus.Available
reader.CellArrayStatus = ["id1", "torque_tangential"]
reader.UpdatePipeline(0.04)
assert sorted(array.GetName() for array in OutputPort(reader, 1).CellData[:]) == ["id1", "length", "torque_tangential"]

# what was chosen stays, whatever the names are meanwhile
reader.CellArrayStatus = ["id1", "damage"]
for layout, expected in (("Numbered", ["id1", "length"]), ("Automatic", ["damage", "id1", "length"])):
    reader.HistoryLayout = layout
    reader.UpdatePipeline(0.04)
    found = sorted(array.GetName() for array in OutputPort(reader, 1).CellData[:])
    assert found == expected, (layout, found)
chosen = GranularRestartReader(FileNames=[fibres], HistoryLayout="Numbered", CellArrayStatus=["id1", "history13"])
chosen.UpdatePipeline()
assert sorted(array.GetName() for array in OutputPort(chosen, 1).CellData[:]) == ["history13", "id1", "length"]
Delete(chosen)
pfm = OpenDataFile(os.path.join(data, "restart", "pfm.restart"))
assert "initial_length" in pfm.CellArrayStatus.Available and "equilibrium_length" not in pfm.CellArrayStatus.Available
Delete(pfm)

# ---- files that change -----------------------------------------------------------------------------------

# A run that writes the same names again: the base first, then the files of the processes.
for name in ("base", "0", "1", "2"):
    shutil.copyfile(os.path.join(data, "restart", f"parts.{name}.restart"), f"again.{name}.restart")
again = OpenDataFile(os.path.abspath("again.base.restart"), RefreshOnUpdate=1)
again.UpdatePipeline()
assert again.PointData["radius"].GetRange(0)[0] == 0.001
with open("again.1.restart", "rb") as file:
    content = file.read()
with open("again.1.restart", "wb") as file:
    file.write(content.replace(struct.pack("<d", 0.001), struct.pack("<d", 0.0005)))
again.UpdatePipelineInformation()
again.UpdatePipeline(10000)
assert again.PointData["radius"].GetRange(0)[0] == 0.0005, again.PointData["radius"].GetRange(0)
Delete(again)
reader = OpenDataFile([os.path.join(samples, f"fibres.{step}.restart") for step in (40000, 10000, 20000)],
                      TimestepSize=1e-6)

# arrays that only a file in the middle has are shown, where nobody has left out others
with open(os.path.join(data, "restart", "style_charge.restart"), "rb") as file:
    content = file.read()
flag = 5
with open("charge.restart", "wb") as file:
    file.write(content.replace(struct.pack("<iq", flag, 0), struct.pack("<iq", flag, 15000)))
mixed = OpenDataFile([os.path.join(samples, "fibres.10000.restart"), os.path.abspath("charge.restart"),
                      os.path.join(samples, "fibres.20000.restart")])
assert list(mixed.TimestepValues) == [10000, 15000, 20000]
mixed.UpdatePipeline(15000)
assert "q" in [array.GetName() for array in mixed.PointData[:]]
none = servermanager.Fetch(mixed, idx=1)
assert none.GetNumberOfCells() == 0 and none.GetFieldData().GetArray("timestep").GetValue(0) == 15000
mixed.PointArrayStatus = ["id"]
mixed.UpdatePipeline(15000)
assert [array.GetName() for array in mixed.PointData[:]] == ["id"]
Delete(mixed)

# ---- in the picture --------------------------------------------------------------------------------------

view = CreateRenderView(ViewSize=[400, 300], OrientationAxesVisibility=0, UseColorPaletteForBackground=0,
                        Background=[1, 1, 1])
view.ViewTime = 0.04
shown = Show(reader, view)
assert shown.Representation == "Grains", shown.Representation
Hide(reader, view)
assert Show(OutputPort(reader, 2), view).Representation == "Wireframe"
Hide(OutputPort(reader, 2), view)
tubes = Show(Tube(Input=OutputPort(reader, 1), Radius=0.0005), view)
ColorBy(tubes, ("CELLS", "torque_tangential", "Magnitude"))
ResetCamera(view)
view.ResetActiveCameraToPositiveY()
SaveScreenshot("fibres.png", view)
picture = vtkPNGReader()
picture.SetFileName("fibres.png")
picture.Update()
pixels = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(300, 400, -1)[..., :3]
drawn = (pixels != 255).any(axis=2)
assert 0.01 < drawn.mean() < 0.5, drawn.mean()
assert len(numpy.unique(pixels[drawn], axis=0)) > 100
print("shown")
