# SPDX-License-Identifier: BSD-3-Clause
"""Ellipsoids and superquadrics of the files that LIGGGHTS and LAMMPS write: sizes, exponents and rotations mean what each program means
by them, in the arrays and in the picture."""
import os

import numpy
import plain_data
import ray_caster
import vtkgranular as vg
from discs import black_view, picture
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

PIXELS = 160
HERE = os.path.join(os.environ["GRANULAR_DATA"], "good", "shapes")
HALF, DIAMETERS = 1, 0.5
X, QUAT, BLOCK = ["x", "y", "z"], ["quatw", "quati", "quatj", "quatk"], ["block1", "block2"]
SHAPE = ["shapex", "shapey", "shapez"]
C_Q, C_S = [f"c_q[{i}]" for i in (1, 2, 3, 4)], [f"c_s[{i}]" for i in (1, 2, 3)]
# file, factor of half axes, and columns: sizes, rotation, exponents; and the arrays of the reader, which leaves computes as they are
TABLE = [("by_hand.dump", HALF, SHAPE, ["quat1", "quat2", "quat3", "quat4"], ["blockiness1", "blockiness2"], ("shape", "quat", "blockiness")),
         ("ellipsoids.dump", DIAMETERS, SHAPE, QUAT, [], ("shape", "quat")),
         ("superellipsoids.dump", DIAMETERS, SHAPE, QUAT, BLOCK, ("shape", "quat", "blockiness")),
         ("computes.dump", DIAMETERS, C_S, C_Q, [], ("c_s", "c_q")),
         ("ellipsoids.data", DIAMETERS, SHAPE, QUAT, [], ("shape", "quat")),
         ("superellipsoids.data", DIAMETERS, SHAPE, QUAT, BLOCK, ("shape", "quat", "blockiness"))]
view = black_view(PIXELS)


def plainly(name):
    """Columns of a file by their names, in its order."""
    if name.endswith(".data"):
        data = plain_data.Data(os.path.join(HERE, name))
        shapes = data.rows("Ellipsoids")
        rows = [[number, *row[3:6], *shapes[number]] for number, row in data.rows("Atoms").items()]
        names = ["id", *X, *SHAPE, *QUAT, *BLOCK]
    else:
        with open(os.path.join(HERE, name)) as file:
            lines = file.read().split("\n")
        first = [line.startswith("ITEM: ATOMS") for line in lines].index(True)
        names = lines[first].split()[2:]
        rows = [[word if word[0] not in "bs" else "0" for word in line.split()] for line in lines[first + 1:] if line]
    return dict(zip(names, numpy.array(rows, float).T))


def compare(source, half, sizes, turns, powers, columns):
    """The picture and the ray caster's."""
    display = vg.show(source, view)
    display.Ambient, display.Diffuse, display.AmbientColor, display.DiffuseColor = 1, 0, [1, 1, 1], [1, 1, 1]
    display.ColorArrayName = [None, ""]
    points = numpy.stack([columns[name] for name in X], 1)
    middle, extent = points.mean(0), numpy.ptp(points, 0).max()
    view.CameraFocalPoint, view.CameraPosition = list(middle), list(middle + extent * numpy.array([1, -2, 0.7]))
    view.CameraViewUp, view.CameraViewAngle = [0, 0, 1], 35
    Render(view)
    seen = picture(view, "shapes").any(axis=2)
    numbers = ray_caster.cast(ray_caster.Camera(view.GetActiveCamera(), PIXELS, PIXELS), points, half * sizes, turns, powers)[2]
    assert (numbers >= 0).sum() > 200 and (seen != (numbers >= 0)).sum() <= 3, ((numbers >= 0).sum(), (seen != (numbers >= 0)).sum())
    return display


for name, half, *wanted, arrays in TABLE:
    columns = plainly(name)
    source = vg.reader(os.path.join(HERE, name))
    source.UpdatePipeline()
    read = source.GetClientSideObject().GetOutputDataObject(0)
    rows = numpy.argsort(vtk_to_numpy(read.GetPointData().GetArray("id")))
    for array, names in zip(arrays, wanted):
        values = numpy.stack([columns[each] for each in names], 1)[numpy.argsort(columns["id"])]
        assert (vtk_to_numpy(read.GetPointData().GetArray(array))[rows] == values).all(), (name, array)
    said = read.GetFieldData().GetAbstractArray("ShapeSizes")
    assert said is None if arrays[0] == "c_s" else said.GetValue(0) == ("HalfAxes" if half == HALF else "Diameters"), name
    sizes, turns, powers = (numpy.stack([columns[each] for each in names], 1) if names else None for names in wanted)
    display = compare(source, half, sizes, turns, powers, columns)
    if name == "by_hand.dump":  # the user knows better
        display.GrainShapeSizes = "Diameters"
        compare(source, DIAMETERS, sizes, turns, powers, columns)
    Delete(source)
    print(name, len(rows), "particles")

# the dump and the data file are of the same step of one run, and LAMMPS wrote six digits into the dump
for name in ("ellipsoids", "superellipsoids"):
    dump, data = plainly(name + ".dump"), plainly(name + ".data")
    for column in X + SHAPE + QUAT:
        apart = abs(dump[column][numpy.argsort(dump["id"])] - data[column][numpy.argsort(data["id"])])
        assert (apart <= 5e-6 * abs(data[column]).max()).all(), (name, column)

# a dump that is written has the columns of the one that was read, to the byte
for name in ("by_hand.dump", "ellipsoids.dump", "superellipsoids.dump", "computes.dump"):
    vg.save(vg.reader(os.path.join(HERE, name)), "again.dump")
    with open(os.path.join(HERE, name)) as old, open("again.dump") as new:
        old, new = old.read(), new.read()
        assert old[old.index("ITEM: ATOMS"):].split() == new[new.index("ITEM: ATOMS"):].split(), name
# and so have chosen arrays: half axes must not become diameters by a name
for name in ("superellipsoids.data", "superellipsoids.dump", "by_hand.dump"):
    source = vg.reader(os.path.join(HERE, name), **({"Boundary": "pp pp ff"} if name.endswith(".data") else {}))
    vg.save(source, "chosen.dump", Columns=["id", "x", "y", "z", "shape", "quat", "blockiness"])
    first, again = (vg.fetch(each) for each in (source, vg.reader("chosen.dump")))
    said = [each.GetFieldDataInformation().GetArray("ShapeSizes").GetStringValue(0) for each in (source, GetActiveSource())]
    assert all((first[array] == again[array]).all() for array in ("id", "shape", "quat", "blockiness")) and said[0] == said[1], name
print("all shapes compared")
