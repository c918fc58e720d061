# SPDX-License-Identifier: BSD-3-Clause
"""A working session: save data, save and load the state."""
import os

from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
reader = OpenDataFile(os.path.join(data, "grains.dump"), TimestepSize=2e-5)
reader.PointArrayStatus = ["id", "radius", "v"]
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == [0, 1000 * 2e-5, 2000 * 2e-5], reader.TimestepValues

# data for others: everything is in the file
reader.UpdatePipeline(0.04)
# the default, appended raw data, is not read back by ParaView 5.11 with today's libexpat
SaveData(os.path.abspath("particles.vtp"), reader, DataMode="Binary")
again = OpenDataFile(os.path.abspath("particles.vtp"))
again.UpdatePipeline()
assert again.GetDataInformation().GetNumberOfPoints() == 1200
assert sorted(again.PointData.keys()) == ["id", "radius", "v"]
assert again.PointData["id"].GetRange(0) == (1, 1200)
fields = servermanager.Fetch(again).GetFieldData()
assert fields.GetAbstractArray("Coordinates").GetValue(0) == "Absolute"
assert fields.GetArray("timestep").GetValue(0) == 2000
SaveData(os.path.abspath("all.pvd"), reader, WriteTimeSteps=1, DataMode="Binary")
series = OpenDataFile(os.path.abspath("all.pvd"))
assert list(series.TimestepValues) == list(reader.TimestepValues), series.TimestepValues

# the state of the session
reader.Coordinates = "Scaled"
reader.PointOrigin = [0.5, 0.5, 0.5]
reader.Stride = 2
reader.SortById = 1
reader.RegionOfInterest = [-1, 1, -1, 1, 0, 0.1]
SaveState(os.path.abspath("session.pvsm"))
ResetSession()
LoadState(os.path.abspath("session.pvsm"))
loaded = [proxy for proxy in GetSources().values() if proxy.GetXMLName() == "GranularDumpReader"]
assert len(loaded) == 1, GetSources()
reader = loaded[0]
assert reader.Coordinates == "Scaled" and reader.Stride == 2 and reader.SortById == 1
assert list(reader.PointOrigin) == [0.5] * 3
assert list(reader.PointArrayStatus) == ["id", "radius", "v"], reader.PointArrayStatus
assert list(reader.TimestepValues) == [0, 1000 * 2e-5, 2000 * 2e-5]
reader.UpdatePipeline(0.04)
assert 0 < reader.GetDataInformation().GetNumberOfPoints() <= 600
bounds = reader.GetDataInformation().GetBounds()
assert all(-0.6 < bounds[2 * i] and bounds[2 * i + 1] < 0.6 for i in range(3)), bounds

# a filter sees what the reader gives
threshold = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=0.003,
                      UpperThreshold=1)
threshold.UpdatePipeline(0.04)
assert 0 < threshold.GetDataInformation().GetNumberOfCells() < \
    reader.GetDataInformation().GetNumberOfPoints()
