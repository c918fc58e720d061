# SPDX-License-Identifier: BSD-3-Clause
"""Sums and averages of particles and their contacts."""
from __future__ import annotations

from typing import Any, Sequence

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataObjectTypes
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkExtentTranslator
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from ._algorithm import piece_of
from ._arrays import Table, cells, numbers, pass_piece, pass_rows
from ._contents import Content, add_lines, lines, particles, places, values_of
from ._filters import Filter
from ._frames import InputFrames
from ._ranks import is_own_piece, own_piece


class GranularContactSums(Filter):
    ports, inputs, optional = ("vtkPolyData", "vtkPolyData"), (particles, lines, lines), (1, 2)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        (sums, facts), given, output = tables[:2], self.data[0], outputs[0]
        rows = vtk_to_numpy(sums.arrays.pop("input_row"))
        if not is_own_piece(self.piece):
            pass_piece(given, rows[0] if len(rows) else 0, rows[-1] + 1 if len(rows) else 0, output)
        elif given.IsA("vtkPolyData"):
            output.CopyStructure(given)
            output.GetCellData().PassData(given.GetCellData())
            output.GetPointData().PassData(given.GetPointData())
        else:
            output.SetPoints(given.GetPoints())
            output.SetVerts(cells(len(rows), 1))
            output.GetPointData().PassData(given.GetPointData())
        for array in sums.arrays.values():
            output.GetPointData().AddArray(array)
        output.GetFieldData().PassData(given.GetFieldData())
        for array in facts.arrays.values():
            output.GetFieldData().AddArray(array)
        if len(tables) > 2:
            self._fill_lines(tables[2], outputs[1])

    def _fill_lines(self, friction: Table, output: Any) -> None:
        of_cells = vtk_to_numpy(friction.arrays.pop("input_cell"))
        add_lines(self.data[1], of_cells, output)
        pass_rows(self.data[1].GetCellData(), -1, of_cells, output.GetCellData())
        for array in friction.arrays.values():
            output.GetCellData().AddArray(array)
        output.GetFieldData().PassData(self.data[1].GetFieldData())


class _Average(Filter):
    """Base of the filters that average."""

    ports: tuple[str, ...] = ("vtkDataObject",)
    inputs, optional = (particles, lines, lines), (1, 2)

    def settings(self) -> dict[str, Any]:
        left_out = self.data[0] and self.data[0].GetFieldData().GetAbstractArray("ParticlesLeftOut")
        names = [str(name) for name in values_of(left_out)] if left_out else []
        return {**super().settings(), "LeftOut": ", ".join(names)}

    @staticmethod
    def set_output(outputs: Any, kind: str) -> int:
        """Makes the output one of this class."""
        info = outputs.GetInformationObject(0)
        data = vtkDataObject.GetData(info)
        if not data or not data.IsA(kind):
            info.Set(vtkDataObject.DATA_OBJECT(), vtkDataObjectTypes.NewDataObject(kind))
        return 1


class GranularPointAverage(_Average):
    inputs = (*_Average.inputs, places)

    def RequestDataObject(self, request: Any, inputs: Any, outputs: Any) -> int:
        points = vtkDataObject.GetData(inputs[3], 0)
        return self.set_output(outputs, points.GetClassName()) if points else 1

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        points, output = inputs[3].GetInformationObject(0), outputs.GetInformationObject(0)
        for key in (Pipeline.WHOLE_EXTENT(), vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), vtkDataObject.ORIGIN(), vtkDataObject.SPACING()):
            output.CopyEntry(points, key)  # structured points have an extent, and the times are those of the particles
        return 1 if output.Has(Pipeline.WHOLE_EXTENT()) else super().RequestInformation(request, inputs, outputs)

    def RequestUpdateExtent(self, request: Any, inputs: Any, outputs: Any) -> int:
        super().RequestUpdateExtent(request, inputs, outputs)
        points, output = inputs[3].GetInformationObject(0), outputs.GetInformationObject(0)
        piece, pieces = piece_of(output)
        points.Set(Pipeline.UPDATE_PIECE_NUMBER(), piece)
        points.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), pieces)
        if output.Has(Pipeline.UPDATE_EXTENT()):
            points.CopyEntry(output, Pipeline.UPDATE_EXTENT())
        return 1

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        given, points, output = self.data[0], self.data[3], outputs[0]
        output.ShallowCopy(points)
        for name, array in tables[0].arrays.items():
            if points.GetPointData().HasArray(name):
                array.SetName(name + "_avg")
            output.GetPointData().AddArray(array)
        for name in ("timestep", "time"):
            if given.GetFieldData().GetAbstractArray(name):
                output.GetFieldData().AddArray(given.GetFieldData().GetAbstractArray(name))


_POINTS, _IMAGE, _PROFILE = range(3)


class _CellAverage(_Average):
    """Base of the filters that average in cells."""

    output = _PROFILE

    def __init__(self) -> None:
        super().__init__()
        self._extra: dict[str, Any] = {}  # settings beside the properties
        self._whole = self._extent = (0, -1) * 3
        self._frames: dict[int, InputFrames] = {}
        self._times: list[float] = []
        self.data, self.piece = [None], (0, 1)

    def settings(self) -> dict[str, Any]:
        return {**super().settings(), **self._extra}

    def RequestDataObject(self, request: Any, inputs: Any, outputs: Any) -> int:
        return self.set_output(outputs, ("vtkPolyData", "vtkImageData", "vtkTable")[self.output])

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        info = outputs.GetInformationObject(0)
        keys = [vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), Pipeline.WHOLE_EXTENT()]
        for key in keys + ([Pipeline.TIME_STEPS(), Pipeline.TIME_RANGE()] if self.values["TimeAverage"] else []):
            info.Remove(key)
        if self.output != _IMAGE:
            return super().RequestInformation(request, inputs, outputs)

        self._whole = (0, -1) * 3

        def work() -> None:
            self._whole = tuple(int(bound) for count in self._find_counts() for bound in (0, count))
            info.Set(vtkAlgorithm.CAN_PRODUCE_SUB_EXTENT(), 1)
            info.Set(Pipeline.WHOLE_EXTENT(), self._whole, 6)
            info.Set(Pipeline.UNRESTRICTED_UPDATE_EXTENT(), 1)

        return self._guarded(work, outputs)  # the extent of an image is known before its data

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        self._extent = self._asked_extent(outputs.GetInformationObject(0))
        return super().RequestData(request, inputs, outputs)

    def _asked_extent(self, info: Any) -> tuple[int, ...]:
        """Returns the cells that are asked for; after an error these may be of an earlier whole, and are the piece of this one."""
        asked, whole = list(info.Get(Pipeline.UPDATE_EXTENT()) if info.Has(Pipeline.UPDATE_EXTENT()) else self._whole), self._whole
        if any(asked[k] < whole[k] or asked[k + 1] > whole[k + 1] for k in (0, 2, 4)):
            ghosts = info.Get(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS()) if info.Has(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS()) else 0
            vtkExtentTranslator().PieceToExtentThreadSafe(*piece_of(info), ghosts, list(whole), asked, vtkExtentTranslator.BLOCK_MODE, 0)
        return tuple(asked)

    def apply(self, split: bool = False, times: Sequence[float] = (), shown: int = 0) -> list[Table]:
        if self.output == _IMAGE and "GridOnly" not in self._extra:
            if self._whole[1] > 0:
                self._extra = {"CellRange": self._extent, "CellsBy": 0, "CellCounts": self._whole[1::2]}
            elif self._needs_frame():
                self._find_counts()  # raises again what RequestInformation told
                raise c.Error("the number of cells was not found before: update again")
        try:
            if not self.values["TimeAverage"]:
                return super().apply()
            self._frames = {port: InputFrames(self, port, self.piece_of_inputs(self.piece)) for port in range(3) if self.data[port]}
            self._times = self._frames[0].shared_times()
            return super().apply(times=self._times)
        finally:
            self._close()

    def _find_counts(self) -> Any:
        """Returns how many cells an image has along x, y and z."""
        self.data, self._extra, self.piece = [None], {"GridOnly": 1}, own_piece()
        try:
            return vtk_to_numpy(super().apply()[0].arrays["counts"]).ravel()
        finally:
            self._close()

    def _needs_frame(self) -> bool:
        """True if the cells of an image follow from a frame."""
        bounds, by = self.values["Bounds"], self.values["CellsBy"]
        return by == 2 or by == 1 and not all(lo <= hi and (lo or hi) for lo, hi in zip(bounds[::2], bounds[1::2]))

    def _close(self) -> None:
        for one in self._frames.values():
            one.close()
        self._extra, self._frames = {}, {}

    def take(self, port: int, frame: int) -> Content | None:
        if "GridOnly" in self._extra:  # cells that follow from a frame: the last one, because runs often begin without particles
            self._frames[port] = InputFrames(self, port, self.piece)
            self._times = self._frames[port].shared_times()[-1:]
        if port in self._frames:
            self._frames[port].update(self._times[frame] if self._times else None)
            self.data[port] = self._frames[port].data()
        return super().take(port, frame)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        (table, facts), output = tables, outputs[0]
        if self.output == _POINTS:
            output.SetPoints(table.points)
            output.SetVerts(cells(table.points.GetNumberOfPoints(), 1))
            attributes = output.GetPointData()
        elif self.output == _PROFILE:
            attributes = output.GetRowData()
            centres = vtk_to_numpy(table.points.GetData())
            attributes.AddArray(numbers("position", centres[:, self.values["ProfileAxis"]]))
        else:
            attributes = output.GetCellData()
            if all(self._extent[k] < self._extent[k + 1] for k in (0, 2, 4)):
                low, spacing = (vtk_to_numpy(facts.arrays[name]).ravel() for name in ("lo", "spacing"))
                output.SetOrigin(*(low - numpy.array(table.header.origin[:])).tolist())
                output.SetSpacing(*spacing.tolist())
                output.SetExtent(*self._extent)
        for name, array in table.arrays.items():
            attributes.AddArray(array)
            if (name, array.GetNumberOfComponents()) == ("volumefraction", 1):
                attributes.SetActiveScalars(name)
            if (name, array.GetNumberOfComponents()) == ("v_avg", 3):
                attributes.SetActiveVectors(name)
        fields = output.GetFieldData()
        fields.PassData(self.data[0].GetFieldData())
        fields.RemoveArray("Columns")  # of particles
        if table.header.has_box:
            table.add_header(fields)
        for name in ("timestep", "time") if self.values["TimeAverage"] else ():  # it is of no moment
            fields.RemoveArray(name)


class GranularEulerAverage(_CellAverage):
    @property
    def output(self) -> int:
        return self.values["Output"]


class GranularProfile(_CellAverage):
    pass


AVERAGES = {f"vtk{made.__name__}": made for made in (GranularContactSums, GranularPointAverage, GranularEulerAverage, GranularProfile)}
