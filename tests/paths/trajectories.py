# SPDX-License-Identifier: BSD-3-Clause
"""Paths of real runs: those that a plain reading of the files gives, straight from the reader and through a filter."""
import gc
import os
import runpy
import sys

if __name__ == "__main__":  # where the scripts of filters leave names such as max
    runpy.run_path(__file__, run_name="apart")
    sys.exit()

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

import plain_dump
import plain_paths
from said import said_by

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
gc.freeze()  # a filter with a script collects garbage each time it runs, through all of ParaView's modules


def reader_of(*names, **properties):
    return GranularDumpReader(FileNames=[os.path.join(data, name) for name in names], **properties)


def beside(reader):
    """A filter that changes nothing that paths need: the frames come by the pipeline."""
    return ProgrammableFilter(Input=reader, Script="self.GetOutput().ShallowCopy(self.GetInput())", CopyArrays=0)


def update(proxy, time=None):
    """The lines, and what was said."""
    algorithm = proxy.GetClientSideObject()
    said = said_by(algorithm)
    proxy.UpdatePipeline(*([] if time is None else [time]))
    algorithm.RemoveObservers("WarningEvent")
    algorithm.RemoveObservers("ErrorEvent")
    return plain_paths.lines_of(algorithm.GetOutput()), said


def times_of(proxy):
    proxy.UpdatePipelineInformation()
    information = proxy.GetClientSideObject().GetOutputInformation(0)
    return list(information.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or [])


def draw(source, time=None, said=None, **properties):
    proxy = GranularTrajectories(Input=source, **{"NumberOfSamples": 0, **properties})
    lines, messages = update(proxy, time)
    Delete(proxy)
    if said is None:
        assert messages == [], messages
    else:
        assert len(messages) == 1 and said in messages[0], messages
    return lines


def expect(lines, paths, times, steps, frames=(), arrays=(), near=1e-12):
    """Lines of points, times and numbers of rows are those of plain paths."""
    assert list(lines) and set(lines) == set(paths)
    for particle, path in paths.items():
        stretches = path.stretches()
        assert len(lines[particle]) == len(stretches), particle
        for line, stretch in zip(lines[particle], stretches):
            places = numpy.array([path.places[i] for i in stretch])
            numbers = [path.frames[i] for i in stretch]
            assert abs(line["points"] - places).max() <= near * max(1, abs(places).max()), (particle, line["points"], places)
            assert (line["time"] == [times[f] for f in numbers]).all()
            assert (line["timestep"] == [steps[f] for f in numbers]).all()
            assert line["timestep"].dtype == numpy.int64
            assert numpy.allclose(line["displacement"], places - path.places[0], rtol=0, atol=near * max(1, abs(places).max()))
            way = numpy.sqrt((numpy.diff(places, axis=0) ** 2).sum(axis=1))
            assert abs(line["length"] - way.sum()) <= 1e-11 * max(1, way.sum())
            for i in range(len(stretch)):
                near_steps = way[max(i - 1, 0):i + 1]
                last, first = times[numbers[min(i + 1, len(stretch) - 1)]], times[numbers[max(i - 1, 0)]]
                speed = near_steps.sum() / (last - first) if len(near_steps) else 0
                assert abs(line["speed"][i] - speed) <= 1e-10 * max(1, speed)
            for name, columns in arrays:
                values = numpy.array([[float(frames[path.frames[i]].columns[column][path.rows[i]]) for column in columns]
                                      for i in stretch])
                assert (line[name].reshape(values.shape) == values).all(), (particle, name)


# ---- real files, both ways -----------------------------------------------------------------------------------------

KINDS = [
    (["grains.dump"], {}, {}, [("v", ["vx", "vy", "vz"]), ("radius", ["radius"]), ("type", ["type"]), ("image", ["ix", "iy", "iz"])]),
    (["grains_0.dump", "grains_1000.dump", "grains_2000.dump"], {}, {}, [("radius", ["radius"])]),
    (["plain.dump"], {}, {}, [("v", ["vx", "vy", "vz"])]),
    (["ortho_image.dump"], {}, {}, [("type", ["type"])]),
    (["ortho_plain.dump"], {}, {"use_images": False}, []),
    (["ortho_scaled.dump"], {}, {"use_images": False}, []),
    (["ortho_scaled_image.dump"], {}, {}, []),
    (["ortho_unwrapped.dump"], {}, {}, []),
    (["ortho_unwrapped.dump"], {"Coordinates": "Unwrapped"}, {"unwrapped": True}, []),
    (["ortho_unwrapped.dump"], {"Coordinates": "Scaled"}, {}, []),
    (["tri_unwrapped.dump"], {}, {}, []),
    (["tri_plain.dump"], {}, {"use_images": False}, []),
    (["local/chain.dump"], {}, {}, [("v", ["vx", "vy", "vz"]), ("mol", ["mol"])]),
    (["process_0.dump", "process_50.dump"], {}, {"use_images": False}, [("proc", ["proc"])]),
    (["paths/walk.dump.gz"], {}, {}, [("v", ["vx", "vy", "vz"])]),
    (["paths/grown.dump.gz"], {}, {}, []),
]
for names, form, plainly, arrays in KINDS:
    frames = [frame for name in names for frame in plain_dump.read(os.path.join(data, name))]
    steps = [frame.timestep for frame in frames]
    reader = reader_of(*names, **form)
    times = [float(step) for step in steps] if frames[0].time is None else [frame.time for frame in frames]
    assert numpy.allclose(reader.TimestepValues, times, rtol=1e-15, atol=0), (names, times, reader.TimestepValues)
    times = list(reader.TimestepValues)
    paths = plain_paths.paths(frames, **plainly)
    wanted = ", ".join(name for name, _ in arrays)
    # steps of ortho_* and process_* are longer than a quarter of a period here and there
    said = "longer than a quarter of a period" if names[0][:5] in ("ortho", "tri_p", "proce") and not plainly.get(
        "use_images", True) else None
    near = 1e-6 if form.get("Coordinates") == "Scaled" else 1e-12
    proxy = GranularTrajectories(Input=reader, Arrays=wanted, NumberOfSamples=0)
    straight, messages = update(proxy, times[-1])
    assert messages == [] or "longer than a quarter of a period" in messages[0] and not plainly.get("use_images", True), messages
    expect(straight, paths, times, steps, frames, arrays, near)
    output = proxy.GetClientSideObject().GetOutput()
    # by ids, points first; the file's box, and no times
    fields = output.GetFieldData()
    assert fields.GetArray("timestep").GetValue(0) == steps[-1]
    assert fields.GetAbstractArray("Coordinates").GetValue(0) == "Unwrapped"
    through = beside(reader)
    piped = GranularTrajectories(Input=through, Arrays=wanted, NumberOfSamples=0)
    lines, again = update(piped, times[-1])
    assert again == messages, (again, messages)
    if form.get("Coordinates") == "Scaled":  # by the box and back
        expect(lines, paths, times, steps, frames, arrays, near)
    else:
        assert plain_paths.same(lines, straight), names
    for each in (piped, through, proxy, reader):
        Delete(each)

# ---- particles that appear: most have no place in the first frame ------------------------------------------------------

frames = plain_dump.read(os.path.join(data, "grains.dump"))
assert frames[0].rows == 0 and 0 < frames[1].rows
all_particles = reader_of("grains.dump")
through = beside(all_particles)
times = [0., 1000., 2000.]


def both(*, said=None, **properties):
    """The same both ways."""
    one = draw(all_particles, times[-1], said, **properties)
    assert plain_paths.same(one, draw(through, times[-1], said, **properties)), properties
    return one


everything = both()
ids = sorted(everything)


def chosen(lines):
    """That these are some of all paths, and which."""
    assert plain_paths.same(lines, {i: everything[i] for i in lines})
    return sorted(lines)


assert chosen(both(Ids="17, 42,100-110:5 999999", said="in no frame: 999999")) == [17, 42, 100, 105, 110]
assert chosen(both(EveryNth=7)) == [i for i in ids if i % 7 == 0]
assert chosen(both(EveryNth=7, Ids="1-100")) == [i for i in ids if i % 7 == 0 and i <= 100]
last = {int(i): place for i, place in zip(frames[2].columns["id"], frames[2].stack("xyz"))}
first = {int(i): place for i, place in zip(frames[1].columns["id"], frames[1].stack("xyz"))}
middle = float(numpy.median([place[2] for place in last.values()]))
assert chosen(both(RegionOfInterest=[1, -1, 1, -1, 0, middle])) == sorted(i for i, place in last.items() if 0 <= place[2] <= middle)
assert chosen(both(RegionOfInterest=[1, -1, 1, -1, 0, middle], SelectionFrame=1)) == sorted(
    i for i, place in first.items() if 0 <= place[2] <= middle)
assert chosen(both(RegionOfInterest=[0, 0.01, 1, -1, 0, middle], SelectionFrame=-2, EveryNth=2)) == sorted(
    i for i, place in first.items() if 0 <= place[2] <= middle and 0 <= place[0] <= 0.01 and i % 2 == 0)
assert both(RegionOfInterest=[1, -1, 1, -1, 0, middle], SelectionFrame=0) == {}
sample = chosen(both(NumberOfSamples=20))
assert len(sample) == 20 and sample != ids[:20]
assert chosen(both(NumberOfSamples=20, Seed=1)) != sample
assert chosen(both(NumberOfSamples=100000)) == sorted(last)
assert chosen(both(NumberOfSamples=-1)) == chosen(both(NumberOfSamples=40)), "a few, if nothing else chooses"
assert chosen(both(NumberOfSamples=-1, EveryNth=7)) == [i for i in ids if i % 7 == 0]
assert chosen(both(NumberOfSamples=-1, RegionOfInterest=[1, -1, 1, -1, 0, middle])) == sorted(i for i, place in last.items() if 0 <= place[2] <= middle)
assert len(chosen(both(NumberOfSamples=-1, SelectionFrame=0))) == 40, "of the middle frame, if the selection frame has no particles"
assert len(chosen(both(NumberOfSamples=5, EveryNth=50, SelectionFrame=1))) == 5
assert both(Ids="-7", said="in no frame: -7") == {}
assert both(NumberOfSamples=3, SelectionFrame=0) == {}

# frames
assert {line["time"][0] for lines in both(TimeWindow=[500, 1500]).values() for line in lines} == {1000.}
alone = both(TimeWindow=[1000, 1000])
assert len(alone) == frames[1].rows and all(len(lines) == 1 and len(lines[0]["points"]) == 1 and lines[0]["speed"][0] == 0
                                            and lines[0]["length"] == 0 for lines in alone.values())
proxy = GranularTrajectories(Input=all_particles, TimeWindow=[1000, 1000], NumberOfSamples=0)
proxy.UpdatePipeline(0)
output = proxy.GetClientSideObject().GetOutput()
assert output.GetNumberOfVerts() == frames[1].rows and output.GetNumberOfLines() == 0
Delete(proxy)
assert sorted({t for lines in both(FrameStride=2).values() for line in lines for t in line["time"]}) == [2000.]
assert sorted({t for lines in both(FrameStride=2, TimeWindow=[1, 1e9]).values() for line in lines for t in line["time"]}) == [1000.]
for first_time, last_time in ((5, 4), (1, -1)):
    assert plain_paths.same(both(TimeWindow=[first_time, last_time]), everything)

# arrays
names = {"type", "image", "v", "f", "omega", "radius", "mass"}
lines = both(Arrays="*", Ids="1-50")
line = next(iter(lines.values()))[0]
assert names | {"points", "length", "time", "timestep", "speed", "displacement"} == set(line), set(line)
assert line["type"].dtype == line["image"].dtype == numpy.int64 and line["v"].dtype == numpy.float64
texts = reader_of("plain.dump")
for source in (texts, beside(texts)):
    assert draw(source, 0, "expected numbers in array 'element' of the particles, got texts", Arrays="element") == {}
    assert "element" not in draw(source, 0, Arrays="*")[1][0]
Delete(texts)

# ---- a filter makes particles come and go --------------------------------------------------------------------------

walk = plain_dump.read(os.path.join(data, "paths", "walk.dump.gz"))
walkers = reader_of("paths/walk.dump.gz")
HIDE = """
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy, numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
particles, output = self.GetInput(), self.GetOutput()
step = particles.GetFieldData().GetArray("timestep").GetValue(0) // 20
ids = vtk_to_numpy(particles.GetPointData().GetArray("id"))
keep = numpy.flatnonzero((ids + step) % 7 > 2) if step != 5 else []
points = vtkPoints()
points.SetDataTypeToDouble()
points.SetData(numpy_to_vtk(vtk_to_numpy(particles.GetPoints().GetData())[keep].reshape(-1, 3), deep=1))
output.SetPoints(points)
for i in range(particles.GetPointData().GetNumberOfArrays()):
    array = particles.GetPointData().GetArray(i)
    part = numpy_to_vtk(vtk_to_numpy(array)[keep], deep=1, array_type=array.GetDataType())
    part.SetName(array.GetName())
    output.GetPointData().AddArray(part)
output.GetFieldData().ShallowCopy(particles.GetFieldData())
"""
hidden = ProgrammableFilter(Input=walkers, Script=HIDE, CopyArrays=0)
for frame in walk:
    step = frame.timestep // 20
    keep = [row for row, i in enumerate(frame.columns["id"]) if (int(i) + step) % 7 > 2 and step != 5]
    frame.columns = {name: [column[row] for row in keep] for name, column in frame.columns.items()}
    frame.rows = len(keep)
paths = plain_paths.paths(walk)
lines = draw(hidden, 0, Arrays="v")
expect(lines, paths, list(walkers.TimestepValues), [frame.timestep for frame in walk], walk, [("v", ["vx", "vy", "vz"])])
assert sum(len(each) for each in lines.values()) > 100
history = GranularHistory(Input=hidden, MeanSquareDisplacement=1, NumberOfSamples=0)
history.UpdatePipeline(0)
table = history.GetClientSideObject().GetOutput().GetRowData()
for particle, path in paths.items():
    expected = numpy.full((31, 3), numpy.nan)
    expected[path.frames] = path.places
    assert numpy.allclose(vtk_to_numpy(table.GetArray(f"position (id {particle})")), expected, rtol=1e-12, atol=1e-12, equal_nan=True), particle
for number, (count, msd) in enumerate(zip(*(vtk_to_numpy(table.GetArray(name)) for name in ("msd_particles", "msd")))):
    steps = [path.places[path.frames.index(number)] - path.places[0] for path in paths.values() if path.frames[0] == 0 and number in path.frames]
    assert count == len(steps) and (numpy.isclose(msd, (numpy.array(steps) ** 2).sum() / len(steps), rtol=1e-9, atol=1e-20) if steps else msd != msd)
Delete(history)

# ---- tails ---------------------------------------------------------------------------------------------------------

times = list(walkers.TimestepValues)
for source in (walkers, hidden):
    tail = GranularTrajectories(Input=source, Tail=4, Arrays="*", NumberOfSamples=0)
    assert times_of(tail) == times
    order = [*range(7), 11, 10, 9, 3, 4, 30, 0, 1, 15, 14, 16, 29, 30]
    for number in order:
        lines, messages = update(tail, times[number])
        assert messages == []
        shown = sorted({t for each in lines.values() for line in each for t in line["time"]})
        wanted = times[max(0, number - 4):number + 1]
        assert shown == [t for t in wanted if source is walkers or t != times[5]], (number, shown)
        fresh = draw(source, times[number], TimeWindow=[wanted[0], wanted[-1]], Arrays="*")
        assert plain_paths.same(lines, fresh), number
    # in between, before and after
    for time, number in ((times[7] + 0.01, 7), (-5, 0), (1e9, 30)):
        lines, _ = update(tail, time)
        assert max(t for each in lines.values() for line in each for t in line["time"]) == times[number]
    # what changes is not forgotten
    tail.Ids = "1-10"
    lines, _ = update(tail, times[8])
    assert set(lines) <= set(range(1, 11)) and lines
    tail.Arrays = ""
    lines, _ = update(tail, times[9])
    assert "v" not in next(iter(lines.values()))[0]
    tail.FrameStride = 3
    lines, _ = update(tail, times[9])
    shown = sorted({t for each in lines.values() for line in each for t in line["time"]})
    assert shown == [times[f] for f in (0, 3, 6, 9)], shown
    tail.Tail = 0
    lines, _ = update(tail, times[9])
    shown = sorted({t for each in lines.values() for line in each for t in line["time"]})
    assert shown == [times[f] for f in range(0, 31, 3)], shown
    Delete(tail)
assert times_of(GranularTrajectories(Input=walkers)) == []

# of particles.dump, whose first frame has no particles, and "*" none of their arrays
tail = GranularTrajectories(Input=all_particles, Tail=1, Arrays="*", NumberOfSamples=0)
for time in (0, 1000, 2000, 0, 1000, 2000, 1000, 0):
    lines, messages = update(tail, time)
    assert messages == []
    fresh = draw(all_particles, time, TimeWindow=[time - 1000, time], Arrays="*") if time else {}
    assert plain_paths.same(lines, fresh), time
Delete(tail)

# frames whose columns change: "*" is that of each time
with open("changing.dump", "w") as file:
    for step, extra in enumerate(("", " radius", " radius mass vx vy vz", " mass", "")):
        numbers = " 0.5" * (len(extra.split()))
        file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                   f"ITEM: ATOMS id x y z{extra}\n1 0.{step}1 0.5 0.5{numbers}\n2 0.{step}2 0.5 0.5{numbers}\n")
changing = GranularDumpReader(FileNames=[os.path.abspath("changing.dump")])
for source in (changing, beside(changing)):
    tail = GranularTrajectories(Input=source, Tail=2, Arrays="*", NumberOfSamples=0)
    for time in (0, 1, 2, 3, 4, 3, 2, 1, 0, 4, 0, 2):
        lines, messages = update(tail, time)
        assert messages == [], messages
        fresh = draw(source, time, TimeWindow=[time - 2, time], Arrays="*")
        assert plain_paths.same(lines, fresh), time
    Delete(tail)
    lines = draw(source, 2, Arrays="*")
    assert numpy.array_equal(lines[1][0]["radius"], [numpy.nan, 0.5, 0.5, numpy.nan, numpy.nan], equal_nan=True)

# ---- split lines ---------------------------------------------------------------------------------------------------

chains = reader_of("local/chain.dump")
for source in (walkers, chains):
    for name in ("Unwrapped", "Split"):
        proxy = GranularTrajectories(Input=source, PeriodicLines=name, Arrays="v", NumberOfSamples=0)
        proxy.UpdatePipeline(0)
        fields = proxy.GetClientSideObject().GetOutput().GetFieldData()
        assert fields.GetAbstractArray("Coordinates").GetValue(0) == ("Absolute" if name == "Split" else "Unwrapped")
        Delete(proxy)
whole = draw(chains, 0, Arrays="mol v")
split = draw(chains, 0, PeriodicLines="Split", Arrays="mol v")
cut = 0
for particle, lines in split.items():
    cut += len(lines) - 1
    assert all(line["length"] == whole[particle][0]["length"] for line in lines)
    # numbers at the cuts are between those of the frames, the same on both sides
    for one, other in zip(lines, lines[1:]):
        assert one["time"][-1] == other["time"][0] and (one["v"][-1] == other["v"][0]).all()
        assert one["timestep"][-1] == other["timestep"][0]
    every = numpy.concatenate([line["time"] for line in lines])
    assert (numpy.diff(every) >= 0).all()
    for name in ("time", "speed", "v"):
        values = numpy.concatenate([line[name] for line in lines])
        at = [int(i) for i in numpy.flatnonzero(numpy.isin(every, whole[particle][0]["time"]))]
        expected = numpy.stack([numpy.interp(every, whole[particle][0]["time"], column)
                                for column in whole[particle][0][name].reshape(len(whole[particle][0]["time"]), -1).T], axis=1)
        assert numpy.allclose(values.reshape(expected.shape), expected, rtol=1e-12, atol=1e-12), name
        assert at
assert cut > 10, cut
assert plain_paths.same(draw(beside(chains), 0, PeriodicLines="Split", Arrays="mol v"), split)
unwrapped = reader_of("ortho_unwrapped.dump", Coordinates="Unwrapped")
assert plain_paths.same(draw(unwrapped, 0, PeriodicLines="Split"), draw(unwrapped, 0))

# ---- an input without times, and the origin of points --------------------------------------------------------------

still = TrivialProducer()
still.GetClientSideObject().SetOutput(chains.GetClientSideObject().GetOutput())
lines = draw(still)
assert len(lines) == 100 and all(len(each) == 1 and each[0]["time"].tolist() == [0] for each in lines.values())
shifted = reader_of("local/chain.dump", PointOrigin=[1000, -3, 0.5])
for properties in ({}, {"PeriodicLines": "Split"}):
    moved, there = draw(shifted, 0, **properties), draw(chains, 0, **properties)
    for particle, lines in there.items():
        for line, other in zip(lines, moved[particle]):
            assert abs(line["points"] - [1000, -3, 0.5] - other["points"]).max() < 1e-12
proxy = GranularTrajectories(Input=shifted)
proxy.UpdatePipeline(0)
origin = proxy.GetClientSideObject().GetOutput().GetFieldData().GetArray("PointOrigin")
assert [origin.GetComponent(0, i) for i in range(3)] == [1000, -3, 0.5]
print("drawn as they went")
