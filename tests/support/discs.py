# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of spheres, and what arithmetic in doubles says of them: in each pixel the nearest disc, its
colour and its shade."""
import math

import numpy
from paraview.simple import ColorBy, CreateRenderView, GetColorTransferFunction, SaveScreenshot
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOImage import vtkPNGReader

EDGE = 0.01  # pixels: within, rounding decides
# From VTK 9.4 on a sphere in perspective is projected as if it were small, and lies in the picture's plane.
PROJECTED = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion(), vtkVersion.GetVTKBuildVersion()) >= \
    (9, 3, 20240101)
LEVELS = 1.5  # of 255: the table of colours has 256, and each value is rounded


def black_view(pixels):
    """Returns a square render view of so many pixels a side that shows nothing but data."""
    view = CreateRenderView()
    view.ViewSize = [pixels, pixels]
    view.UseColorPaletteForBackground = 0
    view.Background = [0, 0, 0]
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0  # it would mix neighbours
    return view


def color_by_id(display, view, last):
    """Colours particles by id: 1 is red, `last` is blue."""
    colors = GetColorTransferFunction("id")
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [1, 1, 0, 0, last, 0, 0, 1]
    ColorBy(display, ("POINTS", "id"))
    display.RescaleTransferFunctionToDataRange(False)
    display.LookupTable = colors
    display.SetScalarBarVisibility(view, False)
    colors.RescaleTransferFunction(1, last)


def picture(view, name):
    """Returns the colours of the view's pixels, rows from below, and keeps them as name.png."""
    SaveScreenshot(f"{name}.png", view, ImageResolution=view.ViewSize)
    png = vtkPNGReader()
    png.SetFileName(f"{name}.png")
    png.Update()
    width, height = view.ViewSize
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].astype(float)


def projected_distance(x, y, centre, radius, half):
    """Returns how far x and y are from a sphere's centre, in units of the ellipse that the projection's derivative at
    the centre makes of the sphere. The view's half height is `half` at distance 1."""
    u, v = centre[:2] / -centre[2]
    scale = (radius / centre[2]) ** 2
    uu, vv, uv = scale * (1 + u * u), scale * (1 + v * v), scale * u * v
    if abs(uv) <= 1e-6 * half ** 2:  # as the shader has it
        uv = 0
    along, across = x - u, y - v
    return numpy.sqrt((vv * along ** 2 - 2 * uv * along * across + uu * across ** 2) / (uu * vv - uv * uv))


class Camera:
    """A camera at `position` that looks at `focal`: parallel, with `scale` as half the height of the
    picture, or in perspective with an `angle` in degrees."""

    def __init__(self, position, focal, scale=None, angle=None):
        self.position, self.focal = numpy.array(position, float), numpy.array(focal, float)
        self.scale, self.angle = scale, angle

    def look(self, view, shift=(0, 0, 0)):
        """Gives the view this camera, moved by `shift`."""
        view.CameraPosition = list(self.position + shift)
        view.CameraFocalPoint = list(self.focal + shift)
        view.CameraViewUp = [0, 1, 0]
        view.CameraParallelProjection = int(self.scale is not None)
        if self.scale is not None:
            view.CameraParallelScale = self.scale
        else:
            view.CameraViewAngle = self.angle

    def discs(self, centres, radii, ids, pixels):
        """Returns of each pixel the id of the nearest disc or 0, its shade, and True where an edge is near.
        A disc faces the eye, and its shade falls with the square of the distance from the centre."""
        normal = self.position - self.focal
        normal /= numpy.linalg.norm(normal)
        right = numpy.cross([0, 1, 0], normal)
        right /= numpy.linalg.norm(right)
        axes = numpy.stack([right, numpy.cross(normal, right), normal])
        half = math.tan(math.radians(self.angle) / 2) if self.scale is None else self.scale
        unit = 2 * half / pixels
        line = (numpy.arange(pixels) + 0.5) * unit - half
        shape = (pixels, pixels)
        nearest = numpy.full(shape, -numpy.inf)
        seen, shade, edge = numpy.zeros(shape, int), numpy.zeros(shape), numpy.zeros(shape, bool)
        for centre, radius, identity in zip((centres - self.position) @ axes.T, radii, ids):
            depth, pixel = (centre[2], unit) if self.scale is not None else (None, -centre[2] * unit)
            # of the pixels only those around the disc
            reach = radius + EDGE * abs(pixel)
            ends = numpy.stack([centre[:2] - reach, centre[:2] + reach])
            if self.scale is None:
                ends = (numpy.concatenate([ends / (-centre[2] - reach), ends / (-centre[2] + reach)])
                        if -centre[2] > reach and not PROJECTED else numpy.array([[-numpy.inf], [numpy.inf]]) * [1, 1])
            columns, rows = (slice(*numpy.searchsorted(line, [ends[:, k].min(), ends[:, k].max()])) for k in (0, 1))
            x, y = line[None, columns], line[rows, None]
            if self.scale is not None:
                distance = numpy.hypot(x - centre[0], y - centre[1])
            elif PROJECTED:
                u, v = abs(centre[:2] / centre[2])
                if numpy.hypot(u, v) > 1.7 and max(u, v) > 1.3 * half:
                    continue  # stretched too far, and left out
                distance, depth = radius * projected_distance(x, y, centre, radius, half), centre[2]
            else:
                along = centre @ centre / (x * centre[0] + y * centre[1] - centre[2])
                distance = numpy.sqrt((along * x - centre[0]) ** 2 + (along * y - centre[1]) ** 2
                                      + (along + centre[2]) ** 2)
                depth = -along
            before = nearest[rows, columns]
            inside = (distance < radius) & (depth > before) & (depth < 0)
            before[...] = numpy.where(inside, depth, before)
            seen[rows, columns][inside] = identity
            shade[rows, columns][inside] = 1 - (distance[inside] / radius) ** 2
            edge[rows, columns] |= abs(distance - radius) < EDGE * pixel
        return seen, shade, edge

    def compare(self, pixels, centres, radii, ids, last):
        """Raises AssertionError unless the pixels show these discs, coloured by id as color_by_id does."""
        seen, shade, edge = self.discs(centres, radii, ids, len(pixels))
        assert (seen > 0).sum() > 5000 and edge.mean() < 0.01, "the truth itself shows little"
        wrong = pixels.any(axis=2) & (seen == 0) & ~edge
        assert not wrong.any(), f"something where nothing is: {wrong.sum()} pixels"
        inside = (seen > 0) & ~edge
        blue = (seen[inside] - 1) / (last - 1)
        exact = 255 * shade[inside][:, None] * numpy.stack([1 - blue, 0 * blue, blue], axis=1)
        away = abs(pixels[inside] - exact).max(axis=1)
        assert away.max() < LEVELS, f"{(away >= LEVELS).sum()} pixels of {inside.sum()}: {away.max()} levels"
