# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the picture is the one that arithmetic says: in each pixel the nearest disc,
its colour and its shade. The grains are dealt to the ranks at random, in slabs, and to one alone."""
import os

import granular
import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkTypeInt64Array
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

PIECES, PIXELS, SCALE = 6, 400, 1.8  # SCALE: half the height of the picture
EDGE = 0.01  # pixels: within, rounding decides
LEVELS = 1.5  # of 255: the table of colours has 256, and each value is rounded
random = numpy.random.default_rng(1)
CENTRES = random.uniform(-1, 1, (60, 3))
RADII = random.uniform(0.05, 0.3, 60)
IDS = numpy.arange(1, 61)

# ---- the truth ----------------------------------------------------------------------------------
POSITION = numpy.array([3.0, 2.0, 5.0])
NORMAL = POSITION / numpy.linalg.norm(POSITION)  # towards the camera, which looks at the origin
RIGHT = numpy.cross([0, 1, 0], NORMAL)
RIGHT /= numpy.linalg.norm(RIGHT)
UP = numpy.cross(NORMAL, RIGHT)


def truth(shown=slice(None), factor=1.0):
    """Of each pixel the id of the nearest grain or 0, its shade, and True where an edge is near."""
    unit = 2 * SCALE / PIXELS
    line = (numpy.arange(PIXELS) + 0.5) * unit - SCALE
    x, y = numpy.meshgrid(line, line)
    nearest = numpy.full(x.shape, -numpy.inf)
    ids, shade, edge = numpy.zeros(x.shape, int), numpy.zeros(x.shape), numpy.zeros(x.shape, bool)
    for centre, radius, identity in zip(CENTRES[shown], factor * RADII[shown], IDS[shown]):
        distance = numpy.hypot(x - centre @ RIGHT, y - centre @ UP)
        inside = (distance < radius) & (centre @ NORMAL > nearest)
        nearest[inside], ids[inside] = centre @ NORMAL, identity
        shade[inside] = 1 - (distance[inside] / radius) ** 2
        edge |= abs(distance - radius) < EDGE * unit
    return ids, shade, edge


# ---- the same grains in files of pieces -----------------------------------------------------------
def write_piece(path, rows):
    data, points, vertices = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(CENTRES[rows], deep=True))
    data.SetPoints(points)
    for i in range(len(rows)):
        vertices.InsertNextCell(1, [i])
    data.SetVerts(vertices)
    radius = numpy_to_vtk(RADII[rows], deep=True)
    radius.SetName("radius")
    data.GetPointData().AddArray(radius)
    identity = vtkTypeInt64Array()
    identity.SetName("id")
    for row in rows:
        identity.InsertNextValue(int(IDS[row]))
    data.GetPointData().AddArray(identity)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(data)
    writer.SetDataModeToBinary()
    assert writer.Write() == 1


def write(name, pieces):
    for i, rows in enumerate(pieces):
        write_piece(f"{name}_{i}.vtp", rows)
    sources = "\n".join(f'<Piece Source="{name}_{i}.vtp"/>' for i in range(len(pieces)))
    with open(f"{name}.pvtp", "w") as file:
        file.write('<VTKFile type="PPolyData"><PPolyData GhostLevel="0"><PPointData>'
                   '<PDataArray type="Float64" Name="radius"/><PDataArray type="Int64" Name="id"/>'
                   '</PPointData><PPoints><PDataArray type="Float64" Name="Points" '
                   f'NumberOfComponents="3"/></PPoints>\n{sources}\n</PPolyData></VTKFile>\n')
    return os.path.abspath(f"{name}.pvtp")


everything = numpy.arange(60)
none = everything[:0]
splits = {"random": numpy.array_split(everything, PIECES),
          "slabs": numpy.array_split(numpy.argsort(CENTRES[:, 0]), PIECES),
          "last": (PIECES - 1) * [none] + [everything]}

# ---- the pictures -----------------------------------------------------------------------------------
view = CreateRenderView()
view.ViewSize = [PIXELS, PIXELS]
view.UseColorPaletteForBackground = 0
view.Background = [0, 0, 0]
view.OrientationAxesVisibility = 0
view.CameraParallelProjection = 1
view.UseFXAA = 0  # it would mix neighbours

colors = GetColorTransferFunction("id")
colors.AutomaticRescaleRangeMode = "Never"
colors.ColorSpace = "RGB"
colors.RGBPoints = [1, 1, 0, 0, 60, 0, 0, 1]  # from red to blue


def look():
    Render(view)  # the first one resets the camera
    view.CameraPosition, view.CameraFocalPoint = list(POSITION), [0, 0, 0]
    view.CameraViewUp, view.CameraParallelScale = [0, 1, 0], SCALE


def picture(name):
    SaveScreenshot(f"{name}.png", view, ImageResolution=[PIXELS, PIXELS])
    png = vtkPNGReader()
    png.SetFileName(f"{name}.png")
    png.Update()
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(PIXELS, PIXELS, -1)[:, :, :3].astype(float)


def color_by_id(display):
    ColorBy(display, ("POINTS", "id"))
    display.RescaleTransferFunctionToDataRange(False)
    display.LookupTable = colors
    display.SetScalarBarVisibility(view, False)
    colors.RescaleTransferFunction(1, 60)


def expect(name, display, *wanted):
    color_by_id(display)
    look()
    pixels = picture(name)
    ids, shade, edge = truth(*wanted)
    assert (ids > 0).sum() > 5000 and edge.mean() < 0.01, "the truth itself shows little"
    assert not pixels[(ids == 0) & ~edge].any(), (name, "something where nothing is")
    inside = (ids > 0) & ~edge
    blue = (ids[inside] - 1) / 59
    exact = 255 * shade[inside][:, None] * numpy.stack([1 - blue, 0 * blue, blue], axis=1)
    away = abs(pixels[inside] - exact).max(axis=1)
    assert away.max() < LEVELS, (name, away.max(), int((away >= LEVELS).sum()))


def expect_whole_if_translucent(name, display):
    """What the blended colours are depends on an order; where something is seen does not."""
    display.Opacity = 0.5
    look()
    pixels = picture(name)
    ids, shade, edge = truth()
    assert not pixels[(ids == 0) & ~edge].any(), (name, "something where nothing is")
    assert pixels[(ids > 0) & (shade > 0.1)].any(axis=1).all(), (name, "nothing where something is")
    display.Opacity = 1


def expect_camera_around_spheres():
    Render(view)
    ResetCamera(view)
    middle = 0.5 * ((CENTRES - RADII[:, None]).min(axis=0) + (CENTRES + RADII[:, None]).max(axis=0))
    assert numpy.allclose(view.CameraFocalPoint, middle, rtol=0, atol=1e-12), (
        view.CameraFocalPoint, middle)


for name, pieces in splits.items():
    reader = OpenDataFile(write(name, pieces))
    display = Show(reader, view)
    display.SetRepresentationType("Grains")
    expect(f"{name}_grains", display)
    expect_camera_around_spheres()
    expect_whole_if_translucent(f"{name}_translucent", display)
    expect(f"{name}_show", granular.show(reader, view))
    Hide(reader, view)

display.GrainScale = 0.5
display.Visibility = 1
expect("small", display, slice(None), 0.5)
Hide(reader, view)
some = Threshold(reader, Scalars=["POINTS", "id"], ThresholdMethod="Between",
                 LowerThreshold=10, UpperThreshold=40)
some.UpdatePipeline()
expect("some", granular.show(some, view), slice(9, 40))
Delete(some)

# ---- our own reader, as a file is opened by default -----------------------------------------------
with open("grains.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n60\nITEM: BOX BOUNDS ff ff ff\n"
               + 3 * "-1 1\n" + "ITEM: ATOMS id x y z radius\n")
    for identity, centre, radius in zip(IDS, CENTRES.tolist(), RADII.tolist()):
        file.write(f"{identity} {centre[0]!r} {centre[1]!r} {centre[2]!r} {radius!r}\n")
reader = OpenDataFile(os.path.abspath("grains.dump"))
display = Show(reader, view)
assert display.Representation == "Grains", display.Representation
expect("dump", display)
Delete(reader)

# ---- a grain whose centre is not in the picture ----------------------------------------------------
CENTRES, RADII, IDS = numpy.array([[0.0, 0.0, 0.0]]), numpy.array([4.0]), numpy.array([30])
reader = OpenDataFile(write("one", [numpy.array([0])]))
display = granular.show(reader, view)
color_by_id(display)
look()
view.CameraPosition = list(POSITION + 2.5 * RIGHT)
view.CameraFocalPoint = list(2.5 * RIGHT)
pixels = picture("one")
line = (numpy.arange(PIXELS) + 0.5) * 2 * SCALE / PIXELS - SCALE
shade = 1 - ((line[None, :] + 2.5) ** 2 + line[:, None] ** 2) / 4.0 ** 2
assert (shade < 0).any() and (shade > 0.5).any()
assert abs(pixels.sum(axis=2) - 255 * numpy.maximum(shade, 0)).max() < 2 * LEVELS
