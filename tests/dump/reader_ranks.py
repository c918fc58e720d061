# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks every particle is there once, in the order of the file, whoever asks."""
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import plain_dump
from all_ranks import symmetric, whole


def good(*names):
    return [os.path.join(os.environ["GRANULAR_DATA"], "good", name) for name in names]


def open_files(*names, **properties):
    return GranularDumpReader(FileNames=good(*names), **properties)


def check(reader, time, frames):
    """frames: of the pieces of one frame, as a second parser sees them."""
    data = whole(reader, time)
    ids = [int(word) for frame in frames for word in frame.columns["id"]]
    assert data.GetNumberOfPoints() == len(ids), (data.GetNumberOfPoints(), len(ids))
    assert data.GetNumberOfVerts() == len(ids)
    if not ids:
        return
    order = numpy.argsort(ids, kind="stable") if reader.SortById else numpy.arange(len(ids))
    read = vtk_to_numpy(data.GetPointData().GetArray("id"))
    assert numpy.array_equal(read, numpy.array(ids)[order]), (reader.FileNames, time)
    if "x" in frames[0].columns:
        points = numpy.concatenate([frame.stack(["x", "y", "z"]) for frame in frames])[order]
        assert numpy.array_equal(vtk_to_numpy(data.GetPoints().GetData()), points)


grains = {step: plain_dump.read(good(f"grains_{step}.dump")[0])[0] for step in (0, 1000, 2000)}
reader = open_files(*[f"grains_{step}.dump" for step in grains])
assert list(reader.TimestepValues) == list(grains)
for time in (0, 1000, 2000):
    check(reader, time, [grains[time]])
reader.SortById = 1
check(reader, 1000, [grains[1000]])

# some of the rows: what is kept of the whole file
reader.Stride = 3
rows = whole(reader, 1000)
ids = vtk_to_numpy(rows.GetPointData().GetArray("id"))
assert list(ids) == list(range(3, 1201, 3)), ids
Delete(reader)

# one file a process of the simulation; and half of the heap
reader = open_files(*[f"pieces_{step}.{piece}.dump" for step in (0, 1000) for piece in range(4)])
for step in (0, 1000):
    frames = [plain_dump.read(good(f"pieces_{step}.{piece}.dump")[0])[0] for piece in range(4)]
    check(reader, step, frames)
heights = numpy.concatenate([frame.numbers("z") for frame in frames])
reader.RegionOfInterest = [1, -1, 1, -1, -1, numpy.median(heights)]
assert whole(reader, 1000).GetNumberOfPoints() == (heights <= numpy.median(heights)).sum() > 100
Delete(reader)

# compressed, and binary
reader = open_files(*[f"ortho_{step:06d}.dump.gz" for step in (0, 50, 100)])
for step in (0, 50, 100):
    check(reader, step, plain_dump.read(good(f"ortho_{step:06d}.dump.gz")[0]))
Delete(reader)
for sort in (0, 1):
    reader = open_files("ortho_custom.bin", SortById=sort)
    frames = plain_dump.read_binary(good("ortho_custom.bin")[0], None)
    for frame in frames:
        check(reader, reader.TimestepValues[frames.index(frame)] if len(frames) > 1
              else frame.timestep, [frame])
    Delete(reader)

# the box once, and arrays that are whole, not there on some ranks only
reader = open_files("grains_1000.dump")
reader.UpdatePipeline()
if not symmetric:
    assert OutputPort(reader, 1).GetDataInformation().GetNumberOfCells() == 1
    assert reader.GetDataInformation().GetNumberOfPoints() == 1200
    assert reader.PointData["id"].GetRange(0) == (1, 1200)
    for name in ("id", "type", "image", "radius"):
        assert not reader.GetPointDataInformation().GetArray(name).GetIsPartial(), name
print("all there")
