# SPDX-License-Identifier: BSD-3-Clause
"""Every number of every file of the test data, against a plain parser."""
import os

import numpy
import plain_dump
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
UNNAMED = {"grains.bin": "id type x y z ix iy iz vx vy vz radius",
           "plain.bin": "id type x y z ix iy iz vx vy vz radius element"}
VECTORS = {"v": ("vx", "vy", "vz"), "f": ("fx", "fy", "fz"),
           "omega": ("omegax", "omegay", "omegaz"), "image": ("ix", "iy", "iz")}


def positions(frame, coordinates):
    """The points in doubles, from whichever columns there are."""
    origin, vectors = frame.box()
    names = list(frame.columns)
    if "x" in names:
        points = frame.stack("xyz")
    elif "xs" in names:
        points = origin + frame.stack(("xs", "ys", "zs")) @ vectors
    if coordinates == "Unwrapped":
        points = points + frame.stack(("ix", "iy", "iz")) @ vectors
    if coordinates == "Scaled":
        points = (points - origin) @ numpy.linalg.inv(vectors)
    return points


def check(name, frame, points_are):
    dataset = servermanager.Fetch(reader)
    fields = dataset.GetFieldData()
    assert fields.GetAbstractArray("Coordinates").GetValue(0) == points_are
    assert fields.GetArray("timestep").GetValue(0) == frame.timestep
    if frame.time is not None:
        assert fields.GetArray("time").GetValue(0) == frame.time
    columns = fields.GetAbstractArray("Columns")
    names = [columns.GetValue(i) for i in range(columns.GetNumberOfValues())]
    assert names == list(frame.columns), (names, list(frame.columns))
    origin, vectors = frame.box()
    numpy.testing.assert_allclose(vtk_to_numpy(fields.GetArray("BoxOrigin"))[0], origin, rtol=1e-15)
    numpy.testing.assert_allclose(
        vtk_to_numpy(fields.GetArray("BoxVectors"))[0], vectors.ravel(), rtol=1e-15)

    assert dataset.GetNumberOfPoints() == frame.rows, name
    if frame.rows == 0:
        return 0
    scale = 1 if points_are == "Scaled" else numpy.abs(vectors).max()
    points = vtk_to_numpy(dataset.GetPoints().GetData())
    assert points.dtype == numpy.float64
    numpy.testing.assert_allclose(points, positions(frame, points_are), rtol=0, atol=1e-14 * scale)

    count = points.size
    seen = set()
    for index in range(dataset.GetPointData().GetNumberOfArrays()):
        array = dataset.GetPointData().GetAbstractArray(index)
        if array.IsA("vtkStringArray"):
            words = [array.GetValue(row) for row in range(frame.rows)]
            assert words == list(frame.columns[array.GetName()]), (name, array.GetName())
            seen.add(array.GetName())
            continue
        parts = VECTORS.get(array.GetName(), (array.GetName(),))
        values = vtk_to_numpy(array).reshape(frame.rows, -1)
        assert numpy.array_equal(values, frame.stack(parts)), (name, array.GetName())
        seen.update(parts)
        count += values.size
    assert seen == set(frame.columns), (name, seen)
    return count


total = 0
for name in sorted(os.listdir(data)):
    path = os.path.join(data, name)
    if os.path.isdir(path) or name.endswith(".vtk"):
        continue  # of another system
    names = UNNAMED.get(name, "")
    reader = GranularDumpReader(FileNames=[path], ColumnNames=names) if names else OpenDataFile(path)
    reader.UpdatePipelineInformation()
    everything = reader.GetProperty("PointArrayInfo")
    reader.PointArrayStatus = list(everything)[::2]
    frames = (plain_dump.read_binary(path, names) if name.endswith(".bin")
              else plain_dump.read(path))
    times = list(reader.TimestepValues)
    assert len(times) == len(frames), name
    for coordinates in ("Absolute", "Unwrapped", "Scaled"):
        if coordinates == "Unwrapped" and "ix" not in frames[-1].columns:
            continue
        reader.Coordinates = coordinates
        for time, frame in zip(times, frames):
            reader.UpdatePipeline(time)
            total += check(name, frame, coordinates)
    Delete(reader)
assert total > 100000, total
print(total, "numbers agree")
