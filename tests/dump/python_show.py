# SPDX-License-Identifier: BSD-3-Clause
"""vg.show: the spheres in the picture have the radii of the file, to the pixel."""
import math
import os
import subprocess
import sys

import numpy
import vtkgranular as vg
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

HEADER = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n" \
    "-10 10\n-10 10\n-10 10\nITEM: ATOMS "
PIXELS = 50  # a unit of length

view = CreateRenderView()
if sys.argv[1:] == ["without a display"]:
    vg.show(Sphere(), view)
    Render(view)
    sys.exit()
view.ViewSize = [800, 800]
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
view.OrientationAxesVisibility = 0
view.CameraParallelProjection = 1


def write(name, text):
    with open(name, "w") as file:
        file.write(HEADER + text)
    return OpenDataFile(os.path.abspath(name))


def radii(display, middle):
    """Radii of what is left and right of a place on both axes, from its width, height and area."""
    display.ColorArrayName = [None, ""]
    display.AmbientColor = display.DiffuseColor = [1, 1, 1]
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0  # no side without light
    Render(view)  # the first one resets the camera
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [middle, middle, 50], [middle, middle, 0], [0, 1, 0]
    view.CameraParallelScale = 400 / PIXELS
    SaveScreenshot("spheres.png", view, ImageResolution=[800, 800])
    png = vtkPNGReader()
    png.SetFileName("spheres.png")
    png.Update()
    image = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars()).reshape(800, 800, -1).max(axis=2)
    for half in (image[:, :400] > 0, image[:, 400:] > 0):
        yield (0.5 * half.any(axis=0).sum() / PIXELS, 0.5 * half.any(axis=1).sum() / PIXELS,
               math.sqrt(half.sum() / math.pi) / PIXELS)


def expect(display, left, right, middle=0):
    for is_, truth in zip(radii(display, middle), (left, right)):
        assert all(abs(one - truth) <= 1.5 / PIXELS for one in is_), (is_, truth)


# opened the plain way, as File > Open does: the hints of the plugin choose the representation
reader = write("two.dump", "id type x y z radius\n1 1 -4 0 0 3\n2 1 4 0 0 0.5\n")
display = Show(reader, view)
assert display.Representation == "Grains", display.Representation
box = Show(OutputPort(reader, 1), view)
assert box.Representation == "Wireframe", box.Representation
Hide(OutputPort(reader, 1), view)
expect(display, 3, 0.5)
display.GrainScale = 0.5
expect(display, 1.5, 0.25)

# opened our way
display = vg.show(reader, view)
assert display.Representation == "Grains"
expect(display, 3, 0.5)
expect(vg.show(reader, view, radius=2), 2, 2)
expect(vg.show(reader), 3, 0.5)
vg.show(reader, color="type")
assert display.ColorArrayName[1] == "type"
Hide(reader, view)

# no radius: dots of the point size, as no radius is made up; our way half the mean distance
plain = write("plain.dump", "id type x y z\n1 1 -4 0 0\n2 1 4 0 0\n")
points = Show(plain, view)
assert points.Representation == "Grains", points.Representation
box = Show(OutputPort(plain, 1), view)
assert box.Representation == "Wireframe", box.Representation
Hide(OutputPort(plain, 1), view)
points.PointSize = 10
expect(points, *2 * [5 / PIXELS])
expect(vg.show(plain, view), 2, 2)
display = Show(plain, view)
expect(display, 2, 2)  # as it was: one radius for all, of no array
display.GrainRadiusArray = "radius"
expect(display, *2 * [5 / PIXELS])
display.GrainScale = 3
expect(display, *2 * [5 / PIXELS])
display.GrainRadiusArray = ""
expect(display, 3, 3)
Hide(plain, view)

# radii are lengths, scaled coordinates are not
reader.Coordinates = "Scaled"
display = vg.show(reader, view)
assert display.GrainRadiusArray == "" and display.GrainScale < 1
Delete(reader)

# so it is when opened the plain way, and where the radii are not loaded: dots, and spheres again with radii
plain_name, name = (os.path.abspath(each) for each in ("plain.dump", "two.dump"))
for other, back, middle in (({"Coordinates": "Scaled"}, {"Coordinates": "Absolute"}, 0.5),
                            ({"PointArrayStatus": ["id"]}, {"PointArrayStatus": ["id", "type", "radius"]}, 0),
                            ({"FileNames": [plain_name]}, {"FileNames": [name]}, 0)):
    reader = OpenDataFile(name)
    display = Show(reader, view)
    display.PointSize = 10
    expect(display, 3, 0.5)
    vg.set_properties(reader, **other)
    expect(display, *2 * [5 / PIXELS], middle)
    vg.set_properties(reader, **back)
    expect(display, 3, 0.5)
    Delete(reader)

# a state brings back what was chosen
display = Show(plain, view)
display.SetRepresentationType("Grains")
SaveState("chosen.pvsm")
names = [name for name, _ in GetSources()]
Delete(reader)
Delete(plain)
LoadState("chosen.pvsm")
for name in names:
    reader = FindSource(name)
    display = GetRepresentation(reader, GetActiveViewOrCreate("RenderView"))
    assert display.Representation == "Grains", (name, display.Representation)

# the first frame of a run may be empty: the next ones are shown, either way
grown = HEADER.replace("\n2\n", "\n0\n") + "id x y z radius\n" + HEADER.replace(
    "TIMESTEP\n0", "TIMESTEP\n10") + "id x y z radius\n1 -4 0 0 3\n2 4 0 0 0.5\n"
with open("grown.dump", "w") as file:
    file.write(grown)
for way in (vg.show, Show):
    view.ViewTime = 0
    particles = OpenDataFile(os.path.abspath("grown.dump"))
    display = way(particles, view)
    Render(view)
    assert particles.GetDataInformation().GetNumberOfPoints() == 0
    view.ViewTime = 10
    expect(display, 3, 0.5)
    Delete(particles)

# colours can be chosen before there is anything to colour
view.ViewTime = 0
particles = OpenDataFile(os.path.abspath("grown.dump"))
display = vg.show(particles, view, color="radius")
view.ViewTime = 10
Render(view)
assert list(display.ColorArrayName) == ["POINTS", "radius"]

# colours by type have names, and ranges come from the last frame where the first one is empty
typed = HEADER.replace("\n2\n", "\n0\n") + "id type x y z radius\n" + HEADER.replace(
    "TIMESTEP\n0", "TIMESTEP\n10") + "id type x y z radius\n1 2 -4 0 0 3\n2 4 4 0 0 0.5\n"
with open("typed.dump", "w") as file:
    file.write(typed)
view.ViewTime = 0
for particles in (vg.reader("typed.dump"), Calculator(Input=vg.reader("typed.dump"))):
    display = vg.show(particles, view, color="type", box=True)
    colours = GetColorTransferFunction("type")
    assert list(colours.Annotations) == ["2", "type 2", "3", "type 3", "4", "type 4"], colours.Annotations
    assert len(colours.IndexedColors) == 9 and colours.InterpretValuesAsCategories == 1
    assert particles.GetDataInformation().GetNumberOfPoints() == 0  # the frame that is shown is the one that was shown
    vg.show(particles, view, color="radius")
    points = list(GetColorTransferFunction("radius").RGBPoints)
    assert (points[0], points[-4]) == (0.5, 3), points

# an array that is not there, neither in this frame nor in the last one
for source in (vg.reader("typed.dump"), vg.reader("two.dump")):
    try:
        vg.show(source, view, color="v")
        raise AssertionError("a colour of nothing")
    except ValueError as error:
        assert str(error) == "expected a point array to colour by, of id, radius, type, got 'v'", error

# bonds and boxes of sources, through filters; and what has none
packing = GranularPackingSource(Arrangement="Chain", NumberOfGrains=5, BondFactor=1)
before = len(view.Representations)
vg.show(Calculator(Input=packing), view, box=True, bonds=True)
assert len(view.Representations) == before + 3, len(view.Representations) - before
for wanted in ("box", "bonds"):
    try:
        vg.show(Sphere(), view, **{wanted: True})
        raise AssertionError(f"a sphere has {wanted}")
    except ValueError as error:
        assert wanted.capitalize() in str(error), error

# cells, parts of them and subdomains are surfaces, contacts lines, coloured by their arrays, also where the first frame is empty
good = os.path.join(os.environ["GRANULAR_DATA"], "good")
contacts = vg.reader(os.path.join(good, "local", "contacts.dump"), Preset="ContactsForce")
cells = GranularEulerAverage(Input=vg.reader(os.path.join(good, "grains.dump")))
for source, name in ((cells, "volumefraction"), (Threshold(Input=cells, Scalars=["CELLS", "volumefraction"]), "volumefraction"),
                     (GranularDecomposition(Input=packing), "nlocal"), (contacts, "force"),
                     (GranularTrajectories(Input=cells.Input), "speed")):
    display = vg.show(source, view, color=name, box=True)
    kind = "POINTS" if name == "speed" else "CELLS"
    assert display.Representation != "Grains" and display.ColorArrayName[:2] == [kind, name], (display.Representation, name)

# a legend, and none unless wanted
typed = vg.reader("typed.dump")
for wanted in (False, True):
    display = vg.show(typed, view, color="type", legend=wanted)
    assert bool(display.IsScalarBarVisible(view)) == wanted

# without a display a message instead of a crash, or a picture where ParaView can do without
environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
done = subprocess.run([sys.executable if "pvpython" in sys.executable else "pvpython", "--dr", __file__, "without a display"],
                      env=environment, capture_output=True, text=True)
assert done.returncode == 0 or "expected a display to draw on, got none" in done.stderr, done.stderr
assert "SIGSEGV" not in done.stderr, done.stderr
