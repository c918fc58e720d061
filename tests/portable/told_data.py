# SPDX-License-Identifier: BSD-3-Clause
"""All that there is to compare of a data object, as values of JSON."""
import hashlib

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy


def digest(values):
    return hashlib.sha256(values).hexdigest()[:16]


def of_array(array):
    if array is None:
        return None
    told = [array.GetClassName(), array.GetName(), array.GetNumberOfComponents(), array.GetNumberOfTuples()]
    told.append([array.GetComponentName(i) for i in range(array.GetNumberOfComponents())])
    if array.GetClassName() == "vtkStringArray":
        return [*told, [array.GetValue(i) for i in range(min(array.GetNumberOfValues(), 1000))]]
    size = array.GetNumberOfValues()
    told.append(digest(bytes(memoryview(array)) if size else b""))
    ranges = [array.GetRange(i) for i in range(-1 if array.GetNumberOfComponents() > 1 else 0, array.GetNumberOfComponents())]
    return [*told, repr(ranges)]


def of_cells(cells):
    if cells is None:
        return None
    # by their types: cells that VTK 9.6 fills have arrays of a template, which Python cannot make
    return [cells.GetNumberOfCells(), *(of_array(each)[4:] + [each.GetDataTypeAsString()] for each in
                                        (cells.GetOffsetsArray(), cells.GetConnectivityArray()))]


def ranges_of(data, array):
    """Those that field data find themselves, from VTK 9.3 on; ParaView asks for them."""
    if array is None or not array.IsA("vtkDataArray") or not hasattr(data, "GetRange"):
        return None
    found = []
    for component in range(-1 if array.GetNumberOfComponents() > 1 else 0, array.GetNumberOfComponents()):
        for find in (data.GetRange, data.GetFiniteRange):
            found.append([0.0, 0.0])
            find(array.GetName(), found[-1], component)
    values = vtk_to_numpy(array).reshape(-1, array.GetNumberOfComponents()).astype(float)
    if len(values) and numpy.isfinite(values).all():
        sizes = [numpy.sqrt((values**2).sum(axis=1))] if values.shape[1] > 1 else []
        expected = [[part.min(), part.max()] for part in (*sizes, *values.T) for _ in range(2)]
        assert numpy.allclose(found, expected, rtol=1e-14, atol=0), (array.GetName(), found, expected)
    return repr(found)


def of_fields(data):
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    told = {array.GetName(): [of_array(array), ranges_of(data, array)] for array in arrays}
    for name in ("GetScalars", "GetVectors", "GetPedigreeIds"):
        active = getattr(data, name, lambda: None)()
        told[name] = active.GetName() if active else None
    return [list(told), told]


def of_data(data):
    told = {"class": data.GetClassName(), "field": of_fields(data.GetFieldData()), "time": data.GetInformation().Get(data.DATA_TIME_STEP())}
    if data.IsA("vtkTable"):
        return told | {"rows": of_fields(data.GetRowData())}
    if data.IsA("vtkPartitionedDataSet"):
        return told | {"parts": [of_data(data.GetPartition(i)) for i in range(data.GetNumberOfPartitions())]}
    told |= {"points": of_fields(data.GetPointData()), "cells": of_fields(data.GetCellData()), "bounds": repr(data.GetBounds())}
    if data.IsA("vtkImageData"):
        return told | {"image": repr([data.GetExtent(), data.GetOrigin(), data.GetSpacing()])}
    if data.GetPoints():
        told["place"] = of_array(data.GetPoints().GetData())
    if data.IsA("vtkPolyData"):
        return told | {"verts": of_cells(data.GetVerts()), "lines": of_cells(data.GetLines())}
    return told | {"grid": of_cells(data.GetCells()), "types": [data.GetCellType(i) for i in range(data.GetNumberOfCells())][:100]}
