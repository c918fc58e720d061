# SPDX-License-Identifier: BSD-3-Clause
"""Sums and averages of particles and their contacts."""
from __future__ import annotations

from typing import Any

from vtkmodules.util.numpy_support import vtk_to_numpy

from ._arrays import Table, cells, pass_piece, pass_rows
from ._contents import add_lines, lines, particles
from ._filters import Filter
from ._ranks import is_own_piece


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


AVERAGES = {f"vtk{made.__name__}": made for made in (GranularContactSums,)}
