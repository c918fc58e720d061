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
    """Shows particles as spheres and returns their display.

    reader  a GranularDumpReader, or any source or filter whose first output has points.
    view    a render view; by default the active one, or a new one.
    radius  name of the point array with the radii, in the unit of the points, or one number for all.
            Where there is no such array, and where the points are scaled coordinates, spheres of
            half the mean distance of the points are shown.
    color   name of a point array to colour by; by default as ParaView decides.

    The spheres are drawn with exactly these radii, by the plugin's representation Grains, and are the
    same on any number of ranks. They are flat discs with the shading of spheres: where they overlap
    they do not cut into each other.

    Raises RuntimeError if the plugin was not loaded before.
    """
    from paraview import simple

    display = simple.Show(reader, view)
    if "Grains" not in display.GetProperty("Representation").Available:
        raise RuntimeError("expected the plugin Granular, got a ParaView without it: load it first, "
                           "as with granular.load_plugin()")
    display.SetRepresentationType("Grains")
    # ParaView does not know the arrays of a frame without particles: later ones will have them
    empty = reader.GetDataInformation().GetNumberOfPoints() == 0
    by_array = isinstance(radius, str) and not _is_scaled(reader) and \
        (empty or radius in reader.PointData.keys())
    display.GrainRadiusArray = radius if by_array else ""
    if by_array:
        display.GrainScale = 1.0
    elif isinstance(radius, str):
        display.GrainScale = _spacing_radius(reader) or 1.0
    else:
        display.GrainScale = float(radius)
    if color is not None and empty:
        # there is no range to fit the colours to yet
        display.ColorArrayName = ["POINTS", color]
        display.LookupTable = simple.GetColorTransferFunction(color)
    elif color is not None:
        simple.ColorBy(display, ("POINTS", color))
    return display
