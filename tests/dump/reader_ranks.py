# SPDX-License-Identifier: BSD-3-Clause
"""Under several ranks the particles are there once, whoever asks."""
import os

from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
reader = OpenDataFile([os.path.join(data, f"grains_{step}.dump") for step in (0, 1000, 2000)])
assert list(reader.TimestepValues) == [0, 1000, 2000]
for time, points in ((0, 0), (1000, 1200), (2000, 1200)):
    reader.UpdatePipeline(time)
    information = reader.GetDataInformation()
    assert information.GetNumberOfPoints() == points, (time, information.GetNumberOfPoints())
    assert information.GetNumberOfCells() == points
box = OutputPort(reader, 1)
assert box.GetDataInformation().GetNumberOfCells() == 1
identity = reader.PointData["id"]
assert identity.GetRange(0) == (1, 1200), identity.GetRange(0)
# every array is whole, not there on some ranks only
for name in ("id", "type", "image", "radius"):
    assert not reader.GetPointDataInformation().GetArray(name).GetIsPartial(), name
SaveData(os.path.abspath("particles.pvtp"), reader, DataMode="Binary")
again = OpenDataFile(os.path.abspath("particles.pvtp"))
again.UpdatePipeline()
assert again.GetDataInformation().GetNumberOfPoints() == 1200
