# SPDX-License-Identifier: BSD-3-Clause
"""Data sets of VTK as the C library takes them, to write and to filter; nothing is copied that lies in memory as it wants it."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_LINE, VTK_POLY_LINE, VTK_VOXEL, vtkCellArray, vtkDataSetAttributes

from .. import _library as c
from .._write import _c_arrays
from ._arrays import numbers

_COORDINATES = ("Absolute", "Unwrapped", "Scaled")
DUPLICATE = 1  # of vtkGhostType
#: How corners of a box are numbered: which bound each has along x (1), y (2) and z (4), in voxels, in those of LIGGGHTS-INL, whose x and
#: z are exchanged, and in hexahedra.
_CORNERS = numpy.array([[0, 1, 2, 3, 4, 5, 6, 7], [0, 4, 2, 6, 1, 5, 3, 7], [0, 1, 3, 2, 4, 5, 7, 6]])


class Rows:
    """The rows of a rank: arrays by their names, and what field data tell of the frame."""

    def __init__(self, data: Any):
        self.arrays: dict[str, Any] = {}
        self.told: list[str] = []
        self.facts = {name: values_of(data.GetFieldData().GetAbstractArray(name)) for name in (
            "Columns", "ColumnDigits", "Dialect", "label", "RowLabel", "units", "timestep", "time", "Coordinates", "PointOrigin", "BoxOrigin",
            "BoxVectors", "BoxBounds", "Boundary")}

    def see(self, attributes: Any, count: int, names: tuple[str, ...] = ()) -> None:
        """Takes all arrays of attributes, or those of some names, with a value for each of so many rows, to be written."""
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetAbstractArray(i)
            name = array.GetName()
            if name == vtkDataSetAttributes.GhostArrayName() or (names and name not in names):
                continue
            if name in ("points", "ends"):
                raise c.Error(f"column '{name}': expected another name, as the places of rows have it")
            if not name or not _is_known(array):
                self.told.append(f"the array '{name}' of the type {array.GetDataTypeAsString()} is left out" if name else
                                 "an array without a name is left out")
                continue
            self.arrays[name] = _checked(array, count, "rows")

    def see_all(self, attributes: Any, count: int, owners: str) -> None:
        """Takes all arrays of attributes to be filtered, ghosts included. owners: what there are so many of, in errors."""
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetAbstractArray(i)
            if array.GetName() and array.GetName() not in ("points", "ends") and _is_known(array) and array.GetNumberOfComponents():
                self.arrays[array.GetName()] = _checked(array, count, owners)

    def keep(self, mask: Any) -> None:
        """Keeps some rows."""
        self.arrays = {name: values[mask] for name, values in self.arrays.items()}

    def leave_out(self, ghosts: Any) -> None:
        """Leaves out the rows that another rank has, by an array of ghosts, if there is one."""
        if ghosts:
            self.keep((vtk_to_numpy(ghosts) & DUPLICATE) == 0)

    def add_points(self, data: Any) -> None:
        """Takes the points of a data set at their true places."""
        if self.facts["Coordinates"] is not None and "Scaled" in self.facts["Coordinates"]:
            raise c.Error("expected absolute coordinates, got scaled ones")
        origin = self.facts["PointOrigin"]
        self.facts["PointOrigin"] = None
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float) if data.GetNumberOfPoints() else numpy.empty((0, 3))
        self.arrays["points"] = points + (0 if origin is None else origin.reshape(3))

    def see_voxels(self, data: Any, place: str = "") -> None:
        """Takes the cells of an unstructured grid as subdomains: lo, hi, nlocal and proc. place: where they go, in errors."""
        count = data.GetNumberOfCells()
        types = numpy.array([data.GetCellType(i) for i in range(count)], dtype=numpy.int64)
        bad = numpy.flatnonzero((types != VTK_VOXEL) & (types != VTK_HEXAHEDRON))
        self.add_points(data)
        points = self.arrays.pop("points")
        if not len(bad):
            corners = points[vtk_to_numpy(data.GetCells().GetConnectivityArray()).reshape(-1, 8)] if count else numpy.empty((0, 8, 3))
            self.arrays["lo"], self.arrays["hi"] = numpy.empty((count, 3)), numpy.empty((count, 3))
            orders = numpy.full(count, -1)
            for order, sides in reversed(list(enumerate(_CORNERS))):  # the first one that fits counts
                lo, hi = (corners[:, numpy.flatnonzero(sides == side)[0]] for side in (0, 7))
                expected = numpy.where(sides[:, None] >> numpy.arange(3) & 1, hi[:, None], lo[:, None])
                fits = ((corners == expected) | (numpy.isnan(corners) & numpy.isnan(expected))).all(axis=(1, 2))
                self.arrays["lo"][fits], self.arrays["hi"][fits], orders[fits] = lo[fits], hi[fits], order
            bad = numpy.flatnonzero(orders < 0)
            reflected = int((orders == 1).sum())
            if reflected:
                self.told.append(f"corners of {reflected} voxel{' are' if reflected == 1 else 's are'} in the order of LIGGGHTS-INL, x and z "
                                 "exchanged: they were put right")
        if len(bad):
            raise c.Error(f"{place}expected voxels, or hexahedra along the axes, got another cell: number {bad[0]} of type "
                          f"{types[bad[0]]}")
        for name, own in (("nlocal", ("nlocal",)), ("proc", ("proc", "procID"))):
            arrays = [array for array in map(data.GetCellData().GetArray, own) if array and array.GetNumberOfComponents() == 1]
            if arrays:
                self.arrays[name] = _whole_numbers(arrays[0])

    def __len__(self) -> int:
        return len(next(iter(self.arrays.values()), ()))


class Content(c.Content):
    """Rows as the library takes them. Its timestep is known if the field data know it."""

    def __init__(self, arrays: dict[str, Any], facts: dict[str, Any]):
        super().__init__()
        c.library().granular_content_init(ctypes.byref(self))
        self._header = header = c.FrameHeader()
        given, self.rows, self._kept = _c_arrays(arrays)
        self.arrays, self.array_count, self.header = given, len(arrays), ctypes.pointer(header)
        step = facts["timestep"]
        self.timestep = int(step[0]) if step is not None and len(step) == 1 and step[0] == int(step[0]) else c.NO_TIMESTEP

        def text(name: str) -> bytes:
            return str(facts[name][0]).encode() if facts[name] is not None and len(facts[name]) else b""

        columns = [] if facts["Columns"] is None else [str(name) for name in facts["Columns"]]
        header.columns = " ".join(columns).encode()
        if facts["ColumnDigits"] is not None and len(facts["ColumnDigits"]) == len(columns):
            digits = (c.c_int * max(1, len(columns)))(*map(int, facts["ColumnDigits"]))
            header.digits, header.digit_count = digits, len(columns)
            self._kept.append(digits)
        dialect = text("Dialect")
        header.dialect = dialect if dialect in (b"LAMMPS", b"LIGGGHTS") else b""
        header.label, header.row_label, header.units = text("label"), text("RowLabel"), text("units")
        self.units = header.units
        coordinates = text("Coordinates").decode()
        header.coordinates = _COORDINATES.index(coordinates) if coordinates in _COORDINATES else 0
        if facts["PointOrigin"] is not None and facts["PointOrigin"].size == 3:
            header.origin[:] = facts["PointOrigin"].ravel().tolist()

    def set_box(self, box: c.CBox | None) -> None:
        """Gives it a box, or none."""
        if box is not None:
            self.box = ctypes.pointer(box)


def box_of(facts: dict[str, Any]) -> c.CBox | None:
    """Returns the box that field data tell, if they tell one."""
    box, boundary = c.CBox(), facts["Boundary"]
    origin, vectors, bounds = (facts[name] for name in ("BoxOrigin", "BoxVectors", "BoxBounds"))
    box.boundary = str(boundary[0]).encode() if boundary is not None and len(boundary) else b""
    if origin is None or vectors is None or origin.size != 3 or vectors.size != 9:
        return None
    box.origin[:], box.vectors[:] = origin.ravel().tolist(), vectors.ravel().tolist()
    if bounds is not None and bounds.size in (6, 9):
        exact = c.CBox()
        exact.has_bounds, exact.bounds[:bounds.size] = 1, bounds.ravel().tolist()
        c.library().granular_complete_box(c.byref(exact))
        if exact.origin[:] == box.origin[:] and exact.vectors[:] == box.vectors[:]:
            box.has_bounds, box.bounds[:] = 1, exact.bounds[:]
    return box


def values_of(array: Any) -> Any:
    """Returns the values of an array of VTK, or None. They are copied where numpy cannot see them."""
    if array is None:
        return None
    if array.IsA("vtkStringArray"):
        return numpy.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], dtype=str)
    if not array.HasStandardMemoryLayout():
        copy = vtkDataArray.CreateDataArray(array.GetDataType())
        copy.DeepCopy(array)
        array = copy
    values = vtk_to_numpy(array)
    return values.reshape(-1, array.GetNumberOfComponents()) if array.GetNumberOfComponents() > 1 else values


def _whole_numbers(array: Any) -> Any:
    values = vtk_to_numpy(array)
    bad = numpy.flatnonzero(~((values >= 0) & (values == numpy.trunc(values))))
    if len(bad):
        raise c.Error(f"column '{array.GetName()}': expected whole numbers from 0, got {values[bad[0]]} in cell {bad[0]}")
    return values


def _is_known(array: Any) -> bool:
    return bool(array.IsA("vtkDataArray") or array.IsA("vtkStringArray"))


def _checked(array: Any, count: int, owners: str) -> Any:
    if array.GetNumberOfTuples() != count:
        raise c.Error(f"column '{array.GetName()}': expected a value for each of {count} {owners}, got {array.GetNumberOfTuples()}")
    return values_of(array)


# ---- inputs of filters ---------------------------------------------------------------------------
def _expected(data: Any, expected: str) -> c.Error:
    got = f"a {data.GetClassName()}" if data else "nothing"
    more = ": the filter MergeBlocks makes one of it" if data and data.IsA("vtkCompositeDataSet") else ""
    return c.Error(f"expected {expected}, got {got}{more}")


def _content(rows: Rows, count: int) -> Content:
    made = Content(rows.arrays, rows.facts)
    made.rows = count
    time = rows.facts["time"]
    if time is not None and time.size == 1 and time.dtype.kind in "iuf":
        made.time, made.has_time = float(time.ravel()[0]), 1
    made.set_box(box_of(rows.facts))
    return made


def particles(data: Any) -> Content:
    """Takes the points of a data set."""
    if data is None or not data.IsA("vtkPointSet"):
        raise _expected(data, "a vtkPointSet of particles")
    rows, count = Rows(data), data.GetNumberOfPoints()
    if data.GetPoints():
        rows.arrays["points"] = values_of(data.GetPoints().GetData()).reshape(-1, 3)
    rows.see_all(data.GetPointData(), count, "points")
    return _content(rows, count)


def places(data: Any) -> Content:
    """Takes the points of any data set, without arrays."""
    if data is None or not data.IsA("vtkDataSet"):
        raise _expected(data, "a vtkDataSet as Points")
    rows, count = Rows(data), data.GetNumberOfPoints()
    if data.IsA("vtkPointSet"):
        points = values_of(data.GetPoints().GetData()) if data.GetPoints() else numpy.empty(0)
    else:
        points = numpy.array([data.GetPoint(i) for i in range(count)])
    rows.arrays["points"] = points.reshape(-1, 3)
    return _content(rows, count)


def attributes_of(data: Any) -> tuple[Any, int]:
    """Returns the arrays of the cells of a data set, or of the rows of a table, and the number of these."""
    if data is not None and data.IsA("vtkDataSet"):
        return data.GetCellData(), data.GetNumberOfCells()
    if data is not None and data.IsA("vtkTable"):
        return data.GetRowData(), data.GetNumberOfRows()
    raise _expected(data, "lines as cells of a vtkDataSet, or a vtkTable with a row for each")


def lines(data: Any, places: bool = True) -> Content:
    """Takes cells as lines, or the rows of a table. places: False if only the arrays matter, and not where the ends are."""
    attributes, count = attributes_of(data)
    rows = Rows(data)
    if data.IsA("vtkPointSet" if places else "vtkDataSet"):
        rows.arrays["ends"] = _ends(data, count) if places and attributes.HasArray("id2") else numpy.empty((count, 6))
    rows.see_all(attributes, count, "rows")
    return _content(rows, count)


def rows_only(data: Any) -> Content:
    """Takes cells as lines, or the rows of a table, without the places of the ends."""
    return lines(data, False)


def lines_with_points(data: Any) -> Content:
    """Takes cells as lines that have points, but not the places of the ends."""
    if data is None or not data.IsA("vtkPointSet"):
        raise _expected(data, "lines with points (GranularLocalJoin makes them of a table)")
    return lines(data, False)


def _points_of_cells(data: Any) -> tuple[Any, Any]:
    """Returns the ids of the points of all cells, and where those of each begin, with the end of the last. Raises Error unless all cells
    are lines."""
    names = ("GetVerts", "GetLines", "GetPolys", "GetStrips") if data.IsA("vtkPolyData") else ("GetCells",)
    kinds = [cells for cells in (getattr(data, name, lambda: None)() for name in names) if cells and cells.GetNumberOfCells()]
    for row in range(data.GetNumberOfCells() if len(kinds) > 1 or (kinds and not data.IsA("vtkPolyData")) or
                     (kinds and kinds[0] is not data.GetLines()) else 0):
        if data.GetCellType(row) not in (VTK_LINE, VTK_POLY_LINE):
            raise c.Error(f"expected lines as cells, got a cell of the VTK type {data.GetCellType(row)} in row {row} (the first is 0)")
    ids = [vtk_to_numpy(cells.GetConnectivityArray()) for cells in kinds]
    sizes = [numpy.diff(vtk_to_numpy(cells.GetOffsetsArray())) for cells in kinds]
    begins = numpy.cumsum(numpy.concatenate([[0], *sizes]), dtype=numpy.int64)
    return numpy.concatenate(ids) if ids else numpy.empty(0, dtype=numpy.int64), begins


def _ends(data: Any, count: int) -> Any:
    """Returns the first and the last point of each cell."""
    ids, begins = _points_of_cells(data)
    if len(begins) != count + 1 or not count:
        return numpy.empty((count, 6))
    points, first, last = values_of(data.GetPoints().GetData()).astype(float, copy=False), ids[begins[:-1]], ids[begins[1:] - 1]
    if len(points) == 2 * count and (first == numpy.arange(0, 2 * count, 2)).all() and (last == first + 1).all():
        return points.reshape(-1, 6)  # in place
    return numpy.concatenate([points[first], points[last]], axis=1)


def add_lines(data: Any, rows: Any, to: Any) -> None:
    """Adds some cells of a data set to one without any, each with points of its own, which are doubles."""
    ids, begins = _points_of_cells(data)
    sizes = numpy.diff(begins)[rows]
    offsets = numpy.cumsum(numpy.concatenate([[0], sizes]), dtype=numpy.int64)
    of_points = numpy.repeat(begins[:-1][rows] - offsets[:-1], sizes) + numpy.arange(offsets[-1])
    points, made = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    points.SetNumberOfPoints(len(of_points))
    if len(of_points):
        vtk_to_numpy(points.GetData())[:] = values_of(data.GetPoints().GetData()).reshape(-1, 3)[ids[of_points]]
    if len(rows):
        made.SetData(numbers(None, offsets), numbers(None, numpy.arange(offsets[-1], dtype=numpy.int64)))
    to.SetPoints(points)
    to.SetLines(made)


def voxels(data: Any) -> Content:
    """Takes cells as subdomains; what is told of them is in `told`."""
    if data is None or not data.IsA("vtkUnstructuredGrid"):
        raise c.Error("expected the subdomains as voxels at the second input, got nothing")
    rows = Rows(data)
    rows.see_voxels(data)
    rows.leave_out(data.GetCellGhostArray())
    made = _content(rows, len(rows))
    made.told = rows.told
    return made
