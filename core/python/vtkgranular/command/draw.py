# SPDX-License-Identifier: BSD-3-Clause
"""Draws a frame by VTK: a process of its own, because VTK ends the process where it cannot draw."""
from __future__ import annotations

import json
import os
import sys
import warnings
from typing import Any

_GREY = (0.35, 0.35, 0.35)
_SAND = (0.80, 0.68, 0.50)


def _colour(mapper: Any, data: Any, name: str | None, renderer: Any) -> None:
    """Colours by an array, with a bar that explains the colours, or in one colour."""
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

    if name is None:
        mapper.ScalarVisibilityOff()
        return
    lines = data.GetCellData().HasArray(name)
    array = (data.GetCellData() if lines else data.GetPointData()).GetArray(name)
    if array is None:
        raise ValueError(f"expected a column of numbers to colour by, got {name!r}")
    component = -1 if array.GetNumberOfComponents() > 1 else 0
    low, high = array.GetRange(component)
    colours = vtkColorTransferFunction()
    for part, colour in ((0.0, (0.19, 0.07, 0.23)), (0.25, (0.27, 0.54, 0.99)), (0.5, (0.64, 0.99, 0.24)), (0.75, (0.98, 0.49, 0.13)),
                         (1.0, (0.48, 0.02, 0.01))):
        colours.AddRGBPoint(low + part * ((high - low) or 1), *colour)
    if component < 0:
        colours.SetVectorModeToMagnitude()
    mapper.SetLookupTable(colours)
    (mapper.SetScalarModeToUseCellFieldData if lines else mapper.SetScalarModeToUsePointFieldData)()
    mapper.SelectColorArray(name)
    mapper.InterpolateScalarsBeforeMappingOff()
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle(name + (" magnitude" if component < 0 else ""))
    bar.SetUnconstrainedFontSize(True)
    bar.SetVerticalTitleSeparation(10)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(16)
        text.ShadowOff()
        text.ItalicOff()
    bar.SetPosition(0.88, 0.1)
    bar.SetWidth(0.08)
    bar.SetHeight(0.5)
    renderer.AddViewProp(bar)


def _edges(corners: Any) -> Any:
    """Lines along the edges of boxes; corners of shape (boxes, 2, 2, 2, 3)."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points = vtkPoints()
    points.SetData(numpy_to_vtk(corners.reshape(-1, 3), deep=True))
    ends = numpy.array([(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit])
    cells = vtkCellArray()
    every = (8 * numpy.arange(len(corners))[:, None, None] + ends).astype(numpy.int64)
    cells.SetData(2, numpy_to_vtkIdTypeArray(every.ravel(), deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    return data


def _centre(frame: Any) -> Any:
    """What is drawn at the origin, because OpenGL counts in floats."""
    if frame.box is not None:
        return frame.box.origin + frame.box.vectors.sum(axis=0) / 2
    return frame.points.reshape(-1, 3).mean(axis=0) if frame.rows and frame._has_points() else 0


def _corners(origin: Any, vectors: Any) -> Any:
    import numpy

    return numpy.array([[[origin + numpy.array([i, j, k]) @ vectors for k in (0, 1)] for j in (0, 1)] for i in (0, 1)])[None]


def _add_lines(renderer: Any, data: Any, name: str | None, width: float = 0) -> None:
    """Lines of a width, or a translucent surface."""
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    _colour(mapper, data, name, renderer)
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*_GREY)
    actor.GetProperty().SetLineWidth(width or 1)
    actor.GetProperty().SetLighting(width == 0)
    actor.GetProperty().SetOpacity(1 if width else 0.3)
    renderer.AddActor(actor)


#: The modules and classes of VTK that read files with these endings; others are XML.
_READERS = {".stl": ("vtkIOGeometry", "vtkSTLReader"), ".ply": ("vtkIOPLY", "vtkPLYReader"), ".vtk": ("vtkIOLegacy", "vtkGenericDataObjectReader")}


def _read(path: str, centre: Any) -> Any:
    """Returns the surface of a VTK or STL file, moved to the centre."""
    import importlib

    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    module, name = _READERS.get(os.path.splitext(path)[1].lower(), ("vtkIOXML", "vtkXMLGenericDataObjectReader"))
    reader, surface = getattr(importlib.import_module("vtkmodules." + module), name)(), vtkGeometryFilter()
    reader.SetFileName(path)
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    data = surface.GetOutputDataObject(0)
    if not data.IsA("vtkPolyData"):
        raise ValueError(f"{path}: expected a file of VTK without blocks: vtkgranular.show_run draws those in ParaView")
    if data.GetNumberOfPoints():
        data.GetPoints().SetData(numpy_to_vtk(vtk_to_numpy(data.GetPoints().GetData()).astype(float) - centre, deep=True))
    return data


def _add_spheres(renderer: Any, data: Any, points: Any, radii: Any, name: str | None) -> None:
    """Spheres; the mapper reads points and radii as floats, whatever they are."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import VTK_FLOAT
    from vtkmodules.vtkRenderingCore import vtkActor
    from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

    if radii is None:  # half the mean distance
        extents = points.max(axis=0) - points.min(axis=0)
        extents = extents[extents > 0]
        radii = numpy.full(len(points), 0.5 * (float(numpy.prod(extents)) / len(points)) ** (1 / len(extents)) if len(extents) else 1.0)
    scales = numpy_to_vtk(numpy.asarray(radii, dtype=numpy.float32), deep=True, array_type=VTK_FLOAT)
    scales.SetName("drawn radius")
    data.GetPointData().AddArray(scales)
    data.GetPoints().SetData(numpy_to_vtk(points.astype(numpy.float32), deep=True, array_type=VTK_FLOAT))
    mapper, actor = vtkOpenGLSphereMapper(), vtkActor()
    mapper.SetInputData(data)
    mapper.SetScaleArray("drawn radius")
    _colour(mapper, data, name, renderer)
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*_SAND)
    renderer.AddActor(actor)


def _draw_frame(renderer: Any, given: dict[str, Any]) -> Any:
    """Draws a frame of a run and its box, and returns the centre of the picture."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk

    import vtkgranular

    frame = vtkgranular.open(given["files"], **given["options"])[given["frame"]].read()
    centre = _centre(frame)
    if "lo" in frame and "hi" in frame:
        boxes = numpy.array([_corners(lo - centre, numpy.diag(hi - lo))[0] for lo, hi in zip(frame["lo"], frame["hi"])])
        _add_lines(renderer, _edges(boxes), None, 2)
    elif frame.rows and frame._is_lines():
        lines = frame.to_vtk()
        lines.GetPoints().SetData(numpy_to_vtk(frame.points.reshape(-1, 3) - centre, deep=True))
        _add_lines(renderer, lines, given["color"], 3)
    elif frame.rows:
        _add_spheres(renderer, frame.to_vtk(), frame.points - centre, frame.get("radius"), given["color"])
    if frame.box is not None:
        _add_lines(renderer, _edges(_corners(frame.box.origin - centre, frame.box.vectors)), None, 1.5)
    return centre


def _draw_file(renderer: Any, given: dict[str, Any]) -> Any:
    """Draws particles of VTK files and their box, and returns the centre of the picture."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData

    pieces = vtkAppendPolyData()
    for path in given["files"]:  # one of each rank
        pieces.AddInputData(_read(path, 0))
    pieces.Update()
    data = pieces.GetOutput()
    for bounds in [_read(path, 0).GetBounds() for path in given["boxes"]] or [data.GetBounds()]:
        lo, hi = numpy.array(bounds[::2]), numpy.array(bounds[1::2])
        centre = (lo + hi) / 2
    if given["boxes"]:
        _add_lines(renderer, _edges(_corners(lo - centre, numpy.diag(hi - lo))), None, 1.5)
    radii = data.GetPointData().GetArray("radius")
    if data.GetNumberOfPoints():
        _add_spheres(renderer, data, vtk_to_numpy(data.GetPoints().GetData()) - centre, radii and vtk_to_numpy(radii), given["color"])
    return centre


def main() -> None:
    """Draws what the input asks for, in JSON: files, options, frame, color, walls, size, picture."""
    import vtkmodules.vtkInteractionStyle
    import vtkmodules.vtkRenderingFreeType
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter

    warnings.showwarning = lambda message, *_: print(message, file=sys.stderr)  # type: ignore[assignment]
    with open(0, closefd=False) as stream:  # pvpython of ParaView 5.13 puts something in the place of sys.stdin that cannot be read
        given = json.load(stream)
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(1, 1, 1)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(*given["size"])
    window.AddRenderer(renderer)
    centre = (_draw_file if given["frame"] is None else _draw_frame)(renderer, given)
    for path in given["walls"]:
        _add_lines(renderer, _read(path, centre), None)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.6, -1, 0.45)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    window.Render()
    grab, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.SetFileName(given["picture"])
    writer.Write()


if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))  # the folder of the package
    try:
        main()
    except (RuntimeError, ValueError, OSError) as error:
        sys.exit(str(error))
