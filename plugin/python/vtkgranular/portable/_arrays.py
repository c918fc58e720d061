# SPDX-License-Identifier: BSD-3-Clause
"""Frames of the C library as arrays and data sets of VTK, equal to those of the compiled readers."""
from __future__ import annotations

import ctypes
import functools
import mmap
from typing import Any, Iterable

import numpy
from vtkmodules import vtkCommonCore as core
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_VOXEL, vtkCellArray, vtkDataSetAttributes, vtkUnstructuredGrid

from .. import _library as c
from .._run import _Handle, _to_numpy

#: Not those of numpy_support, which makes arrays of C's long.
_CLASSES = {"int32": core.vtkTypeInt32Array, "int64": core.vtkTypeInt64Array, "float32": core.vtkFloatArray,
            "float64": core.vtkDoubleArray, "uint8": core.vtkUnsignedCharArray}


def numbers(name: str | None, values: Any) -> Any:
    """Returns an array of VTK with the values of a numpy array.

    They are copied: filters make arrays that share the memory of others, and know nothing of what numpy keeps.
    """
    made = _CLASSES[values.dtype.name]()
    made.SetNumberOfComponents(values.shape[1] if values.ndim > 1 else 1)
    _fill(made, values)
    if name is not None:
        made.SetName(name)
    return made


def _fill(made: Any, values: Any) -> None:
    made.SetNumberOfTuples(len(values))
    if values.size:
        memory = vtk_to_numpy(made).reshape(-1)
        _ask_for_large_pages(memory)
        memory[:] = numpy.ascontiguousarray(values).reshape(-1)


@functools.cache
def _system() -> ctypes.CDLL:
    return ctypes.CDLL(None)  # which takes milliseconds


def _ask_for_large_pages(memory: Any) -> None:
    """Asks Linux for large pages behind memory that was not used yet: to get small ones takes three times as long as to fill them."""
    begin, end = -(-memory.ctypes.data // mmap.PAGESIZE) * mmap.PAGESIZE, memory.ctypes.data + memory.nbytes
    if memory.nbytes >= 2**22 and hasattr(mmap, "MADV_HUGEPAGE"):
        _system().madvise(ctypes.c_void_p(begin), ctypes.c_size_t(end - begin), mmap.MADV_HUGEPAGE)  # a wish: no matter if it fails


def texts(name: str, values: Iterable[str]) -> Any:
    """Returns a vtkStringArray."""
    made = core.vtkStringArray()
    made.SetName(name)
    for value in values:
        made.InsertNextValue(value)
    return made


def _ranges_of(made: Any, known: c.CArray) -> list[float]:
    """Returns the ranges of the components of an array and, of several, that of their lengths; none if they are not known."""
    count = made.GetNumberOfComponents()
    return known.range[:2 * count + (2 if count > 1 else 0)] if known.range and known.components == count else []


def _tell_ranges(made: Any, known: c.CArray) -> None:
    """Tells an array the ranges of its components and, of several, that of their lengths, as VTK would find them, if they are known."""
    count, ranges = made.GetNumberOfComponents(), _ranges_of(made, known)
    if not ranges:
        return
    information = made.GetInformation()
    for key in (made.PER_COMPONENT(), made.PER_FINITE_COMPONENT()):
        vector = core.vtkInformationVector()
        for i in range(count):
            one = core.vtkInformation()
            one.Set(made.COMPONENT_RANGE(), ranges[2 * i:2 * i + 2], 2)
            vector.Append(one)
        information.Set(key, vector)
    if count > 1:
        for key in (made.L2_NORM_RANGE(), made.L2_NORM_FINITE_RANGE()):
            information.Set(key, ranges[2 * count:], 2)


def _prepare_ranges(attributes: Any, made: Any, known: c.CArray) -> None:
    """Fills the array with two tuples that have its ranges, so that point or cell data cache them. From VTK 9.3 on they do not ask the array,
    and the cache stays valid when the values replace the tuples."""
    count, ranges = made.GetNumberOfComponents(), numpy.array(_ranges_of(made, known)).reshape(-1, 2).T
    if not ranges.size or not hasattr(attributes, "GetRange"):
        return
    lengths = numpy.zeros((2, count))
    lengths[:, :1] = ranges[:, -1:]
    for component, tuples in ((0, ranges[:, :count]), *([(-1, lengths)] if count > 1 else [])):
        with numpy.errstate(invalid="ignore"):
            _fill(made, tuples)
        if (vtk_to_numpy(made).reshape(2, count) == tuples).all():  # a float or an integer may not hold these numbers exactly
            for find in (attributes.GetRange, attributes.GetFiniteRange):
                find(made.GetName(), [0.0, 0.0], component)


class Table:
    """A frame that was read: its header and its arrays as VTK has them.

    points  the positions, of lines both ends
    drawn   arrays that only lines have: row, part, length
    arrays  the others, by their names
    """

    def __init__(self, handle: _Handle, split: bool = False, single: bool = False, takes: bool = False):
        """takes: VTK gets the memory of an array when `add_to` adds the array, which is empty until then."""
        library, self.header, self._takes = c.library(), c.FrameHeader(), takes
        self._waiting: dict[int, tuple[Any, int, c.CArray]] = {}  # by id(): from VTK 9.7 on, arrays compare their values
        library.granular_header(handle, c.byref(self.header))
        self.handle = handle
        self.columns = c.text(self.header.columns).split()
        self.points = core.vtkPoints()
        self.points.SetData(numbers("Points", numpy.empty((0, 3), dtype=numpy.float32 if single else float)))
        self.arrays: dict[str, Any] = {}
        self.drawn: dict[str, Any] = {}
        made = []
        for number in range(self.header.arrays):
            array = c.CArray()
            library.granular_array_at(handle, number, c.byref(array))
            made.append((c.text(array.name), self._array(number, array)))
        self.has_lines, self.has_points = (bool(made) and made[0][0] == name for name in ("ends", "points"))
        if self.has_lines or self.has_points:
            made.pop(0)
        if self.has_lines:
            own = [made.pop(0) for _ in range(3 if split else 1)]
            self.drawn = dict(own[1:] + own[:1])
        self.arrays = dict(made)

    def _array(self, number: int, array: c.CArray) -> Any:
        name = c.text(array.name)
        if array.type == c.TEXT:
            return texts(name, _to_numpy(self.handle, array))
        made = _CLASSES[c.TYPES[array.type]]()
        if name in ("ends", "points"):
            self._place(made, number, array)
        else:
            made.SetName(name)
            made.SetNumberOfComponents(array.components)
            if self._takes:
                self._waiting[id(made)] = made, number, array
            else:
                self._give(made, number, array)
        columns = c.text(array.columns).split()
        # components of three are axes, and shown as X, Y and Z anyway; others, and those of tensors, keep their names
        if len(columns) > 1 and (len(columns) != 3 or "[" in columns[0] or columns[0] in ("XX", "XY")):
            for i, column in enumerate(columns):
                made.SetComponentName(i, column)
        return made

    def add_to(self, attributes: Any, arrays: Iterable[Any]) -> None:
        """Adds arrays to an output."""
        for array in arrays:
            attributes.AddArray(array)
            if id(array) in self._waiting:
                _, number, known = self._waiting.pop(id(array))
                _prepare_ranges(attributes, array, known)
                self._give(array, number, known)

    def _give(self, made: Any, number: int, array: c.CArray) -> None:
        """Gives an array of VTK its values."""
        if self._takes and array.rows and c.IS_HEAP_SHARED:
            memory, values = c.c_void_p(), array.rows * array.components
            c.library().granular_take(self.handle, number, c.byref(memory))
            made.SetVoidArray(c._memory(memory.value, values * made.GetDataTypeSize()), values, 0, core.vtkAbstractArray.VTK_DATA_ARRAY_FREE)
        else:
            _fill(made, _to_numpy(self.handle, array).reshape(-1, made.GetNumberOfComponents()))
        _tell_ranges(made, array)

    def _place(self, made: Any, number: int, array: c.CArray) -> None:
        """Makes the values the points. VTK finds the bounds of two points that have them, and keeps them for those that come instead."""
        made.SetName("Points")
        made.SetNumberOfComponents(3)
        if array.rows:
            self.points.SetData(made)  # which forgets the ranges
        if array.rows and array.range and array.components == 3:
            _fill(made, numpy.array(array.range[:6]).reshape(3, 2).T)
            self.points.ComputeBounds()
        self._give(made, number, array)

    def add_no_lines(self, split: bool) -> None:
        """Makes the arrays of lines where there are none."""
        names = {"row": numpy.int64, "part": numpy.int32, "length": float} if split else {"length": float}
        self.has_lines = True
        self.drawn = {name: numbers(name, numpy.empty(0, dtype=kind)) for name, kind in names.items()}

    # ---- the header ----
    def add_header(self, data: Any) -> None:
        """Adds what a writer and a person need to know of a frame as field data."""
        header = self.header
        data.AddArray(texts("Coordinates", [("Absolute", "Unwrapped", "Scaled")[header.coordinates]]))
        data.AddArray(_row("PointOrigin", header.origin))
        box = header.box
        if header.has_box:
            data.AddArray(_row("BoxOrigin", box.origin))
            data.AddArray(_row("BoxVectors", box.vectors))
            if header.box_form != 2:
                data.AddArray(_row("BoxBounds", box.bounds[:9 if header.box_form == 1 else 6]))
            data.AddArray(texts("Boundary", [c.text(box.boundary)]))
        data.AddArray(numbers("timestep", numpy.array([header.timestep], dtype=numpy.int64)))
        word = c.text(header.row_label)
        for name, text in (("label", c.text(header.label)), ("RowLabel", word if word != "ATOMS" else ""), ("units", c.text(header.units))):
            if text:
                data.AddArray(texts(name, [text]))
        if header.has_time:
            data.AddArray(_row("time", [header.time]))
        if header.dialect:
            data.AddArray(texts("Dialect", [c.text(header.dialect)]))

    def add_columns(self, data: Any) -> None:
        """Adds what is known of the columns of a file, behind the header."""
        header = self.header
        if header.type_name_count:
            data.AddArray(texts("TypeNames", map(c.text, header.type_names[:header.type_name_count])))
        if header.shape_sizes:
            data.AddArray(texts("ShapeSizes", ["HalfAxes" if c.text(header.shape_sizes) == "half axes" else "Diameters"]))
        data.AddArray(texts("Columns", self.columns))
        if header.digit_count == len(self.columns):
            made = core.vtkIntArray()
            made.SetName("ColumnDigits")
            for digits in header.digits[:header.digit_count]:
                made.InsertNextValue(digits)
            data.AddArray(made)

    def fill_box(self, grid: vtkUnstructuredGrid) -> bool:
        """Makes the box of the frame the one cell of a grid. Returns False if it is not finite."""
        corners = numpy.array(self.header.box_corners[:]).reshape(8, 3)[[0, 1, 3, 2, 4, 5, 7, 6]]
        if not numpy.isfinite(corners).all():
            return False
        points = core.vtkPoints()
        points.SetDataTypeToDouble()
        for corner in corners:
            points.InsertNextPoint(corner)
        grid.SetPoints(points)
        grid.Allocate(1)
        grid.InsertNextCell(VTK_HEXAHEDRON, 8, range(8))
        return True


def _row(name: str, values: Iterable[float]) -> Any:
    return numbers(name, numpy.array([list(values)], dtype=float))


def take_tuples(array: Any, rows: Any) -> Any:
    """Returns some tuples of an array as an array of the same kind."""
    made = array.NewInstance()
    made.SetName(array.GetName())
    made.SetNumberOfComponents(array.GetNumberOfComponents())
    made.CopyComponentNames(array)
    made.SetNumberOfTuples(len(rows))
    if array.IsA("vtkDataArray") and array.HasStandardMemoryLayout() and array.GetDataType() != core.VTK_BIT:
        if len(rows):
            vtk_to_numpy(made)[:] = vtk_to_numpy(array)[rows]
        return made
    ids = core.vtkIdList()
    for row in rows.tolist():
        ids.InsertNextId(row)
    array.GetTuples(ids, made)
    return made


def pass_rows(attributes: Any, count: int, rows: Any, to: Any) -> None:
    """Adds all arrays but ghosts, with the values of some of so many rows; the arrays themselves where these are all rows in order."""
    all_rows = len(rows) == count and bool((rows == numpy.arange(count)).all())
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetAbstractArray(i)
        if array.GetName() and array.GetName() != vtkDataSetAttributes.GhostArrayName():
            to.AddArray(array if all_rows else take_tuples(array, rows))


def pass_piece(given: Any, first: int, last: int, to: Any) -> None:
    """Adds a part of the points of a data set, with all their arrays."""
    rows = numpy.arange(first, last)
    if given.GetPoints():
        points = core.vtkPoints()
        points.SetData(take_tuples(given.GetPoints().GetData(), rows))
        to.SetPoints(points)
    to.SetVerts(cells(last - first, 1))
    for i in range(given.GetPointData().GetNumberOfArrays()):
        to.GetPointData().AddArray(take_tuples(given.GetPointData().GetAbstractArray(i), rows))


def cells(count: int, size: int) -> vtkCellArray:
    """Returns cells of the same size, of which each has points of its own."""
    made = vtkCellArray()
    if count * size:
        kind = numpy.int32 if count * size < 2**31 - 1 else numpy.int64
        made.SetData(numbers(None, numpy.arange(0, count * size + 1, size, dtype=kind)), numbers(None, numpy.arange(count * size, dtype=kind)))
    return made


def fill_particles(output: Any, table: Table, form: int = 2) -> None:
    """Fills an output with particles and their arrays. form: 0 no cells, 1 one with all points, 2 one for each."""
    output.SetPoints(table.points)
    rows = output.GetNumberOfPoints()
    if rows and form:
        output.SetVerts(cells(*((rows, 1) if form == 2 else (1, rows))))
    table.add_to(output.GetPointData(), table.arrays.values())
    if "id" in table.arrays:
        output.GetPointData().SetPedigreeIds(table.arrays["id"])


def fill_voxels(output: Any, subdomains: dict[str, Any], begin: int, end: int, origin: Any = 0) -> None:
    """Fills an output with a part of subdomains, of which the arrays lo, hi, nlocal and proc are known, or the first two."""
    bounds = numpy.stack([subdomains["lo"][begin:end], subdomains["hi"][begin:end]]) - origin
    # corner i j k of subdomain p is point 8p + 4i + 2j + k, as dump decomposition/vtk numbers points
    corners = numpy.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    points = core.vtkPoints()
    points.SetData(numbers("Points", bounds[corners, :, [0, 1, 2]].transpose(2, 0, 1).reshape(-1, 3)))
    output.SetPoints(points)
    types = numbers(None, numpy.full(end - begin, VTK_VOXEL, dtype=numpy.uint8))
    firsts = 8 * numpy.arange(end - begin + 1, dtype=numpy.int64)
    voxels = numpy.array([0, 4, 2, 6, 1, 5, 3, 7]) + firsts[:-1, None]
    cells_of = vtkCellArray()
    if end > begin:
        cells_of.SetData(numbers(None, firsts), numbers(None, voxels.reshape(-1)))
    output.SetCells(types, cells_of)
    if "nlocal" in subdomains:
        output.GetCellData().SetScalars(numbers("nlocal", subdomains["nlocal"][begin:end]))
    if "proc" in subdomains:
        output.GetCellData().AddArray(numbers("proc", subdomains["proc"][begin:end].astype(numpy.int32)))


def fill_lines(output: Any, table: Table) -> None:
    """Fills an output with lines and their arrays."""
    output.SetPoints(table.points)
    output.SetLines(cells(output.GetNumberOfPoints() // 2, 2))
    table.add_to(output.GetCellData(), (*table.arrays.values(), *table.drawn.values()))
