# SPDX-License-Identifier: BSD-3-Clause
"""What the pipeline holds, as numpy arrays."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._errors import output_names, update

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


def _bring(proxy: Any, port: int) -> Any:
    """The data of an output, of all ranks together, on the first one.

    ParaView's own Fetch joins parts of polygonal and composite data alone; of others it brings what the first rank has.
    """
    from paraview import servermanager

    information = proxy.GetDataInformation(port)
    kind = information.GetDataClassName()
    ranks = servermanager.ActiveConnection.GetNumberOfDataPartitions()
    if ranks == 1 or kind == "vtkPolyData" or information.IsCompositeDataSet():
        return servermanager.Fetch(proxy, idx=port)
    whole = servermanager.filters.ReductionFilter(Input=servermanager.OutputPort(proxy, port))
    whole.PostGatherHelperName = "vtkPVMergeTables" if kind == "vtkTable" else "vtkAppendFilter"
    return servermanager.Fetch(whole, 0)


class _Image:
    """Where the points and cells of an image are, and in which order parts of it from several ranks are to be put."""

    def __init__(self, information: Any):
        import numpy

        extent = numpy.array(information.GetExtent())
        bounds = numpy.array(information.GetBounds())
        self.dimensions = extent[1::2] - extent[::2] + 1
        self.origin = bounds[::2]
        self.spacing = (bounds[1::2] - bounds[::2]) / numpy.maximum(self.dimensions - 1, 1)

    def orders(self, parts: Any) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Which points and cells of an unstructured grid are those of the image, in its order."""
        import numpy
        from vtkmodules.util.numpy_support import vtk_to_numpy

        points = vtk_to_numpy(parts.GetPoints().GetData())
        corners = vtk_to_numpy(parts.GetCells().GetConnectivityArray()).reshape(-1, 8)
        steps = numpy.where(self.spacing > 0, self.spacing, 1)

        def order(places: numpy.ndarray, counts: numpy.ndarray) -> numpy.ndarray:
            index = numpy.rint((places - self.origin) / steps).astype(int)
            flat = index[:, 0] + counts[0] * (index[:, 1] + counts[1] * index[:, 2])
            return numpy.unique(flat, return_index=True)[1]

        return order(points, self.dimensions), order(points[corners].mean(axis=1) - steps / 2, self.dimensions - 1)


def fetch_groups(proxy: Any, port: int | str | None = None, time: float | None = None) -> dict[str, dict[str, numpy.ndarray]]:
    """Returns what fetch returns in groups: "places", the point arrays in "points", "cells", "rows" of tables, "fields" and "image"."""
    import numpy

    update(proxy, time)
    outputs = output_names(proxy)
    if port in outputs:
        port = outputs.index(port)
    elif port is None:
        port = proxy.Port
    if not (isinstance(port, int) and 0 <= port < len(outputs)):
        raise ValueError(f"expected an output of {', '.join(outputs)}, got {port}")
    information = proxy.GetDataInformation(port)
    image = _Image(information) if information.GetDataClassName() == "vtkImageData" else None
    data = _whole(_bring(proxy, port))
    groups: dict[str, dict[str, numpy.ndarray]] = {name: {} for name in ("places", "points", "cells", "rows", "fields", "image")}
    if data is None:
        return groups
    if image is None and data.IsA("vtkPointSet"):
        points = data.GetPoints()
        groups["places"]["points"] = _to_numpy(points.GetData()) if points else numpy.empty((0, 3))
    kinds = {"rows": 6} if data.IsA("vtkTable") else {"points": 0, "cells": 1}  # numbers of vtkDataObject::AttributeTypes
    orders = image.orders(data) if image and data.IsA("vtkUnstructuredGrid") else [slice(None)] * 2
    algorithm = proxy.GetClientSideObject()
    own = algorithm.GetOutputDataObject(port) if algorithm else None
    for (name, kind), order in zip(kinds.items(), orders):
        # ParaView puts the arrays of several ranks into another order
        for group in (own.GetAttributes(kind) if own else None, data.GetAttributes(kind)):
            for i in range(group.GetNumberOfArrays() if group else 0):
                array = data.GetAttributes(kind).GetAbstractArray(group.GetArrayName(i) or "")
                if array:
                    groups[name].setdefault(array.GetName(), _to_numpy(array)[order])
    fields = data.GetFieldData()
    for i in range(fields.GetNumberOfArrays()):
        array = fields.GetAbstractArray(i)
        if array.GetName():
            values = _to_numpy(array)
            groups["fields"][array.GetName()] = values[0] if len(values) == 1 else values
    if image:
        groups["image"] = {name: getattr(image, name) for name in ("dimensions", "origin", "spacing")}
    return groups


def fetch(proxy: Any, port: int | str | None = None, time: float | None = None) -> dict[str, numpy.ndarray]:
    """Returns what a source or filter holds as a dict of numpy arrays.

    proxy  a source or filter of paraview.simple, or one of its output ports
    port   the output, by number or name: "Box", "Bonds". None: the first, or the port that proxy is.
    time   the time to update to, as for vtkgranular.update

    The keys, in this order; where two have the same name the first one counts:
    "points"                  the points, shape (n, 3); for lines, both ends of each line
    names of point arrays     shape (n,) or (n, components)
    names of cell arrays      of lines, subdomains and cells, and the columns of tables
    names of field data       "timestep", "BoxBounds", "BoxVectors", "Columns", ...: what the header of the frame says;
                              one number or text has the shape ()
    "dimensions", "origin", "spacing"  of images: points along x, y, z, and where they are

    On several ranks the first rank gets the whole, and the others what they hold. The arrays are read-only views of the
    pipeline's memory, which stays as long as they do; copy an array to change it. Raises RuntimeError as vtkgranular.update does,
    ValueError for an output that there is not.
    """
    found: dict[str, numpy.ndarray] = {}
    for group in fetch_groups(proxy, port, time).values():
        found |= {name: values for name, values in group.items() if name not in found}
    return found
