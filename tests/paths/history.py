# SPDX-License-Identifier: BSD-3-Clause
"""Tables against time of real runs: those of a plain reading of the files, straight from the reader and through a filter."""
import math
import os

import numpy
import vtkgranular as vg
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkPolyData

import plain_dump
import plain_paths
from said import said_by

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
STATISTICS = 1


class Passing(VTKPythonAlgorithmBase):
    """Passes all on; change() may do something to each frame."""

    def __init__(self, source, change=None):
        super().__init__(nInputPorts=1, nOutputPorts=1, inputType="vtkPolyData", outputType="vtkPolyData")
        self.change = change
        self.SetInputConnection(source.GetOutputPort())

    def RequestData(self, request, inputs, outputs):
        output = vtkPolyData.GetData(outputs)
        output.ShallowCopy(vtkPolyData.GetData(inputs[0]))
        if self.change:
            self.change(output)
        return 1


def reader_of(*names):
    reader = vg.vtkGranularDumpReader()
    reader.SetController(None)
    for name in names:
        reader.AddFileName(os.path.join(data, name))
    return reader


def history(source, said=None, time=None, **properties):
    """The columns by name, and their order."""
    filter_ = vg.vtkGranularHistory()
    filter_.SetController(None)
    filter_.SetInputConnection(source.GetOutputPort())
    for name, value in properties.items():
        getattr(filter_, f"Set{name}")(*value if isinstance(value, (tuple, list)) else (value,))
    messages = said_by(filter_)
    if time is None:
        filter_.Update()
    else:
        filter_.UpdateTimeStep(time)
    if said is None:
        assert messages == [], messages
    else:
        assert len(messages) == 1 and said in messages[0], messages
    row = filter_.GetOutput().GetRowData()
    return {row.GetArrayName(i): vtk_to_numpy(row.GetArray(i)).copy() for i in range(row.GetNumberOfArrays())}


def same(one, other):
    return list(one) == list(other) and all(
        one[name].shape == other[name].shape and one[name].tobytes() == other[name].tobytes() for name in one)


def both(reader, **properties):
    """The same straight from the files, through a filter, and with one thread."""
    one = history(reader, **properties)
    assert same(one, history(Passing(reader), **properties)), properties
    assert same(one, history(reader, Threads=1, **properties)), properties
    return one


# ---- single particles ----------------------------------------------------------------------------------------------

RUNS = [(["grains.dump"], {}, "v radius image", "17 3 5-9 999999 9000-9009"), (["plain.dump"], {}, "v type", ""),
        (["ortho_image.dump"], {}, "type", "100-300:10"), (["local/chain.dump"], {}, "mol v", ""),
        (["process_0.dump", "process_50.dump"], {"use_images": False}, "proc", "1-20"),
        (["paths/walk.dump.gz"], {}, "v c_shift", "")]
COLUMNS = {"v": ["vx", "vy", "vz"], "image": ["ix", "iy", "iz"], "c_shift": [f"c_shift[{i}]" for i in (1, 2, 3)]}
for names, plainly, arrays, ids in RUNS:
    frames = [frame for name in names for frame in plain_dump.read(os.path.join(data, name))]
    paths = plain_paths.paths(frames, **plainly)
    reader = reader_of(*names)
    reader.UpdateInformation()
    found = both(reader, Arrays=arrays, Ids=ids, said="ids that are in no frame: 999999\n" if "999999" in ids else None)
    # the particles that are there, ascending, each with its arrays
    chosen = [i for i in paths if not ids or any(
        int(word.split("-")[0]) <= i <= int(word.split("-")[-1].split(":")[0]) and
        (i - int(word.split("-")[0])) % int((word.split(":") + ["1"])[1]) == 0 for word in ids.split())]
    assert chosen
    wanted = ["position"] + arrays.split()
    assert list(found) == ["time", "timestep"] + [f"{name} (id {i})" for i in chosen for name in wanted], list(found)
    assert found["timestep"].tolist() == [frame.timestep for frame in frames]
    assert found["timestep"].dtype == numpy.int64
    for i in chosen:
        path = paths[i]
        expected = numpy.full((len(frames), 3), numpy.nan)
        expected[path.frames] = path.places
        assert numpy.allclose(found[f"position (id {i})"], expected, rtol=1e-12, atol=1e-12, equal_nan=True), i
        for name in arrays.split():
            columns = COLUMNS.get(name, [name])
            expected = numpy.full((len(frames), len(columns)), numpy.nan)
            for number, row in zip(path.frames, path.rows):
                expected[number] = [float(frames[number].columns[column][row]) for column in columns]
            values = found[f"{name} (id {i})"]
            assert values.dtype == numpy.float64
            assert numpy.array_equal(values.reshape(expected.shape), expected, equal_nan=True), (i, name)

all_particles, walk = reader_of("grains.dump"), reader_of("paths/walk.dump.gz")
frames = plain_dump.read(os.path.join(data, "grains.dump"))
assert history(all_particles, "expected at most 1000 particles for columns of their own, got 1200: select fewer by Ids, EveryNth or NumberOfSamples, or take the Output Statistics") == {}
assert len(both(all_particles, EveryNth=2)) == 2 + len({int(i) for frame in frames if frame.rows for i in frame.columns["id"]
                                                 if int(i) % 2 == 0})
assert list(both(all_particles, Ids="-5 7000 7001,7002 7003 8000 8001", said="in no frame: -5, 7000, 7001, 7002, 7003 and 2 others")) == ["time", "timestep"]
few = history(all_particles, "have no particles: msd begins there", NumberOfSamples=-1, MeanSquareDisplacement=True)
assert list(few) == list(both(all_particles, NumberOfSamples=10)) + ["msd", "msd_xyz", "msd_particles"] and len(few) == 15
assert few["msd_particles"][-1] == frames[1].rows, "of all particles"
assert len(both(all_particles, TimeWindow=(500, 1500), Ids="5")["time"]) == 1
assert both(walk, FrameStride=7, Ids="5")["timestep"].tolist() == list(range(0, 601, 140))

# the time that is shown does not matter
assert same(history(walk, time=0, Arrays="v"), history(walk, time=2, Arrays="v"))

# pieces: the first has the table
pieces = [vg.vtkGranularHistory() for _ in range(2)]
for piece, filter_ in enumerate(pieces):
    filter_.SetController(None)
    filter_.SetInputConnection(walk.GetOutputPort())
    filter_.UpdatePiece(piece, 2, 0)
assert pieces[0].GetOutput().GetNumberOfRows() == 31 and pieces[1].GetOutput().GetNumberOfRows() == 0

# ---- statistics ----------------------------------------------------------------------------------------------------

def quantile(values, part):
    values = sorted(values)
    return next((value for k, value in enumerate(values) if (k + 1) / len(values) >= part), values[-1])


for names, arrays, parts in ((["grains.dump"], "v radius type", "0.5"), (["grains.dump"], "mass, v", "0 0.1, 0.25 0.9 1"),
                             (["ortho_custom.bin"], "v", "0.5 0.333"), (["paths/walk.dump.gz"], "v", ""),
                             (["plain.dump"], "radius", "1e-1")):
    frames = plain_dump.read_binary(os.path.join(data, names[0]), "") if names[0].endswith("bin") else plain_dump.read(
        os.path.join(data, names[0]))
    for properties in ({}, {"EveryNth": 3}, {"Ids": "999999"}):
        keep = [[row for row, i in enumerate(frame.columns.get("id", [])) if int(float(i)) % properties.get("EveryNth", 1) == 0
                 and "Ids" not in properties] for frame in frames]
        found = both(reader_of(*names), OutputType=STATISTICS, Arrays=arrays, Quantiles=parts, **properties)
        words = parts.replace(",", " ").split()
        assert list(found) == ["time", "timestep", "particles"] + [
            f"{name}_{what}" for name in arrays.replace(",", " ").split() for what in ["mean", "min", "max"] + words]
        assert found["particles"].tolist() == [len(rows) for rows in keep]
        for name in arrays.replace(",", " ").split():
            columns = COLUMNS.get(name, [name])
            for number, (frame, rows) in enumerate(zip(frames, keep)):
                for k, column in enumerate(columns):
                    values = [float(frame.columns[column][row]) for row in rows]
                    at = lambda what: found[f"{name}_{what}"].reshape(len(frames), -1)[number]
                    if not values:
                        assert all(numpy.isnan(at(what)).all() for what in ["mean", "min", "max"] + words)
                        continue
                    assert len(at("mean")) == len(columns)
                    assert at("mean")[k] == math.fsum(values) / len(values)
                    assert at("min")[k] == min(values) and at("max")[k] == max(values)
                    for word in words:
                        assert at(word)[k] == quantile(values, float(word)), (name, word)

for bad in ("1.5", "-0.1", "x", "0.5x", "nan", "0,5 2"):
    assert history(walk, "expected Quantiles of numbers from 0 to 1, got", OutputType=STATISTICS, Arrays="v", Quantiles=bad) == {}


# an array that some frames lack, as columns of later files do: nan there, as for single particles
def drop(output):
    if output.GetFieldData().GetArray("timestep").GetValue(0) % 40:
        output.GetPointData().RemoveArray("v")


found = history(Passing(walk, drop), Arrays="v", Ids="3")
lacking = numpy.arange(31) % 2 == 1
assert (numpy.isnan(found["v (id 3)"]).all(axis=1) == lacking).all()
found = history(Passing(walk, drop), OutputType=STATISTICS, Arrays="v")
assert (numpy.isnan(found["v_mean"]).all(axis=1) == lacking).all() and found["v_mean"].shape == (31, 3)
assert history(walk, "expected an array 'nothing' of the particles, got none in any frame", OutputType=STATISTICS,
               Arrays="nothing") == {}

# ---- mean square displacements -------------------------------------------------------------------------------------

for names, plainly in ((["grains.dump"], {}), (["plain.dump"], {}), (["ortho_image.dump"], {}), (["tri_unwrapped.dump"], {}),
                       (["local/chain.dump"], {}), (["paths/walk.dump.gz"], {}), (["paths/grown.dump.gz"], {}),
                       (["process_0.dump", "process_50.dump"], {"use_images": False})):
    frames = [frame for name in names for frame in plain_dump.read(os.path.join(data, name))]
    paths = plain_paths.paths(frames, **plainly)
    for output in (0, STATISTICS):
        for properties in ({"EveryNth": 2}, {"Ids": "1-500"}):
            chosen = [path for i, path in paths.items() if (i % 2 == 0 if "EveryNth" in properties else 1 <= i <= 500)]
            start = min(path.frames[0] for path in chosen)  # the first frame that has any of them
            said = f"frames before timestep {frames[start].timestep} have no particles: msd begins there" if start > 0 else None
            found = both(reader_of(*names), said=said, MeanSquareDisplacement=True, OutputType=output, **properties)
            assert list(found)[-3:] == ["msd", "msd_xyz", "msd_particles"]
            for number in range(len(frames)):
                steps = numpy.array([path.places[path.frames.index(number)] - path.places[0] for path in chosen
                                     if path.frames[0] == start and number in path.frames]).reshape(-1, 3)
                assert found["msd_particles"][number] == len(steps)
                if not len(steps):
                    assert math.isnan(found["msd"][number]) and numpy.isnan(found["msd_xyz"][number]).all()
                    continue
                squares = (steps ** 2).mean(axis=0)
                assert numpy.allclose(found["msd_xyz"][number], squares, rtol=1e-9, atol=1e-20), (names, number)
                assert math.isclose(found["msd"][number], squares.sum(), rel_tol=1e-9, abs_tol=1e-20)


# ---- without image counts: to the nearest image, in a box that is sheared and flipped -------------------------------

def forget(output):
    output.GetPointData().RemoveArray("image")


for name, shift in (("walk", "c_shift"), ("grown", "c_again")):
    source = reader_of(f"paths/{name}.dump.gz")
    counted, nearest = (history(each, Arrays=shift, MeanSquareDisplacement=True) for each in (source, Passing(source, forget)))
    for i in range(1, 31):
        for found in (counted, nearest):
            if name == "grown" and found is nearest:
                continue  # a step there begins in images that a box of another size moves
            place = found[f"position (id {i})"]
            assert abs(place - place[0] - found[f"{shift} (id {i})"]).max() < 1e-11, (name, i)
    log = open(os.path.join(data, "paths", f"{name}_log.txt")).read().splitlines()
    rows = [line.split() for line in log if line.split() and line.split()[0].isdigit() and len(line.split()) == 6]
    rows = numpy.array(rows, float)
    for found in (counted, nearest) if name == "walk" else (counted,):
        assert (found["timestep"] == rows[:, 0]).all()
        assert numpy.allclose(found["msd"], rows[:, 5], rtol=1e-10, atol=1e-20)
        assert numpy.allclose(found["msd_xyz"], rows[:, 2:5], rtol=1e-10, atol=1e-20)
print("as it was")
