# SPDX-License-Identifier: BSD-3-Clause
"""Averages of the grains of a real run: against numpy, LIGGGHTS' own files, and sums that must come out."""
import os

import numpy
import plain_average
import plain_dump
import plain_euler
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
dump = os.path.join(data, "grains.dump")
LO, HI = numpy.array([-0.05, -0.05, 0]), numpy.array([0.05, 0.05, 0.15])
read = [frame for frame in plain_dump.read(dump) if frame.rows]
frames = {frame.timestep: plain_average.particles(frame) for frame in read}
words = {frame.timestep: frame.columns["id"] for frame in read}
particles = GranularDumpReader(FileNames=[dump])


def owners(step):
    """Which of LIGGGHTS' processes wrote each grain of the dump."""
    owner = {}
    for process in range(4):
        frame, = plain_dump.read(os.path.join(data, f"pieces_{step}.{process}.dump"))
        owner.update((word, process) for word in frame.columns["id"])
    return numpy.array([owner[word] for word in words[step]])


def values(proxy, time=None):
    """The output, and its arrays by name."""
    proxy.UpdatePipeline(*([] if time is None else [time]))
    output = servermanager.Fetch(proxy)
    attributes = output.GetPointData() if output.IsA("vtkPolyData") else output.GetCellData()
    found = {}
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        assert array.GetDataTypeAsString() == "double", array
        found[array.GetName()] = vtk_to_numpy(array).reshape(array.GetNumberOfTuples(), -1)
    return output, found


def check(found, expected, why, relative=1e-12):
    assert list(found) == list(expected), (why, list(found))
    for name, rows in expected.items():
        apart = abs(found[name] - rows).max()
        assert apart <= relative * abs(rows).max(), (why, name, apart, abs(rows).max())


def same(found, expected, why):
    assert list(found) == list(expected), (why, list(found))
    for name, rows in expected.items():
        assert found[name].tobytes() == rows.tobytes(), (why, name, abs(found[name] - rows).max())


# ---- what LIGGGHTS has: by centres, against numpy, and against its own files -------------------------------

centred = GranularEulerAverage(Input=particles, Output="Points", CellsBy="CellSizeRelative", CellSizeRelative=3,
                               Weights="Centre")
for step, rows in frames.items():
    output, found = values(centred, step)
    assert output.IsA("vtkPolyData") and output.GetNumberOfVerts() == output.GetNumberOfPoints() == 112
    shares = plain_average.by_centres(rows, LO, HI, (4, 4, 7), (0, 1))
    assert len(shares[0]) == 1200
    volume = (HI - LO).prod() / 112
    check(found, plain_average.values(rows, shares, 112, volume), ("numpy", step))
    fields = output.GetFieldData()
    assert fields.GetArray("timestep").GetValue(0) == step and not fields.HasArray("Columns")
    assert vtk_to_numpy(fields.GetArray("BoxBounds")).ravel().tolist() == [-.05, .05, -.05, .05, 0, .15]

    theirs = plain_euler.read(os.path.join(data, f"euler_{step}.vtk"))
    centres = vtk_to_numpy(output.GetPoints().GetData())
    assert abs(centres - theirs["centres"]).max() < 5.001e-7
    for name in ("volumefraction", "radius"):
        assert abs(found[name] - theirs[name]).max() < 5.001e-7, (step, name)
    # what the six digits of the dump leave open; where particles of two of LIGGGHTS' processes meet its v_avg is too small
    open_by = plain_average.uncertainty(rows, shares, 112) + 5.001e-7
    shared = plain_average.shared(shares, owners(step), 112)
    apart = abs(found["v_avg"] - theirs["v_avg"])
    assert 16 <= shared.sum() <= 18, shared.sum()
    assert (apart <= open_by)[~shared].all(), (step, (apart - open_by)[~shared].max())
    too_small = 3.5e-5 * abs(theirs["v_avg"])
    assert (apart <= open_by + too_small)[shared].all(), (step, (apart - open_by - too_small)[shared].max())

# ---- an image has the same values -----------------------------------------------------------------------------

_, points = values(centred, 2000)
vg.set_properties(centred, Output="ImageData", CellsBy="CellCounts", CellCounts=[4, 4, 7])
output, found = values(centred, 2000)
assert output.IsA("vtkImageData") and output.GetExtent() == (0, 4, 0, 4, 0, 7)
assert numpy.allclose(output.GetBounds(), [-.05, .05, -.05, .05, 0, .15], rtol=0, atol=1e-16)
same(found, points, "image")
assert centred.GetDataInformation().GetNumberOfCells() == 112
vg.set_properties(centred, CellsBy="CellSize", CellSize=[0.021, 0.0249, 0.021], Bounds=[-.05, .05, -.05, .05, 0, .15])
output, found = values(centred, 2000)
assert output.GetExtent() == (0, 4, 0, 4, 0, 7)
same(found, points, "size")
centred.Threads = 1
same(values(centred, 2000)[1], points, "threads")
Delete(centred)

# ---- by overlap: slabs of spheres are differences of caps, also through periodic faces -------------------------

overlap = GranularEulerAverage(Input=particles)
for name, default in {"Output": "ImageData", "CellsBy": "CellCounts", "Weights": "Overlap", "Periodic": "Boundary",
                      "CellSizeRelative": 3, "VelocityArray": "v", "MassArray": "mass", "RadiusArray": "radius",
                      "StressArray": "", "TimeAverage": 0, "Threads": 0}.items():
    assert getattr(overlap, name) == default, (name, getattr(overlap, name))
high = [-0.05, 0.05, -0.05, 0.05, -0.01, 0.16]  # where all particles are, also below the ground
for axis in range(3):
    for count in (1, 7, 100):
        counts = [1, 1, 1]
        counts[axis] = count
        vg.set_properties(overlap, CellCounts=counts, Bounds=high)
        _, found = values(overlap, 2000)
        shares = plain_average.by_slabs(frames[2000], axis, high[2 * axis], high[2 * axis + 1], count, axis < 2)
        volume = 0.1 * 0.1 * 0.17 / count
        check(found, plain_average.values(frames[2000], shares, count, volume), (axis, count), 1e-10)

# cells of cells: what is in eight of them is in their block
vg.set_properties(overlap, CellCounts=[16, 14, 20])
_, fine = values(overlap, 2000)
overlap.CellCounts = [8, 7, 10]
_, coarse = values(overlap, 2000)
phi = fine["volumefraction"].reshape(10, 2, 7, 2, 8, 2).mean(axis=(1, 3, 5)).ravel()
assert abs(phi - coarse["volumefraction"].ravel()).max() < 1e-14

# as ParaView sums it: all particles, but for what is below the ground where the box ends there
solid = 4 / 3 * numpy.pi * (frames[2000]["radius"]**3).sum()
integral = IntegrateVariables(Input=overlap)
for periodic in ("Boundary", "None"):
    vg.set_properties(overlap, Periodic=periodic, CellCounts=[17, 13, 11], Bounds=high)
    _, found = values(integral, 2000)
    missing = 1 - found["volumefraction"][0, 0] / solid
    assert abs(found["Volume"][0, 0] - 0.1 * 0.1 * 0.17) < 1e-15
    assert abs(missing) < 1e-12 if periodic == "Boundary" else 0.001 < missing < 0.1, (periodic, missing)
vg.set_properties(overlap, Periodic="Boundary", Bounds=[1, -1] * 3)
_, found = values(integral, 2000)
height = numpy.clip(frames[2000]["radius"] - frames[2000]["x"][:, 2], 0, None)
above = solid - (numpy.pi * height**2 * (3 * frames[2000]["radius"] - height) / 3).sum()
assert above < solid and abs(found["volumefraction"][0, 0] - above) < 1e-12 * solid

# ---- whatever the points are ---------------------------------------------------------------------------------------

overlap.CellCounts = [5, 6, 7]
_, expected = values(overlap, 2000)
for properties in ({"Coordinates": "Unwrapped"}, {"Coordinates": "Scaled"}, {"PointOrigin": [0.5, -2, 1e3]},
                   {"PointPrecision": "Single"}):
    other = GranularDumpReader(FileNames=[dump], **properties)
    for kind in ("Points", "ImageData"):
        proxy = GranularEulerAverage(Input=other, CellCounts=[5, 6, 7], Output=kind)
        output, found = values(proxy, 2000)
        check(found, expected, properties, 1e-5 if "PointPrecision" in properties else 1e-9)
        bounds = numpy.array([-0.05, 0.05, -0.05, 0.05, 0, 0.15])
        if kind == "Points":
            half = numpy.array([0.1 / 5, 0.1 / 6, 0.15 / 7]) / 2
            bounds += numpy.column_stack((half, -half)).ravel()
        bounds -= numpy.repeat(properties.get("PointOrigin", [0, 0, 0]), 2)
        assert numpy.allclose(output.GetBounds(), bounds, rtol=0, atol=1e-12), (properties, output.GetBounds())
        assert output.GetFieldData().GetAbstractArray("Coordinates").GetValue(0) == "Absolute"

# ---- as files -------------------------------------------------------------------------------------------------------

for kind in ("Points", "ImageData"):
    overlap.Output = kind
    overlap.UpdatePipeline(2000)
    vg.save(overlap, f"{kind}_*.euler", Dialect="LIGGGHTS")
    wanted = {"centres": plain_euler.grid(LO, HI, (5, 6, 7)), **expected}
    with open(f"{kind}_2000.euler") as file:
        assert file.read() == plain_euler.text(wanted), kind
    vg.save(overlap, "wide_*.vtk", writer="GranularEulerWriter")  # by default all digits
    again = OpenDataFile(os.path.abspath("wide_2000.vtk"))
    assert again.GetXMLName() == "GranularEulerReader"
    same(values(again)[1], expected, kind)
overlap.Output = "ImageData"
vg.save(overlap, "all_*.euler", WriteTimeSteps=1)
assert plain_euler.read("all_0.euler")["volumefraction"].max() == 0  # no particles yet
for step in (1000, 2000):
    assert plain_euler.read(f"all_{step}.euler")["volumefraction"].max() > 0.1

# ---- the names in a call are all that is made, as if they were set later ------------------------------------------

chains = GranularPackingSource(Arrangement="Chain")
for make, inputs, name in ((GranularEulerAverage, {"MassArray": "radius"}, "volumefraction"),
                           (GranularPointAverage, {"Points": chains, "MassArray": "radius"}, "volumefraction"),
                           (GranularContactSums, {"Lines": OutputPort(chains, 2)}, "coordination")):
    made = make(Input=chains, Arrays=[name], **inputs)
    found = set(vg.fetch(made)) & set(made.Arrays.Available)
    assert found - set(vg.fetch(chains)) == {name} and list(made.Arrays) == [name], (make, found, made.Arrays)
print("averaged")
