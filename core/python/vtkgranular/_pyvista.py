# SPDX-License-Identifier: BSD-3-Clause
"""Dumps in PyVista, which finds READER by its entry point pyvista.readers: pyvista.read("run.dump"), and
pyvista.get_reader("run.dump") with the times of the run."""
from __future__ import annotations

from typing import Any

import pyvista

from ._run import Run, open


class _RunReader(pyvista.BaseVTKReader):  # type: ignore[misc]
    """A run as PyVista's readers use readers of VTK. The shown frame is the last one by default: the first one is often empty."""

    def __init__(self) -> None:
        super().__init__()
        self.run: Run | None = None
        self.dt: float | None = None
        self.shown = -1

    def UpdateInformation(self) -> None:
        self.run = open(self._filename, dt=self.dt)

    def Update(self) -> None:
        assert self.run is not None
        self._data_object = self.run[self.shown].to_vtk() if len(self.run) else pyvista.PolyData()


class DumpReader(pyvista.BaseReader, pyvista.TimeReader):  # type: ignore[misc]
    """Reads a frame of a dump as particles, with the field data timestep and time."""

    _vtk_class_name = ""
    _class_reader = _RunReader

    @property
    def dt(self) -> float | None:
        """Time of one timestep; None stands for 1, or the times in the file."""
        return self.reader.dt  # type: ignore[no-any-return]

    @dt.setter
    def dt(self, value: float | None) -> None:
        self.reader.dt = value
        self.reader.UpdateInformation()

    @property
    def number_time_points(self) -> int:
        return len(self.reader.run)

    def time_point_value(self, time_point: int) -> float:
        return float(self.reader.run.times[time_point])

    @property
    def active_time_value(self) -> float:
        return self.time_point_value(self.reader.shown)

    @active_time_value.setter
    def active_time_value(self, value: float) -> None:
        self.set_active_time_value(value)

    def set_active_time_value(self, time_value: float) -> None:
        times = self.time_values
        if time_value not in times:
            raise ValueError(f"time {time_value}: expected one of {times}")
        self.reader.shown = times.index(time_value)

    def set_active_time_point(self, time_point: int) -> None:
        self.reader.run[time_point]  # an error of its own if there is no such frame
        self.reader.shown = time_point


def read(path: str, **attributes: Any) -> Any:
    """Returns a frame for versions of PyVista whose entry points are functions. attributes: of DumpReader."""
    reader = DumpReader(path)
    for name, value in attributes.items():
        setattr(reader, name, value)
    return reader.read()


def _takes_classes() -> bool:
    from pyvista.core.utilities import reader_registry

    return "reader_class" in reader_registry.ReaderRegistration._fields


READER = DumpReader if _takes_classes() else read
