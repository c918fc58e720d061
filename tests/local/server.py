# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks opens contacts and draws them; what goes wrong is said and passes."""
import os

from paraview.simple import *
from ranks_server import connected

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")

with connected() as server:
    reader = OpenDataFile(os.path.join(data, "contacts.dump"))
    assert reader.GetXMLName() == "GranularLocalReader"
    assert list(reader.TimestepValues) == [0, 1000, 2000, 3000, 4000]
    assert reader.CellArrayStatus[:] == ["id1", "id2", "periodic", "force"], reader.CellArrayStatus[:]
    for step, count in ((0, 0), (4000, 261), (1000, 4)):
        reader.UpdatePipeline(step)
        assert reader.GetDataInformation().GetNumberOfCells() == count
        assert OutputPort(reader, "Rows").GetDataInformation().GetNumberOfRows() == count
    server.wait_for("taken for the preset ContactsForce")
    reader.PeriodicLines = "Split"
    tube = Tube(Input=reader)
    tube.UpdatePipeline(4000)
    assert tube.GetDataInformation().GetNumberOfCells() > 261
    low, high = reader.CellData["row"].GetRange(0)
    assert (low, high) == (0, 260), (low, high)
    reader.Preset = "Bonds"
    reader.UpdatePipeline(4000)
    assert reader.GetDataInformation().GetNumberOfCells() == 0
    server.wait_for(r"contacts.dump:1: expected the 9 columns of the preset Bonds")
    print("Bonds were refused")
    reader.Preset = "Automatic"
    reader.UpdatePipeline(2000)
    assert OutputPort(reader, "Rows").GetDataInformation().GetNumberOfRows() == 35
print("served")
