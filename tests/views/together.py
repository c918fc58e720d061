# SPDX-License-Identifier: BSD-3-Clause
"""Particles beside what else ParaView draws: a volume, ambient occlusion and translucency take a ball as they take one made of triangles;
a frustum selects the particles in it, and no hidden one is selected on the surface."""
import numpy
import ray_caster
import vtkgranular as vg
from discs import black_view, made, picture
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

PIXELS = 200
view = black_view(PIXELS)
view.RemoteRenderThreshold = 1e9


def compare(what, grains, mesh, outline):
    """The same picture of particles and of triangles, but on the outlines."""
    pictures = []
    for source in (grains, mesh):
        display = Show(source, view)
        if source is grains:
            display = vg.show(source, view)
        display.ColorArrayName, display.DiffuseColor, display.AmbientColor = [None, ""], [1, 1, 1], [1, 1, 1]
        display.Specular = 0
        pictures.append(picture(view, what))
        Hide(source, view)
    apart = abs(pictures[0] - pictures[1]).max(axis=2)
    assert (apart > 12).sum() <= outline and pictures[0].any(), (what, (apart > 12).sum(), apart.max())
    return pictures[0]


ball = made([[0, 0, 0]], radius=[3.0])
mesh = Sphere(Radius=3, ThetaResolution=400, PhiResolution=400)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [12, -25, 9], [0, 0, 0], [0, 0, 1]
lit = compare("alone", ball, mesh, 30)
volume = Wavelet(WholeExtent=[-8, 8, 0, 16, -8, 8])  # one face through the middle of the ball, which hides a part of the rest
display = Show(volume, view)
display.SetRepresentationType("Volume")
ColorBy(display, ("POINTS", "RTData"))
mixed = compare("volume", ball, mesh, 60)
assert (mixed != lit).any(axis=2).sum() > 1000 and (abs(mixed - lit)[PIXELS // 2 - 20:PIXELS // 2, PIXELS // 2 - 10] < 12).all()
Hide(volume, view)

heap = made([[0, 0, 0], [3, 0, 0], [1.5, -1.5, 2], [0, 3, 0]], radius=[2.0, 1.5, 1.2, 1.8])
balls = AppendDatasets(Input=[Sphere(Center=place, Radius=radius, ThetaResolution=200, PhiResolution=200)
                              for place, radius in zip(([0, 0, 0], [3, 0, 0], [1.5, -1.5, 2], [0, 3, 0]), (2.0, 1.5, 1.2, 1.8))])
balls = ExtractSurface(Input=balls)
view.UseAmbientOcclusion = 1
occluded = compare("occlusion", heap, balls, 200)
view.UseAmbientOcclusion = 0
assert abs(compare("open", heap, balls, 60) - occluded).max(axis=2).max() > 30

# the side towards the camera, one layer a particle
pair = made([[0, 0, 0], [0, 0, 3]], radius=[2.0, 1.0])
display = vg.show(pair, view)
display.ColorArrayName, display.Opacity, display.Ambient, display.Diffuse = [None, ""], 0.5, 1, 0
display.AmbientColor = display.DiffuseColor = [1, 1, 1]
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 20], [0, 0, 0], [0, 1, 0]
grey = picture(view, "translucent")[..., 0]
assert abs(grey[PIXELS // 2, PIXELS // 2] - 255 * 0.75) <= 2 and set(numpy.unique(grey)) <= {0, *range(125, 131), *range(189, 194)}
Delete(pair)

# ---- colours and opacities of the particles themselves ------------------------------------------------------------------
view.CameraPosition, view.CameraParallelProjection, view.CameraParallelScale = [0, 0, 20], 1, 4
colors, opacities = numpy.array([[200, 0, 0], [0, 150, 0], [90, 0, 250]], numpy.uint8), [0.25, 0.5, 1.0]
shapes = {"shape": numpy.full((3, 3), [1, 0.7, 0.8]), "quat": numpy.full((3, 4), [1, 0.1, 0.2, 0.3])}
for arrays in {}, shapes, {**shapes, "blockiness": numpy.full((3, 2), [3., 6])}:
    three = made([[-2.5, 0, 0], [0, 0, 0], [2.5, 0, 0]], radius=numpy.ones(3), color=colors, seen=opacities, **arrays)
    display = vg.show(three, view)
    ColorBy(display, ("POINTS", "color"))
    display.MapScalars, display.Ambient, display.Diffuse, display.Specular = 0, 1, 0, 0
    for solid in 1, 0:
        if not solid:
            display.GrainOpacities = "seen"
        pixels = picture(view, "colors")[PIXELS // 2, [int(PIXELS * (0.5 + place / 8)) for place in (-2.5, 0, 2.5)]]
        assert abs(pixels - colors * (1 if solid else numpy.c_[opacities])).max() <= 2, (list(arrays), solid, pixels)
    Delete(three)

# ---- selection -----------------------------------------------------------------------------------------------------------
cloud = numpy.random.default_rng(2).uniform(-1, 1, (500, 3))
particles = made(cloud, radius=numpy.full(500, 0.15))
display = vg.show(particles, view)
view.CameraPosition, view.CameraParallelProjection, view.CameraParallelScale = [0, 0, 5], 1, 1.25
Render(view)
rectangle = [0, 0, PIXELS // 2, PIXELS // 2]


def chosen(select):
    select(Rectangle=rectangle, View=view)
    found = ExtractSelection(Input=particles)
    found.UpdatePipeline()
    ids = vtk_to_numpy(servermanager.Fetch(found).GetPointData().GetArray("id"))
    ClearSelection(particles)
    return set(ids)


low, high = ((numpy.array(rectangle[k:k + 2]) + (0.5, 0.5)) / PIXELS * 2.5 - 1.25 for k in (0, 2))
inside = ((cloud[:, :2] > low) & (cloud[:, :2] < high)).all(axis=1)
through, surface = chosen(SelectPointsThrough), chosen(SelectSurfacePoints)
display.SetRepresentationType("Points")
assert through == chosen(SelectPointsThrough) and len(through & set(numpy.flatnonzero(inside) + 1)) >= inside.sum() - 2
seen = ray_caster.cast(ray_caster.Camera(view.GetActiveCamera(), PIXELS, PIXELS), cloud, numpy.full((500, 3), 0.15))[2]
seen, counts = numpy.unique(seen[:rectangle[3] + 1, :rectangle[2] + 1], return_counts=True)
assert len(surface) > 30 and surface <= set(seen + 1) and set(seen[counts > 3] + 1) - {0} <= surface, surface ^ set(seen + 1)
print("all together")
