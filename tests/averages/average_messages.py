# SPDX-License-Identifier: BSD-3-Clause
"""What averages say: what is left out or missing is counted and named, errors leave the next update good."""
import os
import re

import numpy
import plain_average
import plain_dump
import vtkgranular as vg
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
POINTS, IMAGE = 0, 1
COUNTS, SIZE, RELATIVE = 0, 1, 2
CENTRE, OVERLAP = 0, 1
said = []


def listen(algorithm):
    algorithm.SetController(None)
    for event in ("WarningEvent", "ErrorEvent"):
        def keep(caller, kind, text):
            said.append(text)
        keep.CallDataType = "string0"
        algorithm.AddObserver(event, keep)
    algorithm.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    return algorithm


def reader_of(name):
    reader = listen(vg.vtkGranularDumpReader())
    reader.AddFileName(os.path.abspath(name))
    return reader


def filter_of(source, **properties):
    average = listen(vg.vtkGranularEulerAverage())
    if source.IsA("vtkDataObject"):
        average.SetInputData(source)
    else:
        average.SetInputConnection(source.GetOutputPort())
    change(average, **properties)
    return average


def change(average, **properties):
    for name, value in properties.items():
        getattr(average, f"Set{name}")(*value if isinstance(value, (tuple, list)) else (value,))


def update(average, time=None, **properties):
    """The arrays of cells by name, {} without cells, and what was said."""
    change(average, **properties)
    said.clear()
    average.UpdateInformation()
    if time is not None:
        average.UpdateTimeStep(time)
    else:
        average.Update()
    output = average.GetOutputDataObject(0)
    attributes = output.GetPointData() if output.IsA("vtkPolyData") else output.GetCellData()
    arrays = [attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())]
    found = {array.GetName(): vtk_to_numpy(array).copy() for array in arrays} if output.GetNumberOfCells() else {}
    return found, list(said)


def fails(average, pattern, time=None, **properties):
    found, messages = update(average, time, **properties)
    assert found == {}, (pattern, found)
    assert len(messages) == 1 and re.search(pattern, messages[0]), (pattern, messages)


def works(average, time=None, warnings=(), **properties):
    found, messages = update(average, time, **properties)
    assert found, messages
    assert len(messages) == len(warnings), messages
    for message, pattern in zip(messages, warnings):
        assert re.search(pattern, message), (pattern, message)
    return found


def all_particles(places, **arrays):
    made, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(numpy.array(places, float), deep=1))
    made.SetPoints(points)
    for name, values in arrays.items():
        array = numpy_to_vtk(numpy.array(values), deep=1)
        array.SetName(name)
        made.GetPointData().AddArray(array)
    return made


# ---- cells that cannot be, and the update after ------------------------------------------------------------

dump = reader_of(os.path.join(data, "grains.dump"))
BOX = (-0.05, 0.05, -0.05, 0.05, 0, 0.15)
average = filter_of(dump)
good = works(average, 2000)
fails(average, "expected edges of cells above 0, got ", 2000, CellsBy=SIZE, CellSize=(0, 0.01, 0.01), Bounds=BOX)
works(average, 2000, CellSize=(0.01, 0.02, 0.015), Bounds=(1, -1) * 3)  # by the box of the dump
assert average.GetOutputDataObject(0).GetExtent() == (0, 10, 0, 5, 0, 10)
works(average, 0, Bounds=(0, 0, -0.02, 0.02, 1, -1))
assert average.GetOutputDataObject(0).GetExtent() == (0, 10, 0, 2, 0, 10)
assert average.GetOutputDataObject(0).GetOrigin() == (-0.05, -0.02, 0)
relative = works(average, 2000, CellsBy=RELATIVE, Bounds=(0, 0) * 3)
assert relative["radius"].tobytes() == works(average, 2000, OutputType=POINTS)["radius"].tobytes()
assert len(relative["radius"]) == 112 and average.GetOutputDataObject(0).GetNumberOfPoints() == 112
average.SetOutputType(1)
fails(average, "expected 1 to 2.31 - 1 cells along each axis, got", 2000, CellsBy=COUNTS, CellCounts=(3, -7, 3))
# as many as there may be: of the memory, where there is no room
fails(average, "memory", 2000, CellCounts=(10000, 10000, 10000))
fails(average, "expected finite bounds of cells", 2000, CellCounts=(10, 10, 10), Bounds=(2, 2) * 3)
fails(average, "expected Bounds of numbers, got nan", 2000, Bounds=(1, -1, 1, -1, 0, float("nan")))
fails(average, "expected finite bounds of cells", 2000, Bounds=(1, -1, 1, -1, 0, float("inf")))
again = works(average, 2000, Bounds=(1, -1) * 3)
assert all(again[name].tobytes() == good[name].tobytes() for name in good)
for bad in (0.0, -1.0):
    fails(average, "expected a CellSizeRelative above 0, got ", 2000, OutputType=POINTS, CellsBy=RELATIVE,
          CellSizeRelative=bad)
assert len(works(average, 2000, CellSizeRelative=3)["radius"]) == 112
# without particles there is no largest one: one cell
empty = works(average, 0)
assert len(empty["radius"]) == 1 and not any(values.any() for values in empty.values())
assert len(works(average, 2000)["radius"]) == 112

# ---- what is needed -------------------------------------------------------------------------------------------

fails(average, "expected an array 'size' of radii, got none", 2000, RadiusArray="size")
fails(average, "expected an array 'v' with one value a particle, got 3", 2000, RadiusArray="radius", MassArray="v")
works(average, 2000, MassArray="mass", CellsBy=COUNTS, Weights=CENTRE)

tilted = filter_of(reader_of(os.path.join(data, "tri_plain.dump")), Weights=CENTRE)
nothing = ["no array 'v'", "no array 'radius'", "neither an array 'mass'"]
_, messages = update(tilted, 0)
assert not any("tilted" in text for text in messages), messages
boxless = all_particles([[0.5, 0.5, 0.5]], radius=[0.25], mass=[1.0], v=[[1.0, 2.0, 3.0]])
bare = filter_of(boxless, CellCounts=(1, 1, 1))
fails(bare, "expected the box in the field data of the input .*, got none: give Bounds")
found = works(bare, Bounds=(0, 1, 0, 1, 0, 1))
assert numpy.allclose(found["volumefraction"], 4 / 3 * numpy.pi / 64, rtol=1e-15, atol=0)
assert found["v_avg"].tolist() == [[1, 2, 3]] and found["pressure"] == 0 and found["radius"] == 0.25
image = vtkImageData()
image.SetDimensions(2, 2, 2)
for other, text in ((image, "got a vtkImageData"), (vtkMultiBlockDataSet(), "MergeBlocks")):
    bare.SetInputDataObject(other)
    found, messages = update(bare)
    assert found == {} and len(messages) == 1 and text in messages[0], messages
bare.SetInputData(boxless)
works(bare)

# ---- what is in no cell, or is no number, is counted -------------------------------------------------------------

half = (-0.05, 0.05, -0.05, 0.05, 0, 0.05)
frame = plain_average.particles(plain_dump.read(os.path.join(data, "grains.dump"))[-1])
for weights, above in ((CENTRE, (frame["x"][:, 2] > 0.05)), (OVERLAP, frame["x"][:, 2] - frame["radius"] > 0.05)):
    assert 100 < above.sum() < 1100
    works(average, 2000, [f"{above.sum()} particles are outside of all cells, and in none"], Weights=weights, Bounds=half)

# ---- what the reader left out: known through the filters between ----------------------------------------------

part = reader_of(os.path.join(data, "grains.dump"))
moved = vtkTransformPolyDataFilter()
moved.SetTransform(vtkTransform())
moved.SetInputConnection(part.GetOutputPort())
kept = vtkThreshold()
kept.SetInputConnection(moved.GetOutputPort())
kept.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "radius")
for source in (part, moved, kept):
    behind = filter_of(source)
    works(behind, 2000)
    part.SetStride(10)
    works(behind, 2000, ["particles are missing that the reader left out .Stride 10.: averages count the particles that are there"])
    part.SetRegionOfInterest(1, -1, 1, -1, 0, 0.05)
    works(behind, 2000, ["left out .Stride 10, RegionOfInterest."])
    part.SetStride(1)
    works(behind, None, ["left out .RegionOfInterest."], TimeAverage=True)  # once, not once a frame
    part.SetRegionOfInterest(1, -1, 1, -1, 1, -1)
    works(behind, None)

nan, inf = float("nan"), float("inf")
places = [[0.5, 0.5, 0.5]] * 8
places[1], places[2] = [nan, 0.5, 0.5], [0.5, inf, 0.5]
numbers = {"radius": [0.25, 0.25, 0.25, nan, -0.25, 0.25, 0.25, 0.25],
           "mass": [1.0, 1, 1, 1, 1, -1, 1, 1],
           "v": [[1.0, 2.0, 3.0]] * 6 + [[0, 0, -inf], [3.0, 2.0, 1.0]]}
broken = filter_of(all_particles(places, **numbers), CellCounts=(1, 1, 1), Bounds=(0, 1, 0, 1, 0, 1))
for weights in (CENTRE, OVERLAP):
    found = works(broken, None, ["6 particles are left out: .* no number, infinite or too large, or a mass or radius is neg"],
                  Weights=weights)
    assert numpy.allclose(found["volumefraction"], 8 / 3 * numpy.pi / 64, rtol=1e-15, atol=0), found
    assert found["v_avg"].tolist() == [[2, 2, 2]] and found["radius"] == 0.25, found

# ghosts that another process has are not counted twice; other marks do not matter
ghosts = filter_of(all_particles([[0.5, 0.5, 0.5]] * 3, radius=[0.25] * 3, mass=[1.0] * 3, v=[[1.0, 0, 0]] * 3,
                          vtkGhostType=numpy.array([0, 1, 0], numpy.uint8)),
                   CellCounts=(1, 1, 1), Bounds=(0, 1, 0, 1, 0, 1))
found = works(ghosts)
assert numpy.allclose(found["volumefraction"], 8 / 3 * numpy.pi / 64, rtol=1e-15, atol=0), found

# ---- time ---------------------------------------------------------------------------------------------------------

over_time = filter_of(dump, Weights=CENTRE, CellCounts=(9, 8, 20), TimeAverage=True)
found = works(over_time)
info = over_time.GetOutputInformation(0)
steps = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
assert not info.Has(steps)
assert over_time.GetOutputDataObject(0).GetExtent() == (0, 9, 0, 8, 0, 20)
# the first frame has no particles
alone = [works(over_time, time, TimeAverage=False)["volumefraction"] for time in (1000, 2000)]
assert numpy.allclose(found["volumefraction"], sum(alone) / 3, rtol=1e-13, atol=1e-15)
over_time.SetTimeAverage(True)
# only some frames, as after the filling
later = works(over_time, TimeWindow=(1000, 1000))
fails(over_time, "expected a TimeWindow with frames, got none from 2001 to 9000", TimeWindow=(2001, 9000))
# one step after it again: the reader is at the time that is shown
alone = works(over_time, 1000, TimeAverage=False, TimeWindow=(1, -1))
assert numpy.allclose(later["volumefraction"], alone["volumefraction"], rtol=1e-15, atol=0)
assert info.Length(steps) == 3
fails(over_time, "expected the same cells in all frames that are averaged, got others in frame 1", OutputType=POINTS,
      CellsBy=RELATIVE, TimeAverage=True)

# a frame that cannot be read: one error of each, no average, no second try
text = open(os.path.join(data, "grains.dump")).read()
at = text.rindex("ITEM: TIMESTEP")
with open("word.dump", "w") as file:
    file.write(text[:at] + text[at:].replace("ff\n", "ff\n", 1).replace(" 0.0025 ", " 0.0025x ", 1))
damaged = filter_of(reader_of("word.dump"), TimeAverage=True)
found, messages = update(damaged)
assert found == {} and len(messages) == 2, messages
assert "word.dump" in messages[0] and "0.0025x" in messages[0], messages
assert "the input could not be made" in messages[1], messages
assert len(works(damaged, 1000, TimeAverage=False)["radius"]) == 1000

# boxes that change, and the Bounds that help
for number in (0, 1):
    with open(f"box_{number}.dump", "w") as file:
        file.write(f"ITEM: TIMESTEP\n{number}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n"
                   f"0 {number + 1}\n0 1\n0 1\nITEM: ATOMS id x y z vx vy vz radius mass\n"
                   f"1 0.5 0.5 0.5 {2 * number} 0 0 0.25 {number + 1}\n")
growing = reader_of("box_0.dump")
growing.AddFileName(os.path.abspath("box_1.dump"))
average = filter_of(growing, CellCounts=(1, 1, 1), TimeAverage=True)
fails(average, "expected the same cells in all frames that are averaged, got others in frame 1: their bounds and their number")
found = works(average, Bounds=(0, 1, 0, 1, 0, 1))
assert numpy.allclose(found["v_avg"], [[4 / 3, 0, 0]], rtol=1e-15, atol=0), found
assert numpy.allclose(found["volumefraction"], 4 / 3 * numpy.pi / 64, rtol=1e-15, atol=0)

# ---- cancel -------------------------------------------------------------------------------------------------------

for together in (False, True):
    average = filter_of(dump, TimeAverage=together)
    expected = works(average, 2000 if not together else None)
    mark = average.AddObserver("ProgressEvent", lambda *_: average.SetAbortExecute(1))
    average.Modified()
    found, messages = update(average)
    assert found == {} and messages == [], messages
    average.RemoveObserver(mark)
    found = works(average, 2000 if not together else None)
    assert all(found[name].tobytes() == expected[name].tobytes() for name in expected)
print("all said")
