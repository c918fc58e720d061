# SPDX-License-Identifier: BSD-3-Clause
"""A working session: reload a growing file, animate, save data, save and load the state."""
import os

from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
with open(os.path.join(data, "grains.dump")) as file:
    text = file.read()
second = text.index("ITEM: TIMESTEP", 1)
third = text.index("ITEM: TIMESTEP", second + 1)


def write(length):
    with open("growing.dump", "w") as file:
        file.write(text[:length])


# a running simulation writes on
write(third - 100)  # the second frame is not complete
reader = OpenDataFile(os.path.abspath("growing.dump"))
reader.UpdatePipeline()
assert list(reader.TimestepValues) == [0], reader.TimestepValues
reader.PointArrayStatus = ["id", "radius", "v"]
write(len(text))
ReloadFiles(reader)
assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
assert list(reader.PointArrayStatus) == ["id", "radius", "v"], reader.PointArrayStatus
reader.UpdatePipeline(2000)
assert reader.GetDataInformation().GetNumberOfPoints() == 1200
assert sorted(reader.PointData.keys()) == ["id", "radius", "v"], reader.PointData.keys()

# time of the run instead of steps
reader.TimestepSize = 2e-5
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == [0, 1000 * 2e-5, 2000 * 2e-5], reader.TimestepValues
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
assert list(GetTimeKeeper().TimestepValues) == list(reader.TimestepValues)
seen = []
for time in reader.TimestepValues:
    scene.AnimationTime = time
    reader.UpdatePipeline(time)
    seen.append(reader.GetDataInformation().GetNumberOfPoints())
assert seen == [0, 1200, 1200], seen

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
