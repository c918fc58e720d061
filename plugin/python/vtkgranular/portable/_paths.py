# SPDX-License-Identifier: BSD-3-Clause
"""Filters that follow particles and lines through frames."""
from __future__ import annotations

import bisect
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_BIT, VTK_DOUBLE, VTK_FLOAT, vtkAbstractArray, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_POLY_LINE, vtkCellArray, vtkDataSetAttributes
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from ._arrays import Table, cells, numbers
from ._contents import Content, lines_with_points, particles
from ._filters import Filter
from ._frames import InputFrames, KeptFrames, copy_of
from ._ranks import everyone, together


class GranularCompare(Filter):
    ports, inputs, optional = ("vtkPolyData", "vtkPolyData"), (particles, lines_with_points), (1,)

    def __init__(self) -> None:
        super().__init__()
        self._frames = KeptFrames(self)
        self._contents: dict[tuple[int, int], Content] = {}

    def take(self, port: int, frame: int) -> Content | None:
        source = port % 2  # the library asks at port 2 for lines at the first input
        data = self._frames.get(frame)
        if source >= len(data):
            return None
        if (port, frame) not in self._contents:
            self._contents[port, frame] = (particles, lines_with_points, lines_with_points)[port](data[source])
        return self._contents[port, frame]

    def apply(self, split: bool = False, **of_frames: Any) -> list[Table]:
        self._frames.begin(self.piece_of_inputs(self.piece))
        try:
            return super().apply(split, times=self._frames.times, shown=self._frames.number)
        finally:
            self._contents = {}

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        of_particles, of_lines, facts = tables
        current = self._frames.get(self._frames.number)
        reference = self._frames.get(int(facts.arrays["reference"].GetValue(0)))
        self._frames.end(self.values["Reference"] == 1)
        lines_alone = bool(facts.arrays["of_lines"].GetValue(0))
        port = 0 if lines_alone else 1
        if port < len(current):
            changed, output = _Changed(of_lines), outputs[port]
            together(lambda: _fill_lines(output, [(current[port], changed.rows), (reference[port], changed.lost)]))
            self._pass(changed, current[port].GetCellData(), reference[port].GetCellData(), output.GetCellData())
        if not lines_alone:
            changed = _Changed(of_particles)
            self._pass(changed, current[0].GetPointData(), reference[0].GetPointData(), outputs[0].GetPointData())
            changed.fill_points(outputs[0], *(data.GetPoints().GetData() if data.GetPoints() else None for data in (current[0], reference[0])))
        for output in outputs:
            output.GetFieldData().PassData(current[0].GetFieldData())

    def _pass(self, changed: _Changed, current: Any, reference: Any, to: Any) -> None:
        """Adds the arrays that the current rows of all ranks have, and those that were made."""
        own = _forms(current, reference)
        _, forms = max(everyone(own) if self.piece_of_inputs(self.piece) == self.piece else [own], key=lambda known: known[0])
        for form in forms:
            to.AddArray(changed.combine(form, current.GetAbstractArray(form[0]), reference.GetAbstractArray(form[0])))
        for kind in range(vtkDataSetAttributes.NUM_ATTRIBUTES):
            active = current.GetAbstractAttribute(kind)
            if active and active.GetName() and to.HasArray(active.GetName()):
                to.SetActiveAttribute(active.GetName(), kind)
        for array in changed.made:
            to.AddArray(array)


class _Paths(Filter):
    """Base of filters that go through all frames of the input."""

    inputs = (particles,)

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        if not self.values.get("Tail", 0):  # it is the same at all times
            for key in (Pipeline.TIME_STEPS(), Pipeline.TIME_RANGE()):
                outputs.GetInformationObject(0).Remove(key)
        return super().RequestInformation(request, inputs, outputs)

    def take(self, port: int, frame: int) -> Content | None:
        if frame == self._number:
            return particles(self._shown)
        self._frames.update(self._frames.times()[frame])
        return particles(self._frames.data())

    def apply(self, split: bool = False, **of_frames: Any) -> list[Table]:
        self._shown = copy_of(self.data[0])
        self._frames = InputFrames(self, 0, self.piece_of_inputs(self.piece))
        times, self._number = self._frames.shared_times(), self._frames.shown_number()
        try:
            made = super().apply(split, times=times, shown=self._asked(times))
            self._frames.restore()
            return made
        finally:
            self._frames.close()
            del self._shown, self._frames

    def _asked(self, times: list[float]) -> int:
        """Returns the number of the frame that a tail ends with, or of the shown one."""
        info = self.GetOutputInformation(0)
        if not self.values.get("Tail", 0) or not times:
            return self._number
        return max(bisect.bisect_right(times, info.Get(Pipeline.UPDATE_TIME_STEP())) - 1, 0) if info.Has(Pipeline.UPDATE_TIME_STEP()) else len(times) - 1


class GranularTrajectories(_Paths):
    ports = ("vtkPolyData",)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        (points, paths), output = tables, outputs[0]
        firsts, ends = (vtk_to_numpy(paths.arrays.pop(name)) for name in ("first_point", "end_point"))
        single = ends - firsts == 1
        output.SetPoints(points.points)
        output.SetVerts(_cells_of(firsts[single], ends[single]))
        output.SetLines(_cells_of(firsts[~single], ends[~single]))
        for array in paths.arrays.values():
            output.GetCellData().AddArray(array)
        for array in points.arrays.values():
            output.GetPointData().AddArray(array)
        output.GetPointData().SetActiveScalars("speed")  # the colour that ParaView begins with
        if points.header.has_box:
            points.add_header(output.GetFieldData())


class GranularHistory(_Paths):
    ports = ("vtkTable",)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        for array in tables[0].arrays.values():
            outputs[0].AddColumn(array)


def _cells_of(firsts: Any, ends: Any) -> vtkCellArray:
    """Returns cells of consecutive points."""
    made, sizes = vtkCellArray(), ends - firsts
    if len(sizes):
        offsets = numpy.concatenate([[0], sizes.cumsum()])
        made.SetData(numbers(None, offsets), numbers(None, numpy.arange(offsets[-1]) + numpy.repeat(firsts - offsets[:-1], sizes)))
    return made


def _form(array: Any) -> tuple[str, int, int]:
    return array.GetName(), array.GetDataType(), array.GetNumberOfComponents()


def _forms(current: Any, reference: Any) -> tuple[int, list[tuple[str, int, int]]]:
    """Returns the arrays that a rank knows, and how well: 2 if it has current rows, 1 if it has only rows of the reference frame."""
    rows = 2 if current.GetNumberOfTuples() > 0 else 1 if reference.GetNumberOfTuples() > 0 else 0
    data = reference if rows == 1 else current
    arrays = (data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays()))
    return rows, [_form(array) for array in arrays if array.GetName() and array.GetName() != vtkDataSetAttributes.GhostArrayName()]


class _Changed:
    """Rows of the current frame, and behind them the lost ones of a reference frame."""

    def __init__(self, table: Table):
        both = vtk_to_numpy(table.arrays.pop("input_row"))
        count = len(both) - int((vtk_to_numpy(table.arrays["change"]) == 2).sum()) if len(both) else 0
        self.rows, self.lost, self.made = both[:count], both[count:], list(table.arrays.values())

    def combine(self, form: tuple[str, int, int], current: Any, reference: Any) -> Any:
        """Returns an array with the values of both; `current` itself if it has exactly these. Rows without a value, because an array is
        missing or of another kind, get nan, 0 or an empty text."""
        name, kind, size = form
        fits = [array is not None and _form(array)[1:] == (kind, size) for array in (current, reference)]
        if fits[0] and current.GetNumberOfTuples() == len(self.rows) and not len(self.lost):
            return current
        model = current if fits[0] else reference
        made = model.NewInstance() if any(fits) else vtkAbstractArray.CreateArray(kind)
        made.SetName(name)
        made.SetNumberOfComponents(size)
        made.SetNumberOfTuples(len(self.rows) + len(self.lost))
        if model:
            made.CopyComponentNames(model)
        for array, fit, rows, first in ((current, fits[0], self.rows, 0), (reference, fits[1], self.lost, len(self.rows))):
            if len(rows):
                _set_rows(made, first, array if fit else None, rows)
        return made

    def fill_points(self, output: Any, now: Any, before: Any) -> None:
        known = now if now and now.GetNumberOfTuples() else before
        points = vtkPoints()
        points.SetData(self.combine(("Points", VTK_FLOAT if known and known.GetDataType() == VTK_FLOAT else VTK_DOUBLE, 3), now, before))
        output.SetPoints(points)
        output.SetVerts(cells(len(self.rows) + len(self.lost), 1))


def _set_rows(to: Any, first: int, array: Any, rows: Any) -> None:
    """Sets rows from the first one on to some rows of an array, or to nan, 0 or empty texts."""
    if not to.IsA("vtkDataArray") and array is None:
        return
    if to.IsA("vtkDataArray") and to.GetDataType() != VTK_BIT and all(each is None or each.HasStandardMemoryLayout() for each in (to, array)):
        values = vtk_to_numpy(to)
        none = numpy.nan if to.GetDataType() in (VTK_DOUBLE, VTK_FLOAT) else 0
        values[first:first + len(rows)] = none if array is None else vtk_to_numpy(array)[rows]
        return
    if array is None:
        array = vtkAbstractArray.CreateArray(to.GetDataType())
        array.SetNumberOfComponents(to.GetNumberOfComponents())
        array.SetNumberOfTuples(1)
        array.Fill(numpy.nan if to.GetDataType() in (VTK_DOUBLE, VTK_FLOAT) else 0)
        rows = numpy.zeros(len(rows), dtype=int)
    places, tuples = vtkIdList(), vtkIdList()
    for place, row in enumerate(rows.tolist(), first):
        places.InsertNextId(place)
        tuples.InsertNextId(row)
    to.InsertTuples(places, tuples, array)


def _fill_lines(output: Any, parts: list[tuple[Any, Any]]) -> None:
    """Makes lines of some cells of data sets, each with points of its own, which are doubles."""
    places, sizes = [numpy.empty((0, 3))], [numpy.empty(0, dtype=numpy.int64)]
    for data, chosen in parts:
        if len(chosen):
            ids, counts = _corners(data, chosen)
            places.append(vtk_to_numpy(data.GetPoints().GetData())[ids])
            sizes.append(counts)
    points, lines, values = vtkPoints(), vtkCellArray(), numpy.concatenate(places)
    points.SetDataTypeToDouble()
    if len(values):
        points.SetNumberOfPoints(len(values))
        vtk_to_numpy(points.GetData())[:] = values
    offsets = numpy.concatenate([[0], *sizes]).cumsum().astype(numpy.int64)
    if len(offsets) > 1:
        lines.SetData(numbers(None, offsets), numbers(None, numpy.arange(offsets[-1], dtype=numpy.int64)))
    output.SetPoints(points)
    output.SetLines(lines)


def _corners(data: Any, chosen: Any) -> tuple[Any, Any]:
    """Returns the points of some cells, one cell after the other, and how many each has. Raises Error for a cell that is no line."""
    if data.IsA("vtkPolyData") and data.GetNumberOfCells() == data.GetNumberOfLines():
        offsets, ids = vtk_to_numpy(data.GetLines().GetOffsetsArray()), vtk_to_numpy(data.GetLines().GetConnectivityArray())
        counts = (offsets[1:] - offsets[:-1])[chosen].astype(numpy.int64)
        if (counts >= 2).all():
            within = numpy.arange(counts.sum()) - numpy.repeat(counts.cumsum() - counts, counts)
            return ids[numpy.repeat(offsets[:-1][chosen], counts) + within], counts
    made, counted, corners = [], [], vtkIdList()
    for cell in chosen.tolist():
        kind = data.GetCellType(cell)
        if kind not in (VTK_LINE, VTK_POLY_LINE):
            raise c.Error(f"expected lines as cells, got a cell of the VTK type {kind} in row {cell} (the first is 0)")
        data.GetCellPoints(cell, corners)
        made += [corners.GetId(i) for i in range(corners.GetNumberOfIds())]
        counted.append(corners.GetNumberOfIds())
    return numpy.array(made, dtype=numpy.int64), numpy.array(counted, dtype=numpy.int64)


PATHS = {f"vtk{made.__name__}": made for made in (GranularCompare, GranularTrajectories, GranularHistory)}
