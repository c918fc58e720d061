# SPDX-License-Identifier: BSD-3-Clause
"""Drawing a scene: frames a second of Grains and of other ways to draw the same particles, in windows of 1000 x 800 pixels.

The scene is drawn by pvpython, which this script starts for itself; ways take turns, zoom by zoom. Ways of VTK alone have a window of
their own, without ParaView."""
import json
import math
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[3]
SIZE = (1000, 800)
ZOOMS = (1, 4, 16)
POWER = 8.0  # exponents of superquadrics


def packing(count):
    """Places and radii on a disturbed lattice, whose constant is 1."""
    random = numpy.random.default_rng(1)
    side = round(count ** (1 / 3))
    i = numpy.arange(count)
    points = numpy.stack([i % side, i // side % side, i // side**2], 1) + random.uniform(-.2, .2, (count, 3))
    return side, points, random.uniform(.3, .5, count), random


def polydata(count, shapes):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    side, places, radius, random = packing(count)
    data, points, vertices = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(places, deep=True))
    data.SetPoints(points)
    vertices.SetData(1, numpy_to_vtk(numpy.arange(count, dtype=numpy.int64), deep=True, array_type=16))  # vtkTypeInt64Array
    data.SetVerts(vertices)
    arrays = {"radius": radius, "v": radius}
    if shapes:
        turns = random.normal(size=(count, 4))
        arrays.update(shape=radius[:, None] * random.uniform(0.5, 1, (count, 3)) / 2, blockiness=numpy.full((count, 2), POWER),
                      quat=turns / numpy.linalg.norm(turns, axis=1)[:, None])
        arrays["diameters"] = 2 * arrays["shape"]
    for name, values in arrays.items():
        array = numpy_to_vtk(values.astype(numpy.float32), deep=True)  # VTK's sphere mapper takes no other radii
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return side, data


class Camera:
    """Turns around the middle of the packing by two degrees a frame."""

    def __init__(self, camera, side, zoom):
        middle = [side / 2] * 3
        camera.SetFocalPoint(*middle)
        camera.SetPosition(*(m + 1.2 * side * d for m, d in zip(middle, (1.1, 0.7, 1.7))))
        camera.SetViewUp(0, 1, 0)
        camera.SetViewAngle(30 / zoom)
        self.turn = lambda: camera.Azimuth(2)


class InParaView:
    """Grains, or the representation of ParaView that plays a sphere."""

    def __init__(self, data, side, discs):
        import vtkgranular as vg
        from paraview import simple

        self.source = simple.TrivialProducer()
        self.source.GetClientSideObject().SetOutput(data)
        self.view = simple.CreateView("RenderView", ViewSize=list(SIZE), OrientationAxesVisibility=0)
        self.view.LODThreshold = self.view.RemoteRenderThreshold = 1e9
        Camera(self.view.GetActiveCamera(), side, 1)
        display = vg.show(self.source, self.view, color="v")
        if discs:
            display.SetRepresentationType("Point Gaussian")
            vg.set_properties(display, ShaderPreset="Sphere", SetScaleArray=["POINTS", "radius"], ScaleByArray=1,
                              UseScaleFunction=0, GaussianRadius=1)
        simple.Render(self.view)
        self.camera = self.view.GetActiveCamera()
        self.delete = lambda: (simple.Delete(self.view), simple.Delete(self.source))

    def reset(self):
        self.view.SMProxy.ResetCamera()

    def render(self):
        self.view.SMProxy.StillRender()


class InVTK:
    """A mapper of VTK alone."""

    def __init__(self, mapper):
        from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

        self.window, self.renderer, actor = vtkRenderWindow(), vtkRenderer(), vtkActor()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*SIZE)
        self.window.AddRenderer(self.renderer)
        actor.SetMapper(mapper)
        self.renderer.AddActor(actor)
        self.camera = self.renderer.GetActiveCamera()
        self.delete = self.window.Finalize

    def reset(self):
        self.renderer.ResetCameraClippingRange()

    def render(self):
        self.renderer.ResetCameraClippingRange()
        self.window.Render()


def sphere_mapper(data):
    from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

    mapper = vtkOpenGLSphereMapper()
    mapper.SetInputData(data)
    mapper.SetScaleArray("radius")
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("v")
    mapper.SetScalarRange(.3, .5)
    return mapper


def glyph_mapper(data, resolution, shapes):
    """Balls of so many sides around and half as many from pole to pole, or superquadrics."""
    from vtkmodules.vtkFiltersSources import vtkSphereSource, vtkSuperquadricSource
    from vtkmodules.vtkRenderingCore import vtkGlyph3DMapper

    ball = vtkSuperquadricSource() if shapes else vtkSphereSource()
    ball.SetThetaResolution(resolution)
    ball.SetPhiResolution(resolution)
    mapper = vtkGlyph3DMapper()
    if shapes:
        ball.SetSize(0.5)
        ball.SetAxisOfSymmetry(2)
        ball.SetPhiRoundness(2 / POWER)
        ball.SetThetaRoundness(2 / POWER)
        mapper.SetOrientationArray("quat")
        mapper.SetOrientationModeToQuaternion()
        mapper.SetScaleModeToScaleByVectorComponents()
        mapper.SetScaleArray("diameters")
    else:
        ball.SetRadius(1)
        mapper.SetScaleModeToScaleByMagnitude()
        mapper.SetScaleArray("radius")
    mapper.SetSourceConnection(ball.GetOutputPort())
    mapper.SetInputData(data)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("v")
    mapper.SetScalarRange(.3, .5)
    return mapper


def sides(side, zoom):
    """Sides of a polygon whose edges are nowhere a quarter of a pixel from the circle of a typical particle."""
    distance = 1.2 * side * math.hypot(1.1, 0.7, 1.7)
    radius = 0.4 * SIZE[1] / 2 / math.tan(math.radians(15 / zoom)) / distance
    return math.ceil(math.pi / math.acos(1 - 0.25 / max(radius, 0.5)))


def measure(count, shapes, names, rounds, frames, zooms=ZOOMS):
    side, data = polydata(count, shapes)
    makers = {"Grains": lambda zoom: InParaView(data, side, False), "Point Gaussian": lambda zoom: InParaView(data, side, True),
              "VTK's sphere mapper": lambda zoom: InVTK(sphere_mapper(data)),
              "glyphs": lambda zoom: InVTK(glyph_mapper(data, sides(side, zoom) if shapes else 8, shapes))}
    for zoom in zooms:
        seconds = {name: [] for name in names}
        for turn in range(rounds):
            for name in (*names[turn % len(names):], *names[:turn % len(names)]):
                way = makers[name](zoom)
                camera = Camera(way.camera, side, zoom)
                way.render()
                camera.turn()
                way.render()
                start = time.perf_counter()
                for _ in range(frames):
                    camera.turn()
                    way.render()
                seconds[name].append((time.perf_counter() - start) / frames)
                way.delete()
        for name in names:
            case = f"{count:.0e} {'superquadrics' if shapes else 'spheres'}, {name}".replace("e+0", "e")
            against = statistics.median(b / a for a, b in zip(seconds[name], seconds["glyphs" if shapes else "Point Gaussian"]))
            print("TOLD " + json.dumps([case, zoom, 1 / statistics.median(seconds[name]), against]), flush=True)


SPHERES = ("Grains", "Point Gaussian", "VTK's sphere mapper", "glyphs")
# particles, superquadrics, ways, rounds, frames, zooms
SCENES = {"quick": [(1000, False, SPHERES, 1, 1, (1,)), (1000, True, ("Grains", "glyphs"), 1, 1, (1,))],
          "full": [(10**6, False, SPHERES[:3], 3, 3), (10**5, False, SPHERES, 3, 3), (10**5, True, ("Grains", "glyphs"), 3, 3)],
          "large": [(10**7, False, SPHERES[:3], 1, 2), (10**6, False, SPHERES, 1, 1)]}


def study_of(study):
    kinds = ["large", "full"] if study.large else ["quick" if study.quick else "full"]
    build, told = Path(vg.__file__).resolve().parents[4], {}
    for kind in kinds:
        run = subprocess.run(["sh", "-c", '. "$0/environment" && exec "$@"', build, ROOT / "cmake" / "with_display", "pvpython", "--dr",
                              __file__, "--inside", kind], stdout=subprocess.PIPE, text=True, check=True)
        for line in run.stdout.splitlines():
            if line.startswith("TOLD "):
                case, zoom, frames, against = json.loads(line[5:])
                study.check(frames > 0, case)
                told.setdefault(case, {})[zoom] = (frames, against)
    rows = [[f"`{case}`", *(f"{zooms[zoom][column]:.2f}" if zoom in zooms else None for column in (0, 1) for zoom in ZOOMS)]
            for case, zooms in told.items()]
    study.block("draw", "A disturbed lattice that fills the window of 1000 x 800 pixels at zoom 1; the camera turns by two degrees a frame; time on "
                "the wall. Speeds are against Point Gaussian for spheres, and against glyphs for superquadrics. Glyphs of spheres have 96 "
                "triangles; those of superquadrics have as many sides as keep the outline of a typical particle within a quarter of a pixel.",
                table(["case", *(f"frames/s at zoom {zoom}" for zoom in ZOOMS), *(f"against, at zoom {zoom}" for zoom in ZOOMS)], rows))


if "--inside" in sys.argv:
    for scene in SCENES[sys.argv[sys.argv.index("--inside") + 1]]:
        measure(*scene)
else:
    import vtkgranular as vg
    from scene import main, table

    main(study_of)
