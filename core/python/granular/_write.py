# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and frames as files."""
from __future__ import annotations

import ctypes
import itertools
import math
import os
from typing import Any, Callable, Iterable, Mapping, Sized

from . import _library as c
from ._run import Box, Frame, Run, _Frames, _warn


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
        values = numpy.asarray(given)
        if values.dtype.kind in "OS":
            values = values.astype(str)
        if name == "points" and values.ndim == 3:
            name = "ends"
        if name == "ends" and values.ndim > 1 and math.prod(values.shape[1:]) == 6:
            values = values.astype(float).reshape(len(values), 6)
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
        values = numpy.ascontiguousarray(values, dtype=numpy.uint8 if values.dtype.kind == "b" else values.dtype.newbyteorder("="))
        array.data = values.ctypes.data
        kept.append(values)
        made.append(array)
    return (c.CArray * max(1, len(made)))(*made), rows or 0, kept


class Writer:
    """A file that is being written: see granular.write, which makes one.

    It appears under its name when the block is left without an error; until then the old file is untouched.

        with granular.Writer("run.dump") as writer:
            writer.write({"points": x, "v": v}, box=box, step=100)
    """

    def __init__(self, path: str | os.PathLike[str], style: str = "", dialect: str = "", columns: str | Iterable[str] = "",
                 numbers: str = "", label: str = "", scaled: bool = True, image: bool = False, sort: bool = False,
                 units: bool = False, times: bool = False, threads: int = 0, progress: Callable[[float], Any] | None = None):
        self._pointer: Any = None
        self.path = os.fspath(path)
        pointer = c.c_void_p()
        self._calls = c.Calls(progress, _warn)
        library, given = c.library(), c.Format()
        library.granular_format_init(c.byref(given))
        words = columns if isinstance(columns, str) else " ".join(columns)
        for name, value in (("style", style), ("dialect", dialect), ("columns", words), ("numbers", numbers), ("label", label)):
            setattr(given, name, (value or "").encode())
        given.scaled, given.image, given.sort_by_id = int(scaled), int(image), int(sort)
        given.write_units, given.write_time, given.threads = int(units), int(times), int(threads)
        given.progress, given.notice = self._calls.progress, self._calls.notice
        library.granular_create(os.fsencode(self.path), c.byref(given), c.byref(pointer))
        self._pointer = pointer

    def write(self, data: Frame | Mapping[str, Any], box: Box | Any = None, step: int = 0, time: float | None = None,
              units: str = "") -> None:
        """Adds a frame: one that was read, with the digits and columns of its file, or arrays by their names.

        "points" has the positions of particles, shape (n, 3), or of cells; lines have "points" of shape (n, 2, 3), both ends, and
        "id1", "id2"; subdomains have "lo", "hi" and, if known, "nlocal" and "proc".
        box    a granular.Box, or three pairs of bounds; None: made from the bounds of the particles
        step   the timestep; time, units: the time and ITEM: UNITS of the frame
        """
        if not self._pointer:
            raise ValueError(f"{self.path}: expected a file that is being written, got one that is finished")
        library = c.library()
        with self._calls:
            if isinstance(data, Frame):
                library.granular_write_frame(self._pointer, data._to_write())
            else:
                content = c.Content()
                library.granular_content_init(c.byref(content))
                arrays, rows, kept = _c_arrays(data)
                content.timestep, content.rows = int(step), rows
                content.has_time, content.time = int(time is not None), float(time or 0)
                content.units = units.encode()
                content.arrays, content.array_count = arrays, len(data)
                if box is not None:
                    boxed = (box if isinstance(box, Box) else Box(*zip(*box)))._to_c()
                    content.box = ctypes.pointer(boxed)
                library.granular_write(self._pointer, c.byref(content))
                del kept
        self._calls.notices.clear()

    def finish(self) -> None:
        """Gives the file its name."""
        pointer, self._pointer = self._pointer, None
        if pointer:
            c.library().granular_finish(pointer)

    def abandon(self) -> None:
        """Ends without the file; the old one is untouched."""
        pointer, self._pointer = self._pointer, None
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
          progress: Callable[[float], Any] | None = None) -> None:
    """Writes arrays, a frame, or the frames of a run. Needs neither VTK nor ParaView.

    path      the file. Its ending chooses the format: .bonds (contacts and bonds), .euler (cells), .decomposition (subdomains),
              .bin and .lammpsbin (binary dumps); all others are text dumps, compressed if .gz or .zst follows. `*` in the name
              stands for the timestep, and each frame gets a file.
    data      a Frame; a Run, a slice of one or an iterable of frames; or arrays by their names: "points", shape (n, 3), and any
              others with n rows. See granular.Writer for lines, cells and subdomains.
    box       a granular.Box, or three pairs of bounds; None: made from the bounds of the particles. With step, time and units it
              belongs to arrays; frames have their own.
    style     "custom", "atom", "local", "euler", "decomposition"; empty: by the ending
    dialect   "LIGGGHTS" or "LAMMPS"; of decompositions "PUBLIC" or "INL", of cells "LIGGGHTS" or "Wide"; empty: that of the file
              that a frame comes from, else LAMMPS, INL, Wide
    columns   columns or arrays in their order, as one text or a list; empty: all
    numbers   "Automatic" (default): the digits of the file, and what changed exactly; "%g", "%.9g", ... "shortest"
    label     the word for rows of contacts and bonds
    scaled, image  of style "atom": xs ys zs (default) or x y z; also ix iy iz
    sort      True: rows in the order of their ids
    threads   0 (default): one per core; progress: as for granular.open

    The file appears when it is complete; after an error the old one is untouched. Raises granular.Error with path and column,
    granular.ArgumentError for arrays of a wrong shape or type.
    """
    many = isinstance(data, _Frames) or not isinstance(data, Mapping)
    total = len(data) if many and isinstance(data, Sized) else 1
    done = 0
    frames = iter((data,) if isinstance(data, Frame) else data) if many or isinstance(data, Frame) else iter(())
    first = next(frames, None)
    if many and first is None:
        raise c.ArgumentError(f"{os.fspath(path)}: expected at least one frame, got none")
    if first is not None and not isinstance(first, Frame):
        raise c.ArgumentError(f"{os.fspath(path)}: expected frames, or one mapping of arrays, got {type(first).__name__} in a list")
    lammps = first is not None and first._kind == "dump" and (dialect or first.dialect) == "LAMMPS"

    def within(start: float) -> Callable[[float], Any] | None:
        """The progress of a half of a frame: it is read, and written."""
        return progress and (lambda fraction: progress((done + start + fraction / 2) / max(total, done + 1)))  # type: ignore[misc]

    with Writer(path, style or _style_of(first), dialect, columns, numbers, label, scaled, image, sort,
                bool(units) or bool(lammps and first.units), time is not None or bool(lammps and first._head("has_time")), threads,
                within(0.5)) as writer:
        if first is None:
            writer.write(data, box, step, time, units)  # type: ignore[arg-type]
            return
        for frame in itertools.chain((first,), frames):
            if not frame._is_lines():
                frame.read(within(0))
            writer.write(frame)
            done += 1


def _style_of(frame: Frame | None) -> str:
    """Frames of contacts, cells and subdomains are written as such, whatever the name."""
    if frame is None:
        return ""
    return "local" if frame._is_lines() else frame._kind if frame._kind in ("euler", "decomposition") else ""
