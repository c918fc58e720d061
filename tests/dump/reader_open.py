# SPDX-License-Identifier: BSD-3-Clause
"""OpenDataFile finds the reader by name and content; its names are those of the documentation."""
import os
import shutil

from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
source = os.path.join(data, "grains_1000.dump")

# every name that users give to dumps
for name in ("a.dump", "a.lammpstrj", "a.liggghts", "a.dmp", "A.DUMP", "dump.1000", "dump.liggghts",
             "dump.1000.liggghts", "dump1000.liggghts_run", "dump_xyzr-2000", "dump.settling.1000"):
    path = os.path.abspath(name)
    shutil.copy(source, path)
    os.chmod(path, 0o644)
    reader = OpenDataFile(path)
    assert reader is not None and reader.GetXMLName() == "GranularDumpReader", name
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 1200, name
    Delete(reader)

# several files are one run
reader = OpenDataFile([os.path.join(data, f"grains_{step}.dump") for step in (0, 1000, 2000)])
assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
assert list(reader.PointArrayStatus) == ["id", "type", "image", "radius"], reader.PointArrayStatus

# names and defaults
expected = {"Coordinates": "Absolute", "PointPrecision": "Double", "PointOrigin": [0, 0, 0],
            "TimestepSize": 1, "SortById": 0, "Vertices": "Vertex", "Stride": 1,
            "RegionOfInterest": [1, -1, 1, -1, 1, -1]}
for name, default in expected.items():
    value = getattr(reader, name)
    assert (list(value) if isinstance(default, list) else value) == default, (name, value)
assert len(reader.FileNames) == 3

# each property is explained
for name in list(expected) + ["FileNames", "PointArrayStatus", "TimestepValues", "Refresh"]:
    text = reader.SMProxy.GetProperty(name).GetDocumentation()
    assert text and len(text.GetDescription().strip()) > 60, name

# values as words; nonsense is refused
reader.Coordinates = "Scaled"
reader.PointPrecision = "Single"
reader.Vertices = "PolyVertex"
try:
    reader.Coordinates = "Sideways"
except ValueError:
    pass
else:
    raise AssertionError("a coordinate style that does not exist was accepted")
reader.UpdatePipeline(1000)
information = reader.GetDataInformation()
assert information.GetNumberOfPoints() == 1200 and information.GetNumberOfCells() == 1
bounds = information.GetBounds()
assert all(-0.1 < bounds[2 * i] and bounds[2 * i + 1] < 1.1 for i in range(3)), bounds

# what is switched off is not there
reader.PointArrayStatus = ["radius"]
reader.UpdatePipeline(1000)
assert list(reader.PointData.keys()) == ["radius"], reader.PointData.keys()
reader.Stride = 100
reader.UpdatePipeline(1000)
assert reader.GetDataInformation().GetNumberOfPoints() == 12

# the box
box = OutputPort(reader, "Box")
assert box.Port == 1
assert box.GetDataInformation().GetNumberOfCells() == 1
