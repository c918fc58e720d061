# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks opens restart files and draws their bonds; what goes wrong is said and passes."""
import os

from paraview.simple import *
from ranks_server import connected

fibres = os.path.join(os.environ["GRANULAR_DATA"], "good", "restart", "fibres.restart")
with open(fibres, "rb") as file:
    whole = file.read()
with open("restart.cut", "wb") as file:
    file.write(whole[:-100])

with connected() as server:
    reader = OpenDataFile(fibres)
    assert reader.GetXMLName() == "GranularRestartReader"
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 31
    assert OutputPort(reader, "Bonds").GetDataInformation().GetNumberOfCells() == 27
    assert OutputPort(reader, "Box").GetDataInformation().GetNumberOfCells() == 1
    tube = Tube(Input=OutputPort(reader, 1), Radius=0.0005)
    tube.UpdatePipeline()
    assert tube.GetDataInformation().GetNumberOfCells() > 27
    reader.FileNames = [os.path.abspath("restart.cut")]
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 0
    server.wait_for(r"restart.cut.*expected 31 particles of 3 processes")
    reader.FileNames = [fibres]
    reader.PeriodicLines = "Split"
    reader.UpdatePipeline()
    assert OutputPort(reader, "Bonds").GetDataInformation().GetNumberOfCells() == 28
print("served")
