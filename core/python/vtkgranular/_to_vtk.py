# SPDX-License-Identifier: BSD-3-Clause
"""Frames as data sets of VTK."""
from __future__ import annotations

from typing import Any, Iterable


def to_vtk(frame: Any, names: Iterable[str]) -> Any:
    """Returns a vtkPolyData: points with a vertex each, or lines, with the arrays of these names; field data timestep and time.

    Arrays of numbers share the memory of the frame.
    """
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    def array(name: str, values: Any) -> Any:
        if values.dtype.kind in "UO":
            made = vtkStringArray()
            for value in values:
                made.InsertNextValue(str(value))
        else:
            made = numpy_to_vtk(values)
        made.SetName(name)
        return made

    lines = frame._is_lines()
    data = vtkPolyData()
    positions = numpy.ascontiguousarray(frame.points.reshape(-1, 3))
    points = vtkPoints()
    points.SetData(array("points", positions))
    data.SetPoints(points)
    size = 2 if lines else 1
    count = len(positions) // size
    cells = vtkCellArray()
    cells.SetData(size, numpy_to_vtkIdTypeArray(numpy.arange(size * count, dtype=numpy.int64), deep=True))
    (data.SetLines if lines else data.SetVerts)(cells)
    to = data.GetCellData() if lines else data.GetPointData()
    for name in names:
        to.AddArray(array(name, frame[name]))
    for name, value in (("timestep", numpy.array([frame.step], dtype=numpy.int64)), ("time", numpy.array([frame.time]))):
        data.GetFieldData().AddArray(array(name, value))
    return data
