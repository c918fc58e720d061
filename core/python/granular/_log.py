# SPDX-License-Identifier: BSD-3-Clause
"""The thermo tables in logs of LAMMPS and LIGGGHTS as numpy arrays."""
from __future__ import annotations

import io
import math
import os
import re
import stat
from array import array
from typing import TYPE_CHECKING, Any, Iterable, Iterator, NoReturn

from . import _library as c
from ._run import _warn

if TYPE_CHECKING:
    import gzip
    from fractions import Fraction

    import numpy
    import pandas

#: The timesteps that LAMMPS and LIGGGHTS use after the command `units`.
_DEFAULTS = {b"lj": b"0.005", b"real": b"1.0", b"metal": b"0.001", b"si": b"1e-8", b"cgs": b"1e-8", b"electron": b"0.001", b"micro": b"2.0",
             b"nano": b"0.00045"}
# The first line of a block of `thermo_style multi`.
_BLOCK = re.compile(rb"\s*-{4,}\s*Step\s+(-?\d+)\s+-{2,}\s*CPU\s*=\s*(\S+)")
_LARGEST = (1 << 63) - 1
_MOST_DIGITS = 100


class _Column:
    """A column that becomes an array when it is asked for: the tables of a log may have more columns together than rows with values.

    parts  rows and their values, of `rows` rows; the others are nan
    kept   the rows of these that stay, in their order; None: all
    ends   rows of these, and their values
    """

    def __init__(self, rows: int, parts: list[tuple[Any, Any]], kept: Any = None):
        self.rows, self.parts, self.kept = rows, parts, kept
        self.ends: list[tuple[int, float]] = []

    def to_array(self) -> numpy.ndarray:
        """Returns the values, nan where there are none."""
        import numpy

        values = numpy.full(self.rows, math.nan)
        for rows, known in self.parts:
            values[rows] = known
        values = values if self.kept is None else values[self.kept]
        for row, value in self.ends:
            values[row] = value
        return values


class _Table:
    """Columns of equal length by their names: arrays, and _Columns that become arrays."""

    def __init__(self, arrays: dict[str, Any], times: Any):
        self._arrays, self._times = arrays, times
        times.flags.writeable = False

    @property
    def columns(self) -> list[str]:
        """The names of the columns, as the log spells them. The second column of the same name is "NAME#2"."""
        return list(self._arrays)

    @property
    def steps(self) -> numpy.ndarray:
        """The timesteps, shape (rows,), int64."""
        return self["Step"]

    @property
    def times(self) -> numpy.ndarray:
        """The times, shape (rows,), float64: see granular.read_log."""
        return self._times

    def __getitem__(self, name: str) -> numpy.ndarray:
        if name not in self._arrays:
            raise c.ColumnError(f"expected a column of {', '.join(self._arrays)}, got {name!r}")
        values = self._arrays[name]
        if isinstance(values, _Column):
            values = self._arrays[name] = values.to_array()
        values.flags.writeable = False
        return values

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self.steps)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the rows as a pandas.DataFrame with the same columns."""
        import pandas

        return pandas.DataFrame(dict(self))

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__


class LogTable(_Table):
    """The rows of one run, or all rows, in the order of the log.

    table["KinEng"]  a column, float64; "Step" and "Run" are int64
    table.path       the log; of all rows, the first one
    table.line       the line of the names of the columns, from 1
    """

    def __init__(self, arrays: dict[str, Any], times: Any, path: str, line: int):
        super().__init__(arrays, times)
        self.path, self.line = path, line

    def __repr__(self) -> str:
        return f"<{len(self)} rows from {os.path.basename(self.path)}:{self.line}: {' '.join(self)}>"


class Log(_Table):
    """The thermo output of a simulation, from granular.read_log: each timestep once, in ascending order.

    log["KinEng"]         a column, shape (rows,), float64; "Step" is int64. The arrays are read-only.
    log.columns           the names of all columns, also list(log)
    log.steps, log.times  timesteps and times
    len(log)              the number of rows
    log.runs              a LogTable for each run
    log.all_rows          a LogTable of all rows in the order of the log; its column "Run" counts from 0
    log.paths             the logs, absolute

    If a timestep repeats, the last row counts, as the last frame of a restarted run does. At a timestep where one run ends and the
    next one begins, columns that only the run before has keep their values. A value that a run does not print is nan.
    """

    def __init__(self, arrays: dict[str, Any], times: Any, paths: list[str], runs: list[LogTable], all_rows: LogTable):
        super().__init__(arrays, times)
        self.paths, self.runs, self.all_rows = paths, runs, all_rows

    def __repr__(self) -> str:
        names = ", ".join(os.path.basename(path) for path in self.paths)
        return f"<log {names}: {len(self)} timesteps in {len(self.runs)} runs, columns {' '.join(self)}>"


def _numbers(words: list[bytes]) -> list[float] | None:
    """Returns the numbers that words spell, or None. Python would take 1_0 for a number, too."""
    try:
        return None if any(b"_" in word for word in words) else list(map(float, words))
    except ValueError:
        return None


def _whole(word: bytes) -> int:
    """Returns the whole number that a word spells, or one beyond all timesteps: Python refuses thousands of digits. Raises ValueError."""
    is_long = len(word) > _MOST_DIGITS and word.lstrip(b"-").isdigit()
    return _LARGEST + 1 if is_long else int(word)


def _unique(names: list[str]) -> list[str]:
    """Returns the names of columns, of which each occurs once."""
    made: dict[str, None] = {}
    counts: dict[str, int] = {}
    for name in names:
        unique, count = name, counts.get(name, 1)
        while unique in made:
            count += 1
            unique = f"{name}#{count}"
        made[unique], counts[name] = None, count
    return list(made)


class _Rows:
    """The rows of a run while the log is read: numbers in rows of the same width, or blocks of names and numbers."""

    def __init__(self, names: list[str], path: str, line: int, dt: bytes | None):
        self.columns, self.path, self.line, self.dt = _unique(names), path, line, dt
        self.width, self.at = len(names), names.index("Step")
        self.steps, self.values, self.last = array("q"), array("d"), -1
        self.blocks: list[dict[str, float]] | None = None
        self.known = {"CPU"}  # names in the blocks
        #: Where the first word of the first row begins and ends; 0: anywhere
        self.blanks = self.edge = 0

    def drop_last(self) -> None:
        """Takes the last row back."""
        self.steps.pop()
        if self.blocks is None:
            del self.values[-self.width:]
        else:
            self.blocks.pop()

    def arrays(self) -> dict[str, Any]:
        """The columns as arrays, Step first."""
        import numpy

        steps = numpy.frombuffer(self.steps, dtype=numpy.int64)
        if self.blocks is not None:
            parts: dict[str, tuple[list[int], list[float]]] = {}
            for row, block in enumerate(self.blocks):
                for name, value in block.items():
                    rows, known = parts.setdefault(name, ([], []))
                    rows.append(row)
                    known.append(value)
            return {"Step": steps, **{name: _Column(len(steps), [(numpy.array(rows), numpy.array(known))])
                                      for name, (rows, known) in parts.items()}}
        values = numpy.ascontiguousarray(numpy.frombuffer(self.values).reshape(-1, self.width).T)
        return {"Step": steps, **{name: values[i] for i, name in enumerate(self.columns) if i != self.at}}


_FREE_CONTENT = 1 << 28  # bytes that are read whatever the size of the compressed file
_LARGEST_EXPANSION = 200
_LONGEST_LINE = 1 << 22


class _TooMuch(ValueError):
    """The content of a compressed file is beyond its limit."""


class _Unpacked(io.RawIOBase):
    """A gzip file with content of at most so many bytes. If it ends early, its data are read up to the end before the error."""

    def __init__(self, file: gzip.GzipFile, most: int):
        self._file = file
        self._left = most

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        data = self._file.read1(len(buffer))
        self._left -= len(data)
        if self._left < 0:
            raise _TooMuch
        buffer[:len(data)] = data
        return len(data)


class _Reader:
    """Finds the tables among the lines of a log."""

    def __init__(self, path: str):
        self.path = path
        self.runs: list[_Rows] = []
        self._run: _Rows | None = None
        self._width = -1  # of rows that are expected now
        self._names: list[str] | None = None  # of a table whose first row may follow
        self._names_line, self._names_at, self._is_sure, self._is_yaml = 0, 0, False, False
        self._after_memory, self._knows_memory, self._in_block = False, False, False
        self._dt: bytes | None = None
        self._left_out, self._first_left_out, self._without_step = 0, "", 0
        self._empty_table: tuple[int, str] | None = None

    def _fail(self, line: int, text: str, column: str = "", byte: int = -1) -> NoReturn:
        raise c.Error(f"{c.shown(self.path)}{f':{line}' if line else ''}: {text}", self.path, line, byte, column)

    # ---- the file ----
    def read(self) -> list[_Rows]:
        import gzip
        import zlib

        def opened(path: str, flags: int) -> int:
            return os.open(path, flags | os.O_NONBLOCK)  # a pipe of that name must not make it wait

        with open(self.path, "rb", opener=opened) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError(f"{c.shown(self.path)}: expected a file, got a device or a pipe")
            head = file.peek(4)[:4]
            if head[:2] == b"\x1f\x8b":
                size = os.fstat(file.fileno()).st_size
                most = max(_FREE_CONTENT, size * _LARGEST_EXPANSION)
                try:
                    self._read(io.BufferedReader(_Unpacked(gzip.GzipFile(fileobj=file), most), 1 << 16))
                except _TooMuch:
                    self._fail(0, f"expected content of at most {_LARGEST_EXPANSION} times the {size} bytes of the file, got more; "
                                  "if you trust the file, unpack it first")
                except (OSError, zlib.error) as error:
                    self._fail(0, f"expected gzip data, got damaged ones: {error}")
            elif head == b"\x28\xb5\x2f\xfd":
                self._fail(0, "expected text or gzip data, got Zstandard: unpack the log first")
            else:
                self._read(file)
        return self.runs

    def _read(self, stream: Any) -> None:
        try:
            head = stream.peek(1024)[:1024]
        except EOFError:
            head = b""
        if b"\0" in head:
            self._fail(0, "expected the text of a log, got a binary file", byte=head.index(b"\0"))
        count, line, was_cut = self._read_lines(stream)
        if count == 0 and not was_cut:
            self._fail(0, "expected a log, got an empty file")
        if self._run and self._is_cut(line):
            self._run.drop_last()
            if not self._run.steps:
                self._empty_table = self._run.line, " ".join(self._run.columns)
        self.runs = [run for run in self.runs if run.steps]
        if not self.runs:
            self._fail_without_tables(count)
        if was_cut:
            _warn(f"{c.shown(self.path)}: expected complete gzip data, got data that end early: the rows before the end are read")
        if self._run and not line.endswith(b"\n"):
            _warn(f"{c.shown(self.path)}:{count}: the last line ends early and is left out")
        elif self._run and self._run.blocks is not None and self._cut_block:
            _warn(f"{c.shown(self.path)}:{count}: the last block ends early and is left out")
        if self._without_step:
            _warn(f"{c.shown(self.path)}:{self._without_step}: expected the column Step, got a table without it, which is left out")
        if self._left_out:
            _warn(f"{self._first_left_out}; lines like this are left out: {self._left_out}")

    _cut_block = False

    def _is_cut(self, line: bytes) -> bool:
        """Returns true if the last row of a run without an end is to be left out. Sets _cut_block."""
        run = self._run
        assert run is not None
        if run.blocks is None:
            return not line.endswith(b"\n") and self._took_last
        # a first block may have any number of lines
        is_short = len(run.blocks) < 2 or len(run.blocks[-1]) < len(run.blocks[-2])
        self._cut_block = self._in_block and (is_short or not line.endswith(b"\n"))
        return self._cut_block

    def _read_lines(self, stream: Any) -> tuple[int, bytes, bool]:
        """Returns the number of lines, the last one, and whether compressed data end early."""
        number, last, took = 0, b"", False
        try:
            while line := stream.readline(_LONGEST_LINE):
                number += 1
                if len(line) == _LONGEST_LINE and not line.endswith(b"\n"):
                    self._fail(number, f"expected lines of fewer than {_LONGEST_LINE} bytes, got a longer one")
                last = line
                words = line.split()
                took = len(words) == self._width and self._row(line, words, number)
                if not took and words:
                    took = self._other(line, words, number)
        except EOFError:
            return number, b"\n", True
        finally:
            self._took_last = took
        return number, last, False

    def _fail_without_tables(self, count: int) -> NoReturn:
        if self._empty_table is None and self._names:
            self._empty_table = self._names_line, " ".join(self._names)
        if self._empty_table:
            self._fail(self._empty_table[0], f"expected rows of numbers below the columns {self._empty_table[1]}, got none")
        if self._without_step:
            self._fail(self._without_step, "expected the column Step, got a table without it")
        self._fail(0, "expected a thermo table (a line of columns that begins with Step, or blocks '---- Step 0 ----- CPU = ...'), "
                      f"got {count} lines without one")

    # ---- rows of one line ----
    def _row(self, line: bytes, words: list[bytes], number: int) -> bool:
        """Takes a line as a row of the run, if it is one."""
        run = self._run
        assert run is not None
        try:
            step = _whole(words[run.at])
            values = list(map(float, words))
        except ValueError:
            return False
        if step <= run.last or b"_" in line or (run.edge and not self._fits(line, words)):
            return False
        self._check_step(step, words[run.at], number)
        run.last = step
        run.steps.append(step)
        run.values.extend(values)
        return True

    def _check_step(self, step: int, word: bytes, number: int) -> None:
        if abs(step) > _LARGEST:
            got = os.fsdecode(word) if len(word) <= _MOST_DIGITS else f"{len(word)} digits"
            self._fail(number, f"column 'Step': expected at most {_LARGEST}, got {got}", "Step")

    def _fits(self, line: bytes, words: list[bytes]) -> bool:
        """Returns true if a line begins as the first row does. Lines that `fix print` writes begin elsewhere."""
        run = self._run
        assert run is not None
        blanks = line.find(words[0])
        edge = blanks + len(words[0])
        return edge == run.edge or blanks == run.blanks or (blanks == 0 and edge > run.edge)

    def _begin(self, line: bytes, words: list[bytes], number: int) -> bool:
        """Begins a table if this line is its first row. If the names are not sure, the first row must follow them at once."""
        names = self._names
        assert names is not None
        is_row = len(words) == len(names) and _numbers(words) is not None
        is_close = self._is_sure or (number == self._names_line + 1 and (line[:1].isspace() or not self._knows_memory))
        if is_row and "Step" not in names and self._is_sure:
            self._without_step = self._without_step or self._names_line
            self._names = None
            return True
        if is_row and is_close and "Step" in names:
            before, self._run = self._run, _Rows(names, self.path, self._names_line, self._dt)
            run = self._run
            if self._row(line, words, number):
                if run.at == 0 and not self._is_yaml:
                    run.blanks = len(line) - len(line.lstrip())
                    run.edge = run.blanks + len(words[0])
                self.runs.append(run)
                self._names, self._width = None, run.width if not self._is_yaml else -1
                return True
            self._run = before
        if self._is_sure:
            self._judge(line, words, number, names, self._names_at)
            return False
        self._note_empty()
        self._names, self._width = None, self._run.width if self._run and self._run.blocks is None else -1
        return len(words) == self._width and self._row(line, words, number)

    def _judge(self, line: bytes, words: list[bytes], number: int, names: list[str], at: int) -> None:
        """Judges a line among the rows: other output, a damaged row, which is an error, or a line of numbers, which is counted."""
        run = self._run
        if not line.endswith(b"\n") or len(words) <= at or not words[at][:1].isdigit():
            return
        bad = [i for i, word in enumerate(words) if _numbers([word]) is None]
        if bad and len(words) == len(names) and 2 * len(bad) < len(words) and (run is None or run.edge == 0 or self._fits(line, words)):
            self._fail(number, f"column {names[bad[0]]!r}: expected a number, got {os.fsdecode(words[bad[0]])!r}", names[bad[0]])
        if 2 * len(bad) > len(words):
            return
        if not self._left_out:
            what = f"{len(names)} numbers in a row, got {len(words)}"
            if len(words) == len(names):
                after = f"a row after timestep {run.steps[-1]}" if run and run.steps else "a row of numbers"
                what = f"{after}, got {os.fsdecode(line.strip())!r}"
            self._first_left_out = f"{c.shown(self.path)}:{number}: expected {what}"
        self._left_out += 1

    # ---- other lines ----
    def _other(self, line: bytes, words: list[bytes], number: int) -> bool:
        """Looks at a line that is no row of the table. Returns True if it became one."""
        first = words[0]
        after_memory, self._after_memory = self._after_memory, False
        keyword = _KEYWORDS.get(first)
        if keyword and keyword(self, words, number, after_memory):
            return False
        if first == b"-" and len(words) > 1 and words[1][:1] == b"[":
            return self._yaml_row(line, number)
        if first.startswith(b"----") and self._begin_block(line, number):
            return False
        if self._in_block:
            self._in_block = self._pairs(line, words, number)
            if self._in_block:
                return False
        if after_memory and first.startswith(b"WARNING"):
            self._after_memory = True
        elif after_memory:
            self._expect([os.fsdecode(word) for word in words], number, is_sure=True)
            return False
        if self._names and self._begin(line, words, number):
            return True
        if self._run and self._run.blocks is None:
            self._judge(line, words, number, self._run.columns, self._run.at)
        return False

    def _expect(self, names: list[str], number: int, is_sure: bool, is_yaml: bool = False) -> None:
        """Expects the first row of a table."""
        self._note_empty()
        self._names, self._names_line, self._is_sure, self._is_yaml, self._width = names, number, is_sure, is_yaml, -1
        self._names_at = names.index("Step") if "Step" in names else _LARGEST

    def _note_empty(self) -> None:
        if self._names and self._empty_table is None:
            self._empty_table = self._names_line, " ".join(self._names)

    def _end(self, *_: Any) -> bool:
        """Ends the table: `Loop time of ...`, the beginning of another run, or of another program."""
        self._note_empty()
        self._run, self._names, self._width, self._in_block = None, None, -1, False
        return True

    def _loop(self, words: list[bytes], *_: Any) -> bool:
        return words[1:2] == [b"time"] and self._end()

    def _program(self, words: list[bytes], *_: Any) -> bool:
        return words[1:2] != [] and words[1][:1] == b"(" and self._end()

    def _memory(self, words: list[bytes], *_: Any) -> bool:
        """`Per MPI rank memory allocation ...` or `Memory usage per processor ...`, which the names of the columns follow."""
        if words[1:4] not in ([b"MPI", b"rank", b"memory"], [b"usage", b"per", b"processor"]):
            return False
        self._after_memory = self._knows_memory = True
        return self._end()

    def _step(self, words: list[bytes], number: int, after_memory: bool) -> bool:
        """Names of columns that begin with Step. After the line about memory they may be numbers: LIGGGHTS prints compute 1 as "1"."""
        if not after_memory and any(_numbers([word]) for word in words[1:]):
            return False
        self._expect([os.fsdecode(word) for word in words], number, after_memory)
        return True

    def _keywords(self, words: list[bytes], number: int, _: bool) -> bool:
        """Names of the columns by `thermo_modify line yaml`: keywords: ['Step', 'Temp', ]."""
        names = b" ".join(words[1:]).strip(b"[] ").split(b",")
        self._expect([os.fsdecode(name.strip(b" '\"")) for name in names if name.strip()], number, is_sure=True, is_yaml=True)
        return True

    def _yaml_row(self, line: bytes, number: int) -> bool:
        words = line.strip()[1:].strip(b" []").replace(b",", b" ").split()
        if not line.rstrip().endswith(b"]"):
            return False  # the last line, which ends early
        if self._names:
            return self._begin(line, words, number)
        if self._run and self._run.edge == 0 and self._run.blocks is None:
            if len(words) == self._run.width and self._row(line, words, number):
                return True
            self._judge(line, words, number, self._run.columns, self._run.at)
        return False

    def _timestep(self, words: list[bytes], *_: Any) -> bool:
        """The echo of `timestep 1e-5`, and what LAMMPS prints: `Time step : 1e-5`."""
        place = 1 if words[0] == b"timestep" else 3 if words[1:3] == [b"step", b":"] else len(words)
        numbers = _numbers(words[place:place + 1])
        if numbers and 0 < numbers[0] < math.inf:
            self._dt = words[place]
        return bool(numbers)

    def _units(self, words: list[bytes], *_: Any) -> bool:
        """The echo of `units si`, which sets the timestep."""
        if words[1:2] and words[1] in _DEFAULTS:
            self._dt = _DEFAULTS[words[1]]
        return words[0] == b"units"

    # ---- blocks of thermo_style multi ----
    def _begin_block(self, line: bytes, number: int) -> bool:
        found = _BLOCK.match(line)
        if not found:
            return False
        step, seconds = _whole(found.group(1)), _numbers([found.group(2)])
        self._check_step(step, found.group(1), number)
        run = self._run
        if run is None or run.blocks is None or step <= run.steps[-1]:
            self._end()
            self._run = run = _Rows(["Step"], self.path, number, self._dt)
            run.blocks = []
            self.runs.append(run)
        run.steps.append(step)
        run.blocks.append({"CPU": seconds[0]} if seconds else {})  # type: ignore[union-attr]
        self._in_block = True
        return True

    def _pairs(self, line: bytes, words: list[bytes], number: int) -> bool:
        """Takes a line of `Name = value` after the first line of a block."""
        run = self._run
        if not line.endswith(b"\n"):
            return True  # the block is left out
        if run is None or not run.blocks or len(words) % 3 or any(word != b"=" for word in words[1::3]):
            return False
        names, values = [os.fsdecode(word) for word in words[::3]], _numbers(words[2::3])
        if values is None:
            name, word = next((name, word) for name, word in zip(names, words[2::3]) if _numbers([word]) is None)
            if name not in run.known:
                return False
            self._fail(number, f"column {name!r}: expected a number, got {os.fsdecode(word)!r}", name)
        pairs = {name: value for name, value in zip(names, values) if name != "Step"}
        run.blocks[-1].update(pairs)
        run.known.update(pairs)
        return True


# The first words of lines that say something of the tables. A function returns False if its line says nothing of them.
_KEYWORDS = {b"Step": _Reader._step, b"Loop": _Reader._loop, b"Per": _Reader._memory, b"Memory": _Reader._memory,
             b"LAMMPS": _Reader._program, b"LIGGGHTS": _Reader._program, b"keywords:": _Reader._keywords,
             b"timestep": _Reader._timestep, b"Time": _Reader._timestep, b"units": _Reader._units}


def _clocks(runs: list[_Rows], dt: float | None) -> list[tuple[Fraction, Fraction]] | None:
    """Size and offset of each run: time = offset + size x timestep. None if a run says nothing of its timestep.

    Where the size changes, times go on from those of the runs before."""
    from fractions import Fraction

    sizes = [repr(float(dt)) if dt is not None else run.dt and repr(float(run.dt)) for run in runs]
    made: list[tuple[Fraction, Fraction]] = []
    earlier: list[int] = []  # the runs before that a later one may follow, by their first timesteps
    for number, (run, text) in enumerate(zip(runs, sizes)):
        if text is None:
            return None
        size, offset, start = Fraction(text), Fraction(0), run.steps[0]
        while earlier and runs[earlier[-1]].steps[0] > start:
            earlier.pop()
        if earlier:
            before = made[earlier[-1]]
            offset = before[1] + (before[0] - size) * start
        made.append((size, offset))
        earlier.append(number)
    return made


def _step_times(runs: list[_Rows], dt: float | None) -> Any:
    """The times of all rows by their timesteps: the doubles nearest to the exact numbers. None if they are not known."""
    import numpy

    clocks, times = _clocks(runs, dt), array("d")
    if clocks is None:
        return None
    for run, (size, offset) in zip(runs, clocks):
        below = math.lcm(size.denominator, offset.denominator)
        factor, start = int(size * below), int(offset * below)
        try:
            times.extend((step * factor + start) / below for step in run.steps)  # rounded once
        except OverflowError:
            raise c.ArgumentError(f"{run.path}: expected a dt that gives finite times, got {dt}") from None
    return numpy.frombuffer(times)


def _times(runs: list[_Rows], everything: dict[str, Any], dt: float | None) -> Any:
    """The times of all rows."""
    import numpy

    times = _step_times(runs, dt)
    if dt is None and "Time" in everything:
        printed = everything["Time"].to_array()
        is_known = numpy.isfinite(printed)
        if times is not None:
            return numpy.where(is_known & (abs(times - printed) > 1e-5 * abs(printed)), printed, times)
        if is_known.all():
            return printed
    return everything["Step"].astype(float) if times is None else times


def _merged(runs: list[dict[str, Any]], starts: list[int], everything: dict[str, Any]) -> tuple[dict[str, Any], Any]:
    """Returns the last row of each timestep in ascending order, and the numbers of these rows."""
    import numpy

    steps = everything["Step"]
    order = numpy.argsort(steps, kind="stable")
    ordered = steps[order]
    kept = order[numpy.append(ordered[1:] != ordered[:-1], True)]
    merged = {name: values[kept] if name == "Step" else _Column(len(steps), values.parts, kept) for name, values in everything.items()}
    # the first row of a run is of the state in which the run before ended
    for number, row in enumerate(starts[:-1]):
        place = int(numpy.searchsorted(merged["Step"], steps[row]))
        if kept[place] != row:
            continue
        seen = set(runs[number])
        while number > 0 and steps[starts[number]] == steps[starts[number] - 1]:
            number -= 1
            for name in runs[number].keys() - seen:
                merged[name].ends.append((place, _last(runs[number][name])))
            seen.update(runs[number])
            if len(runs[number]["Step"]) > 1:
                break
    return merged, kept


def _last(values: Any) -> float:
    """The value in the last row."""
    if not isinstance(values, _Column):
        return values[-1]
    rows, known = values.parts[-1]
    return known[-1] if rows[-1] == values.rows - 1 else math.nan


def read_log(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None) -> Log:
    """Reads the thermo tables of a log of LAMMPS or LIGGGHTS, and returns them as a Log. Needs numpy alone.

    paths  the log, or what the program printed on the screen, plain or .gz; a list of logs, in the order in which they were written
    dt     the time of one timestep, greater than 0, in the unit of the run. None: the log says it, by its commands `timestep` and
           `units` or by LAMMPS's line "Time step". If the timestep changes, times go on from those of the run before. A column
           Time counts if it differs by more than rounding, as with `fix dt/reset`. If the log says nothing, times are timesteps.

    The function reads thermo_style one, multi, custom and yaml, of any number of runs, with columns that differ. It skips other lines
    between the rows. Three things are left out with a warning: a last row that ends early, because a simulation may be writing it;
    lines of numbers that are no rows of their table; tables without the column Step.

    Raises FileNotFoundError if there is no such file; granular.Error with path, line and column if a row has a word in place of a
    number, if a file is binary or empty, if a line has 4 MiB or more, if the content of a compressed log exceeds 256 MiB and 200 times
    its size, and if it has no table with rows; granular.ArgumentError for a dt that cannot be.
    """
    import numpy

    given = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    if not given:
        raise c.ArgumentError("expected at least one log, got none")
    if dt is not None and not 0 < float(dt) < math.inf:
        raise c.ArgumentError(f"expected a dt that is finite and greater than 0, got {dt}")
    names = [os.path.abspath(os.fsdecode(path)) for path in given]
    rows: list[_Rows] = []
    for name in names:
        reader = _Reader(name)
        reader._dt = rows[-1].dt if rows else None  # a log that begins with a restart file may not say it again
        rows += reader.read()
    tables = [run.arrays() for run in rows]
    sizes = [len(run.steps) for run in rows]
    starts = [0]
    for size in sizes:
        starts.append(starts[-1] + size)
    everything: dict[str, Any] = {"Step": numpy.concatenate([table["Step"] for table in tables])}
    for table, start, size in zip(tables, starts, sizes):
        for name, values in table.items():
            if name != "Step":
                is_whole = not isinstance(values, _Column)
                parts = [(slice(start, start + size), values)] if is_whole else [(rows + start, known) for rows, known in values.parts]
                everything.setdefault(name, _Column(starts[-1], [])).parts.extend(parts)
    times = _times(rows, everything, dt)
    merged, kept = _merged(tables, starts, everything)
    runs = [LogTable(table, times[start:start + size], run.path, run.line) for table, run, start, size in zip(tables, rows, starts, sizes)]
    numbered = {"Run": numpy.repeat(numpy.arange(len(rows)), sizes), **everything}
    return Log(merged, times[kept], names, runs, LogTable(numbered, times, rows[0].path, rows[0].line))
