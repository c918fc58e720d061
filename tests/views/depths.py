# SPDX-License-Identifier: BSD-3-Clause
"""Particles are seen as rays in double precision see them: depth and normal of each pixel, of spheres, ellipsoids and superquadrics, near
and far, from outside and inside."""
import os
import sys

import numpy
import ray_caster
from discs import black_view, made, seen, show_white
from paraview.simple import *

PIXELS = 160
TOP = 2**24 - 1
FLOATS = "floats" in sys.argv  # as where graphics hardware has no doubles
if FLOATS:
    os.environ["MESA_EXTENSION_OVERRIDE"] = "-GL_ARB_gpu_shader_fp64"
random = numpy.random.default_rng(3)
view = black_view(PIXELS)
view.RemoteRenderThreshold = 1e9
view.UseLight = 0
AddLight(view=view).Coords = "Camera"  # the red of a pixel is the third component of the normal


def look(centre):
    """A camera somewhere, sometimes among the particles, which looks at their middle or elsewhere."""
    away = random.normal(size=3)
    view.CameraFocalPoint, view.CameraPosition = list(centre), list(centre + away / numpy.linalg.norm(away) * 10**random.uniform(0, 1))
    if random.uniform() < 0.4:
        away = numpy.array(view.CameraPosition) - centre
        view.CameraPosition = list(centre + away / numpy.linalg.norm(away) * random.uniform(0, 0.8))
        view.CameraFocalPoint = list(numpy.array(view.CameraPosition) + random.normal(size=3))
    view.CameraViewUp = list(random.normal(size=3))
    view.CameraParallelProjection = int(random.integers(2))
    view.CameraParallelScale, view.CameraViewAngle = random.uniform(0.5, 3), random.uniform(15, 60)


def alike(values):
    """Returns true for the pixels with eight neighbours of their value."""
    wide = numpy.pad(values, 1, mode="edge")
    return numpy.logical_and.reduce([wide[j:j + PIXELS, i:i + PIXELS] == values for j in range(3) for i in range(3)])


def check_depths(kind, scenes):
    """A depth buffer has the numbers from 0 to 2^24 - 1. Surfaces steeper than 85 degrees are left out: there a shift across the line of sight
    makes much of a depth. Without doubles, a depth is right to 2^-20 of the particles' extent, where they are less steep than 60."""
    seen_pixels, wrong, tilted, units, parts, source = 0, 0, 0, [], [], None
    for _ in range(scenes):
        count = int(random.integers(1, 30))
        centre = random.choice([0, 0, 1e3, 2**20]) * numpy.array([1, -1, 0.5])
        points, radius = random.uniform(-1, 1, (count, 3)) + centre, 10**random.uniform(-1.2, -0.2, count)
        if random.uniform() < 0.2:
            points[0] += random.normal(size=3) * 1e3  # what is in view is a small part
        axes, arrays, powers, turns = numpy.repeat(radius[:, None], 3, axis=1), {}, None, None
        if kind != "spheres":
            axes, turns = radius[:, None] * 5**random.uniform(-0.5, 0.5, (count, 3)), random.normal(size=(count, 4))
            arrays = {"shape": axes, "quat": turns}
        if kind == "superquadrics":
            powers = random.choice([2, 2.5, 4, 8, 20], (count, 2)).astype(float)
            arrays.update(blockiness1=powers[:, 0], blockiness2=powers[:, 1])
        source, new = made(points, source, radius=radius, **arrays), source is None
        if new:
            show_white(source, view, lit=True)
        Render(view)  # or the clipping range is that of the scene before
        look(centre)
        camera, depths, light = seen(view)
        truth, normals, numbers = ray_caster.cast(camera, points, axes, turns, powers)
        drawn, there = depths < 1, numbers >= 0
        wrong += (drawn != there).sum()
        assert not (alike(there) & (drawn != there)).any(), (kind, "a hole, or a speck")
        sight = [0, 0, 1] if camera.parallel else -camera.rays()[1]
        cosine = abs((normals * sight).sum(-1)) / numpy.linalg.norm(sight, axis=-1)
        both = there & drawn & (cosine > (0.5 if FLOATS else 0.087))
        if FLOATS:  # where two particles meet, one pixel in a million is of the other
            both &= alike(numbers)
        seen_pixels += both.sum()
        tilted += (abs(light - 255 * numpy.clip(normals[..., 2], 0, 1))[both] > 0.51).sum()
        units.append(abs(numpy.round(depths * TOP) - numpy.round(truth * TOP))[both])
        near, far = camera.near, camera.far
        away = (near + truth * (far - near) if camera.parallel else near * far / (far - truth * (far - near)))[both]
        slope = 1 / (far - near) if camera.parallel else near * far / ((far - near) * away**2)
        parts.append(numpy.clip(units[-1] - 1, 0, None) / (TOP * slope * max(numpy.sqrt(12), numpy.linalg.norm(numpy.ptp(points, axis=0)))))
    Delete(source)
    units, part = numpy.concatenate(units), numpy.concatenate(parts).max()
    print(f"{kind}: {seen_pixels} pixels, {wrong} on outlines wrong, {tilted} with another normal; depth off by at most {units.max():.0f} units, "
          f"{100 * (units > 1).mean():.4f} % by more than 1; beyond 1 by at most {part:.1e} of the extent")
    assert seen_pixels > 2000 and wrong <= 1e-4 * seen_pixels and tilted <= 2e-5 * seen_pixels, (kind, wrong, tilted)
    assert part < 2**-20 if FLOATS else units.max() <= 1


more = int(sys.argv[1])  # 30: a thousand scenes, in about three minutes
for kind, scenes in (("spheres", 15), ("ellipsoids", 15), ("superquadrics", 3)):
    check_depths(kind, scenes * more)
