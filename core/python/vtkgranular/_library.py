# SPDX-License-Identifier: BSD-3-Clause
"""The C library behind runs, frames and filters, by ctypes: the declarations of granular.h and granular_filters.h."""
from __future__ import annotations

import ctypes
import functools
import os
import re
import signal
import threading
import weakref
from ctypes import CFUNCTYPE, POINTER, Structure, byref, c_char_p, c_double, c_int, c_int64, c_size_t, c_ssize_t, c_void_p, pointer
from typing import Any, Callable

from ._folders import LIBRARY, LIBRARY_FOLDER, VERSION
from ._options import FILES, FRAME, Option

PROGRESS = CFUNCTYPE(c_int, c_double, c_void_p)
ALL_GATHER = CFUNCTYPE(c_int, c_void_p, c_void_p, c_size_t, c_void_p)

# numpy's names of the types of granular_type; the last one are indices of words
TYPES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64", "int32")
TEXT = 10

#: Windows has several libraries of C, each with a free() of its own.
IS_HEAP_SHARED = os.name == "posix"


class Error(RuntimeError):
    """An error of a file, or of what was asked of it.

    path    the file; empty if there is none
    line    of a text file, from 1; 0 if it is not known
    byte    of a binary file, from 0; -1 if it is not known
    column  the column as the file spells it; empty if there is none
    """

    def __init__(self, message: str, path: str = "", line: int = 0, byte: int = -1, column: str = ""):
        super().__init__(message)
        self.path, self.line, self.byte, self.column = path, line, byte, column

    def __reduce__(self) -> Any:
        return type(self), (str(self), self.path, self.line, self.byte, self.column)


class Remark(UserWarning):
    """A warning of a file that is no error, with path, line, byte and column as in Error.

    text    the message without the position
    topic   remarks of one topic say the same of many frames; empty: each is new
    """

    path, line, byte, column, text, topic = "", 0, -1, "", "", ""


class ArgumentError(Error, ValueError):
    """What was asked for cannot be: a frame or column that there is not, arrays of a wrong shape or type."""


class ColumnError(ArgumentError, KeyError):
    """A column that a frame does not have. The message lists those there are."""

    def __str__(self) -> str:
        return str(self.args[0])


class _CError(Structure):
    _fields_ = [("status", c_int), ("message", c_char_p), ("text", c_char_p), ("path", c_char_p), ("line", c_int64),
                ("byte", c_int64), ("column", c_char_p), ("system_error", c_int), ("topic", c_char_p)]


NOTICE = CFUNCTYPE(None, POINTER(_CError), c_void_p)


def _fields_of(options: tuple[Option, ...]) -> list[tuple[str, Any]]:
    types = {"text": c_char_p, "names": c_char_p, "count": c_int64, "number": c_double, "point": c_double * 3, "region": c_double * 6}
    return [(option.c, types.get(option.type, c_int)) for option in options]


def _memory(address: int, size: int) -> Any:
    """Returns bytes of the library as a memoryview. An array of ctypes would be a type of its own for each size."""
    view = ctypes.pythonapi.PyMemoryView_FromMemory
    view.argtypes, view.restype = (c_void_p, c_ssize_t, c_int), ctypes.py_object
    return view(address, size, 0x200)  # to be written, too


class Ranks(Structure):
    """The ranks of a communicator of mpi4py, or of anything with Get_rank, Get_size and Allgather."""

    _fields_ = [("rank", c_int), ("size", c_int), ("all_gather", ALL_GATHER), ("user", c_void_p)]

    def __init__(self, communicator: Any):
        self.raised: BaseException | None = None
        me = weakref.ref(self)  # which keeps this function: a cycle stays where no garbage is collected

        def all_gather(mine: int, gathered: int, count: int, _: Any) -> int:
            own = me()
            try:
                if own.raised:
                    return 1  # the ranks are at odds
                communicator.Allgather(_memory(mine, count), _memory(gathered, count * own.size))
            except BaseException as error:  # noqa: BLE001 (of the communicator: raised behind the library)
                own.raised = error
            return 1 if own.raised else 0

        super().__init__(communicator.Get_rank(), communicator.Get_size(), ALL_GATHER(all_gather))


class OpenOptions(Structure):
    _fields_ = [("size", c_size_t), ("kind", c_int), *_fields_of(FILES), ("progress", PROGRESS), ("notice", NOTICE), ("user", c_void_p),
                ("ranks", POINTER(Ranks))]


class RunFacts(Structure):
    _fields_ = [("kind", c_int), ("frames", c_int64), ("files", c_int64), ("tables", c_int)]


class FrameFacts(Structure):
    _fields_ = [("timestep", c_int64), ("time", c_double), ("rows", c_int64), ("path", c_char_p)]


class FileFacts(Structure):
    _fields_ = [("path", c_char_p), ("bytes", c_int64), ("frames", c_int64), ("repeated", c_int64), ("defect", c_char_p)]


class ArrayFacts(Structure):
    _fields_ = [("name", c_char_p), ("type", c_int), ("components", c_int), ("is_usual", c_int), ("unit", c_char_p),
                ("meaning", c_char_p), ("columns", c_char_p)]


class Request(Structure):
    _fields_ = [("size", c_size_t), ("table", c_int), ("arrays", POINTER(c_char_p)), ("array_count", c_size_t), ("points", c_int),
                *_fields_of(FRAME), ("progress", PROGRESS), ("notice", NOTICE), ("user", c_void_p), ("ranges", c_int), ("take", c_int)]


class CBox(Structure):
    _fields_ = [("bounds", c_double * 9), ("has_bounds", c_int), ("origin", c_double * 3), ("vectors", c_double * 9),
                ("boundary", c_char_p)]


class FrameHeader(Structure):
    _fields_ = [("timestep", c_int64), ("time", c_double), ("has_time", c_int), ("rows", c_int64), ("has_box", c_int),
                ("box", CBox), ("coordinates", c_int), ("origin", c_double * 3), ("label", c_char_p), ("units", c_char_p),
                ("columns", c_char_p), ("digits", POINTER(c_int)), ("digit_count", c_size_t), ("dialect", c_char_p), ("arrays", c_size_t),
                ("row_label", c_char_p), ("shape_sizes", c_char_p), ("groups", POINTER(c_char_p)), ("group_count", c_size_t),
                ("type_names", POINTER(c_char_p)), ("type_name_count", c_size_t),
                ("box_form", c_int), ("box_corners", c_double * 24)]


class CArray(Structure):
    _fields_ = [("name", c_char_p), ("type", c_int), ("components", c_int), ("rows", c_int64), ("data", c_void_p),
                ("words", POINTER(c_char_p)), ("word_count", c_size_t), ("unit", c_char_p), ("meaning", c_char_p),
                ("columns", c_char_p), ("range", POINTER(c_double))]


class Grid(Structure):
    _fields_ = [("lo", c_double * 3), ("hi", c_double * 3), ("spacing", c_double * 3), ("counts", c_int64 * 3), ("first", c_int64)]


class Format(Structure):
    _fields_ = [("size", c_size_t), ("style", c_char_p), ("dialect", c_char_p), ("columns", c_char_p), ("numbers", c_char_p),
                ("label", c_char_p), ("scaled", c_int), ("image", c_int), ("sort_by_id", c_int), ("write_units", c_int),
                ("write_time", c_int), ("threads", c_int), ("progress", PROGRESS), ("notice", NOTICE), ("user", c_void_p),
                ("durable", c_int)]


class Content(Structure):
    _fields_ = [("size", c_size_t), ("timestep", c_int64), ("time", c_double), ("has_time", c_int), ("units", c_char_p),
                ("box", POINTER(CBox)), ("rows", c_int64), ("arrays", POINTER(CArray)), ("array_count", c_size_t),
                ("header", POINTER(FrameHeader))]


class Setting(Structure):
    _fields_ = [("name", c_char_p), ("text", c_char_p), ("numbers", POINTER(c_double)), ("count", c_size_t)]


INPUT = CFUNCTYPE(c_int, c_size_t, c_size_t, POINTER(POINTER(Content)), POINTER(c_char_p), c_void_p)
NO_TIMESTEP, GHOSTS, MOST_RESULTS = -2**63, "vtkGhostType", 8


class Task(Structure):
    _fields_ = [("size", c_size_t), ("filter", c_char_p), ("settings", POINTER(Setting)), ("setting_count", c_size_t), ("input", INPUT),
                ("frames", c_size_t), ("times", POINTER(c_double)), ("shown", c_size_t), ("piece", c_int), ("pieces", c_int),
                ("ranks", POINTER(Ranks)), ("threads", c_int), ("progress", PROGRESS), ("notice", NOTICE), ("user", c_void_p)]


_NAMES = POINTER(c_char_p)
_FUNCTIONS = {
    "granular_find_kind": (c_char_p, POINTER(c_int)),
    "granular_open": (_NAMES, c_size_t, POINTER(OpenOptions), POINTER(c_void_p)),
    "granular_refresh": (c_void_p, PROGRESS, NOTICE, c_void_p),
    "granular_run_info": (c_void_p, POINTER(RunFacts)),
    "granular_frame_info": (c_void_p, c_int64, POINTER(FrameFacts)),
    "granular_file_info": (c_void_p, c_int64, POINTER(FileFacts)),
    "granular_find_frame": (c_void_p, c_double, POINTER(c_int64)),
    "granular_arrays": (c_void_p, c_int64, c_int, POINTER(ArrayFacts), c_size_t, POINTER(c_size_t)),
    "granular_read": (c_void_p, c_int64, POINTER(Request), POINTER(c_void_p)),
    "granular_complete_box": (POINTER(CBox),),
    "granular_header": (c_void_p, POINTER(FrameHeader)),
    "granular_grids": (c_void_p, NOTICE, c_void_p, POINTER(Grid), c_size_t, POINTER(c_size_t)),
    "granular_array_at": (c_void_p, c_size_t, POINTER(CArray)),
    "granular_take": (c_void_p, c_size_t, POINTER(c_void_p)),
    "granular_create": (c_char_p, POINTER(Format), POINTER(c_void_p)),
    "granular_add_input": (c_void_p, c_void_p),
    "granular_write": (c_void_p, POINTER(Content)),
    "granular_write_frame": (c_void_p, c_void_p),
    "granular_finish": (c_void_p,),
    "granular_begin_file": (c_char_p, POINTER(c_void_p)),
    "granular_hold_file": (c_void_p, c_int),
    "granular_finish_files": (POINTER(c_void_p), c_size_t, c_int),
    "granular_apply": (POINTER(Task), POINTER(c_void_p), c_size_t, POINTER(c_size_t)),
    "granular_find_files": (_NAMES, c_size_t, POINTER(c_void_p)),
    "granular_open_bytes": (c_char_p, POINTER(c_void_p)),
    "granular_read_bytes": (c_void_p, c_void_p, c_size_t, POINTER(c_size_t), POINTER(c_int)),
}
_OTHERS = {  # without a status: result and arguments
    "granular_open_options_init": (None, POINTER(OpenOptions)),
    "granular_request_init": (None, POINTER(Request)),
    "granular_format_init": (None, POINTER(Format)),
    "granular_content_init": (None, POINTER(Content)),
    "granular_task_init": (None, POINTER(Task)),
    "granular_made_array": (c_char_p, c_char_p, c_size_t, POINTER(c_int)),
    "granular_close": (None, c_void_p),
    "granular_release": (None, c_void_p),
    "granular_abandon": (None, c_void_p),
    "granular_file_name": (c_char_p, c_void_p),
    "granular_close_bytes": (None, c_void_p),
    "granular_close_file": (None, c_void_p),
    "granular_name_count": (c_size_t, c_void_p),
    "granular_name_at": (c_char_p, c_void_p, c_size_t),
    "granular_free_names": (None, c_void_p),
    "granular_version": (c_char_p,),
}
EVERY_FRAME = -2**63
_IO_ERROR, _BAD_ARGUMENT, _CANCELLED, _NO_MEMORY = 1, 5, 6, 7


# The names of settings in messages, which readers share, and those of vtkgranular.open.
_SETTINGS = {"AtomStyle": "atom_style", "ColumnMap": "column_map", "ColumnNames": "column_names", "Preset": "preset",
             "RepeatedSteps to Merge": 'repeated_steps to "merge"', "TimestepSize": "dt"}


def text(value: bytes | None) -> str:
    """Returns a string of the library; names of files may be any bytes."""
    return os.fsdecode(value or b"")


def shown(name: str) -> str:
    """Returns the name of a file for a message, on one line and in UTF-8, as the library shows it."""
    def escape(sign: str) -> str:
        if "\ud800" <= sign <= "\udfff":  # a byte that is not UTF-8
            return f"\\x{ord(sign) & 0xff:02x}"
        return {"\n": r"\n", "\t": r"\t"}.get(sign) or "".join(f"\\x{byte:02x}" for byte in sign.encode())

    return re.sub("[\0-\x1f\x7f-\x9f\ud800-\udfff]", lambda match: escape(match.group()), name)


def message_of(value: bytes | None) -> str:
    """Returns a message of the library with the names of settings that Python has."""
    return re.sub("|".join(rf"\b{name}\b" for name in _SETTINGS), lambda match: _SETTINGS[match.group()], text(value))


def _with_path(error: Any, path: str) -> Any:
    """Returns the error with a path: not as filename, with which Python would make a text of its own."""
    error.path = path
    return error


def _raise(error: _CError) -> None:
    # without a variable for what is raised: its traceback would keep itself, and what callers hold, until Python looks for cycles
    message, path = message_of(error.message), text(error.path)
    where = (path, error.line, error.byte, text(error.column))
    if error.status == _CANCELLED:
        raise Cancelled
    if error.status == _NO_MEMORY:
        raise MemoryError(message)
    if error.status == _IO_ERROR and error.system_error:
        raise _with_path(type(OSError(error.system_error, ""))(message), path)  # FileNotFoundError, PermissionError, ...
    raise (ArgumentError if error.status == _BAD_ARGUMENT else Error)(message, *where)


class Cancelled(Exception):
    """The progress function stopped the work."""


@functools.lru_cache(maxsize=None)
def library() -> Any:
    """Returns the library, loaded once. Functions with a status raise its error instead of returning it."""
    # inside a wheel, where it was built or installed together with this package, or where the system finds it
    folders = [os.path.dirname(__file__), LIBRARY_FOLDER]
    path = next((path for path in (os.path.join(folder, LIBRARY) for folder in folders) if os.path.exists(path)), LIBRARY)
    try:
        loaded = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"expected the library {LIBRARY} in {' or '.join(folders)}: {error}") from None
    loaded.granular_version.restype = c_char_p
    if loaded.granular_version().decode() != VERSION:
        raise ImportError(f"expected the library {LIBRARY} of version {VERSION}, got {loaded.granular_version().decode()}")
    loaded.granular_last_error.restype = POINTER(_CError)

    def check(status: int, function: Any, arguments: Any) -> int:
        if status:
            _raise(loaded.granular_last_error().contents)
        return status

    for name, arguments in _FUNCTIONS.items():
        function = getattr(loaded, name)
        function.argtypes, function.restype, function.errcheck = arguments, c_int, check
    for name, (result, *arguments) in _OTHERS.items():
        function = getattr(loaded, name)
        function.argtypes, function.restype = arguments, result
    return loaded


def texts(values: list[str]) -> Any:
    """Returns an array of strings for the library."""
    return (c_char_p * len(values))(*map(name_bytes, values))


def name_bytes(name: str | bytes) -> bytes:
    """Returns a string for the library. Raises ArgumentError for one that ends early there."""
    if "\0" in os.fsdecode(name):
        raise ArgumentError(f"expected a text without a null character, got {name!r}")
    return os.fsencode(name)


class Calls:
    """The caller's functions for progress and notices, and ranks. An exception in one of them, and Ctrl-C, stop the work and are raised
    again."""

    def __init__(self, progress: Callable[[float], Any] | None, warn: Callable[[Any], Any], ranks: Ranks | None = None):
        self.raised: BaseException | None = None
        self.notices: list[Remark] = []
        self._ranks = ranks
        self._old_handler: Any = None
        me = weakref.ref(self)  # which keeps these functions: a cycle stays where no garbage is collected

        def report(fraction: float, _: Any) -> int:
            own = me()
            if progress is None or own.raised:
                return 1 if own.raised else 0
            try:
                return 1 if progress(fraction) is False else 0
            except BaseException as error:  # noqa: BLE001 (of the caller, who gets it)
                own.raised = error
                return 1

        def tell(notice: Any, _: Any) -> None:
            told = notice.contents
            remark = Remark(message_of(told.message))
            remark.path, remark.line, remark.byte = text(told.path), told.line, told.byte
            remark.column, remark.text, remark.topic = text(told.column), message_of(told.text), text(told.topic)
            me().notices.append(remark)

        # the main thread takes Ctrl-C in this function; others do without, because Python's end would end them in it
        is_called = progress is not None or threading.current_thread() is threading.main_thread()
        self.progress, self.notice, self._warn = PROGRESS(report) if is_called else PROGRESS(), NOTICE(tell), warn

    def _interrupt(self, *_: Any) -> None:
        """Takes Ctrl-C while the library works: an exception at any place of a callback would be lost in C."""
        self.raised = KeyboardInterrupt()

    def __enter__(self) -> Calls:
        self.raised = None
        is_main = threading.current_thread() is threading.main_thread()
        if is_main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            self._old_handler = signal.signal(signal.SIGINT, self._interrupt)
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if self._old_handler is not None:
            signal.signal(signal.SIGINT, self._old_handler)
            self._old_handler = None
        raised, self.raised = self.raised or (self._ranks and self._ranks.raised), None
        if raised:
            try:
                raise raised
            finally:
                del raised  # whose traceback has this frame
        told, self.notices = self.notices, []
        for notice in told:
            self._warn(notice)
