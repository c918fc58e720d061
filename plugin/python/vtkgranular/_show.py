# SPDX-License-Identifier: BSD-3-Clause
"""Particles as spheres."""
from __future__ import annotations

import contextlib
import math
import os
from typing import Any, Callable, Iterator, Sequence

from ._errors import output_names, upstream
from ._plugin import expect_plugin

# Eight colours that most people can tell apart: Okabe and Ito (2008).
_COLOURS = [(0.00, 0.45, 0.70), (0.90, 0.60, 0.00), (0.00, 0.62, 0.45), (0.80, 0.47, 0.65),
            (0.34, 0.71, 0.91), (0.84, 0.37, 0.00), (0.94, 0.89, 0.26), (0.60, 0.60, 0.60)]

_GREY = [0.35, 0.35, 0.35]

# Arrays by which Grains draws shapes that are no spheres; those of computes only where there are rotations, too.
_SHAPES = {"shape", "shapex"}
_COMPUTED_SHAPES = {"c_shape", "c_s", "c_diameter"}
_ROTATIONS = {"quat", "quatw", "quat1", "c_q", "c_quat"}


def _spacing_radius(source: Any) -> float | None:
    """Half the mean distance of the points, or None if there are too few to tell."""
    information = source.GetDataInformation()
    points = information.GetNumberOfPoints()
    bounds = information.GetBounds()
    extents = [bounds[2 * i + 1] - bounds[2 * i] for i in range(3)]
    extents = [extent for extent in extents if extent > 0 and math.isfinite(extent)]
    if points < 2 or not extents:
        return None
    return 0.5 * (math.prod(extents) / points) ** (1 / len(extents))


def _has_sizes(source: Any, radius: str) -> bool:
    """True if the particles have radii of this name, or shapes."""
    names = set(source.PointData.keys())
    return bool({radius, *_SHAPES} & names) or bool(_COMPUTED_SHAPES & names and _ROTATIONS & names)


def _is_scaled(source: Any) -> bool:
    """True if the points are in units of the box, which no radius is."""
    array = source.GetFieldDataInformation().GetArray("Coordinates")
    return array is not None and array.GetNumberOfStringValues() == 1 and \
        array.GetStringValue(0) == "Scaled"


@contextlib.contextmanager
def _frame_with(found: Callable[[], Any], source: Any, view: Any) -> Iterator[Any]:
    """The frame that is shown or, if nothing is found in it, the last one; yields what was found."""
    seen = found()
    times = [] if seen else [time for each in upstream(source) if each.SMProxy.GetProperty("TimestepValues")
                             for time in each.TimestepValues]
    if times:
        source.UpdatePipeline(max(times))
        seen = found()
    try:
        yield seen
    finally:
        if times:
            source.UpdatePipeline(view.ViewTime)


def _is_mesh(source: Any, view: Any, color: str | None) -> bool:
    """True for walls and paths, and where all arrays or that of the colour are at cells, subdomains and lines, or at slices and tubes
    of these."""
    if any(each.GetXMLName() in ("GranularMeshReader", "GranularTrajectories") for each in upstream(source)):
        return True
    with _frame_with(lambda: source.PointData.keys() or source.CellData.keys(), source, view):
        points, cells = set(source.PointData.keys()), set(source.CellData.keys())
        return bool(cells) and not points or color in cells - points


def _range_of(source: Any, name: str, view: Any, kinds: Sequence[str] = ("POINTS",)) -> tuple[str, tuple[float, float] | None]:
    """Where an array is, and its range or that of a vector's length; where the frame lacks the array, in the last frame.

    The range is None if the last frame has no arrays. Raises ValueError if it has only others.
    """
    data = {"POINTS": source.PointData, "CELLS": source.CellData}
    with _frame_with(lambda: next((kind for kind in kinds if data[kind][name]), None), source, view) as kind:
        if kind:
            array = data[kind][name]
            return kind, array.GetRange(-1 if array.GetNumberOfComponents() > 1 else 0)
        names = ", ".join(sorted(key for kind in kinds for key in data[kind].keys()))
    if names:
        raise ValueError(f"expected {'an' if len(kinds) > 1 else 'a point'} array to colour by, of {names}, got '{name}'")
    return kinds[0], None


def _colour_by_type(display: Any, source: Any, view: Any) -> None:
    """A colour and a name for each type."""
    from paraview import simple

    first, last = _range_of(source, "type", view)[1] or (1, 0)
    types = range(int(first), int(last) + 1)
    table = simple.GetColorTransferFunction("type")
    table.InterpretValuesAsCategories = 1
    table.Annotations = [text for number in types for text in (str(number), f"type {number}")]
    table.IndexedColors = [part for number in types for part in _COLOURS[(number - 1) % len(_COLOURS)]]
    display.ColorArrayName = ["POINTS", "type"]
    display.LookupTable = table


def expect_display(view: Any) -> None:
    """Raises RuntimeError where ParaView would crash when it draws."""
    window = view.SMProxy.GetRenderWindow()
    if window.IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY"):
        raise RuntimeError("expected a display to draw on, got none: DISPLAY is not set. Start the script by "
                           "`xvfb-run -a pvpython script.py` (Debian packages xvfb and xauth)")


def _show_output(source: Any, name: str, view: Any, **properties: Any) -> None:
    """Shows an output of the reader or source that the data come from."""
    from paraview import simple

    for each in reversed(upstream(source)):
        outputs = output_names(each)
        if name in outputs:
            simple.Show(simple.OutputPort(each, outputs.index(name)), view, **properties)
            return
    raise ValueError(f"expected a source with an output {name}, got none before this one" +
                     (": GranularLocalJoin draws the bonds of another file" if name == "Bonds" else ""))


def _colour(display: Any, source: Any, view: Any, name: str, kinds: Sequence[str]) -> None:
    """Colours by an array, also where only later frames have it."""
    from paraview import simple

    kind, limits = _range_of(source, name, view, kinds)
    if source.GetDataInformation().GetNumberOfPoints():
        simple.ColorBy(display, (kind, name))
        return
    display.ColorArrayName = [kind, name]
    display.LookupTable = simple.GetColorTransferFunction(name)
    if limits:
        display.LookupTable.RescaleTransferFunction(*limits)


def _show_particles(reader: Any, view: Any, display: Any, radius: str | float, color: str | None) -> None:
    """Shows particles as spheres."""
    from paraview import simple

    expect_plugin("Grains" in display.GetProperty("Representation").Available)
    display.SetRepresentationType("Grains")
    # ParaView does not know the arrays of a frame without particles: later ones will have them
    empty = reader.GetDataInformation().GetNumberOfPoints() == 0
    by_array = isinstance(radius, str) and not _is_scaled(reader) and \
        (empty or _has_sizes(reader, radius))
    name = radius if by_array else ""
    # the portable plugin shows ParaView's own Point Gaussian
    setattr(display, "GrainRadiusArray" if display.SMProxy.GetProperty("GrainRadiusArray") else "GrainScaleArray", name)
    if by_array:
        display.GrainScale = 1.0
    elif isinstance(radius, str):
        display.GrainScale = _spacing_radius(reader) or 1.0
    else:
        display.GrainScale = float(radius)
    if color == "type":
        _colour_by_type(display, reader, view)
    elif color is not None:
        _colour(display, reader, view, color, ["POINTS"])


def _expect_places(source: Any) -> None:
    """Raises ValueError for contacts whose file says which particles touch, but not where: nothing would be seen."""
    outputs = output_names(source)
    if source.GetXMLName() == "GranularLocalReader" and "Rows" in outputs and not source.GetDataInformation().GetNumberOfPoints():
        rows = source.GetDataInformation(outputs.index("Rows"))
        if rows.GetNumberOfRows():
            raise ValueError("expected contacts with positions, got rows without: GranularLocalJoin draws them between particles, with "
                             "Lines=OutputPort(contacts, 1)")


def show(reader: Any, view: Any = None, radius: str | float = "radius", color: str | None = None, box: bool = False,
         bonds: bool = False, legend: bool = False) -> Any:
    """Shows particles as spheres and returns their display.

    reader  a GranularDumpReader, or any source or filter whose first output has points. Walls, paths, cells, subdomains, contacts, and
            slices and tubes of these are shown as surfaces and lines, coloured by cells or points.
    view    a render view; by default the active one, or a new one.
    radius  name of the point array with the radii, in the unit of the points, or one number for all.
            Ellipsoids and superquadrics have the sizes of their own arrays. Without such an array, and for scaled coordinates,
            spheres of half the mean distance of the points are shown.
    color   name of an array to colour by, of spheres a point array; by default as ParaView decides. "type": a colour and a name each.
    box     True: shows the simulation box, the output Box of the reader or source, as well.
    bonds   True: shows the bonds, its output Bonds, as lines.
    legend  True: shows the colour bar of `color`, or the names of the types.

    The spheres are drawn with exactly these radii, by the plugin's representation Grains. Colours of numbers span the values of the frame
    shown now or, if that has no particles, of the last frame. Raises RuntimeError if the plugin was not loaded before, or if there is
    no display to draw on; ValueError if there is no array `color`, or no output for box or bonds.
    """
    from paraview import simple

    view = view or simple.GetActiveViewOrCreate("RenderView")
    expect_display(view)
    display = simple.Show(reader, view)  # which updates the arrays, too
    try:
        _expect_places(reader)
        if _is_mesh(reader, view, color):
            if display.Representation in ("Outline", "Grains"):  # of images, and of frames without lines
                display.SetRepresentationType("Surface")
            if color is not None:
                _colour(display, reader, view, color, ["CELLS", "POINTS"])
        else:
            _show_particles(reader, view, display, radius, color)
    except ValueError:
        simple.Hide(reader, view)
        raise
    if box:
        _show_output(reader, "Box", view)
    if bonds:
        _show_output(reader, "Bonds", view, LineWidth=2, AmbientColor=_GREY, DiffuseColor=_GREY)
    if legend and color is not None:
        display.SetScalarBarVisibility(view, True)
    return display
