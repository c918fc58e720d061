# SPDX-License-Identifier: BSD-3-Clause
"""The lines of a text file, plain or packed."""
from __future__ import annotations

import ctypes
import importlib
import io
import math
import os
import stat
from typing import Any, Iterator, NoReturn

from . import _library as c

#: The first bytes of packed files, the names of the formats, and the modules whose function `open` reads them.
_PACKED = ((b"\x1f\x8b", "gzip", "gzip"), (b"BZh", "bzip2", "bz2"), (b"\xfd7zXZ\0", "xz", "lzma"), (b"\x28\xb5\x2f\xfd", "Zstandard", ""))
_FREE_CONTENT = 1 << 28  # bytes that are read whatever the size of the packed file
_LARGEST_EXPANSION = 200
_LONGEST_LINE = 1 << 22


class _Content(io.RawIOBase):
    """The content of a packed file as the library reads it."""

    def __init__(self, path: str):
        self._bytes = ctypes.c_void_p()
        c.library().granular_open_bytes(c.name_bytes(path), c.byref(self._bytes))

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        got, is_cut = ctypes.c_size_t(), ctypes.c_int()
        memory = (ctypes.c_char * len(buffer)).from_buffer(buffer)
        c.library().granular_read_bytes(self._bytes, memory, len(buffer), c.byref(got), c.byref(is_cut))
        if is_cut.value and not got.value:
            raise EOFError
        return got.value

    def __del__(self) -> None:
        c.library().granular_close_bytes(self._bytes)


class Lines:
    """The lines of a file that are not blank, one after the other.

    line, number  the current line with its line feed, which only the last line of a plain file may lack, and its number, from 1
    following     the next line, or nothing
    notes         lines, or 0, and what is left out there
    """

    def __init__(self, path: str, what: str = "log"):
        self._what = what
        self.path, self.line, self.number, self._ahead = path, b"", 0, 0
        self.notes: list[tuple[int, str]] = []
        self._lines = self._read()
        self.following = next(self._lines, b"")

    def advance(self) -> None:
        self.line, self.number = self.following, self._ahead
        self.following = next(self._lines, b"")

    def where(self, line: int) -> str:
        return f"{c.shown(self.path)}{f':{line}' if line else ''}: "

    def fail(self, text: str, line: int = 0, column: str = "", byte: int = -1) -> NoReturn:
        raise c.Error(self.where(line) + text, self.path, line, byte, column)

    def _read(self) -> Iterator[bytes]:
        without_waiting = getattr(os, "O_NONBLOCK", 0)  # for a pipe, of which Windows has none
        with open(self.path, "rb", opener=lambda path, flags: os.open(path, flags | without_waiting)) as file:
            status, count = os.fstat(file.fileno()), 0
            if not stat.S_ISREG(status.st_mode):
                raise OSError(f"{c.shown(self.path)}: expected a file, got a device or a pipe")
            head = file.peek(6)
            packed, module = next((how for magic, *how in _PACKED if head.startswith(magic)), ("", ""))
            most = max(_FREE_CONTENT, status.st_size * _LARGEST_EXPANSION) if packed else math.inf
            stream: Any = file
            if packed:
                stream = importlib.import_module(module).open(file) if module else io.BufferedReader(_Content(self.path))
            try:
                head = stream.peek(1024)[:1024]
                if b"\0" in head:
                    self.fail(f"expected the text of a {self._what}, got a binary file", byte=head.index(b"\0"))
                while line := stream.readline(_LONGEST_LINE):
                    count += len(line)
                    self._ahead += 1
                    if len(line) == _LONGEST_LINE:
                        self.fail(f"expected lines of fewer than {_LONGEST_LINE} bytes, got a longer one", self._ahead)
                    if count > most:
                        self.fail(f"expected content of at most {_LARGEST_EXPANSION} times the {status.st_size} bytes of the file, got "
                                  "more; if you trust the file, unpack it first")
                    if not line.isspace():
                        yield line + b"\n" if packed and line[-1:] != b"\n" else line  # a checksum says that it is whole
                if count == 0:
                    self.fail(f"expected a {self._what}, got an empty file")
            except EOFError:
                text = f"expected complete {packed} data, got data that end early"
                if count == 0:
                    self.fail(text)
                self.notes.append((0, text + ": the rows before the end are read"))
            except Exception as error:
                if not packed or isinstance(error, (c.Error, MemoryError)):
                    raise
                self.fail(f"expected {packed} data, got damaged ones: {error}")
