# SPDX-License-Identifier: BSD-3-Clause
"""The sources, which make particles without a file."""
from __future__ import annotations

from typing import Any

from ._arrays import Table, fill_lines, fill_particles
from ._filters import Filter


class GranularPackingSource(Filter):
    ports = ("vtkPolyData", "vtkUnstructuredGrid", "vtkPolyData")

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        grains, (particles, box, bonds) = tables[0], outputs
        fill_particles(particles, grains)
        if len(tables) > 1:
            fill_lines(bonds, tables[1])
        if self.piece[0] == 0:
            grains.fill_box(box)
        for output in outputs:
            grains.add_header(output.GetFieldData())
        for output in (particles, box):  # the columns are those of particles
            grains.add_columns(output.GetFieldData())


SOURCES = {f"vtk{made.__name__}": made for made in (GranularPackingSource,)}
