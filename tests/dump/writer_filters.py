# SPDX-License-Identifier: BSD-3-Clause
"""What filters make of particles is written as it is: which ones, where they are, what they have."""
import os

import numpy
import plain_dump
import vtkgranular as vg
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
EXACT = {"NumberFormat": "%.17g"}


def open_dump(name, **properties):
    return GranularDumpReader(FileNames=[os.path.join(data, name)], **properties)


def last(name):
    return plain_dump.read(os.path.join(data, name))[-1]


def written(source, time=None, **properties):
    """The frame that is written of a source."""
    source.UpdatePipeline() if time is None else source.UpdatePipeline(time)
    vg.save(source, "out.dump", **EXACT, **properties)
    frame, = plain_dump.read("out.dump")
    return frame


def ids(frame):
    return frame.numbers("id").astype(int)


def ulps(values, expected):
    """The largest distance, in steps of the doubles expected."""
    return (abs(values - expected) / numpy.spacing(abs(expected))).max()


all_particles = last("grains.dump")
names = list(all_particles.columns)
where = all_particles.stack(["x", "y", "z"])
reader = open_dump("grains.dump")
everything = open_dump("grains.dump")
everything.PointArrayStatus = list(everything.GetProperty("PointArrayStatus").Available)
for source in (reader, everything):
    frame = written(source, 2000)
    assert list(frame.columns) == names
    assert (frame.stack(names) == all_particles.stack(names)).all()

# ---- some of the particles ----------------------------------------------------------------------------

some = Threshold(Input=reader, Scalars=["POINTS", "id"], LowerThreshold=100, UpperThreshold=199)
frame = written(some, 2000)
kept = numpy.isin(ids(all_particles), numpy.arange(100, 200))
assert frame.rows == 100 and frame.timestep == 2000 and frame.bounds == all_particles.bounds
assert list(frame.columns) == names and (frame.stack(names) == all_particles.stack(names)[kept]).all()

selection = IDSelectionSource(FieldType="POINT", IDs=[-1, 3, -1, 7, -1, 1000])
frame = written(ExtractSelection(Input=reader, Selection=selection), 2000)
assert (ids(frame) == ids(all_particles)[[3, 7, 1000]]).all() and list(frame.columns)[:len(names)] == names
assert list(frame.columns)[len(names):] == ["vtkOriginalPointIds"], list(frame.columns)

nothing = Threshold(Input=reader, Scalars=["POINTS", "id"], LowerThreshold=-2, UpperThreshold=-1)
frame = written(nothing, 2000)
assert frame.rows == 0 and frame.bounds == all_particles.bounds and frame.timestep == 2000
assert list(frame.columns) == names

# ---- something new ---------------------------------------------------------------------------------

speed = Calculator(Input=reader, ResultArrayName="speed", Function="mag(v)")
frame = written(speed, 2000)
assert list(frame.columns) == names + ["speed"]
assert ulps(frame.numbers("speed"), numpy.linalg.norm(all_particles.stack(["vx", "vy", "vz"]), axis=1)) <= 2
twice = Calculator(Input=reader, ResultArrayName="two words", Function="2*v")
frame = written(twice, 2000)
assert list(frame.columns) == names + [f"two_words[{i}]" for i in (1, 2, 3)]
assert (frame.numbers("two_words[3]") == 2 * all_particles.numbers("vz")).all()
over = Calculator(Input=reader, ResultArrayName="v", Function="2*v")  # takes the place of the file's
frame = written(over, 2000)
assert list(frame.columns) == names
assert (frame.stack(["vx", "vy", "vz"]) == 2 * all_particles.stack(["vx", "vy", "vz"])).all()

# ---- points that were moved --------------------------------------------------------------------------

for source in (reader, everything):  # with the columns x y z of the file, and without
    moved = Transform(Input=source)
    moved.Transform.Translate = [1, -2, 4]
    frame = written(moved, 2000)
    expected = where + [1, -2, 4]
    assert ulps(frame.stack(["x", "y", "z"]), expected) <= 1
    assert frame.bounds == all_particles.bounds

# ---- what the reader did to them --------------------------------------------------------------------

for name in ("ortho_unwrapped.dump", "tri_unwrapped.dump"):
    truth = last(name)
    for coordinates in ("Absolute", "Unwrapped", "Scaled"):
        for origin in ([0, 0, 0], [1e5, -300, 0.1]):
            reader = open_dump(name, Coordinates=coordinates, PointOrigin=origin)
            frame = written(reader, reader.TimestepValues[-1], Columns="id x y z xu yu zu")
            assert (ids(frame) == ids(truth)).all()
            # the box is about 10 wide: some steps of the numbers that a coordinate is made from
            largest = 10 + numpy.abs(origin).max()
            allowed = 8 * numpy.spacing(largest)
            for columns in (["x", "y", "z"], ["xu", "yu", "zu"]):
                off = abs(frame.stack(columns) - truth.stack(columns)).max()
                assert off <= allowed, (name, coordinates, origin, columns, off)
            Delete(reader)

single = open_dump("grains.dump", PointPrecision="Single")
frame = written(single, 2000)
assert (frame.stack(["x", "y", "z"]) == where.astype(numpy.float32)).all()

print("right")
