# SPDX-License-Identifier: BSD-3-Clause
"""Particles as spheres."""
import math


def _spacing_radius(source):
    """Half the mean distance of the points, or None if there are too few to tell."""
    information = source.GetDataInformation()
    points = information.GetNumberOfPoints()
    bounds = information.GetBounds()
    extents = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
    extents = [extent for extent in extents if extent > 0 and math.isfinite(extent)]
    if points < 2 or not extents:
        return None
    return 0.5 * (math.prod(extents) / points) ** (1 / len(extents))


def _is_scaled(source):
    """True if the points are in units of the box, which no radius is."""
    array = source.GetFieldDataInformation().GetArray("Coordinates")
    return array is not None and array.GetNumberOfStringValues() == 1 and \
        array.GetStringValue(0) == "Scaled"


def show(reader, view=None, radius="radius", color=None):
    """Shows particles as spheres (Point Gaussian) and returns their display.

    reader  a GranularDumpReader, or any source or filter whose first output has points.
    view    a render view; by default the active one, or a new one.
    radius  name of the point array with the radii, in the unit of the points, or one number for all.
            Where there is no such array, and where the points are scaled coordinates, spheres of
            half the mean distance of the points are shown.
    color   name of a point array to colour by; by default as ParaView decides.

    The spheres are drawn with exactly these radii. ParaView draws them as flat discs with the shading
    of spheres: where they overlap they do not cut into each other.
    """
    from paraview import simple

    display = simple.Show(reader, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    # ParaView does not know the arrays of a frame without particles: later ones will have them
    empty = reader.GetDataInformation().GetNumberOfPoints() == 0
    by_array = isinstance(radius, str) and not _is_scaled(reader) and \
        (empty or radius in reader.PointData.keys())
    display.ScaleByArray = int(by_array)
    if by_array:
        display.SetScaleArray = ["POINTS", radius]
        display.ScaleArrayComponent = 0
        display.UseScaleFunction = 0
        display.GaussianRadius = 1.0
    elif isinstance(radius, str):
        display.GaussianRadius = _spacing_radius(reader) or 1.0
    else:
        display.GaussianRadius = float(radius)
    if color is not None and empty:
        # there is no range to fit the colours to yet
        display.ColorArrayName = ["POINTS", color]
        display.LookupTable = simple.GetColorTransferFunction(color)
    elif color is not None:
        simple.ColorBy(display, ("POINTS", color))
    return display
