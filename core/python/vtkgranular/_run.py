# SPDX-License-Identifier: BSD-3-Clause
"""Runs and frames: files as numpy arrays, read when they are asked for."""
from __future__ import annotations

import _thread
import operator
import os
import sys
import threading
import time
import warnings
import weakref
from collections import namedtuple
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, NoReturn, Sequence

from . import _library as c
from ._options import FILES, FRAME, KINDS, Option

if TYPE_CHECKING:
    import numpy
    import pandas

#: An array that a frame has in its file: name, numpy's name of its type ("str" for words), components, unit (of runs in SI units),
#: meaning, and the columns of the file that make it, ("vx", "vy", "vz").
Column = namedtuple("Column", "name type components unit meaning columns")

#: What a file offers: its usual columns and the others, the names of the components of each array, and for each word that names an array
#: or a component, the array and its place there, or None for the whole array.
_Columns = namedtuple("_Columns", "usual others parts words")


def _choice(what: str, given: str, choices: Sequence[str]) -> int:
    if given not in choices:
        raise c.ArgumentError(f"expected {what} of {', '.join(choices)}, got {given!r}")
    return choices.index(given)


#: What the integers of the library hold, which cut off what is more.
_LARGEST = {"int": 2**31 - 1, "threads": 2**31 - 1, "count": 2**63 - 1}


def _fill(struct: c.Structure, options: tuple[Option, ...], given: dict[str, Any]) -> None:
    """Fills a struct of the library with the options that were given."""
    for option in options:
        value = given.get(option.name)
        if value is None:
            continue
        if option.type in ("text", "names"):
            setattr(struct, option.c, words_of(value).encode())
        elif option.type == "choice":
            setattr(struct, option.c, _choice(option.name, value, option.choices))
        elif option.type == "point":
            getattr(struct, option.c)[:] = [float(x) for x in value]
        elif option.type == "region":
            getattr(struct, option.c)[:] = _region(value)
        elif option.type in _LARGEST:
            number, largest = operator.index(value), _LARGEST[option.type]
            if not option.minimum <= number <= largest:
                raise c.ArgumentError(f"expected {option.name} from {option.minimum} to {largest}, got {number}")
            setattr(struct, option.c, number)
        else:
            setattr(struct, option.c, {"flag": bool, "number": float}[option.type](value))


def words_of(given: str | Iterable[str] | None) -> str:
    """Names as one text, or as a list."""
    return given if isinstance(given, str) else " ".join(given or ())


def _warn(text: str | Warning) -> None:
    """Warns at the line of the caller of this package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)


class Box:
    """A simulation box.

    origin    its corner, shape (3,)
    vectors   its edges a, b, c, shape (3, 3), one in each row
    lo, hi    the bounds in a dump's header, shape (3,): of a tilted box, of the smallest box around it
    tilts     xy, xz, yz, shape (3,)
    boundary  "pp pp ff"; empty if it is not known
    """

    def __init__(self, lo: Any = None, hi: Any = None, tilts: Any = (0, 0, 0), boundary: str = "", origin: Any = None,
                 vectors: Any = None):
        import numpy

        self.boundary = boundary
        self.general = vectors is not None
        if self.general:
            self.origin = numpy.array((0, 0, 0) if origin is None else origin, dtype=float).reshape(3)
            self.vectors = numpy.array(vectors, dtype=float).reshape(3, 3)
            corners = numpy.array([self.origin + [i, j, k] @ self.vectors for i in (0, 1) for j in (0, 1) for k in (0, 1)])
            self.lo, self.hi, self.tilts = corners.min(axis=0), corners.max(axis=0), self.vectors[[1, 2, 2], [0, 0, 1]]
        elif lo is None or hi is None:
            raise c.ArgumentError("expected bounds lo and hi, or vectors")
        else:
            self.lo, self.hi, self.tilts = (numpy.array(each, dtype=float).reshape(3) for each in (lo, hi, tilts))
            box = c.CBox()
            box.has_bounds, box.bounds[:] = 1, self._bounds()
            c.library().granular_complete_box(c.byref(box))
            self.origin, self.vectors = numpy.array(box.origin[:]), numpy.array(box.vectors[:]).reshape(3, 3)
        for each in (self.lo, self.hi, self.tilts, self.origin, self.vectors):
            each.flags.writeable = False  # they belong together

    def _bounds(self) -> list[float]:
        return [number for pair in zip(self.lo, self.hi) for number in pair] + list(self.tilts)

    @classmethod
    def _of(cls, box: c.CBox) -> Box:
        boundary = c.text(box.boundary)
        if not box.has_bounds:
            return cls(origin=box.origin[:], vectors=box.vectors[:], boundary=boundary)
        return cls(box.bounds[0:6:2], box.bounds[1:6:2], box.bounds[6:9], boundary)

    def _to_c(self) -> c.CBox:
        box = c.CBox()
        if not self.general:
            box.has_bounds, box.bounds[:] = 1, self._bounds()
        box.origin[:], box.vectors[:] = list(self.origin), list(self.vectors.ravel())
        box.boundary = self.boundary.encode()
        return box

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Box) and self.boundary == other.boundary and \
            bool((self.origin == other.origin).all() and (self.vectors == other.vectors).all())

    def __repr__(self) -> str:
        if self.general:
            return f"Box(origin={self.origin.tolist()}, vectors={self.vectors.tolist()}, boundary={self.boundary!r})"
        return f"Box(lo={self.lo.tolist()}, hi={self.hi.tolist()}, tilts={self.tilts.tolist()}, boundary={self.boundary!r})"


def _interrupt_again() -> None:
    time.sleep(0.01)
    _thread.interrupt_main()


class _Handle:
    """A run or a frame of the library, which is freed when nobody keeps it any longer: arrays keep their frame, and a thread that
    reads keeps the run that another one closes."""

    def __init__(self, pointer: Any, free: Any):
        self._as_parameter_, self._free = pointer, free

    def __del__(self) -> None:
        try:
            self._free(self._as_parameter_)
        except KeyboardInterrupt:  # Python drops what is raised here: once more, when this has ended
            _thread.start_new_thread(_interrupt_again, ())


class _Memory:
    """An array of the library as numpy asks for it."""

    def __init__(self, handle: _Handle, array: c.CArray):
        import numpy

        self.handle = handle
        shape = (array.rows, array.components) if array.components > 1 else (array.rows,)
        self.__array_interface__ = {"shape": shape, "typestr": numpy.dtype(c.TYPES[array.type]).str, "version": 3,
                                    "data": (array.data or 1, True)}


def _to_numpy(handle: _Handle, array: c.CArray) -> numpy.ndarray:
    import numpy

    if array.rows == 0 or not array.data:
        shape = (0, array.components) if array.components > 1 else (0,)
        return numpy.empty(shape, dtype="<U1" if array.type == c.TEXT else c.TYPES[array.type])
    values = numpy.asarray(_Memory(handle, array))
    if array.type != c.TEXT:
        return values
    words = numpy.array([c.text(array.words[i]) for i in range(array.word_count)], dtype=str)
    return words[values]


class Frame(Mapping[str, Any]):
    """One frame of a run: a mapping of names to numpy arrays.

    frame["v"]      a column, or columns that form a vector: shape (rows,) or (rows, components)
    frame[rows]     a frame of some rows, by a mask, indices or a slice as numpy has them: frame[frame["type"] == 1]
    frame.points    positions of particles, centres of cells, or the ends of lines, which have shape (rows, 2, 3)
    frame.step, frame.time, frame.box, frame.units, frame.label
    frame.bonds     of restart and data files: the bonds as a frame of their own

    Arrays are read-only views of the memory that the file was decoded into; they keep it, also after the run is closed. Copy an
    array to change it. The file is read when the first array is asked for, and only this column is converted; a second
    column reads all that are left.

    A frame belongs to one timestep of one file, also if it is pickled. Reading raises ArgumentError if the run has another frame at
    its number by now, or if a part of the frame was read before the run was refreshed: take the frame anew.
    """

    def __init__(self, run: Run, number: int, request: dict[str, Any] | None = None, bonds: bool = False,
                 place: tuple[int, str] | None = None):
        self._run, self._number, self._bonds, self._kind = run, number, bonds, run.kind
        self._state, self._place = (None, place) if place else run._place_of(number)
        self._offered: Any = None
        self._request = dict(request or {})
        wanted = self._request.pop("columns", None)
        self._wanted: list[str] | None = None if wanted is None else list(wanted)
        self._arrays: dict[str, Any] = {}
        self._header: Any = None
        self._whole: _Handle | None = None
        self._asked: dict[str, None] = {}
        self._notices: list[c.Remark] = []
        self._lock = threading.RLock()  # a function for progress may ask the frame something

    # ---- reading ----
    def _current(self) -> int:
        """Returns the number of the frame. Raises ArgumentError if the run has another frame there, or may have since a part was read."""
        if self._state is not self._run._state:
            state, place = self._run._place_of(self._number) if self._number < len(self._run) else (None, None)
            if place != self._place or self._header is not None:
                step, path = self._place
                found = "no such frame" if place is None else f"timestep {place[0]} of {c.shown(place[1])}" if place != self._place else \
                    "files that were looked through again"
                raise c.ArgumentError(f"{c.shown(path)}: expected frame {self._number} to be timestep {step} as it was, got {found}: take the "
                                      "frame anew", path)
            self._state, self._offered = state, None
        return self._number

    def _load(self, names: list[str] | None, progress: Any = None, warn: Any = _warn) -> _Handle:
        """Reads arrays, or all usual ones and the points."""
        handle = self._run._read(self._current(), names, self._bonds, self._request, progress, warn)
        if self._header is not None:
            self._current()  # another thread may have refreshed the run
        library = c.library()
        header = c.FrameHeader()
        library.granular_header(handle, c.byref(header))
        for i in range(header.arrays):
            array = c.CArray()
            library.granular_array_at(handle, i, c.byref(array))
            self._arrays.setdefault(c.text(array.name), _to_numpy(handle, array))
        self._columns()
        columns = c.text(header.columns).split()
        self._header = {"step": header.timestep, "time": header.time, "has_time": bool(header.has_time), "rows": header.rows,
                        "units": c.text(header.units), "label": c.text(header.label), "columns": columns,
                        "digits": dict(zip(columns, header.digits[:header.digit_count])), "dialect": c.text(header.dialect),
                        "row_label": c.text(header.row_label), "shape_sizes": c.text(header.shape_sizes),
                        "groups": [c.text(name) for name in header.groups[:header.group_count]],
                        "type_names": [c.text(name) for name in header.type_names[:header.type_name_count]],
                        "box": Box._of(header.box) if header.has_box else None}
        return handle

    def _tell(self) -> None:
        """What another thread was told when it read ahead."""
        while self._notices:
            _warn(self._notices.pop(0))

    def _load_all(self, progress: Any = None) -> _Handle:
        with self._lock:
            self._tell()
            if self._whole is None:
                self._whole = self._load(self._names(), progress)
            return self._whole

    def _names(self) -> list[str] | None:
        """What is read at most: None stands for all usual arrays."""
        if self._wanted is None:
            return None
        return list(dict.fromkeys([self._points_name(), *self._wanted]))

    def _points_name(self) -> str:
        return "ends" if self._is_lines() else "points"

    def _has_points(self) -> bool:
        """True if a frame that was read has positions, or lines have ends."""
        return self._points_name() in self._arrays

    def _is_lines(self) -> bool:
        return self._bonds or self._kind == "local"

    def _columns(self) -> _Columns:
        """The columns of the file; they stay when the run is closed."""
        if self._offered is None:
            self._offered = self._run._columns(self._current(), self._bonds)
        return self._offered

    def _get(self, name: str) -> Any:
        if name not in self._arrays:
            if self._whole is None and not self._asked:
                with self._lock:
                    self._load([name])
            else:
                self._load_all()
            if name not in self._arrays:  # not a usual one
                with self._lock:
                    self._load([name])
        if name not in self._arrays:
            path = self._place[1]
            raise c.ColumnError(f"{c.shown(path)}: expected a file with positions, got one with {', '.join(self)}", path)
        self._asked[name] = None
        self._tell()
        return self._arrays[name]

    def _raise_no_column(self, name: str) -> NoReturn:
        if self._is_lines():
            self._head("rows")  # says why, if the meaning of the columns is not known
        raise c.ColumnError(f"expected a column of {', '.join(self._columns().parts)}, got {name!r}")

    def _head(self, name: str) -> Any:
        if self._header is None:
            with self._lock:
                self._load([] if not self._is_lines() else ["id1"] if "id1" in self else list(self)[:1])
        return self._header[name]

    def _to_write(self) -> _Handle:
        """The frame as it is written: of contacts and bonds, the ends as the file has them."""
        if not self._is_lines() or self._wanted is not None:
            return self._load_all()
        names = list(self._columns().parts)
        ends = [] if {"position1", "position2"} <= set(names) else ["ends"]
        whole = {name: value for name, value in self._request.items() if name != "periodic_lines"}
        return self._run._read(self._current(), [*names, *ends], self._bonds, whole, None)

    def _is_array(self, name: object) -> bool:
        return name in self._columns().parts

    def _find(self, word: str) -> tuple[str, int | None]:
        """The array that a column is in, and its place there, or None for a whole array: "vx" is the first of "v"."""
        return self._columns().words.get(word) or self._raise_no_column(word)

    # ---- the mapping ----
    def __getitem__(self, name: Any) -> Any:
        if not isinstance(name, str):
            return Rows(self, name)
        if self._is_array(name) or name in ("points", "ends", "length"):
            return self._get(name)
        array, place = self._find(name)
        return self._get(array)[:, place]

    def __iter__(self) -> Iterator[str]:
        if self._wanted is None:
            return iter([column.name for column in self._columns().usual])
        return iter([name for name in self._wanted if self._is_array(name)])

    def __contains__(self, name: object) -> bool:
        return name in self._columns().words

    def __len__(self) -> int:
        """The number of columns; rows are frame.rows."""
        return len(list(iter(self)))

    # ---- facts ----
    @property
    def number(self) -> int:
        """The number of the frame in its run, from 0."""
        return self._number

    @property
    def step(self) -> int:
        """The timestep."""
        return self._place[0]

    @property
    def time(self) -> float:
        """ITEM: TIME of the file, or timestep x dt."""
        if self._header is not None:
            return self._header["time"]
        return self._run.times[self._current()].item()

    @property
    def rows(self) -> int:
        """The number of particles, contacts, bonds, cells or subdomains that were read."""
        return self._head("rows")

    @property
    def box(self) -> Box | None:
        """The simulation box; None if the file has none."""
        return self._head("box")

    @property
    def units(self) -> str:
        """ITEM: UNITS of a dump."""
        return self._head("units")

    @property
    def label(self) -> str:
        """ITEM: LABEL of a dump."""
        return self._head("label")

    @property
    def dialect(self) -> str:
        """"LIGGGHTS" or "LAMMPS", by the form of a dump; empty if it is not known."""
        return self._head("dialect")

    @property
    def row_label(self) -> str:
        """The word for rows in ITEM: NUMBER OF ...: "ATOMS", "ENTRIES"."""
        return self._head("row_label")

    @property
    def shape_sizes(self) -> str:
        """Of the array `shape`: "half axes" or "diameters"; empty if there is none."""
        return self._head("shape_sizes")

    @property
    def groups(self) -> list[str]:
        """The names of the groups of a restart file; empty of other files."""
        return self._head("groups")

    @property
    def type_names(self) -> list[str]:
        """The labels of types from 1 on in a data file that has them; of `bonds` those of types of bonds."""
        return self._head("type_names")

    @property
    def columns(self) -> list[str]:
        """The columns of the file, in its order and spelling."""
        return self._head("columns")

    @property
    def digits(self) -> dict[str, int]:
        """The largest number of digits of each column of a text, in its first rows; 0 for integers and words; empty of other files."""
        return self._head("digits")

    @property
    def points(self) -> numpy.ndarray:
        """Positions, shape (rows, 3); of lines both ends, shape (rows, 2, 3)."""
        if self._is_lines():
            return self._get("ends").reshape(-1, 2, 3)
        return self._get("points")

    @property
    def bonds(self) -> Frame:
        """The bonds of a restart or data file, of the part of the frame that was asked for. Raises ValueError for other files."""
        if self._kind not in ("restart", "data"):
            raise c.ArgumentError(f"expected a restart or data file, got a {self._kind} file: open the file of its bonds")
        return Frame(self._run, self._number, self._request, bonds=True, place=self._place)

    def read(self, progress: Callable[[float], Any] | None = None) -> Frame:
        """Reads all that is wanted at once, and returns the frame itself."""
        self._load_all(progress)
        return self

    def _write(self, writer: Any) -> None:
        """Adds the frame to a file of the library."""
        c.library().granular_write_frame(writer, self._to_write())

    # ---- other libraries ----
    def to_pandas(self) -> pandas.DataFrame:
        """Returns the rows as a pandas.DataFrame, a column for each component: x y z, id, vx vy vz, c_stress[1], ..."""
        import pandas

        return pandas.DataFrame(component_columns(self))

    def to_vtk(self) -> Any:
        """Returns a vtkPolyData with the points or lines and all arrays. Needs VTK."""
        from ._to_vtk import to_vtk

        return to_vtk(self.read(), self)

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    def __reduce__(self) -> Any:
        request = dict(self._request) if self._wanted is None else {**self._request, "columns": self._wanted}
        return Frame, (self._run, self._number, request, self._bonds, self._place)

    def __repr__(self) -> str:
        return f"<frame {self._number} of {self._run!r}: step {self.step}, columns {' '.join(self)}>"


class Rows(Frame):
    """Some rows of a frame, which is read when they are asked for."""

    def __init__(self, frame: Frame, rows: Any):
        import numpy

        chosen = numpy.arange(frame.rows)[rows]
        if chosen.ndim != 1:
            raise IndexError(f"expected the name of a column, or rows by a mask, indices or a slice, got {rows!r}")
        self.__dict__.update(frame.__dict__)
        self._arrays = {}
        self._frame, self._rows = (frame._frame, frame._rows[chosen]) if isinstance(frame, Rows) else (frame, chosen)

    def _get(self, name: str) -> Any:
        if name not in self._arrays:
            self._arrays[name] = self._frame._get(name)[self._rows]
        return self._arrays[name]

    def _head(self, name: str) -> Any:
        return len(self._rows) if name == "rows" else self._frame._head(name)

    def _has_points(self) -> bool:
        return self._frame._has_points()

    def _columns(self) -> _Columns:
        return self._frame._columns()

    def read(self, progress: Callable[[float], Any] | None = None) -> Frame:
        self._frame.read(progress)
        return self

    def _write(self, writer: Any) -> None:
        """Adds the rows to a file, with the digits and the columns of the frame's file."""
        import numpy

        library, handle, header, content = c.library(), self._frame._to_write(), c.FrameHeader(), c.Content()
        library.granular_header(handle, c.byref(header))
        if header.rows != self._frame.rows:
            raise c.ArgumentError("expected rows of the file to write, got parts of lines: periodic_lines=\"split\" made them")
        arrays, kept = (c.CArray * max(1, header.arrays))(), []
        for i in range(header.arrays):
            library.granular_array_at(handle, i, c.byref(arrays[i]))
            kept.append(numpy.asarray(_Memory(handle, arrays[i]))[self._rows])
            arrays[i].rows, arrays[i].data = len(self._rows), kept[-1].ctypes.data
        names, offered = {c.text(array.name) for array in arrays[:header.arrays]}, self._columns()
        if {"position1", "position2"} <= names:  # the ends as the file has them
            arrays = (c.CArray * header.arrays)(*(array for array in arrays if array.name != b"ends"))
        read = {part for column in (*offered.usual, *offered.others) for part in column.columns
                if column.name in names or ("points" in names and column in offered.others)}
        columns = c.text(header.columns).split()
        places = [i for i, column in enumerate(columns) if column in read]  # a writer makes up the others
        header.columns = " ".join(columns[i] for i in places).encode()
        if header.digit_count:
            header.digits, header.digit_count = (c.c_int * max(1, len(places)))(*(header.digits[i] for i in places)), len(places)
        library.granular_content_init(c.byref(content))
        content.timestep, content.has_time, content.time, content.units = header.timestep, header.has_time, header.time, header.units
        content.rows, content.header = len(self._rows), c.pointer(header)
        content.arrays, content.array_count = arrays, sum(1 for array in arrays if array.name)
        if header.has_box:
            content.box = c.pointer(header.box)
        library.granular_add_input(writer, self._run._open())
        library.granular_write(writer, c.byref(content))

    @property
    def bonds(self) -> Frame:
        """The bonds between these particles."""
        import numpy

        bonds = self._frame.bonds
        return bonds[numpy.isin(bonds["id1"], self["id"]) & numpy.isin(bonds["id2"], self["id"])]

    def __reduce__(self) -> Any:
        return Rows, (self._frame, self._rows)

    def __repr__(self) -> str:
        return f"<{len(self._rows)} rows of {self._frame!r}>"


_COMPONENTS = {"points": ("x", "y", "z"), "ends": ("x1", "y1", "z1", "x2", "y2", "z2"), "": ()}

# Components of tensors, by ParaView's names for them.
_TENSORS = {"sigma": "XX YY ZZ", "tau": "XY XZ YZ"} | dict.fromkeys(("fabric", "contact_stress"), "XX YY ZZ XY XZ YZ")


def _component_names(column: Column) -> Sequence[str]:
    """The columns that make an array, or names like theirs of one that no columns make."""
    if column.components == 1:
        return [column.name]
    if column.columns:
        return column.columns
    if column.name == "image":
        return "ix", "iy", "iz"
    tensor = _TENSORS.get(column.name.removesuffix("_kinetic").removesuffix("_contact"), "").split()
    if len(tensor) == column.components:
        return [f"{column.name}_{part}" for part in tensor]
    if "_" not in column.name and column.components == 3:
        return [column.name + axis for axis in "xyz"]
    return [f"{column.name}[{i}]" for i in range(1, column.components + 1)]


def _columns_of(usual: list[Column], others: list[Column], points: str) -> _Columns:
    parts = {column.name: _component_names(column) for column in (*usual, *others)}
    words: dict[str, tuple[str, int | None]] = {part: (points, i) for i, part in enumerate(_COMPONENTS[points])}
    words |= {name: (name, None) for name in (points, *parts) if name and name not in words}
    for name, names in parts.items():
        for i, part in enumerate(names):
            words.setdefault(part, (name, i))
    return _Columns(usual, others, parts, words)


def component_columns(frame: Frame) -> dict[str, Any]:
    """Returns what a frame holds as arrays of shape (rows,): points as x y z, vectors by components, in the order of the frame."""
    frame.read()
    columns: dict[str, Any] = {}
    for name in (frame._points_name(), *frame):
        if frame._has_points() or frame._is_array(name):
            values = frame._get(name)
            parts = [values] if values.ndim == 1 else values.T
            for part, component in zip(_COMPONENTS.get(name) or frame._columns().parts[name], parts):
                columns.setdefault(part, component)
    return columns


def arrays_of(frame: Frame, words: list[str]) -> tuple[list[str], list[str]]:
    """Returns the arrays that columns named by words are in, and the columns: "vx" is in "v", and "v" has vx vy vz."""
    arrays, columns = [], []
    for word in words:
        array, place = frame._find(word)
        arrays.append(array)
        columns += [word] if place is not None else _COMPONENTS.get(array) or frame._columns().parts[array]
    return list(dict.fromkeys(arrays)), columns


class _Frames(Sequence[Frame]):
    """Frames in some order: a run or a slice of one."""

    _request: dict[str, Any] = {}  # what is read of each

    def _run_of(self) -> Run:
        raise NotImplementedError

    def _numbers(self) -> range:
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self._numbers())

    @property
    def steps(self) -> numpy.ndarray:
        """The timesteps, shape (frames,), int64."""
        return self._run_of()._facts()[0][self._as_slice()]

    @property
    def times(self) -> numpy.ndarray:
        """The times, shape (frames,), float64: ITEM: TIME of the file, or timestep x dt."""
        return self._run_of()._facts()[1][self._as_slice()]

    @property
    def rows(self) -> numpy.ndarray:
        """The numbers of rows that the headers of the frames tell, shape (frames,), int64."""
        return self._run_of()._facts()[2][self._as_slice()]

    def _as_slice(self) -> Any:
        numbers = self._numbers()
        stop = numbers.stop if numbers.stop >= 0 else None
        return slice(numbers.start, stop, numbers.step) if len(numbers) else slice(0, 0)

    def __getitem__(self, number: Any) -> Any:
        run = self._run_of()
        if isinstance(number, slice):
            return RunSlice(run, self._numbers()[number], self._request)
        try:
            return run._part(self._numbers()[number], **self._request)
        except IndexError:
            raise IndexError(f"expected a frame from {-len(self)} to {len(self) - 1}, got {number}") from None

    def __iter__(self) -> Iterator[Frame]:
        """Yields the frames. While one is used, another thread reads of the next one what was asked of the one before, but with ranks."""
        frame: Frame | None = None
        following: Frame | None = None
        thread: threading.Thread | None = None
        for i in range(len(self)):
            names, whole = (list(frame._asked), frame._whole is not None) if frame else ([], False)
            if thread:
                thread.join()
            is_current = following is not None and following._state is following._run._state
            frame, following, thread = following if is_current else self[i], None, None  # type: ignore[assignment]
            if i + 1 < len(self) and (names or whole) and not self._run_of()._ranks:
                following = self[i + 1]
                # Python waits for it at the end: it calls functions of ours
                thread = threading.Thread(target=_read_ahead, args=(following, names, whole))
                _reading_ahead.add(thread)
                try:
                    thread.start()
                except RuntimeError:  # the system has no thread to give: the frame is read when it is asked
                    thread = None
            yield frame


#: Threads that a fork waits for: a child has their locks, and not them.
_reading_ahead: weakref.WeakSet[threading.Thread] = weakref.WeakSet()
if hasattr(os, "register_at_fork"):  # not on Windows
    os.register_at_fork(before=lambda: [thread.join() for thread in list(_reading_ahead) if thread.is_alive()])


def _read_ahead(frame: Frame, names: list[str], whole: bool) -> None:
    """Reads a part of a frame. An error is raised again, and a notice told, when the frame itself is asked."""
    try:
        with frame._lock:
            handle = frame._load(frame._names() if whole else names, warn=frame._notices.append)
            if whole:
                frame._whole = handle
    except Exception:  # noqa: BLE001
        frame._arrays.clear()


class RunSlice(_Frames):
    """Some frames of a run: run[10:20:5]."""

    def __init__(self, run: Run, numbers: range, request: dict[str, Any]):
        self._run, self._range, self._request = run, numbers, request

    def _run_of(self) -> Run:
        return self._run

    def _numbers(self) -> range:
        return self._range

    def __repr__(self) -> str:
        return f"<{len(self)} frames of {self._run!r}>"


class Run(_Frames):
    """The frames of one or more files, from vtkgranular.open: a sequence of frames.

    len(run), run[-1], run[10:20:5], for frame in run
    run.steps, run.times   timesteps and times of all frames
    run.columns            the columns of the first frame that has rows
    run.kind               what the files are, as `kind` of vtkgranular.open

    A run may be used by several threads, pickled, and sent to other processes, which open the files again, each alone.
    """

    def __init__(self, paths: list[str], options: dict[str, Any], progress: Callable[[float], Any] | None = None, ranks: Any = None,
                 warn: Any = _warn):
        self._warn, self._paths, self._options = warn, paths, options
        self._ranks = None if ranks is None else c.Ranks(ranks)
        self._handle = None
        self._state = object()  # another one after each refresh
        self._known: dict[Any, Any] = {}
        self._lock = threading.RLock()  # strings of the library stay until the run is refreshed
        library = c.library()
        given = c.OpenOptions()
        library.granular_open_options_init(c.byref(given))
        kind = options.get("kind")
        given.kind = -1 if kind is None else _choice("a kind", kind, KINDS)
        _fill(given, FILES, options)
        if self._ranks:
            given.ranks = c.pointer(self._ranks)
        pointer = c.c_void_p()
        with c.Calls(progress, warn, self._ranks) as calls:
            given.progress, given.notice = calls.progress, calls.notice
            library.granular_open(c.texts(paths), len(paths), c.byref(given), c.byref(pointer))
            self._handle: _Handle | None = _Handle(pointer, library.granular_close)

    # ---- the library ----
    def _open(self) -> _Handle:
        handle = self._handle
        if handle is None:
            raise c.ArgumentError(f"expected an open run, got one that was closed: {', '.join(self._paths)}")
        return handle

    def _run_of(self) -> Run:
        return self

    def _numbers(self) -> range:
        return range(self._info().frames)

    def _info(self) -> c.RunFacts:
        facts = c.RunFacts()
        c.library().granular_run_info(self._open(), c.byref(facts))
        return facts

    def _place_of(self, number: int) -> tuple[object, tuple[int, str]]:
        """Returns the state of the run, and timestep and file of a frame."""
        with self._lock:
            facts = c.FrameFacts()
            c.library().granular_frame_info(self._open(), number, c.byref(facts))
            return self._state, (facts.timestep, c.text(facts.path))

    def _facts(self) -> Any:
        """Timesteps, times and rows of all frames."""
        import numpy

        with self._lock:
            run = self._open()
            if "facts" not in self._known:
                library, count = c.library(), len(self)
                steps, times, rows = (numpy.empty(count, dtype) for dtype in (numpy.int64, float, numpy.int64))
                facts = c.FrameFacts()
                for i in range(count):
                    library.granular_frame_info(run, i, c.byref(facts))
                    steps[i], times[i], rows[i] = facts.timestep, facts.time, facts.rows
                for each in (steps, times, rows):
                    each.flags.writeable = False
                self._known["facts"] = steps, times, rows
            return self._known["facts"]

    def _file_facts(self) -> list[tuple[str, int, int, int, str]]:
        """Path, bytes, frames, repeated frames and defect of each file."""
        with self._lock:
            run = self._open()
            if "files" not in self._known:
                library, facts, found = c.library(), c.FileFacts(), []
                for i in range(self._info().files):
                    library.granular_file_info(run, i, c.byref(facts))
                    found.append((c.text(facts.path), facts.bytes, facts.frames, facts.repeated, c.text(facts.defect)))
                self._known["files"] = found
            return self._known["files"]

    def _columns(self, number: int, bonds: bool = False) -> _Columns:
        """The columns of a frame, or of every one."""
        key = number, bonds
        with self._lock:
            if key not in self._known:
                library, pointer, count = c.library(), self._open(), c.c_size_t()
                library.granular_arrays(pointer, number, int(bonds), None, 0, c.byref(count))
                facts = (c.ArrayFacts * max(1, count.value))()
                library.granular_arrays(pointer, number, int(bonds), facts, count.value, c.byref(count))
                kinds: tuple[list[Column], list[Column]] = [], []
                for fact in facts[:count.value]:
                    kinds[0 if fact.is_usual else 1].append(
                        Column(c.text(fact.name), "str" if fact.type == c.TEXT else c.TYPES[fact.type], fact.components,
                               c.text(fact.unit), c.text(fact.meaning), tuple(c.text(fact.columns).split())))
                points = "ends" if bonds or self.kind == "local" else "points" if kinds[1] or self.kind != "dump" else ""
                self._known[key] = _columns_of(*kinds, points)
            return self._known[key]

    def _read(self, number: int, names: list[str] | None, bonds: bool, request: dict[str, Any], progress: Any, warn: Any = _warn,
              for_vtk: bool = False) -> _Handle:
        library = c.library()
        given = c.Request()
        library.granular_request_init(c.byref(given))
        given.table = int(bonds)
        kept = None
        if names is not None:
            kept = c.texts(names or [""])
            given.arrays, given.array_count = kept, len(names)
        given.points = 1 if names is None or "points" in names else 0
        given.ranges, given.take = for_vtk, for_vtk and c.IS_HEAP_SHARED
        _fill(given, FRAME, request)
        pointer = c.c_void_p()
        with c.Calls(progress, warn, self._ranks) as calls:
            given.progress, given.notice = calls.progress, calls.notice
            library.granular_read(self._open(), number, c.byref(given), c.byref(pointer))
            made = _Handle(pointer, library.granular_release)  # before notices, which may be raised
        return made

    # ---- for users ----
    @property
    def kind(self) -> str:
        """What the files are, as `kind` of vtkgranular.open."""
        return KINDS[self._info().kind]

    @property
    def paths(self) -> list[str]:
        """The names and patterns that the run was opened with."""
        return list(self._paths)

    @property
    def files(self) -> list[str]:
        """The files of the run, absolute, in the order of the numbers in their names."""
        return [path for path, *_ in self._file_facts()]

    @property
    def columns(self) -> list[Column]:
        """The columns of the first frame that has rows, but for coordinates, which are frame.points."""
        with_rows = self.rows.nonzero()[0]
        return list(self._columns(int(with_rows[0]) if len(with_rows) else 0).usual) if len(self) else []

    def find(self, time: float) -> Frame:
        """Returns the last frame at or before a time, or the first one."""
        number = c.c_int64()
        c.library().granular_find_frame(self._open(), float(time), c.byref(number))
        return self[number.value]

    def read(self, frame: int = -1, columns: Iterable[str] | None = None, region: Any = None, stride: int = 1,
             coordinates: str = "absolute", precision: str = "double", origin: Any = None, sort: bool = False,
             periodic_lines: str = "minimum_image", piece: int = 0, pieces: int = 0, threads: int = 0,
             progress: Callable[[float], Any] | None = None) -> Frame:
        """Reads a part of a frame, and returns it.

        frame           its number, from 0, or from the end: -1 (default) is the last one
        columns         names of arrays or columns, as a list or one text: "id v", ["id", "vx"]; None: all. Others are not converted and
                        take no memory; positions are always read.
        region          a box xlo, xhi, ylo, yhi, zlo, zhi in absolute coordinates, faces included: only particles in it are read;
                        or three pairs; None where there is no bound (dumps and data files)
        stride          n keeps particles whose id is a multiple of n, or each n-th row without ids; 1 (default): all (dumps and
                        data files)
        coordinates     points in the box (absolute), moved by the image counts (unwrapped), or in units of the box (scaled):
                        "absolute" (default), "unwrapped" or "scaled" (dumps and data files)
        precision       points as 64-bit or 32-bit floats: "double" (default) or "single" (dumps)
        origin          a point that is subtracted from the points before any rounding; shape (3,)
        sort            rows in the order of their ids (dumps and data files)
        periodic_lines  contacts and bonds across periodic faces: to the nearest image, split at the faces into rows of their own,
                        or from end to end: "minimum_image" (default), "split" or "as_written" (dumps of local data, restart files
                        and data files)
        piece           part of the rows that is read, from 0 to pieces - 1 (dumps, dumps of local data, restart files and data
                        files)
        pieces          number of parts, which together are all rows; 0 (default): one for each rank, and the whole without ranks
                        (dumps, dumps of local data, restart files and data files)
        threads         number of threads; 0 (default): one per core
        progress        is called with fractions from 0 to 1; it returns False to stop

        Raises vtkgranular.Error with path, line
        and column; vtkgranular.ArgumentError for what cannot be, among them a column that there is not; IndexError for a frame that
        there is not.
        """
        given = locals()
        return self._part(self[frame].number, columns=columns, **{option.name: given[option.name] for option in FRAME}).read(progress)

    def _part(self, number: int, **request: Any) -> Frame:
        """A part of a frame, which is read when it is asked for."""
        columns = request.pop("columns", None)
        made = Frame(self, number, request)
        if columns is not None:
            made._wanted = arrays_of(made, words_of(columns).split())[0]
        return made

    def refresh(self, progress: Callable[[float], Any] | None = None) -> Run:
        """Looks for frames that were added and for files that changed, and returns the run itself. After an error the run is as it was.

        A frame that was read in part before cannot read its rest: take it anew.
        """
        with self._lock, c.Calls(progress, self._warn, self._ranks) as calls:
            before, self._state = self._state, object()  # before the library changes the run for other threads
            try:
                c.library().granular_refresh(self._open(), calls.progress, calls.notice, None)
            except BaseException:
                self._state = before
                raise
            self._state = object()  # a function for progress may have taken frames meanwhile
            self._known.clear()
        return self

    def reader(self, **properties: Any) -> Any:
        """Returns the ParaView reader of the same files: see vtkgranular.reader."""
        from . import reader

        set_ones = {option: value for option in FILES if option.type in ("text", "names", "choice")
                    and (value := self._options.get(option.name, option.default)) != option.default}
        own = {option.property: _choice(option.name, value, option.choices) if option.choices else words_of(value)
               for option, value in set_ones.items()}
        return reader(self._paths, dt=self._options.get("dt"), **{**own, **properties})

    def close(self) -> None:
        """Closes the run. Arrays that were read stay."""
        self._handle = None

    def __enter__(self) -> Run:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __reduce__(self) -> Any:
        return Run, (self._paths, self._options)

    def __repr__(self) -> str:
        names = ", ".join(os.path.basename(os.fsdecode(path)) for path in self._paths)
        return f"<run {names}: {len(self)} frames>" if self._handle else f"<closed run {names}>"


def _region(given: Any) -> list[float]:
    """Six bounds; an axis without bounds has lo > hi."""
    bounds = list(given)
    if len(bounds) == 3:
        bounds = [bound for pair in bounds for bound in (pair if pair is not None else (None, None))]
    if len(bounds) != 6:
        raise c.ArgumentError(f"expected a region of six bounds, or of three pairs, got {given!r}")
    made: list[float] = []
    for lo, hi in zip(bounds[::2], bounds[1::2]):
        if lo is None and hi is None:
            made += [1.0, -1.0]
            continue
        least, most = -float("inf") if lo is None else float(lo), float("inf") if hi is None else float(hi)
        if not least <= most:
            raise c.ArgumentError(f"expected bounds of a region in their order, got {lo} and {hi}")
        made += [least, most] if least or most else [-5e-324, 5e-324]  # 0 0 would be no bounds
    return made


def open(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None, *, ranks: Any = None,
         kind: str | None = None, column_names: str | Iterable[str] = "", preset: str = "", column_map: str | Iterable[str] = "",
         atom_style: str = "", boundary: str = "", history_layout: str = "automatic", repeated_steps: str = "auto",
         threads: int = 0, progress: Callable[[float], Any] | None = None) -> Any:
    """Opens files of a simulation and returns their frames as a Run; of a folder, what is in it as a Folder. Needs neither VTK nor ParaView.

    paths           a file, a pattern such as "post/*.dump", or a list of these; see vtkgranular.files; or a folder, "post/". Dumps
                    in every form, contacts and bonds (dump local), restart files, data files, decompositions, Euler cells and grids
                    are told apart by their contents.
    kind            "dump", "local", "restart", "data", "euler", "decomposition" or "grid"; None (default): as the contents say
    dt              time of one timestep, greater than 0, in the unit of the run; by default 1, unless the files hold times
    column_names    columns of dumps that do not name them, binary or without headers: "id type x y z vx vy vz"; or a list
    preset          order of the columns of contacts and bonds, by its name
    column_map      names of the columns of contacts and bonds, one for each column; files without a header need it; of dumps as
                    column_names; or a list
    atom_style      atom style of data files that do not name it: "sphere", "hybrid sphere bond"
    boundary        boundaries of the box in data files, which do not hold them: "p p f"; empty: axes that particles have crossed
                    are periodic
    history_layout  program that wrote the history of bonds in restart files, which says what its values are: "automatic" (default),
                    "numbered", "with_bonds", "pfm", "flexible_fibers" or "flexible_fibers_damage"
    repeated_steps  meaning of a timestep in several files: pieces of one frame (merge), or a run that was restarted (last): "auto"
                    (default), "merge" or "last"
    threads         number of threads; 0 (default): one per core
    progress        is called with fractions from 0 to 1 while the frames are looked for; it returns False to stop
    ranks           a communicator of mpi4py: its ranks open and read together. Each gets its part of the rows of a frame, and
                    cells and subdomains whole. All call the same functions in the same order, ask frames for the same arrays and facts,
                    such as frame.rows and frame.box, in the same order, and get the same errors of files and the same remarks. Set
                    threads where ranks share a machine. None (default): this process alone

    The frames are found now, and read when they are asked for. A last frame that ends early is left out, because a simulation may
    be writing it: `granular check` reports it. Raises FileNotFoundError, vtkgranular.Error with path, line and column, and ValueError for a
    choice that there is not. Remarks that are no errors are warnings, vtkgranular.Remark with path and line.
    """
    given = locals()
    if not isinstance(paths, bytes) and isinstance(paths, (str, os.PathLike)) and os.path.isdir(paths):
        from ._folder import Folder

        return Folder(os.fspath(paths), dt)
    options = {name: given[name] for name in ("kind", *(option.name for option in FILES)) if given[name] not in (None, "")}
    files = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    return Run([os.path.abspath(os.fsdecode(path)) for path in files], options, progress, ranks)


def kind_of(path: str | os.PathLike[str]) -> str | None:
    """Returns what a file is by its contents, as `kind` of vtkgranular.open; None for other files, which that names, and for none."""
    kind = c.c_int()
    c.library().granular_find_kind(c.name_bytes(os.fspath(path)), c.byref(kind))
    return KINDS[kind.value] if kind.value >= 0 else None
