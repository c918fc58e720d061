# SPDX-License-Identifier: BSD-3-Clause
"""Written cells have the bytes of LIGGGHTS, or all digits, and are read back as they were."""
import gzip
import os

import numpy
import plain_euler
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from writing import check_nothing_left, check_properties, content, enter_empty_folder, good

enter_empty_folder()
WRITER = "GranularEulerWriter"


def write(name, values):
    with open(name, "w") as file:
        file.write(plain_euler.text(values))
    return os.path.abspath(name)


def digits(value):
    """All digits of a number."""
    return repr(float(value))


def values(reader):
    reader.UpdatePipeline()
    output = servermanager.Fetch(reader)
    found = {"centres": vtk_to_numpy(output.GetPoints().GetData())}
    for i in range(output.GetPointData().GetNumberOfArrays()):
        array = output.GetPointData().GetArray(i)
        found[array.GetName()] = vtk_to_numpy(array).reshape(output.GetNumberOfPoints(), -1)
    return found


# ---- the bytes of LIGGGHTS, from points and from cells ------------------------------------------------

steps = (1000, 2000, 3000, 4000)
series = GranularEulerReader(FileNames=[good(f"euler_{step}.vtk") for step in steps])
for output in ("Points", "ImageData"):
    series.Output = output
    vg.save(series, "real_*.euler", WriteTimeSteps=1)
    SaveData("data_*.euler", series, WriteTimeSteps=1)
    for step in steps:
        original = content(good(f"euler_{step}.vtk"))
        for name in (f"real_{step}.euler", f"data_{step}.euler"):
            assert content(name) == original, (output, name)
            os.remove(name)
parallel = OpenDataFile(good("euler/parallel_2000.vtk"))
for output in ("Points", "ImageData"):
    parallel.Output = output
    vg.save(parallel, "parallel.vtk", writer=WRITER)
    assert content("parallel.vtk") == content(good("euler/parallel_2000.vtk")), output

# ---- wide: every number comes back, also by VTK's own reader, with stresses -------------------------------

stressed = plain_euler.cells(plain_euler.grid((0, 0, 0), (3e-6, 1e-6, 2e-6), (3, 2, 4)), stresses=True, seed=5)
with open("stressed.vtk", "w") as file:
    file.write(plain_euler.text(stressed, digits))
read = GranularEulerReader(FileNames=[os.path.abspath("stressed.vtk")])
vg.save(read, "all_digits.euler")  # Automatic: nothing is lost
again = GranularEulerReader(FileNames=[os.path.abspath("all_digits.euler")])
for name, expected in stressed.items():
    assert values(again)[name].tobytes() == expected.tobytes(), name
vtk = vtkPolyDataReader()
vtk.SetFileName("all_digits.euler")
vtk.ReadAllScalarsOn()
vtk.ReadAllVectorsOn()
vtk.Update()
output = vtk.GetOutput()
assert output.GetNumberOfVerts() == 24 and output.GetPoints().GetData().GetDataTypeAsString() == "double"
assert (vtk_to_numpy(output.GetPoints().GetData()) == stressed["centres"]).all()
for name in ("v_avg", "volumefraction", "radius", "pressure", "sigma", "tau"):
    found = vtk_to_numpy(output.GetPointData().GetArray(name)).reshape(24, -1)
    assert (found == stressed[name]).all(), name
# ---- compressed, empty, and filters in between ---------------------------------------------------------------

vg.save(series, "packed_*.vtk.gz", time=2000, writer=WRITER)
with gzip.open("packed_2000.vtk.gz") as file:
    assert file.read() == content(good("euler_2000.vtk"))
none = GranularEulerReader(FileNames=[write("none_5.vtk", plain_euler.cells(numpy.zeros((0, 3))))])
for output in ("Points", "ImageData"):
    none.Output = output
    vg.save(none, "nothing.euler")
    assert content("nothing.euler") == content("none_5.vtk"), output
series.Output = "Points"
moved = Transform(Input=series)
moved.Transform.Translate = [1, 0, 0]
vg.save(moved, "moved.euler", time=1000)
first = plain_euler.read("moved.euler")["centres"][0]
assert numpy.allclose(first, [0.9625, -0.0375, 0.010714], rtol=0, atol=1e-6), first
series.Output = "ImageData"
half = ExtractSubset(Input=series, VOI=[0, 4, 0, 4, 0, 3])
vg.save(half, "half.euler", time=1000)
whole = plain_euler.read(good("euler_1000.vtk"))
for name, rows in plain_euler.read("half.euler").items():
    assert (rows == whole[name][:48]).all(), name
dense = Threshold(Input=series, Scalars=["CELLS", "volumefraction"], LowerThreshold=0.1, UpperThreshold=1)
vg.save(CellCenters(Input=dense), "dense.euler", time=4000)
whole = plain_euler.read(good("euler_4000.vtk"))
chosen = whole["volumefraction"].ravel() >= 0.1
assert 0 < chosen.sum() < 112
assert (plain_euler.read("dense.euler")["pressure"] == whole["pressure"][chosen]).all()

# ---- properties ------------------------------------------------------------------------------------------------

check_properties("GranularEulerWriter", series, Dialect="Automatic", WriteTimeSteps=0)
check_nothing_left()
print("written")
