# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and frames as files."""
from __future__ import annotations

import ctypes
import math
import operator
import os
import re
from typing import Any, Callable, Iterable, Mapping, Sized

from . import _library as c
from ._forms import FORMS, FormWriter, form_of
from ._run import Box, Column, Frame, Rows, Run, RunSlice, _columns_of, _warn, words_of


def _type_of(array: str, values: Any) -> int:
    name = values.dtype.name
    if values.dtype.kind in "US":
        return c.TEXT
    if values.dtype.kind == "b":
        return c.TYPES.index("uint8")
    if name not in c.TYPES:
        raise c.ArgumentError(f"array {array!r}: expected numbers of {', '.join(c.TYPES[:10])}, or words, got {name}")
    return c.TYPES.index(name)


def _c_arrays(arrays: Mapping[str, Any]) -> tuple[Any, int, list[Any]]:
    """The arrays as the library takes them, their rows, and what must stay until they are written."""
    import numpy

    made, kept, rows = [], [], None
    for name, given in arrays.items():
        if numpy.ma.is_masked(given):
            raise c.ArgumentError(f"array {name!r}: expected a value for each of {len(given)} rows, got masked ones")
        values = numpy.asarray(given)
        if values.dtype.kind in "OS":
            values = values.astype(str)
        if name == "points" and values.ndim == 3:
            name = "ends"
        if name == "ends" and values.ndim > 1 and math.prod(values.shape[1:]) == 6:
            values = values.astype(float, copy=False).reshape(len(values), 6)
        if name == "points" and values.dtype.kind in "iub":
            values = values.astype(float)
        if values.ndim not in (1, 2):
            raise c.ArgumentError(f"array {name!r}: expected a shape of (rows,) or (rows, components), got {values.shape}")
        if rows is not None and len(values) != rows:
            raise c.ArgumentError(f"array {name!r}: expected {rows} rows as in the arrays before, got {len(values)}")
        rows = len(values)
        array = c.CArray()
        array.name, array.rows = name.encode(), rows
        array.components = 1 if values.ndim == 1 else values.shape[1]
        array.type = _type_of(name, values)
        if array.type == c.TEXT:
            words, values = numpy.unique(values, return_inverse=True)
            encoded = c.texts([str(word) for word in words])
            values = values.astype(numpy.int32)
            array.words, array.word_count = encoded, len(words)
            kept.append(encoded)
        values = numpy.require(values, numpy.uint8 if values.dtype.kind == "b" else values.dtype.newbyteorder("="), ["C", "A"])
        array.data = values.ctypes.data
        kept.append(values)
        made.append(array)
    return (c.CArray * max(1, len(made)))(*made), rows or 0, kept


#: Endings of names that choose a style, and those of dumps; .gz and .zst may follow text.
STYLES = {".bonds": "local", ".decomposition": "decomposition", ".euler": "euler"}
DUMPS = (".dump", ".lammpstrj", ".liggghts", ".lammps", ".dmp")
BINARIES = (".bin", ".lammpsbin")


def ending_of(path: str) -> str:
    """Returns the ending of a name, which chooses its format: run.dump.gz, dump.1000 and dump_%.gz are ".dump"."""
    name = re.sub(r"\.(gz|zst)$", "", os.path.basename(path))
    ending = os.path.splitext(name)[1].lower()
    return ".dump" if name.startswith("dump") and ending not in (*BINARIES, ".vtk") else ending


class _Given(Frame):
    """Arrays of a program as a frame."""

    def __init__(self, data: Mapping[str, Any], box: Any, step: int, time: float | None):
        import numpy

        _c_arrays(data)  # which raises the errors of arrays
        self._run, self._kind, self._wanted, self._place = None, "dump", None, (_timestep(step), "")  # type: ignore[assignment]
        self._arrays = {name: numpy.asarray(values) for name, values in data.items()}
        self._bonds = "ends" in data or self._arrays.get("points", numpy.empty(0)).ndim == 3
        points = self._arrays.pop("ends", None) if "ends" in data else self._arrays.pop("points", None)
        kinds = {"O": str, "S": str, "b": numpy.uint8}
        self._arrays = {name: values.astype(kinds.get(values.dtype.kind, values.dtype)) for name, values in self._arrays.items()}
        columns = [Column(name, values.dtype.name, 1 if values.ndim == 1 else values.shape[1], "", "", ())
                   for name, values in self._arrays.items()]
        if points is not None:
            parts = 6 if self._bonds else 3
            if points.size != parts * len(points):
                raise c.ArgumentError(f"array {self._points_name()!r}: expected {parts} numbers a row, got the shape {points.shape}")
            self._arrays[self._points_name()] = points.astype(float).reshape(len(points), parts)
        self._offered = _columns_of(columns, [], "" if points is None else self._points_name())
        self._header = {"step": step, "time": float(step if time is None else time), "rows": len(next(iter(self._arrays.values()), ())),
                        "box": None if box is None else box if isinstance(box, Box) else Box(*zip(*box))}

    def _get(self, name: str) -> Any:
        return self._arrays[name]

    def read(self, progress: Callable[[float], Any] | None = None) -> Frame:
        return self


class Writer:
    """A file that is being written: see vtkgranular.write, which makes one.

    The file appears under its name when the block is left without an error; until then the old file is untouched. With `*` in the
    name, each frame has a file, which appears when it is complete.

        with vtkgranular.Writer("run.dump") as writer:
            writer.write({"points": x, "v": v}, box=box, step=100)
    """

    def __init__(self, path: str | os.PathLike[str], style: str = "", dialect: str = "", columns: str | Iterable[str] = "",
                 numbers: str = "", label: str = "", scaled: bool = True, image: bool = False, sort: bool = False, threads: int = 0,
                 progress: Callable[[float], Any] | None = None, durable: bool | None = None):
        self._pointer: Any = None
        self._form: FormWriter | None = None
        self.path = os.fsdecode(path)
        self._finished, self._sort = False, sort
        if form_of(self.path) and not style:
            others = {"dialect": dialect, "numbers": numbers, "label": label, "scaled": not scaled, "image": image}
            if any(others.values()):
                named = ", ".join(name for name, value in others.items() if value)
                raise c.ArgumentError(f"{c.shown(self.path)}: expected no {named}, which dumps have, got a name that ends in {form_of(self.path)}")
            self._form = FormWriter(self.path, words_of(columns), durable)
        self._calls = c.Calls(progress, _warn)
        self._format = given = c.Format()
        c.library().granular_format_init(c.byref(given))
        for name, value in (("style", style), ("dialect", dialect), ("columns", words_of(columns)), ("numbers", numbers), ("label", label)):
            setattr(given, name, (value or "").encode())
        given.scaled, given.image, given.sort_by_id, given.threads = int(scaled), int(image), int(sort), int(threads)
        given.progress, given.notice = self._calls.progress, self._calls.notice
        if durable is not None:
            given.durable = int(bool(durable))

    def _create(self, frame: Frame | None, has_time: bool, units: str) -> None:
        """Begins the file as the first frame asks for."""
        given = self._format
        kind = "" if frame is None else "local" if frame._is_lines() else frame._kind
        known = (*DUMPS, *BINARIES, *STYLES, *((".vtk",) if kind in ("euler", "decomposition") else ()))
        if not given.style and ending_of(self.path) not in known:
            raise c.ArgumentError(f"expected a name that ends in one of {', '.join((*known, *FORMS))} (text may be compressed: .gz, .zst), or a style, "
                                  f"got {self.path!r}")
        if frame is not None:
            given.style = given.style or (kind if kind in STYLES.values() else "").encode()
            # the dialect of LIGGGHTS has neither
            lammps = kind == "dump" and (given.dialect or frame.dialect.encode()) == b"LAMMPS"
            has_time, units = has_time or (lammps and frame._head("has_time")), units or (frame.units if lammps else "")
        given.write_time, given.write_units = int(has_time), int(bool(units))
        pointer = c.c_void_p()
        c.library().granular_create(c.name_bytes(self.path), c.byref(given), c.byref(pointer))
        self._pointer = pointer

    def write(self, data: Frame | Mapping[str, Any], box: Box | Any = None, step: int = 0, time: float | None = None,
              units: str = "") -> None:
        """Adds a frame: one that was read, with the digits and columns of its file, or arrays by their names.

        "points" has the positions of particles, shape (n, 3), or of cells; lines have "points" of shape (n, 2, 3), both ends, and
        "id1", "id2", and need the style "local" or the ending .bonds; subdomains have "lo", "hi" and, if known, "nlocal" and
        "proc".
        box    a vtkgranular.Box, or three pairs of bounds; None: made from the bounds of the particles
        step   the timestep; time, units: the time and ITEM: UNITS of the frame, which the first frame decides for all
        """
        if self._finished:
            raise c.ArgumentError(f"{c.shown(self.path)}: expected a file that is being written, got one that is finished")
        if not isinstance(data, (Frame, Mapping)):
            raise c.ArgumentError(f"{c.shown(self.path)}: expected a frame, or arrays by their names, got {type(data).__name__}")
        if isinstance(data, Frame) and data._run._ranks and data._run._ranks.size > 1:
            raise c.ArgumentError(f"{c.shown(self.path)}: expected arrays, or a frame of a run without ranks, got one of which this rank has a "
                                  "part: vtkgranular.save writes one file in pvbatch")
        if self._form:
            import numpy

            frame = data if isinstance(data, Frame) else _Given(data, box, step, time)
            self._form.add(Rows(frame, numpy.argsort(frame["id"], kind="stable")) if self._sort else frame)
            return
        library = c.library()
        with self._calls:
            if isinstance(data, Frame):
                if not self._pointer:
                    self._create(data, False, "")
                data._write(self._pointer)
                return
            content = c.Content()
            library.granular_content_init(c.byref(content))
            arrays, rows, kept = _c_arrays(data)
            content.timestep, content.rows = _timestep(step), rows
            content.has_time, content.time = int(time is not None), float(time or 0)
            content.units = units.encode()
            content.arrays, content.array_count = arrays, len(data)
            if box is not None:
                boxed = (box if isinstance(box, Box) else Box(*zip(*box)))._to_c()
                content.box = ctypes.pointer(boxed)
            if not self._pointer:
                self._create(None, time is not None, units)
            library.granular_write(self._pointer, c.byref(content))
            del kept

    def finish(self) -> None:
        """Gives the file its name. Raises ArgumentError if there is no frame."""
        if self._finished:
            return
        self._finished, pointer, self._pointer = True, self._pointer, None
        if not (self._form._written if self._form else pointer):
            raise c.ArgumentError(f"{c.shown(self.path)}: expected at least one frame, got none")
        if self._form:
            self._form.finish()
        else:
            c.library().granular_finish(pointer)

    def abandon(self) -> None:
        """Ends without the file; the old one is untouched."""
        self._finished, pointer, self._pointer = True, self._pointer, None
        if self._form:
            self._form.abandon()
        if pointer:
            c.library().granular_abandon(pointer)

    def __enter__(self) -> Writer:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if kind is None:
            self.finish()
        else:
            self.abandon()

    def __del__(self) -> None:
        self.abandon()


def write(path: str | os.PathLike[str], data: Frame | Run | Mapping[str, Any] | Iterable[Frame], *, box: Any = None, step: int = 0,
          time: float | None = None, units: str = "", style: str = "", dialect: str = "", columns: str | Iterable[str] = "",
          numbers: str = "", label: str = "", scaled: bool = True, image: bool = False, sort: bool = False, threads: int = 0,
          progress: Callable[[float], Any] | None = None, durable: bool | None = None) -> None:
    """Writes arrays, a frame, or the frames of a run. Needs neither VTK nor ParaView.

    path      the file. Its ending chooses the format: .bonds (contacts and bonds), .euler (cells), .decomposition (subdomains),
              .bin and .lammpsbin (binary dumps), .dump, .lammpstrj, .liggghts, .lammps, .dmp and names that begin with "dump" (text),
              compressed if .gz or .zst follows; .csv (a table, where rows of several frames begin with step and time), .npz (numpy),
              .vtp, .vtu and .vtkhdf (VTK), which hold one frame. With `*` in the name, which stands for the timestep, each frame
              has a file.
    data      a Frame, or rows of one, as frame[frame["type"] == 1]; a Run, a slice of one or an iterable of frames; or arrays by their
              names: "points", shape (n, 3), and any others with n rows. See vtkgranular.Writer for lines, cells and subdomains.
    box       a vtkgranular.Box, or three pairs of bounds; None: made from the bounds of the particles. Box, step, time and units
              belong to arrays; frames have their own.
    style     "custom", "atom", "local", "euler", "decomposition", with any name; empty: by the data and the ending
    dialect   "LIGGGHTS" or "LAMMPS"; of decompositions "PUBLIC" or "INL", of cells "LIGGGHTS" or "Wide"; empty: that of the file
              that a frame comes from, else LAMMPS, INL, Wide
    columns   columns or arrays in their order, as one text or a list; empty: all that the frame has
    numbers   "Automatic" (default): the digits of the file, and what changed exactly; "%g", "%.9g", ... "shortest"
    label     the word for rows of contacts and bonds; scaled, image: of style "atom" xs ys zs (default) or x y z, and also ix iy iz
    sort      True: rows in the order of their ids
    threads   0 (default): one per core; progress: as for vtkgranular.open
    durable   True: the file is on the disk before it gets its name, and survives a loss of power; False: the system writes it when
              it likes, and a file that is written in a loop takes less time; None (default): True for one file, False with `*`

    A file appears when it is complete; after an error the old file is untouched. With `*`, that holds for each file: those of earlier
    frames are there. A file of the run that a frame comes from, under any name, is replaced after the last frame.

    Raises vtkgranular.Error with path and column; vtkgranular.ArgumentError for arrays of a wrong shape or type, masked values, two arrays
    with the same column, coordinates beside "points", a name that says nothing of the format, and if there is no frame; ImportError
    where VTK is missing. Two frames of one timestep are an error, and in a table frames of different columns. It is an error to
    replace a file of the run that has an incomplete frame, because a simulation may be writing it, or pieces of frames.
    """
    is_arrays = isinstance(data, Mapping) and not isinstance(data, Frame)
    frames = [data] if is_arrays or isinstance(data, Frame) else data
    total = len(frames) if isinstance(frames, Sized) else 1
    done = 0

    def within(start: float) -> Callable[[float], Any] | None:
        """The progress of a half of a frame: it is read, and written."""
        return progress and (lambda fraction: progress((done + start + fraction / 2) / max(total, done + 1)))  # type: ignore[misc]

    with Writer(path, style, dialect, columns, numbers, label, scaled, image, sort, threads, within(0.5),
                durable) as writer:
        if writer._form and isinstance(frames, (Run, RunSlice)):
            for step in frames.steps.tolist():
                writer._form.expect_other(frames._run_of(), writer._form.path_of(step))
        for frame in frames:
            if is_arrays:
                writer.write(frame, box, step, time, units)  # type: ignore[arg-type]
                return
            if not isinstance(frame, Frame):
                raise c.ArgumentError(f"{writer.path}: expected frames, or arrays by their names, got {type(frame).__name__} in a list")
            if not frame._is_lines():
                frame.read(within(0))
            writer.write(frame)
            done += 1


def _timestep(step: Any) -> int:
    number = operator.index(step)
    if not -(1 << 63) <= number < 1 << 63:
        raise c.ArgumentError(f"expected a timestep of at most 64 bits, got {number}")
    return number
