# SPDX-License-Identifier: BSD-3-Clause
"""What paths say: errors name what they mean, leave the outputs empty and the next update good; cancelling says nothing."""
import os

import numpy
import vtkgranular as vg
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkElevationFilter

import plain_paths
from stopping import stopped
from said import said_by

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
walk = os.path.join(data, "paths", "walk.dump.gz")
kept = []


def reader_of(name):
    reader = vg.vtkGranularDumpReader()
    reader.SetController(None)
    reader.AddFileName(os.path.abspath(name))
    reader.said = said_by(reader)
    kept.append(reader)  # its port does not keep it
    return reader


def filter_of(kind, source):
    made = getattr(vg, f"vtkGranular{kind}")()
    made.SetController(None)
    if source.IsA("vtkDataObject"):
        made.SetInputData(source)
    else:
        made.SetInputConnection(source.GetOutputPort())
    made.said = said_by(made)
    return made


def set_all(filter_, **properties):
    for name, value in properties.items():
        getattr(filter_, f"Set{name}")(*value if isinstance(value, (tuple, list)) else (value,))


def size_of(filter_):
    output = filter_.GetOutput()
    return output.GetNumberOfColumns() if output.IsA("vtkTable") else output.GetNumberOfCells() + output.GetNumberOfPoints()


def works(filter_, time=None):
    filter_.said.clear()
    filter_.Update() if time is None else filter_.UpdateTimeStep(time)
    assert filter_.said == [] and filter_.GetErrorCode() == 0 and not filter_.GetErrorMessage(), filter_.said
    assert size_of(filter_) > 0


def fails(filter_, *parts):
    filter_.said.clear()
    filter_.Modified()  # the same is not told again of an input that has changed
    filter_.Update()
    assert len(filter_.said) == 1, filter_.said
    assert all(part in filter_.said[0] for part in parts), (filter_.said, parts)
    assert all(part in filter_.GetErrorMessage() for part in parts)
    assert size_of(filter_) == 0 and filter_.GetErrorCode() != 0


def refuses(filter_, name, value, range_):
    """A number outside a range is an error, and changes nothing."""
    before = getattr(filter_, f"Get{name}")()
    filter_.said.clear()
    set_all(filter_, **{name: value})
    assert len(filter_.said) == 1 and f"{name} must be {range_}, got {value}" in filter_.said[0], filter_.said
    assert getattr(filter_, f"Get{name}")() == before


# ---- properties ----------------------------------------------------------------------------------------------------

for kind in ("Trajectories", "History"):
    for through in (False, True):
        source = reader_of(walk)
        if through:
            filter_source = vtkElevationFilter()
            filter_source.SetInputConnection(source.GetOutputPort())
        else:
            filter_source = source
        filter_ = filter_of(kind, filter_source)
        works(filter_)
        for bad, good, *parts in (
                ({"Ids": "1 5-"}, {"Ids": ""}, "expected ids like 5, ranges like 10-20 or 100-900:50, got '5-'"),
                ({"Ids": "1;2"}, {"Ids": "1"}, "got '1;2'"),
                ({"SelectionFrame": 31, "NumberOfSamples": 1}, {"SelectionFrame": 30}, "expected a SelectionFrame from -31 to 30, got 31"),
                ({"SelectionFrame": -32}, {"SelectionFrame": -31}, "got -32"),
                ({"TimeWindow": (5, 6)}, {"TimeWindow": (1, -1)}, "expected a TimeWindow with frames, got none from 5 to 6"),
                ({"Arrays": "v nothing"}, {"Arrays": "v"}, "expected an array 'nothing' of the particles, got none in any frame")):
            set_all(filter_, **bad)
            fails(filter_, *parts)
            set_all(filter_, **good)
            works(filter_)
        # what cannot be set
        for name, value, least in (("EveryNth", 0, 1), ("FrameStride", -3, 1), ("NumberOfSamples", -2, -1)):
            refuses(filter_, name, value, f"at least {least}")

trajectories = filter_of("Trajectories", reader_of(walk))
refuses(trajectories, "Tail", -2, "at least 0")
refuses(trajectories, "PeriodicLines", 7, "from 0 to 1")

# the frame of the choice does not matter where nothing is chosen there
trajectories.SetSelectionFrame(1000)
works(trajectories)

# ---- ids -----------------------------------------------------------------------------------------------------------

HEAD = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS {}\n"


def write(name, columns, *frames):
    with open(name, "w") as file:
        for step, rows in enumerate(frames):
            file.write(HEAD.format(100 * step, len(rows), columns) + "".join(row + "\n" for row in rows))


good_rows = [f"{i} 0.{i}5 0.5 0.5" for i in range(1, 7)]
bad_rows = good_rows[:5] + ["3 0.9 0.5 0.5"] + good_rows[5:] + ["6 0.1 0.1 0.1"]
write("repeated.dump", "id x y z", good_rows, bad_rows, good_rows)
with open("repeated.dump") as lines:
    line = [i for i, text in enumerate(lines, 1) if text == "ITEM: TIMESTEP\n"][1]
MESSAGE = "expected each id once in a frame, got id {} in rows {} and {} of timestep 100 (rows are counted from 0)"
for through in (False, True):
    for kind, properties in (("Trajectories", {}), ("Trajectories", {"Tail": 5}), ("History", {}),
                             ("History", {"MeanSquareDisplacement": True}), ("History", {"MeanSquareDisplacement": True, "OutputType": 1}),
                             ("History", {"OutputType": 1})):
        reader = reader_of("repeated.dump")
        source = vtkElevationFilter() if through else reader
        if through:
            source.SetInputConnection(reader.GetOutputPort())
        filter_ = filter_of(kind, source)
        set_all(filter_, **properties)
        reader.UpdateInformation()
        filter_.UpdateInformation()
        if "Tail" in properties:
            filter_.UpdateTimeStep(0)
            assert filter_.said == [] and size_of(filter_)
            filter_.UpdateTimeStep(200)
            assert len(filter_.said) == 1 and MESSAGE.format(3, 2, 5) in filter_.said[0]
            continue
        parts = [] if through else [f"repeated.dump:{line}: "]
        for ids, text in (("", MESSAGE.format(3, 2, 5)), ("1-3", MESSAGE.format(3, 2, 5)), ("6 1", MESSAGE.format(6, 6, 7))):
            filter_.SetIds(ids)
            fails(filter_, text, *parts)
        # rows are those of the file, also where the reader leaves out some
        reader.SetStride(3)
        filter_.SetIds("6 1")
        fails(filter_, "got id 6 in rows " + ("6 and 7" if not through else ""), *parts)
        reader.SetStride(1)
        reader.SetRegionOfInterest(0.3, 1, 1, -1, 1, -1)
        filter_.SetIds("3")
        fails(filter_, "got id 3 in rows " + ("2 and 5" if not through else ""), *parts)
        reader.SetRegionOfInterest(1, -1, 1, -1, 1, -1)
        for ids in ("1 2 4", "3-6:2 1000"):
            filter_.SetIds(ids)
            works(filter_) if ids == "1 2 4" else fails(filter_, "got id 3")
        filter_.SetIds("")
        filter_.SetTimeWindow(150, 250)
        works(filter_)

# no ids
write("none.dump", "type x y z", ["1 0.5 0.5 0.5"], ["1 0.6 0.5 0.5"])
for kind in ("Trajectories", "History"):
    for ids in ("", "1"):
        filter_ = filter_of(kind, reader_of("none.dump"))
        filter_.SetIds(ids)
        fails(filter_, "none.dump:1: expected a column id: paths need ids")
        elevation = vtkElevationFilter()
        elevation.SetInputConnection(reader_of("none.dump").GetOutputPort())
        filter_ = filter_of(kind, elevation)
        filter_.SetIds(ids)
        fails(filter_, "expected an array 'id' of the particles, got none: paths need ids")

# a file that breaks in the middle: the error of the reader, with its place
write("broken.dump", "id x y z", good_rows, good_rows[:2] + ["3 O.9 0.5 0.5"] + good_rows[3:], good_rows)
with open("broken.dump") as lines:
    line = [i for i, text in enumerate(lines, 1) if "O.9" in text][0]
for kind in ("Trajectories", "History"):
    reader = reader_of("broken.dump")
    filter_ = filter_of(kind, reader)
    fails(filter_, f"broken.dump:{line}: column 'x': expected a number, got 'O.9'")
    elevation = vtkElevationFilter()
    elevation.AddObserver("ErrorEvent", lambda *_: None)
    elevation.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    reader.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    elevation.SetInputConnection(reader.GetOutputPort())
    filter_ = filter_of(kind, elevation)
    fails(filter_, "the input could not be made: see the messages before")
    filter_.SetTimeWindow(150, 250)
    works(filter_, 200)

# ---- inputs that are none ------------------------------------------------------------------------------------------

points = vtkPoints()
points.InsertNextPoint(1, 2, 3)
lonely = vtkPolyData()
lonely.SetPoints(points)
texts = vtkStringArray()
texts.SetName("word")
texts.InsertNextValue("a")
ids = numpy_to_vtk(numpy.array([7]), deep=1)
ids.SetName("id")
named = vtkPolyData()
named.SetPoints(points)
named.GetPointData().AddArray(ids)
named.GetPointData().AddArray(texts)
empty = vtkPolyData()
for kind in ("Trajectories", "History"):
    fails(filter_of(kind, vtkImageData()), "expected a vtkPointSet of particles, got a vtkImageData")
    fails(filter_of(kind, vtkMultiBlockDataSet()), "MergeBlocks")
    fails(filter_of(kind, lonely), "expected an array 'id'")
    filter_ = filter_of(kind, named)
    works(filter_)
    filter_.SetArrays("word")
    fails(filter_, "expected numbers in array 'word' of the particles, got texts")
    filter_.SetArrays("*")
    works(filter_)
    filter_ = filter_of(kind, empty)
    filter_.Update()
    assert filter_.said == []
    filter_.SetArrays("v *")
    filter_.SetNumberOfSamples(5)
    filter_.Update()
    assert filter_.said == [], filter_.said
filter_ = filter_of("Trajectories", named)
filter_.Update()
output = filter_.GetOutput()
assert output.GetNumberOfVerts() == 1 and output.GetPoint(0) == (1, 2, 3)
assert vtk_to_numpy(output.GetCellData().GetArray("id")).tolist() == [7]
# any integers are ids, doubles too
doubles = numpy_to_vtk(numpy.array([7.5]), deep=1)
doubles.SetName("id")
named.GetPointData().AddArray(doubles)
fails(filter_of("Trajectories", named), "column 'id': expected a 64-bit integer as id, got 7.5 in row 0")

# ---- warnings ------------------------------------------------------------------------------------------------------

write("far.dump", "id x y z", ["1 0.1 0.5 0.5", "2 0.1 0.5 0.5"], ["1 0.4 0.5 0.5", "2 0.2 0.5 0.5"], ["1 0.8 0.5 0.5", "2 0.3 0.5 0.5"])
WARNING = " steps from frame to frame are longer than a quarter of a period: without image counts ix iy iz some may go to a wrong image"
for kind, properties in (("Trajectories", {}), ("History", {}), ("History", {"OutputType": 1, "MeanSquareDisplacement": True})):
    reader = reader_of("far.dump")
    elevation = vtkElevationFilter()
    elevation.SetInputConnection(reader.GetOutputPort())
    for source in (reader, elevation):
        filter_ = filter_of(kind, source)
        set_all(filter_, **properties)
        filter_.Update()
        assert len(filter_.said) == 1 and "2" + WARNING in filter_.said[0] and size_of(filter_), filter_.said
        filter_.said.clear()
        filter_.UpdateTimeStep(200)
        assert filter_.said == []  # told once
        filter_.SetIds("2")
        works(filter_)
        filter_.SetIds("1")
        filter_.Update()
        assert len(filter_.said) == 1 and "2" + WARNING in filter_.said[0]
# a run begins with an empty box: what counts from the first frame counts from the first one with particles, and says which
write("late.dump", "id x y z", [], ["1 0.1 0.5 0.5"], ["1 0.2 0.5 0.5", "2 0.5 0.5 0.5"], ["2 0.5 0.5 0.5", "1 0.3 0.5 0.5"])
for through in (False, True):
    reader = reader_of("late.dump")
    source = vtkElevationFilter() if through else reader
    if through:
        source.SetInputConnection(reader.GetOutputPort())
    filter_ = filter_of("History", source)
    set_all(filter_, OutputType=1, MeanSquareDisplacement=True)
    filter_.Update()
    assert len(filter_.said) == 1 and "frames before timestep 100 have no particles: msd begins there" in filter_.said[0], filter_.said
    msd = vtk_to_numpy(filter_.GetOutput().GetColumnByName("msd"))
    assert numpy.isnan(msd[0]) and numpy.allclose(msd[1:], [0, 0.01, 0.04], rtol=1e-14), msd
    compare = filter_of("Compare", source)
    for time, length in ((300, 0.2), (200, 0.1), (100, 0), (0, None), (300, 0.2)):
        compare.said.clear()
        compare.UpdateTimeStep(time)
        late = "the first frame has no particles: the reference is the frame of time 100"
        if time == 0:
            assert compare.GetOutput().GetNumberOfPoints() == 0 and compare.said == []
            continue
        moved = vtk_to_numpy(compare.GetOutput().GetPointData().GetArray("displacement"))[:, 0]
        ids = vtk_to_numpy(compare.GetOutput().GetPointData().GetArray("id"))
        assert numpy.allclose(moved[ids == 1], length, rtol=1e-14) and numpy.isnan(moved[ids == 2]).all(), moved
        assert len(compare.said) == (time == 300) and all(late in text for text in compare.said), compare.said  # told once
# both tables of History follow the particles, and tell the same once
filter_ = filter_of("History", reader_of("far.dump"))
filter_.SetMeanSquareDisplacement(True)
filter_.Update()
assert len(filter_.said) == 1, filter_.said

# ---- cancel --------------------------------------------------------------------------------------------------------

for kind, properties in (("Trajectories", {"Arrays": "v"}), ("Trajectories", {"Tail": 20}), ("Trajectories", {"NumberOfSamples": 5}),
                         ("History", {"Arrays": "v"}), ("History", {"MeanSquareDisplacement": True}),
                         ("History", {"OutputType": 1, "Arrays": "v", "MeanSquareDisplacement": True})):
    for through in (False, True):
        reader = reader_of(walk)
        source = vtkElevationFilter() if through else reader
        if through:
            source.SetInputConnection(reader.GetOutputPort())
        filter_ = filter_of(kind, source)
        set_all(filter_, Threads=1, **properties)
        reported = []
        mark = filter_.AddObserver("ProgressEvent", lambda *_: reported.append(filter_.GetProgress()))
        works(filter_, 3)
        filter_.RemoveObserver(mark)
        assert reported == sorted(reported) and 0 <= reported[0] and reported[-1] == 1 and len(reported) >= 4, reported
        whole = size_of(filter_)
        for stop in sorted({1, 2, len(reported) // 2, len(reported) - 2}):
            with stopped(filter_, stop):
                filter_.Modified()
                filter_.UpdateTimeStep(3)
            assert filter_.said == [] and size_of(filter_) == 0, (kind, properties, stop, filter_.said)
            filter_.Modified()
            works(filter_, 3)
            assert size_of(filter_) == whole
        filter_.RemoveAllObservers()

# ---- pieces, without other processes: each has some of the paths, together all -------------------------------------

for properties in ({}, {"PeriodicLines": 1}, {"Ids": "3 9"}, {"Ids": "99"}):
    whole = filter_of("Trajectories", reader_of(walk))
    set_all(whole, Arrays="v", **properties)
    whole.Update()
    expected = plain_paths.lines_of(whole.GetOutput())
    found = {}
    for piece in range(4):
        part = filter_of("Trajectories", reader_of(walk))
        set_all(part, Arrays="v", **properties)
        part.UpdatePiece(piece, 4, 0)
        assert part.said == [] or ("in no frame: 99\n" in part.said[0]) == (properties.get("Ids") == "99"), part.said
        lines = plain_paths.lines_of(part.GetOutput())
        assert not lines or not found or min(lines) > max(found)
        assert part.GetOutput().GetNumberOfPoints() == sum(len(line["time"]) for each in lines.values() for line in each)
        found.update(lines)
    assert plain_paths.same(dict(sorted(found.items())), dict(sorted(expected.items()))), properties
print("all said")
