# SPDX-License-Identifier: BSD-3-Clause
"""Contacts and bonds as ParaView's users meet them: arrays, rows, lines across faces, tubes in a picture."""
import os

import numpy
import plain_local
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
contacts = os.path.join(data, "local", "contacts.dump")

# ---- arrays and rows ------------------------------------------------------------------------------------

reader = OpenDataFile(contacts, Preset="ContactsForce")
reader.CellArrayStatus = ["force", "position1"]
reader.UpdatePipeline(4000)
assert sorted(array.GetName() for array in reader.CellData[:]) == ["force", "length", "position1"]
rows = OutputPort(reader, "Rows")
assert rows.GetDataInformation().GetNumberOfRows() == 261
assert rows.GetDataInformation().GetDataClassName() == "vtkTable"
reader.Preset = "BondsForce"
reader.UpdatePipelineInformation()
assert "btype" in reader.CellArrayStatus.Available and "periodic" not in reader.CellArrayStatus.Available
reader.Preset = "ContactsForce"

# ---- in space -------------------------------------------------------------------------------------------

frame = plain_local.read(contacts)[-1]
ends = numpy.array(frame.rows, dtype=float)[:, :6].reshape(-1, 3)
for periodic in ("AsWritten", "Split", "MinimumImage"):
    reader.PeriodicLines = periodic
    reader.UpdatePipeline(4000)
    information = reader.GetDataInformation()
    bounds = numpy.array(information.GetBounds()).reshape(3, 2)
    low, high = ends.min(axis=0), ends.max(axis=0)
    if periodic == "AsWritten":
        assert (bounds.T == [low, high]).all(), bounds
    elif periodic == "Split":
        assert numpy.allclose(bounds[:2], 2 * [[-0.05, 0.05]], rtol=0, atol=1e-15), bounds
        assert information.GetNumberOfCells() > 261
    else:
        assert information.GetNumberOfCells() == 261
        assert (bounds[:2, 1] - bounds[:2, 0] > 0.1).any() and (abs(bounds[:2]) < 0.05 + 0.007).all(), bounds

# ---- tubes, as thick as the forces are -------------------------------------------------------------------

view = CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0, UseColorPaletteForBackground=0,
                        Background=[1, 1, 1])
view.ViewTime = 4000
reader.CellArrayStatus = ["id1", "id2", "force"]
shown = Show(reader, view)
assert shown.Representation == "Contacts", shown.Representation
tube = Tube(Input=reader, Radius=0.0006, NumberofSides=12)
Hide(reader, view)
display = Show(tube, view)
ColorBy(display, ("CELLS", "force", "Magnitude"))
colors = GetColorTransferFunction("force")
colors.ApplyPreset(vg.preset("Viridis"), True)
colors.RescaleTransferFunction(0, 0.5)
view.ResetActiveCameraToPositiveY()
ResetCamera(view)
GetActiveCamera().Zoom(1.3)
SaveScreenshot("contacts.png", view)
picture = vtkPNGReader()
picture.SetFileName("contacts.png")
picture.Update()
pixels = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(500, 500, -1)[..., :3]
drawn = (pixels != 255).any(axis=2)
assert 0.05 < drawn.mean() < 0.7, drawn.mean()
assert len(numpy.unique(pixels[drawn], axis=0)) > 500  # colours and shades
fetched = servermanager.Fetch(tube)
assert fetched.GetNumberOfCells() == 261 * 14, fetched.GetNumberOfCells()  # each has 12 sides and 2 caps
assert not numpy.isnan(vtk_to_numpy(fetched.GetPoints().GetData())).any()
print("shown")
