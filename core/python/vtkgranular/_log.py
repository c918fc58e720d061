# SPDX-License-Identifier: BSD-3-Clause
"""The thermo tables in logs of LAMMPS and LIGGGHTS as numpy arrays."""
from __future__ import annotations

import math
import os
import re
import stat
from array import array
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Iterable, Iterator, NoReturn, Sequence

from . import _library as c
from ._run import _warn

if TYPE_CHECKING:
    import numpy
    import pandas

#: The timesteps that LAMMPS and LIGGGHTS use after the command `units`.
_DEFAULTS = {b"lj": 0.005, b"real": 1.0, b"metal": 0.001, b"si": 1e-8, b"cgs": 1e-8, b"electron": 0.001, b"micro": 2.0, b"nano": 0.00045}
#: The columns of `thermo_style one`, which is the first one.
_ONE = [b"step", b"temp", b"epair", b"emol", b"etotal", b"press"]
#: Lines that say something of the tables. The last group of a line names the method of the reader that takes it.
_KNOWN = re.compile(rb"""\s*(?:
    (?P<end>Loop\s+time|(?:LAMMPS|LIGGGHTS)\s+\()
    |(?P<memory>Per\s+MPI\s+rank\s+memory|Memory\s+usage\s+per\s+processor)\s
    |keywords:\s*\[(?P<keywords>.*)\]
    |-\s+\[(?P<row>.*)\]\s*$
    |-{4,}\s*Step\s+(?P<step>-?\d+)\s+-{2,}\s*CPU\s*=\s*(?P<block>\S+)
    |(?P<command>(?:timestep|Time\s+step\s+:|units|reset_timestep|thermo_style|thermo_modify)\s+(?P<words>\S.*))
)""", re.VERBOSE)
# `colname 3 "Kinetic Energy"` or `colname default`, and the names in keywords: ['Step', "v_a", c_b[1], ]
_COLNAME = re.compile(rb"""\bcolname\s+(?:(default)(?!\S)|(\S+)\s+(?:"([^"]+)"|'([^']+)'|(\S+)))""")
_KEYWORD = re.compile(rb"""\s*(?:"([^"]*)"|'([^']*)'|([^\s,][^,]*))""")
_LARGEST = (1 << 63) - 1
_MOST_DIGITS = 100
_FREE_CONTENT = 1 << 28  # bytes that are read whatever the size of the compressed file
_LARGEST_EXPANSION = 200
_LONGEST_LINE = 1 << 22
_CHUNK = 1 << 18


class _Table:
    """Columns of equal length by their names. They become arrays when they are asked for: the tables of a log may have more columns
    together than rows with values."""

    def __init__(self, names: Iterable[str], times: Any):
        self._arrays: dict[str, Any] = dict.fromkeys(names)
        self._times = times
        times.flags.writeable = False

    def _column(self, name: str) -> numpy.ndarray:
        raise NotImplementedError

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
        """The times, shape (rows,), float64: see vtkgranular.read_log."""
        return self._times

    def __getitem__(self, name: str) -> numpy.ndarray:
        if name not in self._arrays:
            raise c.ColumnError(f"expected a column of {', '.join(self._arrays)}, got {name!r}")
        if self._arrays[name] is None:
            self._arrays[name] = self._column(name)
            self._arrays[name].flags.writeable = False
        return self._arrays[name]

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self.steps)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the rows as a pandas.DataFrame with the same columns."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self})


class LogTable(_Table):
    """The rows of one run, or all rows, in the order of the log.

    table["KinEng"]  a column, float64; "Step" and "Run" are int64
    table.path       the log; of all rows, the first one
    table.line       the line of the names of the columns, from 1
    """

    def __init__(self, runs: list[_Run], times: Any, has_numbers: bool = False):
        names = dict.fromkeys(name for run in runs for part in run.parts for name in part)
        self._has_numbers = has_numbers and "Run" not in names  # the log's own column counts
        super().__init__(dict.fromkeys([*(["Run"] if self._has_numbers else []), "Step", *names]), times)
        self._runs, self.path, self.line = runs, runs[0].path, runs[0].line

    def _column(self, name: str) -> numpy.ndarray:
        import numpy

        if name == "Run" and self._has_numbers:
            return numpy.repeat(numpy.arange(len(self._runs)), [len(run.steps) for run in self._runs])
        return numpy.concatenate([numpy.array(run.steps) if name == "Step" else run.column(name) for run in self._runs])

    def __repr__(self) -> str:
        return f"<{len(self)} rows from {os.path.basename(self.path)}:{self.line}: {' '.join(self)}>"


class Log(_Table):
    """The thermo output of a simulation, from vtkgranular.read_log: each timestep once, in ascending order.

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

    def __init__(self, paths: list[str], runs: list[LogTable], all_rows: LogTable):
        import numpy

        steps = all_rows.steps
        order = numpy.argsort(steps, kind="stable")
        self._kept = order[numpy.append(steps[order][1:] != steps[order][:-1], True)]
        super().__init__([name for name in all_rows if name != "Run" or not all_rows._has_numbers], all_rows.times[self._kept])
        self.paths, self.runs, self.all_rows = paths, runs, all_rows

    def _column(self, name: str) -> numpy.ndarray:
        values, steps, start = self.all_rows._column(name), self.all_rows.steps, 0
        for before, run in zip(self.runs, self.runs[1:]):
            start += len(before.times)
            # the first row of a run is of the state in which the run before ended
            if name not in run and steps[start] == steps[start - 1]:
                values[start] = values[start - 1]
        return values[self._kept]

    def __repr__(self) -> str:
        names = ", ".join(os.path.basename(path) for path in self.paths)
        return f"<log {names}: {len(self)} timesteps in {len(self.runs)} runs, columns {' '.join(self)}>"


def _numbers(words: list[bytes]) -> list[float] | None:
    """Returns the numbers that words spell, or None. Python would take 1_0 for a number, too."""
    try:
        return None if any(b"_" in word for word in words) else list(map(float, words))
    except ValueError:
        return None


def _unique(names: list[str]) -> tuple[str, ...]:
    """Returns the names of columns, of which each occurs once."""
    made: dict[str, None] = {}
    counts: dict[str, int] = {}
    for name in names:
        unique, count = name, counts.get(name, 1)
        while unique in made:
            count += 1
            unique = f"{name}#{count}"
        made[unique], counts[name] = None, count
    return tuple(made)


class _Run:
    """The rows of a run: lines of numbers with names, or blocks without.

    dt     the timestep that a command chose since the run before, or None
    reset  the time at the first row after the command `reset_timestep`
    edge   where the first word of the first row begins and ends, if it is the timestep
    parts  by the names of columns: the numbers of the rows that have them, None for all, and their values; blocks make several
    """

    def __init__(self, path: str, line: int, dt: float | None, names: list[str], is_yaml: bool = False):
        self.path, self.line, self.dt, self.names, self.is_yaml = path, line, dt, _unique(names), is_yaml
        self.at, self.width = names.index("Step") if "Step" in names else None, -1 if is_yaml else len(names) or -1
        self.is_counted = bool(names) and self.at is None  # rows without Step
        self.steps, self.last, self.reset = array("q"), -1, None
        self.edge, self.tail = (0, 0), b""  # the line in which the last row ends
        self.values = array("d")  # of the rows in lines
        self.parts: dict[tuple[str, ...], tuple[array[int] | None, array[float]]] = {self.names: (None, self.values)} if names else {}

    def add(self, step: int, block: dict[str, float], tail: bytes) -> None:
        """Adds a block."""
        rows, values = self.parts.setdefault(tuple(block), (array("q"), array("d")))
        rows.append(len(self.steps))
        values.extend(block.values())
        self.steps.append(step)
        self.last, self.tail = step, tail

    def fits(self, line: bytes, words: list[bytes]) -> bool:
        """Returns true if the line begins as the first row does. Lines that `fix print` writes begin elsewhere."""
        begin = line.find(words[0])
        end = begin + len(words[0])
        first, edge = self.edge
        return end == edge or begin == first or edge == 0 or (begin == 0 and end > edge)

    def column(self, name: str) -> numpy.ndarray:
        """Returns a column, nan where a row does not have it."""
        import numpy

        values = numpy.full(len(self.steps), math.nan)
        for names, (rows, numbers) in self.parts.items():
            if name in names:
                places = slice(None) if rows is None else numpy.frombuffer(rows, numpy.int64)
                values[places] = numpy.frombuffer(numbers)[names.index(name)::len(names)]
        return values


class _Reader:
    """Finds the tables among the lines of a log."""

    def __init__(self, path: str):
        self.path, self.number = path, 0  # of the line that is read now
        self.runs: list[_Run] = []
        self.notes: list[tuple[int, str]] = []  # lines, and what is left out there
        self._is_open = False  # has the last line no line feed?
        self._run: _Run | None = None
        self._width = -1  # of rows that are expected now
        self._header: tuple[int, list[list[str]], bytes] | None = None  # whose rows follow: line, ways to read the names, text
        self._is_next = self._knows_memory = False  # is the next line a header, and has a line said so?
        self._columns: list[bytes] = []  # the words of the last such header
        self._block: tuple[int, dict[str, float], bytes] | None = None  # that is read now: timestep, values, last line
        self._style, self._step = _ONE, "Step"  # the keywords of the columns, and the name of the timestep
        self._colnames: set[bytes] = set()
        self._dt: float | None = None
        self._reset: list[float] = []  # the timestep, and the time if it is told
        self._unfit: list[tuple[int, str]] = []  # lines of numbers that are no rows
        self._empty: tuple[int, str] | None = None  # the last line that may be a header, and what is wrong
        self._named, self._loops = 0, [0]  # tables that are read or named, and their number at each line "Loop time"
        self._missing: list[int] = []  # lines "Loop time" without a table

    def where(self, line: int) -> str:
        return f"{c.shown(self.path)}{f':{line}' if line else ''}: "

    def _fail(self, line: int, text: str, column: str = "", byte: int = -1) -> NoReturn:
        raise c.Error(self.where(line) + text, self.path, line, byte, column)

    # ---- the file ----
    def read(self, before: _Run | None) -> None:
        """Reads the log, which may go on after a run of another log."""
        self._before, lines, is_cut = before, self._lines(), False
        following = next(lines, None)
        while following is not None:
            line, following = following, next(lines, None)
            self.number += 1
            words = line.split()
            is_cut = self._is_open and following is None and not self._is_whole(line, words)
            if words and not is_cut and (len(words) != self._width or not self._row(line, words)):
                self._other(line, words, following or b"")
        run, is_short = self._run, False
        if run and self._block:
            is_short = not run.parts or len(self._block[1]) < len(next(reversed(run.parts)))
            self._block = None if is_short else self._block
            self._end_block()
        if run and (is_cut or is_short) and self.runs:
            self.notes.append((self.number, f"the last {'line' if is_cut else 'block'} ends early and is left out"))
        if not self.runs:
            self._drop_header()
            self._fail(*self._empty or (0, "expected a thermo table (a line of columns that begins with Step, or blocks "
                                           f"'---- Step 0 ----- CPU = ...'), got {self.number} lines without one"))
        if self._missing:
            self.notes.append((self._missing[0], f"expected a table for each of {len(self._loops) - 1} lines 'Loop time', got none before "
                                                 f"line {', '.join(map(str, self._missing))}"))
        if self._unfit:
            self.notes.append((self._unfit[0][0], f"{self._unfit[0][1]}; lines like this are left out: {len(self._unfit)}"))

    def _lines(self) -> Iterator[bytes]:
        """Yields the lines. The last one is open if it has no line feed and no checksum closes the file."""
        import gzip
        import zlib

        rest, count, number = b"", 0, 1
        with open(self.path, "rb", opener=lambda path, flags: os.open(path, flags | os.O_NONBLOCK)) as file:  # a pipe must not make it wait
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError(f"{c.shown(self.path)}: expected a file, got a device or a pipe")
            head, size = file.peek(4)[:4], os.fstat(file.fileno()).st_size
            if head == b"\x28\xb5\x2f\xfd":
                self._fail(0, "expected text or gzip data, got Zstandard: unpack the log first")
            is_packed = head[:2] == b"\x1f\x8b"
            read = gzip.GzipFile(fileobj=file).read1 if is_packed else file.read
            try:
                while chunk := read(_CHUNK):
                    if count == 0 and b"\0" in chunk[:1024]:
                        self._fail(0, "expected the text of a log, got a binary file", byte=chunk.index(b"\0"))
                    count += len(chunk)
                    if is_packed and count > max(_FREE_CONTENT, size * _LARGEST_EXPANSION):
                        self._fail(0, f"expected content of at most {_LARGEST_EXPANSION} times the {size} bytes of the file, got more; "
                                      "if you trust the file, unpack it first")
                    *lines, rest = (rest + chunk).split(b"\n")
                    for after, line in ((0, lines[0] if lines else rest), (len(lines), rest)):
                        if len(line) >= _LONGEST_LINE:
                            self._fail(number + after, f"expected lines of fewer than {_LONGEST_LINE} bytes, got a longer one")
                    number += len(lines)
                    yield from lines
            except EOFError:
                rest, count = b"", count or 1
                self.notes.append((0, "expected complete gzip data, got data that end early: the rows before the end are read"))
            except (OSError, zlib.error) as error:
                if not is_packed:
                    raise
                self._fail(0, f"expected gzip data, got damaged ones: {error}")
        if count == 0:
            self._fail(0, "expected a log, got an empty file")
        if rest.strip():
            self._is_open = not is_packed
            yield rest

    def _is_whole(self, line: bytes, words: list[bytes]) -> bool:
        """Returns true if a last line without a line feed is complete: a row as long as the one before, or rows have no fixed length."""
        run, header, is_known = self._run, self._header, bool(_KNOWN.match(line))
        if is_known or not _numbers(words) and not self._block:
            return is_known or not (run or header)
        if header:
            return bool(self._names(len(words))) and (line[-1:].isspace() or not header[2][-1:].isspace())
        if not run or not (self._block or len(words) == self._width):
            return not run
        is_long = len(line) + run.tail[-1:].isspace() >= len(run.tail) > 0
        if self._block:  # the last of its lines
            return is_long and words[::3] == run.tail.split()[::3] and bool(_numbers(words[2::3]))
        return is_long or line[-1:].isspace() or not (run.tail[:1].isspace() or run.tail[-1:].isspace())

    # ---- rows ----
    def _row(self, line: bytes, words: list[bytes]) -> bool:
        """Takes words as a row of the run, if they are one."""
        run = self._run
        try:
            step = run.last + 1 if run.at is None else int(words[run.at][:_MOST_DIGITS])
            values = list(map(float, words))
        except ValueError:
            return False
        if step <= run.last or b"_" in line or (run.edge[1] and not run.fits(line, words)):
            return False
        if step > _LARGEST:
            self._fail_large(words[run.at or 0])
        run.values.extend(values)
        run.steps.append(step)
        run.last, run.tail = step, line
        return True

    def _fail_large(self, word: bytes) -> NoReturn:
        got = os.fsdecode(word) if len(word) <= _MOST_DIGITS else f"{len(word)} digits"
        self._fail(self.number, f"column 'Step': expected at most {_LARGEST}, got {got}", "Step")

    def _begin(self, line: bytes, words: list[bytes], is_yaml: bool = False) -> None:
        """Begins the table whose header was found, if these words are its first row."""
        number, (names, *_), _ = self._header
        found, before = self._names(len(words)), self._run
        self._run = _Run(self.path, number, self._dt, found or names, is_yaml)
        if found and self._row(line, words):
            begin = line.find(words[0])
            self._run.edge = (begin, begin + len(words[0])) if self._run.at == 0 and not is_yaml else (0, 0)
            self._take(self._run)
            self._header, self._width = None, self._run.width
        else:
            self._run = before
            self._judge(line, words, found or names, None)

    def _take(self, run: _Run) -> None:
        """Adds a run with its first row, and the time that `reset_timestep` gives to it: 0 if the timestep becomes smaller."""
        (step, *time), before = self._reset or [-1], self.runs[-1] if self.runs else self._before
        if step == run.last and (time or (before and step < before.last)):
            run.reset = Fraction(repr(time[0] if time else 0.0))
        self._reset, self._dt = [], None
        self.runs.append(run)
        self._named += 1

    def _judge(self, line: bytes, words: list[bytes], names: Sequence[str], run: _Run | None) -> None:
        """Judges a line among the rows: other output, a damaged row, which is an error, or a line of numbers, which is counted."""
        at = names.index("Step") if "Step" in names else 0
        bad = [i for i, word in enumerate(words) if _numbers([word]) is None]
        if len(words) <= at or not words[at][:1].isdigit() or 2 * len(bad) > len(words):
            return
        if bad and len(words) == len(names) and 2 * len(bad) < len(words) and (run is None or run.fits(line, words)):
            self._fail(self.number, f"column {names[bad[0]]!r}: expected a number, got {os.fsdecode(words[bad[0]])!r}", names[bad[0]])
        what = f"{len(names)} numbers in a row, got {len(words)}"
        if len(words) == len(names):
            what = f"{f'a row after timestep {run.last}' if run else 'a row of numbers'}, got {os.fsdecode(line.strip())!r}"
        self._unfit.append((self.number, f"expected {what}"))

    # ---- headers ----
    def _expect(self, ways: list[list[bytes]], line: bytes = b"") -> None:
        """Expects rows of a table with names of columns. A line may be read in several ways."""
        self._drop_header()
        names = [[os.fsdecode(word) for word in way] for way in ways]
        names = [way if "Step" in way else ["Step" if name == self._step else name for name in way] for way in names]
        self._header, self._width = (self.number, names, line), -1

    def _names(self, width: int) -> list[str] | None:
        """Returns so many names of the header, or None. `... RDN PEN`, which NEB prints, stands for any number of columns."""
        names = self._header[1][0]
        if "..." in names and width >= (known := names.index("...")):
            return [*names[:known], *map(str, range(known + 1, width + 1))]
        return next((way for way in self._header[1] if len(way) == width), None)

    def _drop_header(self) -> None:
        """Notes that no rows follow a header."""
        if self._header:
            self._empty = self._header[0], f"expected rows of numbers below the columns {' '.join(self._header[1][0])}, got none"
            self.notes.append((self._empty[0], self._empty[1] + ": the table is left out"))
            self._named += 1
        self._header = None

    def _other(self, line: bytes, words: list[bytes], following: bytes) -> None:
        """Looks at a line that is no row of the table."""
        is_next, self._is_next = self._is_next, False
        found = _KNOWN.match(line)
        if found and not (is_next and found.lastgroup == "command"):
            getattr(self, f"_on_{found.lastgroup}")(found)
            return
        if self._block:
            if self._pairs(line):
                return
            self._end_block()
        if is_next and (words[0].startswith(b"WARNING") or words[:2] == [b"For", b"more"] or words == [b"---"]):
            self._is_next = True
        elif is_next or (words == self._columns and not _numbers(words)):
            self._columns = words
            self._expect(self._ways(line, words), line)
        elif words[0] == b"Step" and not self._header and not any(_numbers([word]) for word in words[1:]):
            self._guess(line, words, following)
        elif self._header:
            self._begin(line, words)
        elif self._run and self._run.names:
            self._judge(line, words, self._run.names, self._run)

    def _ways(self, line: bytes, words: list[bytes]) -> list[list[bytes]]:
        """Returns the ways to split a line into names: words, blanks between them, or names told by `thermo_modify colname`."""
        told = [rb"(?<!\S)" + re.escape(name) + rb"(?!\S)" for name in self._colnames]
        ways = [words, re.split(rb"\s{2,}", line.strip()), re.findall(b"|".join([*told, rb"\S+"]), line)]
        return [way for way in ways if len(way) > 1 or way == words]

    def _guess(self, line: bytes, words: list[bytes], following: bytes) -> None:
        """Expects a table if the first row follows a line that begins with Step at once."""
        self._empty = self.number, f"expected rows of numbers below the columns {os.fsdecode(b' '.join(words))}, got none"
        row, width = following.split(), self._width
        if row and _numbers(row) and (following[:1].isspace() or not self._knows_memory):
            self._expect(self._ways(line, words), line)
            names = self._names(len(row))
            if not names:
                self._drop_header()
            if not names or "Step" not in names or not row[names.index("Step")].isdigit():
                self._header, self._width = None, width

    def _on_end(self, found: Any) -> None:
        """Ends the table: `Loop time of ...`, or the beginning of another run or program."""
        self._end_block()
        self._drop_header()
        self._run, self._width = None, -1
        if found.lastgroup == "end" and found["end"].startswith(b"Loop"):
            self._missing += [self.number] if self._named == self._loops[-1] else []
            self._loops.append(self._named)

    def _on_memory(self, found: Any) -> None:
        """`Per MPI rank memory allocation ...` or `Memory usage per processor ...`, which the names of the columns follow."""
        self._on_end(found)
        self._is_next = self._knows_memory = True

    def _on_keywords(self, found: Any) -> None:
        self._expect([[b"".join(ways).strip() for ways in _KEYWORD.findall(found["keywords"])]])

    def _on_row(self, found: Any) -> None:
        line, words, run = found["row"], found["row"].replace(b",", b" ").split(), self._run
        if self._header:
            self._begin(line, words, is_yaml=True)
        elif run and run.is_yaml and not (len(words) == len(run.names) and self._row(line, words)):
            self._judge(line, words, run.names, run)

    def _on_command(self, found: Any) -> None:
        """The echo of a command that changes times or names, and LAMMPS's `Time step : 1e-5`."""
        name, words = found["command"].split()[0], found["words"].split()
        if name in (b"timestep", b"Time"):
            (number,) = _numbers(words[:1]) or [0]
            self._dt = number if 0 < number < math.inf else self._dt
        elif name == b"units":
            self._dt = _DEFAULTS.get(words[0], self._dt)
        elif name == b"reset_timestep" and words[0].isdigit():
            time = _numbers(words[2:3]) if words[1:2] == [b"time"] else None
            self._reset = [int(words[0][:_MOST_DIGITS]), *filter(math.isfinite, time or [])]
        elif name == b"thermo_style":
            self._style, self._step, self._colnames = words[1:] if words[0] == b"custom" else _ONE, "Step", set()
        elif name == b"thermo_modify":
            for is_default, key, *ways in _COLNAME.findall(found["words"]):
                place = int(key) if re.fullmatch(rb"-?\d{1,4}", key) else 0
                if 0 < abs(place) <= len(self._style):
                    key = self._style[place - (place > 0)]
                self._colnames = set() if is_default else {*self._colnames, b"".join(ways)}
                self._step = "Step" if is_default else os.fsdecode(b"".join(ways)) if key == b"step" else self._step

    # ---- blocks of thermo_style multi ----
    def _on_block(self, found: Any) -> None:
        self._end_block()
        step, seconds, run = int(found["step"][:_MOST_DIGITS]), _numbers([found["block"]]), self._run
        if abs(step) > _LARGEST:
            self._fail_large(found["step"])
        if run is None or run.names or step <= run.last:
            self._on_end(found)
            self._run = _Run(self.path, self.number, self._dt, [])
        self._block = step, {"CPU": seconds[0]} if seconds else {}, b""

    def _end_block(self) -> None:
        if self._block and self._run:
            step, block, line = self._block
            self._run.add(step, block, line)
            if len(self._run.steps) == 1:
                self._take(self._run)
        self._block = None

    def _pairs(self, line: bytes) -> bool:
        """Takes a line of `Name = value` after the first line of a block."""
        step, block, _ = self._block
        name, *others = line.split(b"=")
        pairs = []
        for piece in others:
            value, *rest = piece.split(None, 1) or [b""]
            pairs.append((name.strip(), value))
            name = rest[0] if rest else b""
        if name.strip() or not all(name and (b" " not in name or name in self._colnames) for name, _ in pairs):
            return False
        for name, word in ((os.fsdecode(name), word) for name, word in pairs):
            values = _numbers([word])
            if values is None and not any(name in part for part in (block, *self._run.parts)):
                return False
            if values is None:
                self._fail(self.number, f"column {name!r}: expected a number, got {os.fsdecode(word)!r}", name)
            if name != "Step":
                block[name] = values[0]
        self._block = step, block, line
        return True


def _digit(column: Any) -> float:
    """Returns one unit of the last digit with which the end of a column is printed."""
    finite = [float(x) for x in column[-20:] if math.isfinite(x)]
    return min((10.0 ** int(Decimal(repr(x)).as_tuple().exponent) for x in finite), default=0.0)


def _times(runs: list[_Run], dt: float | None) -> list[Any]:
    """Returns the times of each run: the doubles nearest to offset + size x timestep, or a column Time that differs by more.

    Where the size changes, times go on from those of the runs before. The last dt in a column Dt, or Time over Step, holds for the runs
    that follow, until a command chooses another one.
    """
    import numpy

    size = None if dt is None else Fraction(repr(float(dt)))
    earlier: list[tuple[int, Fraction, Fraction]] = []  # first timestep, size and offset of runs that a later one may follow
    all_times = []
    for run in runs if dt or not runs[0].is_counted else []:
        steps, start, offset = numpy.array(run.steps), run.steps[0], Fraction(0)
        while earlier and (earlier[-1][0] > start or run.reset is not None):
            earlier.pop()
        if dt is None and run.dt:
            size = Fraction(repr(run.dt))
        times = numpy.full(len(steps), math.nan)
        if size is not None:
            if dt is None and run.reset is not None:
                offset = run.reset - size * start
            elif earlier:
                offset = earlier[-1][2] + (earlier[-1][1] - size) * start
            below = math.lcm(size.denominator, offset.denominator)
            factor, first = int(size * below), int(offset * below)
            try:
                times = numpy.array([(step * factor + first) / below for step in run.steps])  # rounded once
            except OverflowError:
                raise c.ArgumentError(f"{run.path}: expected a dt that gives finite times, got {dt}") from None
        if dt is None:
            sizes, printed, known = run.column("Dt"), run.column("Time"), float(size or 0)
            if not run.names or not (numpy.isfinite(sizes) & (sizes > 0)).all():  # blocks print four decimals
                sizes[:] = math.nan
            if (abs(sizes - known) > 1e-5 * known).any():
                begin = sizes[0] * start if size is None else times[0]
                times = begin + numpy.append(0, numpy.cumsum(numpy.diff(steps) * sizes[:-1]))
                known = sizes[-1]
            digit = _digit(printed)
            is_other = numpy.isfinite(printed) & ~(abs(times - printed) <= numpy.maximum(1e-5 * abs(printed), 0.51 * digit))
            times = numpy.where(is_other, printed, times)
            if is_other[-1] and len(steps) > 1 and not sizes[-1] > 0:
                past, count = printed[-1] - printed[-2], steps[-1] - steps[-2]
                if past > 0 and not abs(past - known * count) <= 1e-5 * printed[-1] + digit:
                    known = past / count
            if known and math.isfinite(known) and math.isfinite(times[-1]) and (is_other[-1] or known != float(size or 0)):
                size = Fraction(repr(float(known)))
                offset = Fraction(repr(float(times[-1]))) - size * run.steps[-1]
        if size is not None:
            earlier.append((start, size, offset))
        all_times.append(times)
    for others in ([run.column("Time") for run in runs], [numpy.array(run.steps, dtype=float) for run in runs]):
        all_times = all_times if all_times and all(numpy.isfinite(times).all() for times in all_times) else others
    return all_times


def _number_rows(readers: list[_Reader], given: float | None) -> list[_Run]:
    """Returns the runs. Rows without Step are numbered if no table has it; else their column Time counts, or the tables are left out."""
    runs, dt, last = [run for reader in readers for run in reader.runs], given, -1
    has_steps = not all(run.is_counted for run in runs)
    for reader in readers:
        for run in reader.runs:
            dt = given or run.dt or dt
            if run.is_counted:
                text = "whose rows are numbered"
                if has_steps:
                    steps = [time / dt for time in run.column("Time")] if dt else [math.nan]
                    is_whole = all(math.isfinite(step) and abs(step - round(step)) < 0.01 for step in steps)
                    is_next = is_whole and sorted({*map(round, steps)}) == [*map(round, steps)] and (last < 0 or round(steps[0]) == last)
                    text = "whose column Time counts" if is_next else "which is left out"
                    run.steps, run.is_counted = array("q", map(round, steps) if is_next else []), False
                else:
                    run.steps, run.dt = array("q", range(last + 1, last + 1 + len(run.steps))), None
                reader.notes.append((run.line, f"expected the column Step, got a table without it, {text}"))
            last = run.steps[-1] if run.steps else last
    return [run for run in runs if run.steps]


def read_log(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None) -> Log:
    """Reads the thermo tables of a log of LAMMPS or LIGGGHTS, and returns them as a Log. Needs numpy alone.

    paths  the log, or what the program printed on the screen, plain or .gz; a list of logs, in the order in which they were written
    dt     the time of one timestep, greater than 0, in the unit of the run. None: the log says it, by its commands `timestep` and
           `units` or by LAMMPS's line "Time step". If the timestep changes, times go on from those of the run before. After
           `reset_timestep` to a smaller timestep they begin at 0. A column Time counts if it differs by more than rounding, as with
           `fix dt/reset`. The last dt in a column Dt, or Time over Step, holds until the next command `timestep`. If the log says
           nothing, times are timesteps.

    The function reads thermo_style one, multi, custom and yaml, and the tables of NEB, of any number of runs. Columns may have any names.
    Names with blanks come from `thermo_modify colname`; numbers stand for names that the log abbreviates by "...". Other lines between
    the rows are skipped. If no table has the column Step, rows are numbered from 0; else the column Time gives the timesteps of a table
    without Step. A last row needs no line feed.

    One warning a file tells what is left out: a last row that ends early, because a simulation may be writing it; lines of numbers that
    are no rows of their table; tables without rows that fit their header, or without Step and Time; runs without a table.

    Raises FileNotFoundError if there is no such file; vtkgranular.Error with path, line and column if a row has a word in place of a
    number, if a file is binary or empty, if a line has 4 MiB or more, if the content of a compressed log exceeds 256 MiB and 200 times
    its size, and if it has no table with rows; vtkgranular.ArgumentError for a dt that cannot be.
    """
    import numpy

    given = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    if not given:
        raise c.ArgumentError("expected at least one log, got none")
    if dt is not None and not 0 < float(dt) < math.inf:
        raise c.ArgumentError(f"expected a dt that is finite and greater than 0, got {dt}")
    readers = [_Reader(os.path.abspath(os.fsdecode(path))) for path in given]
    before = None
    for reader in readers:
        reader.read(before)
        before = reader.runs[-1]
    runs = _number_rows(readers, dt)
    for reader in readers:
        if reader.notes:
            (line, text), *others = reader.notes
            _warn("; ".join([reader.where(line) + text, *(f"line {line}: {text}" if line else text for line, text in others)]))
    times = _times(runs, dt)
    tables = [LogTable([run], own) for run, own in zip(runs, times)]
    return Log([reader.path for reader in readers], tables, LogTable(runs, numpy.concatenate(times), has_numbers=True))
