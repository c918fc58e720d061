# SPDX-License-Identifier: BSD-3-Clause
"""Particles are seen as rays in double precision see them: depth, side and number of each pixel, of spheres, ellipsoids and
superquadrics, near and far, from outside and inside; other surfaces cut them where they meet; hidden ones change no pixel."""
import sys

import numpy
import ray_caster
import vtkgranular as vg
from discs import ROUNDED, black_view, made, picture
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkPlane

PIXELS = 160
TOP = 2**24 - 1
random = numpy.random.default_rng(3)
view = black_view(PIXELS)
view.RemoteRenderThreshold = 1e9


def shown(source):
    display = vg.show(source, view)
    display.Ambient, display.Diffuse = 1, 0
    display.AmbientColor = display.DiffuseColor = [1, 1, 1]
    return display


def seen():
    """The camera, and the depths of the pixels, of what is shown: before ParaView draws axes, which clear the depth."""
    depths, renderer = vtkFloatArray(), view.GetRenderer()
    watch = renderer.AddObserver("EndEvent", lambda *_: view.GetRenderWindow().GetZbufferData(0, 0, PIXELS - 1, PIXELS - 1, depths))
    Render(view)
    renderer.RemoveObserver(watch)
    return ray_caster.Camera(view.GetActiveCamera(), PIXELS, PIXELS), vtk_to_numpy(depths).reshape(PIXELS, PIXELS).astype(float)


def look(centre):
    """A camera somewhere, sometimes among the particles."""
    away = random.normal(size=3)
    view.CameraFocalPoint, view.CameraPosition = list(centre), list(centre + away / numpy.linalg.norm(away) * 10**random.uniform(0, 1))
    view.CameraViewUp = list(random.normal(size=3))
    view.CameraParallelProjection = int(random.integers(2))
    view.CameraParallelScale, view.CameraViewAngle = random.uniform(0.5, 3), random.uniform(15, 60)


def within(pixels):
    """The pixels that have eight neighbours of their kind."""
    found = numpy.zeros_like(pixels)
    found[1:-1, 1:-1] = numpy.logical_and.reduce([pixels[1 + j:PIXELS - 1 + j, 1 + i:PIXELS - 1 + i] for j in (-1, 0, 1) for i in (-1, 0, 1)])
    return found


def check_depths(kind, scenes, most):
    """A depth buffer has the numbers from 0 to 2^24 - 1. Few are off by one more than one. Close to the camera such a unit can be less than
    the last place of a float that holds the distance of a particle and its size; there the depth is right to 2^-20 of the particles'
    extent. Steep surfaces are left out: a shift across the line of sight makes more of a depth there."""
    seen_pixels, wrong, units, parts, source = 0, 0, [], [], None
    for _ in range(scenes):
        count = int(random.integers(1, 30))
        centre = random.choice([0, 0, 1e3, 2**20]) * numpy.array([1, -1, 0.5])
        points, radius = random.uniform(-1, 1, (count, 3)) + centre, 10**random.uniform(-1.2, -0.2, count)
        axes, arrays, powers, turns = numpy.repeat(radius[:, None], 3, axis=1), {}, None, None
        if kind != "spheres":
            axes, turns = radius[:, None] * 5**random.uniform(-0.5, 0.5, (count, 3)), random.normal(size=(count, 4))
            arrays = {"shape": axes, "quat": turns}
        if kind == "superquadrics":
            powers = random.choice([2, 2.5, 4, 8, 20], (count, 2)).astype(float)
            arrays.update(blockiness1=powers[:, 0], blockiness2=powers[:, 1])
        source, new = made(points, source, radius=radius, **arrays), source is None
        if new:
            shown(source)
        Render(view)  # or the clipping range is that of the scene before
        look(centre)
        camera, depths = seen()
        truth, normals, numbers = ray_caster.cast(camera, points, axes, turns, powers)
        drawn, there = depths < 1, numbers >= 0
        wrong += (drawn != there).sum()
        assert not (within(there) & ~drawn).any() and not (within(~there) & drawn).any(), (kind, "a hole, or a speck")
        sight = [0, 0, 1] if camera.parallel else -camera.rays()[1]
        steep = abs((normals * sight).sum(-1)) / numpy.linalg.norm(sight, axis=-1) < 0.5
        both = there & drawn & ~steep
        seen_pixels += both.sum()
        off = abs(numpy.round(depths * TOP) - numpy.round(truth * TOP))[both]
        near, far = camera.near, camera.far
        away = (near + truth * (far - near) if camera.parallel else near * far / (far - truth * (far - near)))[both]
        slope = 1 / (far - near) if camera.parallel else near * far / ((far - near) * away**2)
        distances = numpy.linalg.norm(points - (points[0] if camera.parallel else camera.position), axis=1) + axes.max(axis=1)
        units.append(off[distances[numbers[both]] * slope < 1])
        parts.append(numpy.clip(off - 1, 0, None) / (TOP * slope * numpy.sqrt(12)))
    Delete(source)
    units, parts = numpy.concatenate(units), numpy.concatenate(parts)
    print(f"{kind}: {seen_pixels} pixels, {wrong} on outlines wrong; depth off by at most {units.max():.0f} units, "
          f"{100 * (units > 1).mean():.2f} % by more than 1, {100 * (units > 2).mean():.4f} % by more than 2; beyond 1 by at most 2^{numpy.log2(parts.max()):.1f} of the extent")
    assert seen_pixels > 5000 and wrong <= 1e-4 * seen_pixels, (kind, wrong)
    assert units.max() <= most and (units > 1).mean() < 0.005 and (units > 2).mean() < 2e-4 and parts.max() < 2**-20


more = int(sys.argv[1]) if len(sys.argv) > 1 else 1  # 15: a thousand scenes, in about ten minutes
check_depths("spheres", 30 * more, 2)
check_depths("ellipsoids", 30 * more, 8)
check_depths("superquadrics", 6 * more, 8)

# ---- the pole of a superquadric, where powers of x and y are less than floats hold -------------------------------------
pole = made([[0, 0, 0]], radius=[1.], shape=[[1., 1, 1]], quat=[[1., 0, 0, 0]], blockiness1=[2.], blockiness2=[20.])
shown(pole)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 5], [0, 0, 0], [0, 1, 0]
view.CameraParallelProjection, view.CameraParallelScale = 1, 0.05
camera, depths = seen()
x = ((numpy.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * 0.05
height = numpy.sqrt(1 - (x[None, :]**20 + x[:, None]**20)**0.1)
units = abs(numpy.round(depths * TOP) - numpy.round(camera.depth(height - 5) * TOP))
assert units.max() <= 2, units.max()
Delete(pole)

# ---- where surfaces meet: a ball in a ball, a tube and a plane through one, from above ----------------------------------
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 5], [0, 0, 0], [0, 1, 0]
view.CameraParallelProjection, view.CameraParallelScale = 1, 1.5
x = ((numpy.arange(PIXELS) + 0.5) / PIXELS * 2 - 1) * 1.5
x, y = x[None, :], x[:, None]
balls = made([[0, 0, 0], [0, 0, 0.5], [0, 1.1, 0]], radius=[1, 0.3, 0.3])
display = shown(balls)
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
        depths.append(seen()[1])
        for display in displays:
            display.Visibility = 0
    assert pictures[0].any(axis=2).mean() > 0.3
    assert abs(depths[0] - depths[1]).max() * 2**24 < 100, "a hole"
    others = (pictures[0] != pictures[1]).any(axis=2).sum()  # where two have one depth
    assert others < 0.001 * PIXELS**2, others
print("all surfaces compared")
