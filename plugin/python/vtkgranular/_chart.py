# SPDX-License-Identifier: BSD-3-Clause
"""Charts of tables and logs."""
from __future__ import annotations

import os
from typing import Any, Iterable

from ._folder import Series
from ._log import read_log, row_names
from ._table import read_table


def chart(path: str | os.PathLike[str], names: str | Iterable[str], dt: float | None = None, view: Any = None) -> Any:
    """Draws columns of a table or log against time, and returns their display.

    path, dt  a file and the time of a timestep, as for vtkgranular.read_table and read_log, whose errors it raises
    names     a column, or a list of columns; each row of a timestep, such as a layer, has a line of its own
    view      a line chart view; by default a new one
    """
    from paraview import simple

    path = os.path.abspath(os.fsdecode(path))
    read = read_log if Series("", [(path, os.path.getsize(path))], [], False).kind == "log" else read_table
    table = read(path, dt)
    lines = [line for name in ([names] if isinstance(names, str) else names) for line in row_names(name, table[name])]
    folder = os.path.dirname(os.path.dirname(__file__))
    script = (f"import sys\nif {folder!r} not in sys.path:\n    sys.path.append({folder!r})  # behind ParaView's own\nimport vtkgranular\n"
              f"self.GetTableOutput().ShallowCopy(vtkgranular.{read.__name__}({path!r}, dt={dt!r}).to_vtk())")
    source = simple.ProgrammableSource(registrationName=os.path.basename(path), OutputDataSetType="vtkTable", Script=script)
    display = simple.Show(source, view or simple.CreateView("XYChartView"))
    display.UseIndexForXAxis = 0
    display.XArrayName = "time"
    display.SeriesVisibility = lines
    return display
