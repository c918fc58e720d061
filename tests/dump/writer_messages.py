# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView says of a writer: warnings of what is made up, one error of what cannot be written."""
import os

import plain_dump
import vtkgranular as vg
from paraview.simple import *

# ---- no ids, no box, no timestep: all are made, and said ---------------------------------------------

sphere = Sphere(Radius=2)
SaveData("sphere.dump", sphere, Dialect="LIGGGHTS")
frame, = plain_dump.read("sphere.dump")
bounds, count = sphere.GetDataInformation().GetBounds(), sphere.GetDataInformation().GetNumberOfPoints()
assert frame.timestep == 0 and frame.rows == count
assert [word for pair in frame.bounds for word in pair] == list(bounds)
assert list(frame.columns)[:5] == ["id", "type", "x", "y", "z"], list(frame.columns)
assert [int(word) for word in frame.columns["id"]] == list(range(1, count + 1))
assert set(frame.columns["type"]) == {"1"}
assert [name for name in frame.columns if name.startswith("Normals")] == [f"Normals[{i}]" for i in (1, 2, 3)]

particles = GranularDumpReader(FileNames=[os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")])
particles.UpdatePipeline(2000)

# ---- what cannot be written: the old file stays ----------------------------------------------------------

with open("messages.dump", "w") as file:
    file.write("the old file")
before = sorted(os.listdir("."))
group = GroupDatasets(Input=[particles, sphere])
for source, path, properties in (
        (group, "messages.dump", {}), (particles, "gone/messages.dump", {}), (particles, "messages.dump", {"NumberFormat": "%d"})):
    SaveData(path, source, **properties)
    try:
        vg.save(source, path, **properties)
    except RuntimeError as error:
        print(error)
    else:
        raise AssertionError(f"{path} {properties}: nothing was raised")
    with open("messages.dump") as file:
        assert file.read() == "the old file"
    assert sorted(os.listdir(".")) == before, os.listdir(".")
SaveData("merged.dump", MergeBlocks(Input=GroupDatasets(Input=[particles])))
assert plain_dump.read("merged.dump")[0].rows == 1200
print("alive")
