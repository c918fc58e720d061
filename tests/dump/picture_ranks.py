# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the picture is the one that arithmetic says: in each pixel the nearest surface. The grains are dealt to the ranks at random, in slabs, and to one alone."""
import os

import numpy
import vtkgranular as vg
from discs import ROUNDED, Camera, black_view, color_by_id, picture
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints, vtkTypeInt64Array
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

PIECES, PIXELS, SCALE = 6, 280, 1.8  # SCALE: half the height of the picture
random = numpy.random.default_rng(1)
CENTRES = random.uniform(-1, 1, (60, 3))
RADII = random.uniform(0.05, 0.3, 60)
IDS = numpy.arange(1, 61)
CAMERA = Camera([3, 2, 5], [0, 0, 0], scale=SCALE)


# ---- the same particles in files of pieces -----------------------------------------------------------
def write_piece(path, rows, arrays):
    data, points, vertices = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(CENTRES[rows], deep=True))
    data.SetPoints(points)
    for i in range(len(rows)):
        vertices.InsertNextCell(1, [i])
    data.SetVerts(vertices)
    for array, values in {"radius": RADII, **arrays}.items():
        values = numpy_to_vtk(values[rows], deep=True)
        values.SetName(array)
        data.GetPointData().AddArray(values)
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


def write(name, pieces, **arrays):
    for i, rows in enumerate(pieces):
        write_piece(f"{name}_{i}.vtp", rows, arrays)
    sources = "\n".join(f'<Piece Source="{name}_{i}.vtp"/>' for i in range(len(pieces)))
    with open(f"{name}.pvtp", "w") as file:
        file.write('<VTKFile type="PPolyData"><PPolyData GhostLevel="0"><PPointData>'
                   '<PDataArray type="Float64" Name="radius"/>'
                   + "".join(f'<PDataArray type="Float64" Name="{array}" NumberOfComponents="{values.shape[1]}"/>' for array, values in arrays.items())
                   + '<PDataArray type="Int64" Name="id"/>'
                   '</PPointData><PPoints><PDataArray type="Float64" Name="Points" '
                   f'NumberOfComponents="3"/></PPoints>\n{sources}\n</PPolyData></VTKFile>\n')
    return os.path.abspath(f"{name}.pvtp")


everything = numpy.arange(60)
none = everything[:0]
splits = {"random": numpy.array_split(everything, PIECES),
          "slabs": numpy.array_split(numpy.argsort(CENTRES[:, 0]), PIECES),
          "last": (PIECES - 1) * [none] + [everything]}

# ---- the pictures -----------------------------------------------------------------------------------
view = black_view(PIXELS)


def look():
    Render(view)  # the first one resets the camera
    CAMERA.look(view)


def expect(name, display, shown=slice(None), factor=1.0, **shapes):
    color_by_id(display, view, 60)
    look()
    CAMERA.compare(picture(view, name), CENTRES[shown], factor * RADII[shown], IDS[shown], 60, **shapes)


def expect_whole_if_translucent(name, display):
    """What the blended colours are depends on an order; where something is seen does not."""
    display.Opacity = 0.5
    look()
    pixels = picture(view, name)
    wrong = pixels.any(axis=2) != (CAMERA.seen(CENTRES, RADII, IDS, PIXELS) > 0)
    assert wrong.sum() <= ROUNDED, (name, wrong.sum())
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
    expect(f"{name}_show", vg.show(reader, view))
    Hide(reader, view)

display.GrainScale = 0.5
display.Visibility = 1
expect("small", display, slice(None), 0.5)
Hide(reader, view)
some = Threshold(reader, Scalars=["POINTS", "id"], ThresholdMethod="Between",
                 LowerThreshold=10, UpperThreshold=40)
some.UpdatePipeline()
expect("some", vg.show(some, view), slice(9, 40))
Delete(some)

# ---- ellipsoids and superquadrics -----------------------------------------------------------------
AXES, TURNS = RADII[:, None] * 2**random.uniform(-1, 1, (60, 3)), random.normal(size=(60, 4))
POWERS = random.choice([2, 2.5, 4, 8], (60, 2))
for name, powers in {"ellipsoids": {}, "superquadrics": {"powers": POWERS}}.items():
    reader = OpenDataFile(write(name, splits["random"], shape=AXES, quat=TURNS, **({"blockiness": POWERS} if powers else {})))
    display = Show(reader, view)
    display.SetRepresentationType("Grains")
    expect(name, display, axes=AXES, turns=TURNS, **powers)
    Delete(reader)

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

# ---- a particle whose centre is not in the picture ----------------------------------------------------
CENTRES, RADII, IDS = numpy.array([[0.0, 0.0, 0.0]]), numpy.array([4.0]), numpy.array([30])
reader = OpenDataFile(write("one", [numpy.array([0])]))
RIGHT = numpy.cross([0, 1, 0], CAMERA.position)
RIGHT /= numpy.linalg.norm(RIGHT)
display = vg.show(reader, view)
color_by_id(display, view, 60)
Render(view)
CAMERA.look(view, 2.5 * RIGHT)
pixels = picture(view, "one")
line = (numpy.arange(PIXELS) + 0.5) * 2 * SCALE / PIXELS - SCALE
inside = (line[None, :] + 2.5)**2 + line[:, None]**2 < RADII[0]**2
assert inside.any() and not inside.all()
assert (pixels.any(axis=2) != inside).sum() <= ROUNDED
