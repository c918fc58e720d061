# SPDX-License-Identifier: BSD-3-Clause
"""Files of LIGGGHTS and PFM, in every form that VTK writes, read to the last bit."""
import gzip
import os
import re

import numpy
import plain_euler
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from said import said_by
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")


def read(*names, output=0, **properties):
    """The output, and all that was said."""
    reader = vg.vtkGranularEulerReader()
    reader.SetController(None)
    said = said_by(reader)
    for name in names:
        reader.AddFileName(os.path.abspath(name))
    reader.SetOutputType(output)
    for key, value in properties.items():
        getattr(reader, f"Set{key}")(value)
    reader.Update()
    return reader.GetOutputDataObject(0), said


def values(output):
    """All there is of points or cells, by name."""
    attributes = output.GetPointData() if output.IsA("vtkPolyData") else output.GetCellData()
    found = {}
    if output.IsA("vtkPolyData") and output.GetNumberOfPoints():
        found["centres"] = vtk_to_numpy(output.GetPoints().GetData())
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(i)
        assert array.GetDataTypeAsString() == "double", array
        found[array.GetName()] = vtk_to_numpy(array).reshape(array.GetNumberOfTuples(), -1)
    return found


def check(found, expected, why):
    assert set(found) == set(expected), (why, set(found), set(expected))
    for name in expected:
        assert found[name].tobytes() == expected[name].tobytes(), (why, name, found[name], expected[name])


def write(name, text):
    with open(name, "wb") as file:
        file.write(text.encode())


# ---- the real files: every number is the nearest double to the text -----------------------------------

for step in (1000, 2000, 3000, 4000):
    name = os.path.join(data, f"euler_{step}.vtk")
    expected = plain_euler.read(name)
    assert set(expected) == {"centres", *plain_euler.ARRAYS} and len(expected["centres"]) == 112
    points, said = read(name)
    assert said == [], said
    check(values(points), expected, name)
    assert points.GetFieldData().GetArray("timestep").GetValue(0) == step
    image, said = read(name, output=1)
    assert said == [] and image.IsA("vtkImageData") and image.GetDimensions() == (5, 5, 8), said
    expected.pop("centres")
    check(values(image), expected, name)
    # the box of the simulation, within the six decimals of the file
    assert numpy.allclose(image.GetBounds(), [-.05, .05, -.05, .05, 0, .15], rtol=0, atol=2e-6), image.GetBounds()

# ---- other numbers, other forms -------------------------------------------------------------------------

random = plain_euler.cells(plain_euler.grid((0, 0, 0), (3, 1, 2), (3, 2, 2)), stresses=True)
random = {name: numpy.array([[float("%f" % v) for v in row] for row in rows]) for name, rows in random.items()}
text = plain_euler.text(random)
write("pfm_5.vtk", text)
check(values(read("pfm_5.vtk")[0]), random, "pfm")
names = [read("pfm_5.vtk")[0].GetPointData().GetArray(name).GetComponentName(1) for name in ("sigma", "tau", "v_avg")]
assert names == ["YY", "XZ", None], names

with gzip.open("packed_5.vtk", "wb") as file:  # whatever its name
    file.write(text.encode())
check(values(read("packed_5.vtk")[0]), random, "gzip")
write("windows_5.vtk", text.replace("\n", "\r\n"))
check(values(read("windows_5.vtk")[0]), random, "line ends")

# nan and inf are numbers, of which VTK's own reader would drop all that follows
special = {name: rows.copy() for name, rows in random.items()}
special["v_avg"][1] = [numpy.nan, numpy.inf, -numpy.inf]
special["radius"][0] = numpy.nan
write("nan_5.vtk", plain_euler.text(special))
for output in (0, 1):
    found, said = read("nan_5.vtk", output=output)
    found = values(found)
    for name in ("v_avg", "radius", "pressure", "tau"):
        assert numpy.array_equal(found[name], special[name], equal_nan=True), (name, said)

# what VTK makes of such data, ASCII and BINARY, of both versions, with other numbers of digits than six
exact = plain_euler.cells(plain_euler.grid((0, 0, 0), (3, 1, 2), (3, 2, 2)) * 1e-6, seed=7)
grid = vtkPolyData()
points, vertices = vtkPoints(), vtkCellArray()
points.SetDataTypeToDouble()
points.SetData(numpy_to_vtk(exact["centres"], deep=1))
grid.SetPoints(points)
for i in range(len(exact["centres"])):
    vertices.InsertNextCell(1, [i])
grid.SetVerts(vertices)
for name in plain_euler.ARRAYS:
    array = numpy_to_vtk(exact[name], deep=1)
    array.SetName(name)
    grid.GetPointData().AddArray(array)
for version in (42, 51):
    for binary in (False, True):
        name = f"vtk_{version}_{'binary' if binary else 'text'}_5.vtk"
        writer = vtkPolyDataWriter()
        (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
        writer.SetFileVersion(version)
        writer.SetFileName(name)
        writer.SetInputData(grid)
        writer.Write()
        assert vg.vtkGranularEulerReader.CanReadFile(name), name
        output, said = read(name)
        assert said == [], (name, said)
        if binary:
            check(values(output), exact, name)
        else:  # VTK prints doubles with 11 digits
            for key, found in values(output).items():
                assert numpy.allclose(found, exact[key], rtol=1e-10, atol=0), (name, key)
        assert output.GetNumberOfVerts() == len(exact["centres"])

# PFM's grids: cell data of a rectilinear grid
faces = ([0, 1, 2, 3], [0, .5, 1], [0, 1, 2])
middles = [numpy.convolve(f, [.5, .5], "valid") for f in faces]
cells = plain_euler.cells(plain_euler.grid((0, 0, 0), (3, 1, 2), (3, 2, 2)), stresses=True)
cells = {name: numpy.array([[float("%f" % v) for v in row] for row in rows]) for name, rows in cells.items()}
body = plain_euler.text(cells)
body = body[body.index("POINT_DATA"):].replace("POINT_DATA", "CELL_DATA")
head = "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 4 3 3\n"
for axis, along in zip("XYZ", faces):
    head += f"{axis}_COORDINATES {len(along)} float\n{' '.join('%f' % face for face in along)}\n"
write("faces_5.vtk", head + body)
check(values(read("faces_5.vtk")[0]), cells, "faces")
image, said = read("faces_5.vtk", output=1)
assert image.GetBounds() == (0, 3, 0, 1, 0, 2) and said == [], said
cells.pop("centres")
check(values(image), cells, "faces")

# ---- a run on several processes, each with a grid of its own ---------------------------------------------

parts = plain_euler.grids(([0, 1, 2], [0, 1, 2], [0, 1]), ([2, 4], [2, 3], [3]))
whole = plain_euler.cells(numpy.concatenate(parts))
write("parallel_5.vtk", plain_euler.text(whole))
blocks, said = read("parallel_5.vtk", output=1)
assert blocks.IsA("vtkPartitionedDataSet") and blocks.GetNumberOfPartitions() == 4 and said == [], said
at = 0
for i, part in enumerate(parts):
    image = blocks.GetPartition(i)
    assert image.GetNumberOfCells() == len(part)
    rows = whole["pressure"][at:at + len(part)]
    assert numpy.allclose(vtk_to_numpy(image.GetCellData().GetArray("pressure")), rows.ravel(), atol=1e-6)
    expected = [(i % 2), (i % 2) + 1, i // 2, i // 2 + 1, 0, 1]
    assert numpy.allclose(image.GetBounds(), expected, rtol=0, atol=1e-5), (i, image.GetBounds())
    at += len(part)

# ---- what is not complete, or not right -----------------------------------------------------------------

complete = plain_euler.text(plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2))))
write("good_1.vtk", complete)
for size in (0, 20, 100, len(complete) // 2, len(complete) - 12):
    write("good_2.vtk", complete[:size])  # LIGGGHTS is still at work: a later Refresh will find it
    output, said = read("good_1.vtk", "good_2.vtk")
    assert output.GetNumberOfPoints() == 8, (size, said)
    output, said = read("good_2.vtk")
    assert output.GetNumberOfPoints() == 0 and len(said) == 1 and "good_2.vtk" in said[0], (size, said)
for old, new in (("POINT_DATA 8", "POINT_DATA 9"), ("1 7\n", "1 8\n"), ("VECTORS", "VECTOR"),
                 ("POINTS 8", "POINTS 4000000000000"), ("0.250000", "0.25x")):
    assert old in complete, old
    write("bad_1.vtk", complete.replace(old, new, 1))
    for output in (0, 1):
        found, said = read("bad_1.vtk", output=output)
        assert found.GetNumberOfCells() == 0 and len(said) == 1 and "bad_1.vtk" in said[0], (new, said)
        assert re.search(r"bad_1.vtk(:\d+|@\d+)?: ", said[0]), said
print("alive")
