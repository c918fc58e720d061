# SPDX-License-Identifier: BSD-3-Clause
"""Files that Python and VTK write: arrays of numpy, tables, and files of VTK."""
from __future__ import annotations

import contextlib
import csv
import errno
import os
from typing import IO, Any, Optional, cast

from . import _library as c
from ._inline import put_inline
from ._run import Frame, Run, arrays_of, component_columns
from ._whole_file import whole_file


def _write_npz(frame: Frame, path: str, words: list[str], _: str) -> None:
    import zipfile

    import numpy

    names, columns = arrays_of(frame, words) if words else (list(frame), [])
    box, points = frame.box, frame._points_name()
    found: dict[str, Any] = {"step": numpy.array(frame.step), "time": numpy.array(frame.time)}
    if box is not None:
        found |= {"box_origin": box.origin, "box_vectors": box.vectors}
    if frame._has_points() and (not words or {"x", "y", "z", "x1"} & set(columns)):
        found["points"] = frame.points
    found |= {name: frame[name] for name in names if name != points}
    # numpy.savez leaves the archive open after an error, and Python prints a traceback when it closes it
    with open(path, "wb") as stream, zipfile.ZipFile(stream, "w") as archive:
        for name, values in found.items():
            with archive.open(name + ".npy", "w", force_zip64=True) as member:
                numpy.lib.format.write_array(member, numpy.asanyarray(values), allow_pickle=False)


def _write_vtk(frame: Frame, path: str, words: list[str], ending: str) -> None:
    try:
        from vtkmodules.vtkFiltersCore import vtkAppendFilter
        from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
    except ImportError as error:
        raise ImportError(f"{ending} needs VTK for Python (Debian: python3-vtk9; pip: vtk): {error}") from error
    from ._to_vtk import to_vtk

    data = to_vtk(frame, arrays_of(frame, words)[0] if words else list(frame))
    if ending == ".vtu":
        append = vtkAppendFilter()
        append.AddInputData(data)
        append.Update()
        data, writer = append.GetOutput(), vtkXMLUnstructuredGridWriter()
    elif ending == ".vtp":
        writer = vtkXMLPolyDataWriter()
    else:
        try:
            from vtkmodules.vtkIOHDF import vtkHDFWriter
        except ImportError as error:
            raise ImportError(f".vtkhdf needs VTK 9.4 or later: {error}") from error
        writer = vtkHDFWriter()
    if ending != ".vtkhdf":
        writer.EncodeAppendedDataOff()
    writer.SetFileName(path)
    writer.SetInputData(data)
    if not writer.Write():
        raise OSError(errno.EIO, "VTK could not write it")
    put_inline(path, b'<?xml version="1.0"?>\n')  # VTK leaves it out of raw files, which are no XML


class _Csv:
    """A table of the rows of frames. The rows of several frames begin with their step and time."""

    def __init__(self, stream: IO[str], path: str, words: list[str]):
        self._writer, self._path, self._words = csv.writer(stream, lineterminator="\n"), path, words
        self._first: tuple[int, float, dict[str, Any]] | None = None
        self._several = False
        self._header: list[str] = []
        self._names: list[str] = []  # of frames without rows

    def add(self, frame: Frame) -> None:
        try:
            names = arrays_of(frame, self._words)[1]
        except c.ColumnError:
            if frame.rows:
                raise
            names = []  # a frame without rows may have no columns either
        columns = {name: frame[name] for name in names} if self._words else component_columns(frame)
        if self._first is None and not self._several:
            self._first = frame.step, frame.time, columns
            return
        if self._first:
            self._several, first, self._first = True, self._first, None
            self._put(*first)
        self._put(frame.step, frame.time, columns)

    def _put(self, step: int, time: float, columns: dict[str, Any]) -> None:
        values = {name: each.tolist() for name, each in columns.items()}  # the shortest digits that read back as the same number
        if self._several:
            rows = len(next(iter(values.values()), ()))
            values = {"step": [step] * rows, "time": [time] * rows} | values
        self._names = self._names or list(values)
        if not any(values.values()):
            return
        if not self._header:
            self._header = list(values)
            self._writer.writerow(self._header)
        elif self._header != list(values):
            raise c.ArgumentError(f"{c.shown(self._path)}: expected the columns {', '.join(self._header)} in all frames of a table, got "
                                  f"{', '.join(values)} in step {step}: choose columns, or write a file for each frame, with * in its name")
        self._writer.writerows(zip(*values.values()))

    def finish(self) -> None:
        if self._first:
            self._put(*self._first)
        if not self._header:
            self._writer.writerow(self._names)


_ONE_FRAME = {".npz": _write_npz, ".vtp": _write_vtk, ".vtu": _write_vtk, ".vtkhdf": _write_vtk}
FORMS = (".csv", *_ONE_FRAME)


def form_of(path: str) -> str:
    """Returns the ending of a name if it is one of FORMS, else an empty text."""
    ending = os.path.splitext(path)[1].lower()
    return ending if ending in FORMS else ""


class FormWriter:
    """Writes frames in a form of FORMS: a file for each frame with `*` in the name, else one file."""

    def __init__(self, path: str, columns: str, durable: bool | None):
        self._path, self._words, self._form = path, columns.replace(",", " ").split(), form_of(path)
        self._is_series = "*" in os.path.basename(path)
        self._durable = not self._is_series if durable is None else bool(durable)
        self._written: set[str] = set()
        self._temporary, self._failed = "", False
        self._open, self._table = contextlib.ExitStack(), cast(Optional[_Csv], None)
        self._read: dict[Any, set[tuple[int, int]]] = {}

    def path_of(self, step: int) -> str:
        """Returns the name of the file that a frame is written to."""
        folder, name = os.path.split(self._path)
        return os.path.join(folder, name.replace("*", str(step)))

    def expect_other(self, run: Run | None, path: str) -> None:
        """Raises ValueError for a file that is read: as a file of another kind it would be lost to the run."""
        if run is not None and os.path.exists(path):
            if run not in self._read:
                self._read = {run: {(state.st_dev, state.st_ino) for state in map(os.stat, run.files)}}
            state = os.stat(path)
            if (state.st_dev, state.st_ino) in self._read[run]:
                raise ValueError(f"{c.shown(path)}: expected another file to write, got one that is read")

    def add(self, frame: Frame) -> None:
        """Adds a frame."""
        path = self.path_of(frame.step)
        if path in self._written and (self._is_series or self._form != ".csv"):
            expected = f"frames of different timesteps, got two of step {frame.step}" if self._is_series else \
                f"* for the timestep in the name, or one frame: {self._form} holds one frame a file, and there are more"
            raise ValueError(f"{c.shown(path)}: expected {expected}")
        if path not in self._written:
            self._begin(path, frame)
        try:
            if self._table:
                self._table.add(frame)
            else:
                _ONE_FRAME[self._form](frame, self._temporary, self._words, self._form)
        except BaseException:
            self._failed = True
            with self._open:  # removes the file, and names its path in the error
                raise
        if self._is_series:
            self.finish()

    def _begin(self, path: str, frame: Frame) -> None:
        self.expect_other(frame._run, path)
        self._temporary = self._open.enter_context(whole_file(path, self._durable))
        self._written.add(path)
        if self._form == ".csv":
            self._table = _Csv(self._open.enter_context(open(self._temporary, "w", encoding="utf-8", newline="")), path, self._words)

    def finish(self) -> None:
        """Gives the file its name."""
        if self._failed:
            raise c.ArgumentError(f"{c.shown(self._path)}: expected whole frames, got one that could not be written", self._path)
        with self._open:
            table, self._table = self._table, None
            if table:
                table.finish()

    def abandon(self) -> None:
        """Ends without the file; the old one is untouched."""
        with contextlib.suppress(c.Cancelled), self._open:
            raise c.Cancelled
