# SPDX-License-Identifier: BSD-3-Clause
"""The source as ParaView's users meet it: defaults that show something, names, units, a picture."""
import math
import os

import numpy
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

source = GranularPackingSource()

# names and defaults
expected = {"Arrangement": "Random", "NumberOfGrains": 0, "BoxOrigin": [0, 0, 0],
            "BoxLengths": [0, 0, 0], "BoxTilts": [0, 0, 0], "Boundary": "ff ff ff", "Radii": "Two",
            "Radius": 0.003, "SecondRadius": 0.005, "SecondShare": 0.3, "SolidFraction": 0.2,
            "Spacing": 1, "BondFactor": 0, "Speed": 0, "Seed": 1, "Threads": 0}
for name, default in expected.items():
    value = getattr(source, name)
    assert (list(value) if isinstance(default, list) else value) == default, (name, value)
# what is asked for is made: a number in a box of its own, or a box full
volume = 4 / 3 * math.pi * (0.7 * 0.003 ** 3 + 0.3 * 0.005 ** 3)
for properties, number, lengths in (({}, 1000, (1000 * volume / 0.2) ** (1 / 3)),
                                    ({"NumberOfGrains": 5000, "SolidFraction": 0.25}, 5000, (5000 * volume / 0.25) ** (1 / 3)),
                                    ({"BoxLengths": [0.2, 0.2, 0.2]}, int(0.2 * 0.008 / volume), 0.2),
                                    ({"NumberOfGrains": 700, "BoxLengths": [0.2, 0.2, 0.2]}, 700, 0.2)):
    asked = GranularPackingSource(**properties)
    asked.UpdatePipeline()
    assert asked.GetDataInformation().GetNumberOfPoints() == number, (properties, number)
    bounds = OutputPort(asked, "Box").GetDataInformation().GetBounds()
    assert numpy.allclose(bounds, [0, lengths] * 3, rtol=1e-12), (properties, bounds)
    Delete(asked)

source.BoxLengths = [0.1, 0.1, 0.1]
source.NumberOfGrains = 1000
hints = source.SMProxy.GetHints()
assert hints.FindNestedElementByName("ShowInMenu").GetAttribute("category") == "Granular"


def particles():
    data = servermanager.Fetch(source)
    arrays = {name: vtk_to_numpy(data.GetPointData().GetArray(name))
              for name in ("id", "type", "radius", "v")}
    assert data.GetNumberOfVerts() == data.GetNumberOfPoints()
    return vtk_to_numpy(data.GetPoints().GetData()), arrays


def least_gap(points, radius):
    """By all pairs."""
    square = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    numpy.fill_diagonal(square, numpy.inf)
    return (numpy.sqrt(square) / (radius[:, None] + radius[None])).min() - 1


points, arrays = particles()
assert len(points) == 1000
assert (arrays["id"] == numpy.arange(1, 1001)).all() and arrays["id"].dtype == numpy.int64
assert (arrays["type"] == numpy.where(arrays["radius"] == 0.005, 2, 1)).all()
assert arrays["type"].dtype == numpy.int32 and (arrays["type"] == 2).sum() == 300
assert arrays["v"].shape == (1000, 3) and not arrays["v"].any()
assert least_gap(points, arrays["radius"]) > 0
radius = arrays["radius"][:, None]
assert (points >= radius).all() and (points <= 0.1 - radius).all()

# the box, and what readers say of theirs
box = OutputPort(source, "Box")
assert box.GetDataInformation().GetNumberOfCells() == 1
assert list(box.GetDataInformation().GetBounds()) == [0, 0.1, 0, 0.1, 0, 0.1]
field = servermanager.Fetch(source).GetFieldData()
assert field.GetAbstractArray("Coordinates").GetValue(0) == "Absolute"
assert field.GetAbstractArray("Boundary").GetValue(0) == "ff ff ff"
assert [field.GetAbstractArray("Columns").GetValue(i) for i in range(9)] == \
    "id type x y z radius vx vy vz".split()
assert field.GetArray("timestep").GetValue(0) == 0
assert list(field.GetArray("BoxVectors").GetTuple(0)) == [0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1]

# a picture without another word
view = CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
display = Show(source, view)
assert display.Representation == "Grains", display.Representation
assert Show(box, view).Representation == "Wireframe"
ColorBy(display, ("POINTS", "radius"))
display.RescaleTransferFunctionToDataRange(False)
view.ResetActiveCameraToPositiveY()
camera = GetActiveCamera()
camera.Azimuth(30)
camera.Elevation(25)
ResetCamera(view)
SaveScreenshot("random.png", view)


def picture(name):
    png = vtkPNGReader()
    png.SetFileName(name)
    png.Update()
    return vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)


pixels = picture("random.png")
colored = (pixels.max(axis=1) - pixels.min(axis=1)) > 60
assert 0.1 < colored.mean() < 0.9, colored.mean()

# a lattice in a tilted, periodic box
vg.set_properties(source, Arrangement="FaceCentredCubic", NumberOfGrains=0, Radii="One", Radius=0.005,
                  BoxTilts=[0.03, 0, 0], Boundary="p p f", Spacing=1.05, Speed=0.5, Seed=-3)
source.UpdatePipeline()
ResetCamera(view)
SaveScreenshot("lattice.png", view)
points, arrays = particles()
assert len(points) > 300
assert least_gap(points, arrays["radius"]) > 0.05 - 1e-9
assert 0.4 < arrays["v"].std() < 0.6
assert (picture("lattice.png") != pixels).any()

# a bonded chain: tubes on its bonds, in their place
vg.set_properties(source, Arrangement="Chain", NumberOfGrains=15, Radii="One", Radius=0.002, Spacing=1.5, Speed=0,
                  BondFactor=1, Boundary="f f f", BoxLengths=[0, 0, 0], BoxTilts=[0, 0, 0])
source.UpdatePipeline()
bonds = OutputPort(source, "Bonds")
assert bonds.GetDataInformation().GetNumberOfCells() == 14
lines = servermanager.Fetch(source, idx=2)
ids, ends = (vtk_to_numpy(lines.GetCellData().GetArray(name)) for name in ("id1", "id2"))
assert (ends == ids + 1).all()
length = vtk_to_numpy(lines.GetCellData().GetArray("length"))
assert numpy.allclose(length, 0.006, rtol=1e-12)
Hide(source, view)
Hide(box, view)
assert Show(bonds, view).Representation == "Surface"
Hide(bonds, view)
tubes = Tube(bonds, Radius=0.0008)
display = Show(tubes, view)
ColorBy(display, ("CELLS", "id1"))
ResetCamera(view)
SaveScreenshot("tubes.png", view)
pixels = picture("tubes.png")
assert ((pixels.max(axis=1) - pixels.min(axis=1)) > 60).mean() > 0.002
Delete(tubes)
Show(source, view)
vg.set_properties(source, Arrangement="Random", Radius=0.005, BondFactor=0)

# more than 2^31 can be asked for
source.NumberOfGrains = 3_000_000_000
assert source.NumberOfGrains == 3_000_000_000

# filters, and the package's own way to look
source.NumberOfGrains = 500
vg.show(source, view, color="v")
clip = Threshold(source, Scalars=["POINTS", "id"], ThresholdMethod="Below Lower Threshold",
                 LowerThreshold=100)
clip.UpdatePipeline()
assert clip.GetDataInformation().GetNumberOfPoints() == 100

# a dump of the particles is read back as the particles
vg.set_properties(source, BoxLengths=[0.1, 0.1, 0.1], BoxTilts=[0.02, 0, -0.01], Boundary="p p p", NumberOfGrains=300, Speed=1)
path = os.path.abspath("grains.dump")
SaveData(path, source)
reader = OpenDataFile(path)
written, read = servermanager.Fetch(source), servermanager.Fetch(reader)
assert read.GetNumberOfPoints() == 300
for name in ("id", "type", "radius", "v"):
    a, b = (vtk_to_numpy(data.GetPointData().GetArray(name)) for data in (written, read))
    assert a.dtype == b.dtype and numpy.allclose(a, b, rtol=1e-5, atol=0), name
a, b = (vtk_to_numpy(data.GetPoints().GetData()) for data in (written, read))
assert numpy.allclose(a, b, rtol=0, atol=1e-6)
a, b = (data.GetFieldData() for data in (written, read))
assert numpy.allclose(a.GetArray("BoxVectors").GetTuple(0), b.GetArray("BoxVectors").GetTuple(0))
assert a.GetAbstractArray("Boundary").GetValue(0) == b.GetAbstractArray("Boundary").GetValue(0) == "pp pp pp"
