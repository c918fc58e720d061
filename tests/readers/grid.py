# SPDX-License-Identifier: BSD-3-Clause
"""Cells of LAMMPS' dump grid: what the same run has written by dump grid/vtk, in ids' order whatever the order of the file, on any form of
box; and what is wrong with others."""
import os
import warnings

import numpy
from paraview import servermanager
from paraview.simple import Delete, GranularEulerReader, OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLRectilinearGridReader

import vtkgranular as vg

GRID = os.path.join(os.environ["GRANULAR_DATA"], "good", "grid")


def path(name):
    return os.path.join(GRID, name)


def changed(name, change):
    """A file of the last frame, with header and rows changed."""
    with open(path("grid.dump")) as stream:
        lines = stream.read().rpartition("ITEM: TIME\n")[2].splitlines()
    head = lines.index(next(line for line in lines if "GRID CELLS" in line)) + 1
    with open(name, "w") as stream:
        stream.write("\n".join(["ITEM: TIME", *change(lines[:head], lines[head:])]) + "\n")
    return name


def named(head):
    return [line.replace("c_pg:grid:data[1]", "id") for line in head]


# frames, times and cells; centres are those that LAMMPS has computed (xc yc zc), to six digits
run = vg.open(path("grid.dump"), kind="grid")
assert run.kind == "grid" and run.steps.tolist() == [600, 1200] and numpy.allclose(run.times, [0.024, 0.048])
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    frame = run[-1].read()
assert len(said) == 1 and "no column id" in str(said[0].message) and "sort id" in str(said[0].message), said
whole = frame["c_pg:grid:data"]
assert frame.rows == 96 and whole.shape == (96, 7)
assert numpy.allclose(frame.points, whole[:, 3:6], rtol=1e-5, atol=0)
assert whole[:, 0].tolist() == list(range(1, 97))

# an image with the values that dump grid/vtk wrote, read by VTK
other = vtkXMLRectilinearGridReader()
other.SetFileName(path("gridv_1200.vti"))
other.Update()
theirs = other.GetOutput()
reader = OpenDataFile([path("grid_600.dump"), path("grid_1200.dump")])
assert reader.GetXMLName() == "GranularEulerReader" and list(reader.TimestepValues) == [600, 1200]
reader.Output = "ImageData"
reader.UpdatePipeline(1200)
image = servermanager.Fetch(reader)
assert image.GetDimensions() == theirs.GetDimensions() == (5, 5, 7)
assert numpy.allclose(image.GetBounds(), theirs.GetBounds(), rtol=1e-6)
assert image.GetFieldData().GetAbstractArray("Boundary").GetValue(0) == "pp pp ff"
assert numpy.array_equal(vtk_to_numpy(image.GetCellData().GetArray("v")).astype("float32"),
                         vtk_to_numpy(theirs.GetCellData().GetArray("Vector")))
Delete(reader)

# rows of several processes one after the other: a column id puts them in order, and is an array like others
scrambled = changed("scrambled.dump", lambda head, rows: [*named(head), *rows[48:], *rows[:48]])
with warnings.catch_warnings():
    warnings.simplefilter("error")
    sorted_rows = vg.open(scrambled)[0].read()
assert sorted_rows["id"].tolist() == list(range(1, 97)) and "id" not in list(sorted_rows)
assert sorted_rows.units == "" and sorted_rows.box.hi.tolist() == [0.04, 0.04, 0.08] and sorted_rows.box.boundary == "pp pp ff"
assert frame.units == "si" and numpy.array_equal(vg.open(scrambled).read(0, threads=4).points, frame.points)
assert numpy.array_equal(sorted_rows["f_ag:grid:data"], frame["f_ag:grid:data"]) and numpy.array_equal(sorted_rows.points, frame.points)

# a tilted box: middles along its edges; as points, not as an image
tilted = changed("tilted.dump", lambda head, rows: [*named(head), *rows])
with open(tilted) as stream:
    text = stream.read()
bounds = text[text.index("ITEM: BOX"):text.index("ITEM: DIM")]
with open(tilted, "w") as stream:
    stream.write(text.replace(bounds, "ITEM: BOX BOUNDS xy xz yz pp pp ff\n0 6 2\n0 4 0\n0 6 0\n"))
centres = vg.open(tilted)[0].points
assert numpy.allclose(centres[:6], [[0.75, 0.5, 0.5], [1.75, 0.5, 0.5], [2.75, 0.5, 0.5], [3.75, 0.5, 0.5], [1.25, 1.5, 0.5], [2.25, 1.5, 0.5]])

# what is wrong with others
for name, change, words in (
        ("twice.dump", lambda head, rows: [*named(head), *rows[:-1], rows[0]], "each once"),
        ("words.dump", lambda head, rows: [*[line.replace("4 4 6", "4 4 six") for line in head], *rows], "six"),
        ("huge.dump", lambda head, rows: [*[line.replace("4 4 6", "999999 999999 999999") for line in head], *rows], "2^40"),
        ("none.dump", lambda head, rows: [*[line.replace("4 4 6", "4 0 6") for line in head], *rows], "1 and more"),
        ("short.dump", lambda head, rows: [*named(head), *rows[:-1]], "expected 96 rows, got 95"),
        ("no_box.dump", lambda head, rows: [*head[:head.index("ITEM: BOX BOUNDS pp pp ff")], *head[head.index("ITEM: DIMENSION"):], *rows], "BOX BOUNDS")):
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            opened = vg.open(changed(name, change), kind="grid")
            frames = [each.read() for each in opened]
        text = " ".join(str(each.message) for each in said) if not frames else "a frame was read"
    except vg.Error as error:
        text = str(error)
    assert words in text, (name, text)

reader = GranularEulerReader(FileNames=[os.path.abspath(tilted)], Output="ImageData")
try:
    vg.update(reader)
    raise SystemExit("a tilted grid was an image")
except RuntimeError as error:
    assert "tilted.dump" in str(error), error
print("as they are")
