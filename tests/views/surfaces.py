# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of particles at the pole of a superquadric, cut by others where they meet, and in a heap, where hidden ones change no pixel."""
import numpy
import vtkgranular as vg
from discs import ROUNDED, black_view, made, picture, seen, show_white
from paraview.simple import *
from vtkmodules.vtkCommonDataModel import vtkPlane

PIXELS = 160
TOP = 2**24 - 1
random = numpy.random.default_rng(3)
view = black_view(PIXELS)
view.RemoteRenderThreshold = 1e9

# ---- the pole of a superquadric, where powers of x and y are less than floats hold -------------------------------------
pole = made([[0, 0, 0]], radius=[1.], shape=[[1., 1, 1]], quat=[[1., 0, 0, 0]], blockiness1=[2.], blockiness2=[20.])
show_white(pole, view)
Render(view)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 5], [0, 0, 0], [0, 1, 0]
view.CameraParallelProjection, view.CameraParallelScale = 1, 0.05
camera, depths, _ = seen(view)
x = ((numpy.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * 0.05
height = numpy.sqrt(1 - (x[None, :]**20 + x[:, None]**20)**0.1)
units = abs(numpy.round(depths * TOP) - numpy.round(camera.depth(height - 5) * TOP))
assert units.max() <= 1, units.max()
Delete(pole)

# ---- where surfaces meet: a ball in a ball, a tube and a plane through one, from above ----------------------------------
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 5], [0, 0, 0], [0, 1, 0]
view.CameraParallelProjection, view.CameraParallelScale = 1, 1.5
x = ((numpy.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * 1.5
x, y = x[None, :], x[:, None]
balls = made([[0, 0, 0], [0, 0, 0.5], [0, 1.1, 0]], radius=[1, 0.3, 0.3])
display = show_white(balls, view)
line = Line(Point1=[-1.4, 0, 0.6], Point2=[1.4, 0, 0.6])
tube = Tube(Input=line, Radius=0.02, NumberofSides=200)
plane = Plane(Origin=[-1.4, -1.4, 0.3], Point1=[1.4, -1.4, 0.3], Point2=[-1.4, 1.4, 0.3])
for source, height in ((tube, lambda: numpy.where((abs(y) < 0.02) & (abs(x) < 1.4), 0.6 + numpy.sqrt(numpy.clip(0.0004 - y**2, 0, 1)), -9)),
                       (plane, lambda: numpy.where((abs(x) < 1.4) & (abs(y) < 1.4), 0.3, -9))):
    other = Show(source, view)
    other.Ambient, other.Diffuse, other.AmbientColor, other.DiffuseColor = 1, 0, [1, 0, 0], [1, 0, 0]
    with numpy.errstate(invalid="ignore"):
        ball = numpy.fmax(numpy.sqrt(1 - x**2 - y**2), numpy.sqrt(0.09 - x**2 - (y - 1.1)**2))
    in_front = numpy.nan_to_num(ball, nan=-9) > height()
    pixels = picture(view, "meet")
    wrong = (pixels[..., 2] > 128) != in_front  # white, not red or black
    assert wrong.sum() <= ROUNDED, wrong.sum()
    Hide(source, view)

# a clipping plane opens the ball: its inside is below the plane through its middle, and a ring of its outside above, as is the bottom of the ball inside it
plane.Origin, plane.Point1, plane.Point2 = [-1.4, -1.4, 0], [1.4, -1.4, 0], [-1.4, 1.4, 0]
Show(plane, view)
cut = vtkPlane()
cut.SetOrigin(0, 0, 0.3)
cut.SetNormal(0, 0, -1)
actors = view.GetRenderer().GetActors()
mapper = next(actor.GetMapper() for actor in (actors.GetItemAsObject(i) for i in range(actors.GetNumberOfItems()))
              if "Gaussian" in actor.GetMapper().GetClassName() or "Grain" in actor.GetMapper().GetClassName())
mapper.AddClippingPlane(cut)
pixels = picture(view, "clipped")
mapper.RemoveAllClippingPlanes()
beside = y < 0.7  # without the small ball
ring = (x**2 + y**2 < 1) & (x**2 + y**2 > 1 - 0.3**2)
bottom = x**2 + y**2 < 0.3**2 - 0.2**2  # of the ball inside
wrong = ((pixels[..., 2] > 128) != (ring | bottom)) & beside
assert (ring & beside).sum() > 500 and wrong.sum() <= ROUNDED, wrong.sum()
Delete(plane)
Delete(balls)

# ---- many in a heap: those that are left out change nothing --------------------------------------------------------------
side = 24
grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(side)], indexing="ij"), -1).reshape(-1, 3)
points = grid + random.uniform(-0.2, 0.2, grid.shape)
radius = random.uniform(0.3, 0.6, len(points))
whole = made(points, radius=radius)
halves = [made(points[part], radius=radius[part], number=1. + numpy.arange(len(points))[part]) for part in (slice(0, None, 2), slice(1, None, 2))]
assert len(points) > 10000 > len(points) / 2  # of so many none is left out
for parallel in (0, 1):
    view.CameraPosition, view.CameraFocalPoint, view.CameraParallelProjection = [40, 30, 60], [side / 2, side / 2, side / 2], parallel
    view.CameraParallelScale = 12
    pictures, depths = [], []
    for sources in ([whole], halves):
        displays = [vg.show(source, view) for source in sources]
        for display, name in zip(displays, ["id"] if len(sources) == 1 else ["number", "number"]):
            ColorBy(display, ("POINTS", name))
            colors = GetColorTransferFunction(name)
            colors.RGBPoints = [1, 1, 0, 0, len(points), 0, 0, 1]
            display.LookupTable = colors
            display.SetScalarBarVisibility(view, False)
        pictures.append(picture(view, f"heap_{len(sources)}"))
        depths.append(seen(view)[1])
        for display in displays:
            display.Visibility = 0
    assert pictures[0].any(axis=2).mean() > 0.3
    assert abs(depths[0] - depths[1]).max() * 2**24 < 100, "a hole"
    others = (pictures[0] != pictures[1]).any(axis=2).sum()  # where two have one depth
    assert others < 0.001 * PIXELS**2, others
print("all surfaces compared")
