# SPDX-License-Identifier: BSD-3-Clause
"""What the pipeline holds, as numpy arrays."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._errors import output_names, source_of, update

if TYPE_CHECKING:
    import numpy


def _to_numpy(array: Any) -> numpy.ndarray:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if array.IsA("vtkStringArray"):
        return numpy.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], dtype=str)
    values = vtk_to_numpy(array)
    values.flags.writeable = False  # the memory is the pipeline's
    return values


def _whole(data: Any) -> Any:
    """One data set, of a composite one as well."""
    if not data.IsA("vtkCompositeDataSet"):
        return data
    from vtkmodules.vtkFiltersCore import vtkAppendDataSets

    parts = vtkAppendDataSets()
    leaves = data.NewIterator()
    leaves.InitTraversal()
    while not leaves.IsDoneWithTraversal():
        parts.AddInputData(leaves.GetCurrentDataObject())
        leaves.GoToNextItem()
    if parts.GetNumberOfInputConnections(0) == 0:
        return None
    parts.Update()
    return parts.GetOutput()


def fetch(proxy: Any, port: int | str | None = None, time: float | None = None) -> dict[str, numpy.ndarray]:
    """Returns what a source or filter holds as a dict of numpy arrays.

    proxy  a source or filter of paraview.simple, or one of its output ports
    port   the output, by number or name: "Box", "Bonds". None: the first, or the port that proxy is.
    time   the time to update to. None: the time of the last update, or the first one.

    The keys, in this order; where two have the same name the first one counts:
    "points"                  the points, shape (n, 3); for lines, both ends of each line
    names of point arrays     shape (n,) or (n, components)
    names of cell arrays      of lines, subdomains and cells, and the columns of tables
    names of field data       "timestep", "BoxBounds", "BoxVectors", "Columns", ...: what the header of the frame says;
                              one number or text has the shape ()
    "dimensions", "origin", "spacing"  of images: points along x, y, z, and where they are

    On several ranks the first rank gets the whole, and the others what they hold. The arrays are read-only views of the
    pipeline's memory, which stays as long as they do; copy an array to change it. Raises RuntimeError as granular.update does,
    ValueError for an output that there is not.
    """
    import numpy
    from paraview import servermanager

    source = source_of(proxy)
    update(source, time)
    outputs = output_names(source)
    if port in outputs:
        port = outputs.index(port)
    elif port is None:
        port = getattr(proxy, "Port", 0)
    if not (isinstance(port, int) and 0 <= port < len(outputs)):
        raise ValueError(f"expected an output of {', '.join(outputs)}, got {port}")
    data = _whole(servermanager.Fetch(source, idx=port))
    found: dict[str, numpy.ndarray] = {}
    if data is None:
        return found
    if data.IsA("vtkPointSet"):
        points = data.GetPoints()
        found["points"] = _to_numpy(points.GetData()) if points else numpy.empty((0, 3))
    groups = [data.GetRowData()] if data.IsA("vtkTable") else [data.GetPointData(), data.GetCellData()]
    for group in groups:
        for i in range(group.GetNumberOfArrays()):
            array = group.GetAbstractArray(i)
            if array.GetName():
                found.setdefault(array.GetName(), _to_numpy(array))
    fields = data.GetFieldData()
    for i in range(fields.GetNumberOfArrays()):
        array = fields.GetAbstractArray(i)
        if array.GetName():
            values = _to_numpy(array)
            found.setdefault(array.GetName(), values[0] if len(values) == 1 else values)
    if data.IsA("vtkImageData"):
        for name, values in (("dimensions", data.GetDimensions()), ("origin", data.GetOrigin()),
                             ("spacing", data.GetSpacing())):
            found.setdefault(name, numpy.array(values))
    return found
