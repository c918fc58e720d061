# SPDX-License-Identifier: BSD-3-Clause
"""The subdomains of the ranks of a simulation: a source, and a filter that counts particles in them."""
from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ._arrays import Table, fill_voxels, numbers
from ._contents import Content, particles, voxels
from ._filters import Filter


def _fill(output: Any, table: Table, origin: Any = 0) -> None:
    arrays = {name: vtk_to_numpy(array) for name, array in table.arrays.items()}
    fill_voxels(output, arrays, 0, len(arrays["lo"]), origin)


class GranularDecompositionSource(Filter):
    ports = ("vtkUnstructuredGrid",)

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        _fill(outputs[0], tables[0])
        tables[0].add_header(outputs[0].GetFieldData())
        outputs[0].GetFieldData().RemoveArray("timestep")  # it has none


class GranularDecomposition(Filter):
    ports, inputs, optional = ("vtkUnstructuredGrid",), (particles, voxels), (1,)

    def piece_of_inputs(self, piece: tuple[int, int]) -> tuple[int, int]:  # type: ignore[override]
        return piece if self.values["Mode"] == 3 else super().piece_of_inputs(piece)

    def take(self, port: int, frame: int) -> Content | None:
        made = super().take(port, frame)
        for text in made.told if port == 1 and made else ():
            self._told.warn(text)
        return made

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        (table, facts), given = tables, self.data[0].GetFieldData()
        origin = given.GetArray("PointOrigin")
        _fill(outputs[0], table, vtk_to_numpy(origin).reshape(3) if origin and origin.GetNumberOfValues() == 3 else 0)
        fields = outputs[0].GetFieldData()
        fields.PassData(given)
        fields.AddArray(facts.arrays["imbalance"])
        fields.AddArray(numbers("outside", vtk_to_numpy(facts.arrays["outside"]).astype(numpy.int64)))


SUBDOMAINS = {f"vtk{made.__name__}": made for made in (GranularDecompositionSource, GranularDecomposition)}
