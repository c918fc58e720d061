# SPDX-License-Identifier: BSD-3-Clause
"""Files of LIGGGHTS and PFM, and what VTK writes of such data, read to the last bit."""
import os

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
print("alive")
