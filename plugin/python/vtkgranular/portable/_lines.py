# SPDX-License-Identifier: BSD-3-Clause
"""Filters of contacts and bonds."""
from __future__ import annotations

from typing import Any

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from ._arrays import Table, fill_lines, pass_rows
from ._contents import Content, attributes_of, particles, rows_only
from ._filters import Filter
from ._frames import rows_of_timestep


class GranularLocalJoin(Filter):
    ports, inputs = ("vtkPolyData",), (particles, rows_only)

    def take(self, port: int, frame: int) -> Content | None:
        if port == 1:
            self.data[1] = rows_of_timestep(self, 1, self.data[0], self.piece_of_inputs(self.piece))
        made = super().take(port, frame)
        if port == 1 and len(self.GetInputInformation(1, 0).Get(Pipeline.TIME_STEPS()) or ()) < 2:
            made.timestep = c.NO_TIMESTEP  # lines of a single time, or none, are those of all times
        return made

    def apply(self, split: bool = False, **of_frames: Any) -> list[Table]:
        return super().apply(self.values["PeriodicLines"] == 1, **of_frames)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        (table, facts), output = tables, outputs[0]
        cells, points = output.GetCellData(), self.data[0].GetPointData()
        attributes, count = attributes_of(self.data[1])
        pass_rows(attributes, count, vtk_to_numpy(table.arrays.pop("input_row")), cells)
        for name in ("elongation", "strain", *(["part"] if facts.arrays["had_parts"].GetValue(0) else [])):  # of the input
            cells.RemoveArray(name)
        for name, array in table.arrays.items():
            named = points.GetAbstractArray(name[:name.rfind("_")])
            if named:
                array.CopyComponentNames(named)
        fields, of_rows = output.GetFieldData(), self.data[1].GetFieldData()
        fields.PassData(self.data[0].GetFieldData())
        fields.RemoveArray("Columns")  # of particles
        box = ("BoxOrigin", "BoxVectors", "BoxBounds", "Boundary") if facts.arrays["box_of_lines"].GetValue(0) else ()
        for name in ("Columns", "RowLabel", *box):
            if of_rows.GetAbstractArray(name):
                fields.AddArray(of_rows.GetAbstractArray(name))
        fill_lines(output, table)


LINES = {f"vtk{made.__name__}": made for made in (GranularLocalJoin,)}
