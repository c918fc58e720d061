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
    from fractions import Fraction

    import numpy
    import pandas

#: The timesteps that LAMMPS and LIGGGHTS use after the command `units`.
_DEFAULTS = {b"lj": b"0.005", b"real": b"1.0", b"metal": b"0.001", b"si": b"1e-8", b"cgs": b"1e-8", b"electron": b"0.001", b"micro": b"2.0",
             b"nano": b"0.00045"}
#: The columns of `thermo_style one`, which is the first one.
_ONE = [b"step", b"temp", b"epair", b"emol", b"etotal", b"press"]
#: Lines that say something of the tables. The last group of a line names the method of the reader that takes it.
_KNOWN = re.compile(rb"""\s*(?:
    (?P<end>Loop\s+time|(?:LAMMPS|LIGGGHTS)\s+\()
    |(?P<memory>Per\s+MPI\s+rank\s+memory|Memory\s+usage\s+per\s+processor)\s
    |(?P<names>Step\s)
    |keywords:\s*\[(?P<keywords>.*)\]
    |-\s+\[(?P<row>.*)\]\s*$
    |-{4,}\s*Step\s+(?P<step>-?\d+)\s+-{2,}\s*CPU\s*=\s*(?P<block>\S+)
    |(?:timestep|Time\s+step\s+:)\s+(?P<timestep>\S+)
    |units\s+(?P<units>\S+)
    |reset_timestep\s+(?P<reset>\d{1,19}(?:\s+time\s+\S+)?)
    |thermo_style\s+(?P<style>.*)
    |thermo_modify\s(?P<colname>.*\scolname\s.*|colname\s.*)
)""", re.VERBOSE)
# `colname 3 "Kinetic Energy"` or `colname default`, and the names in keywords: ['Step', "v_a", c_b[1], ]
_COLNAME = re.compile(rb"""\bcolname\s+(?:(default)(?!\S)|(\S+)\s+(?:"([^"]+)"|'([^']+)'|(\S+)))""")
_KEYWORD = re.compile(rb"""\s*(?:"([^"]*)"|'([^']*)'|([^\s,][^,]*))""")
_PAIR = re.compile(rb"([^\s=][^=]*?) = (\S+)(?: |$)")
_LARGEST = (1 << 63) - 1
_MOST_DIGITS = 100
_FREE_CONTENT = 1 << 28  # bytes that are read whatever the size of the compressed file
_LARGEST_EXPANSION = 200
_LONGEST_LINE = 1 << 22


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
        names = dict.fromkeys(name for run in runs for part in run.parts for name in part.places)
        self._has_numbers = has_numbers and "Run" not in names  # the log's own column counts
        super().__init__(dict.fromkeys([*(["Run"] if self._has_numbers else []), "Step", *names]), times)
        self._runs, self.path, self.line = runs, runs[0].path, runs[0].line

    def _column(self, name: str) -> numpy.ndarray:
        import numpy

        if name == "Run" and self._has_numbers:
            return numpy.repeat(numpy.arange(len(self._runs)), [len(run.steps) for run in self._runs])
        if name == "Step":
            return numpy.concatenate([numpy.frombuffer(run.steps, dtype=numpy.int64) for run in self._runs])
        values, start = numpy.full(len(self._times), math.nan), 0
        for run in self._runs:
            for part in run.parts:
                if name in part.places:
                    known = numpy.frombuffer(part.values)[part.places[name]::len(part.places)]
                    values[start + part.first:start + part.first + len(known)] = known
            start += len(run.steps)
        return values

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


class _Part:
    """Rows of a run with the same columns: the number of the first row, the places of the columns in a row, and all values."""

    def __init__(self, first: int, names: Iterable[str]):
        self.first, self.places, self.values = first, {name: place for place, name in enumerate(names)}, array("d")


class _Run:
    """The rows of a run: of numbers in a line, or blocks, which are several parts if their columns differ.

    names  of the columns in a line; none: blocks
    dt     the time of a timestep, as the log spells it
    reset  the time at the first row after the command `reset_timestep`
    edge   where the first word of the first row begins and ends; None: anywhere
    """

    def __init__(self, path: str, line: int, dt: bytes | None, names: list[str], is_yaml: bool = False):
        self.path, self.line, self.dt, self.names, self.is_yaml = path, line, dt, _unique(names), is_yaml
        self.at = names.index("Step") if "Step" in names else None
        self.steps, self.last = array("q"), -1
        self.parts = [_Part(0, self.names)] if names else []
        self.reset: Fraction | None = None
        self.edge: tuple[int, int] | None = None


class _Reader:
    """Finds the tables among the lines of a log, which may go on after a run of another log."""

    def __init__(self, path: str, before: _Run | None):
        self.path, self._before, self._dt = path, before, before.dt if before else None
        self.runs: list[_Run] = []
        self._line, self._words, self._number = b"\n", [b""], 0  # that is read now
        self._run: _Run | None = None
        self._width = -1  # of rows that are expected now
        self._header: bytes | list[str] | None = None  # of a table whose first row may follow
        self._header_line, self._is_sure = 0, False
        self._block: tuple[int, dict[str, float]] | None = None  # that is read now
        self._after_memory = self._knows_memory = False
        self._style = _ONE  # the columns by their keywords
        self._colnames: dict[bytes, bytes] = {}  # names by keywords, or by numbers
        self._reset: list[float] = []  # the timestep, and the time if it is told
        self._left_out, self._first_left_out = 0, ""
        self._empty: tuple[int, str] | None = None  # the first table without rows
        self._is_empty_told = False

    def _fail(self, line: int, text: str, column: str = "", byte: int = -1) -> NoReturn:
        raise c.Error(f"{self._where(line)}: {text}", self.path, line, byte, column)

    def _where(self, line: int) -> str:
        return f"{c.shown(self.path)}{f':{line}' if line else ''}"

    # ---- the file ----
    def read(self) -> list[_Run]:
        import gzip
        import zlib

        class Packed(gzip.GzipFile):
            left = math.inf  # bytes of content

            def readinto(self, buffer: Any) -> int:
                count = self.readinto1(buffer)  # keeps what was unpacked before an error
                self.left -= count
                if self.left < 0:
                    fail(0, f"expected content of at most {_LARGEST_EXPANSION} times the {size} bytes of the file, got more; "
                            "if you trust the file, unpack it first")
                return count

        def opened(path: str, flags: int) -> int:
            return os.open(path, flags | os.O_NONBLOCK)  # a pipe of that name must not make it wait

        with open(self.path, "rb", opener=opened) as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise OSError(f"{c.shown(self.path)}: expected a file, got a device or a pipe")
            head, size, fail = file.peek(4)[:4], os.fstat(file.fileno()).st_size, self._fail
            if head == b"\x28\xb5\x2f\xfd":
                self._fail(0, "expected text or gzip data, got Zstandard: unpack the log first")
            if head[:2] != b"\x1f\x8b":
                self._read(file, is_packed=False)
            else:
                try:
                    packed = Packed(fileobj=file)
                    packed.left = max(_FREE_CONTENT, size * _LARGEST_EXPANSION)
                    self._read(io.BufferedReader(packed, 1 << 16), is_packed=True)  # type: ignore[type-var]
                except (OSError, zlib.error) as error:
                    self._fail(0, f"expected gzip data, got damaged ones: {error}")
        return self.runs

    def _read(self, stream: Any, is_packed: bool) -> None:
        """Reads the lines of a stream, and tells what is left out."""
        is_whole, is_cut = True, False
        try:
            head = stream.peek(1024)[:1024]
            if b"\0" in head:
                self._fail(0, "expected the text of a log, got a binary file", byte=head.index(b"\0"))
            while line := stream.readline(_LONGEST_LINE):
                self._line, self._words, self._number = line, line.split(), self._number + 1
                if line[-1:] != b"\n" and not self._is_whole(is_packed and not stream.read(1)):
                    is_whole = False
                    break
                if (len(self._words) != self._width or not self._row(self._words)) and self._words:
                    self._other()
        except EOFError:
            is_cut, self._line = True, b"\n"
        if self._number == 0 and not is_cut:
            self._fail(0, "expected a log, got an empty file")
        is_short = self._block is not None and not self._ends_block(is_whole)
        if not self.runs:
            self._fail_without_tables()
        if is_cut:
            _warn(f"{self._where(0)}: expected complete gzip data, got data that end early: the rows before the end are read")
        if self._run and not is_whole:
            _warn(f"{self._where(self._number)}: the last line ends early and is left out")
        elif is_short:
            _warn(f"{self._where(self._number)}: the last block ends early and is left out")
        if self._is_empty_told and self._empty:
            _warn(f"{self._where(self._empty[0])}: expected rows of numbers below the columns {self._empty[1]}, got none: the table is left out")
        if self._left_out:
            _warn(f"{self._first_left_out}; lines like this are left out: {self._left_out}")

    def _is_whole(self, is_last: bool) -> bool:
        """Returns true if nothing can be missing in a line without a line feed: compressed data are complete, or something follows the
        last number."""
        if len(self._line) == _LONGEST_LINE:
            self._fail(self._number, f"expected lines of fewer than {_LONGEST_LINE} bytes, got a longer one")
        is_row = len(self._words) == self._width and self._line[-1:].isspace()
        return is_last or is_row or self._line.rstrip()[-1:] == b"]" or self._words[:2] == [b"Loop", b"time"]

    def _fail_without_tables(self) -> NoReturn:
        self._note_empty()
        if self._empty:
            self._fail(self._empty[0], f"expected rows of numbers below the columns {self._empty[1]}, got none")
        self._fail(0, "expected a thermo table (a line of columns that begins with Step, or blocks '---- Step 0 ----- CPU = ...'), "
                      f"got {self._number} lines without one")

    # ---- rows of one line ----
    def _row(self, words: list[bytes]) -> bool:
        """Takes words as a row of the run, if they are one."""
        run = self._run
        assert run is not None
        try:
            step = run.last + 1 if run.at is None else int(words[run.at][:_MOST_DIGITS])
            values = list(map(float, words))
        except ValueError:
            return False
        if step <= run.last or b"_" in self._line or (run.edge and not self._fits(run)):
            return False
        if step > _LARGEST:
            self._fail_large(words[run.at or 0])
        run.last = step
        run.steps.append(step)
        run.parts[0].values.extend(values)
        return True

    def _fail_large(self, word: bytes) -> NoReturn:
        got = os.fsdecode(word) if len(word) <= _MOST_DIGITS else f"{len(word)} digits"
        self._fail(self._number, f"column 'Step': expected at most {_LARGEST}, got {got}", "Step")

    def _edge(self) -> tuple[int, int]:
        """Returns where the first word of the line begins and ends."""
        blanks = self._line.find(self._words[0])
        return blanks, blanks + len(self._words[0])

    def _fits(self, run: _Run | None) -> bool:
        """Returns true if the line begins as the first row does. Lines that `fix print` writes begin elsewhere."""
        if not run or not run.edge:
            return True
        blanks, edge = self._edge()
        return edge == run.edge[1] or blanks == run.edge[0] or (blanks == 0 and edge > run.edge[1])

    def _expect(self, header: bytes | list[str], is_sure: bool) -> None:
        """Expects the first row of a table."""
        self._note_empty()
        self._header, self._header_line, self._is_sure, self._width = header, self._number, is_sure, -1

    def _header_names(self, width: int) -> list[str]:
        """Returns the names in the header, so many if that is possible. Names may have blanks, two between columns."""
        header, names = self._header or [], []
        if isinstance(header, bytes):
            told = [rb"(?<!\S)" + re.escape(name) + rb"(?!\S)" for name in self._colnames.values()]
            ways = header.split(), re.split(rb"\s{2,}", header.strip()), re.findall(b"|".join([*told, rb"\S+"]), header)
            names = [os.fsdecode(name) for name in next((way for way in ways if len(way) == width), ways[0])]
        else:
            names = header
        return names if "Step" in names else ["Step" if name == self._step_name() else name for name in names]

    def _step_name(self) -> str:
        """Returns the name that `thermo_modify colname` gave to the timestep, by its keyword or its number."""
        at, count = self._style.index(b"step") if b"step" in self._style else -1, len(self._style)
        ways = [b"step", *([b"%d" % (at + 1), b"%d" % (at - count)] if at >= 0 else [])]
        return os.fsdecode(next((name for key, name in reversed(self._colnames.items()) if key in ways), b"Step"))

    def _begin(self, words: list[bytes]) -> bool:
        """Begins a table if these words are its first row. If the names are not sure, the row must follow them at once."""
        names, is_row, line = self._header_names(len(words)), _numbers(words) is not None, self._line
        is_close = self._is_sure or (self._number == self._header_line + 1 and (line[:1].isspace() or not self._knows_memory))
        if is_row and is_close and len(names) == len(words) and (self._is_sure or "Step" in names):
            before, self._run = self._run, _Run(self.path, self._header_line, self._dt, names, isinstance(self._header, list))
            if self._row(words):
                self._run.edge = self._edge() if self._run.at == 0 and not self._run.is_yaml else None
                self._take(self._run)
                self._header, self._width = None, -1 if self._run.is_yaml else len(words)
                return True
            self._run = before
        if self._is_sure:
            self._judge(words, names)
            return True
        self._note_empty(is_close and is_row and len(names) != len(words))
        self._header, self._width = None, len(self._run.names) if self._run and self._run.names else -1
        return len(words) == self._width and self._row(words)

    def _take(self, run: _Run) -> None:
        """Adds a run with its first row, and the time that `reset_timestep` gives to it: 0 if the timestep becomes smaller."""
        from fractions import Fraction

        (step, *time), before = self._reset or [-1], self.runs[-1] if self.runs else self._before
        if step == run.steps[0] and (time or (before and step < before.steps[-1])):
            run.reset = Fraction(repr(time[-1] if time else 0.0))
        self._reset = []
        self.runs.append(run)

    def _judge(self, words: list[bytes], names: list[str]) -> None:
        """Judges a line among the rows: other output, a damaged row, which is an error, or a line of numbers, which is counted."""
        run = None if self._header else self._run
        at = names.index("Step") if "Step" in names else 0
        if len(words) <= at or not words[at][:1].isdigit():
            return
        bad = [i for i, word in enumerate(words) if _numbers([word]) is None]
        if bad and len(words) == len(names) and 2 * len(bad) < len(words) and self._fits(run):
            self._fail(self._number, f"column {names[bad[0]]!r}: expected a number, got {os.fsdecode(words[bad[0]])!r}", names[bad[0]])
        if 2 * len(bad) > len(words):
            return
        if not self._left_out:
            what = f"{len(names)} numbers in a row, got {len(words)}"
            if len(words) == len(names):
                after = f"a row after timestep {run.steps[-1]}" if run else "a row of numbers"
                what = f"{after}, got {os.fsdecode(self._line.strip())!r}"
            self._first_left_out = f"{self._where(self._number)}: expected {what}"
        self._left_out += 1

    # ---- other lines ----
    def _other(self) -> None:
        """Looks at a line that is no row of the table."""
        words, after_memory, self._after_memory = self._words, self._after_memory, False
        found = _KNOWN.match(self._line)
        # LIGGGHTS prints compute 1 as "1", but only after the line about memory
        if found and not (found.lastgroup == "names" and (after_memory or any(_numbers([word]) for word in words[1:]))):
            getattr(self, f"_on_{found.lastgroup}")(found)
            return
        if self._block is not None:
            if self._pairs():
                return
            self._flush()
        if after_memory and (words[0].startswith(b"WARNING") or words == [b"---"]):
            self._after_memory = True
        elif after_memory:
            self._expect(self._line, is_sure=True)
        elif not (self._header and self._begin(words)) and self._run and self._run.names:
            self._judge(words, self._run.names)

    def _note_empty(self, is_table: bool = False) -> None:
        """Notes that no rows follow a header. This is told if it was a table for sure."""
        if self._header and (self._empty is None or is_table > self._is_empty_told):
            self._empty, self._is_empty_told = (self._header_line, " ".join(self._header_names(0))), is_table

    def _on_end(self, _: Any) -> None:
        """Ends the table: `Loop time of ...`, the beginning of another run, or of another program."""
        self._flush()
        self._note_empty(self._is_sure)
        self._run, self._header, self._width = None, None, -1

    def _on_memory(self, found: Any) -> None:
        """`Per MPI rank memory allocation ...` or `Memory usage per processor ...`, which the names of the columns follow."""
        self._on_end(found)
        self._after_memory = self._knows_memory = True

    def _on_names(self, _: Any) -> None:
        self._expect(self._line, is_sure=False)

    def _on_keywords(self, found: Any) -> None:
        """Names of the columns by `thermo_modify line yaml`: keywords: ['Step', 'Temp', ]."""
        self._expect([os.fsdecode(b"".join(ways).strip()) for ways in _KEYWORD.findall(found["keywords"])], is_sure=True)

    def _on_row(self, found: Any) -> None:
        """A row by `thermo_modify line yaml`."""
        words, run = found["row"].replace(b",", b" ").split(), self._run
        if self._header:
            self._begin(words)
        elif run and run.is_yaml and not (len(words) == len(run.names) and self._row(words)):
            self._judge(words, run.names)

    def _on_timestep(self, found: Any) -> None:
        """The echo of `timestep 1e-5`, and what LAMMPS prints: `Time step : 1e-5`."""
        if 0 < (_numbers([found["timestep"]]) or [0])[0] < math.inf:
            self._dt = found["timestep"]

    def _on_units(self, found: Any) -> None:
        """The echo of `units si`, which sets the timestep."""
        self._dt = _DEFAULTS.get(found["units"], self._dt)

    def _on_reset(self, found: Any) -> None:
        """The echo of `reset_timestep 0`, or of `reset_timestep 0 time 1.5`."""
        step, *time = found["reset"].split()
        self._reset = [int(step), *(number for number in _numbers(time[1:]) or [] if math.isfinite(number))]

    def _on_style(self, found: Any) -> None:
        """The echo of `thermo_style custom step ke`, which takes the names of the columns away."""
        style, *words = found["style"].split() or [b""]
        self._style, self._colnames = words if style == b"custom" else _ONE, {}

    def _on_colname(self, _: Any) -> None:
        """The echo of `thermo_modify colname 3 "Kinetic Energy"`."""
        for default, column, *ways in _COLNAME.findall(self._line):
            if default:
                self._colnames = {}
            else:
                self._colnames[column] = b"".join(ways)

    # ---- blocks of thermo_style multi ----
    def _on_block(self, found: Any) -> None:
        self._flush()
        step, seconds, run = int(found["step"][:_MOST_DIGITS]), _numbers([found["block"]]), self._run
        if abs(step) > _LARGEST:
            self._fail_large(found["step"])
        if run is None or run.names or step <= run.steps[-1]:
            self._on_end(found)
            self._run = _Run(self.path, self._number, self._dt, [])
        self._block = step, {"CPU": seconds[0]} if seconds else {}

    def _flush(self) -> None:
        """Ends a block."""
        run = self._run
        if self._block and run:
            step, block = self._block
            if not run.parts or list(run.parts[-1].places) != list(block):
                run.parts.append(_Part(len(run.steps), block))
            run.parts[-1].values.extend(block.values())
            run.steps.append(step)
            if len(run.steps) == 1:
                self._take(run)
        self._block = None

    def _ends_block(self, is_whole: bool) -> bool:
        """Ends the last block of the log, and returns true if it has as many names as the one before. A first block may have any number."""
        run, block = self._run, self._block
        assert run is not None and block is not None
        if not run.parts:
            self._empty = run.line, "Step"
        elif is_whole and len(block[1]) >= len(run.parts[-1].places):
            self._flush()
            return True
        return False

    def _pairs(self) -> bool:
        """Takes a line of `Name = value` after the first line of a block."""
        run, block, line, pairs, end = self._run, self._block, b" ".join(self._words), [], 0
        assert run is not None and block is not None
        while end < len(line):
            pair = _PAIR.match(line, end)  # from where the last one ends: a long line costs time in proportion
            if pair is None:
                return False
            if b" " in pair[1] and pair[1] not in self._colnames.values():
                return False
            pairs.append(pair.groups())
            end = pair.end()
        for name, word in ((os.fsdecode(name), word) for name, word in pairs):
            values = _numbers([word])
            if values is None:
                if name not in block[1] and not any(name in part.places for part in run.parts[-1:]):
                    return False
                self._fail(self._number, f"column {name!r}: expected a number, got {os.fsdecode(word)!r}", name)
            if name != "Step":
                block[1][name] = values[0]
        return True


def _run_times(runs: list[_Run], dt: float | None) -> Iterator[Any]:
    """Yields the times of each run: the doubles nearest to offset + size x timestep, or a column Time that differs by more.

    Where the size changes, times go on from those of the runs before, also after a column Time.
    """
    from fractions import Fraction

    import numpy

    earlier: list[tuple[int, Fraction, Fraction]] = []  # first timestep, size and offset of runs that a later one may follow
    for run in runs:
        size, offset, start = Fraction(repr(float(run.dt or 0 if dt is None else dt))), Fraction(0), run.steps[0]
        while earlier and (earlier[-1][0] > start or run.reset is not None):
            earlier.pop()
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
            printed = LogTable([run], times)._column("Time")
            is_other = numpy.isfinite(printed) & (abs(times - printed) > 1e-5 * abs(printed))
            times = numpy.where(is_other, printed, times)
            if is_other[-1]:
                offset = Fraction(repr(float(printed[-1]))) - size * run.steps[-1]
        earlier.append((start, size, offset))
        yield times


def _times(runs: list[_Run], dt: float | None) -> Any:
    """The times of all rows."""
    import numpy

    if dt is not None or all(run.dt for run in runs):
        return numpy.concatenate(list(_run_times(runs, dt)))
    rows = LogTable(runs, numpy.empty(sum(len(run.steps) for run in runs)))
    printed = rows._column("Time")
    return printed if numpy.isfinite(printed).all() else rows.steps.astype(float)


def _number_rows(runs: list[_Run]) -> list[_Run]:
    """Numbers the rows of tables without Step, and tells it. They are left out if another table has Step."""
    numbered = [run for run in runs if run.names and run.at is None]
    if not numbered:
        return runs
    is_left_out = len(numbered) < len(runs)
    _warn(f"{c.shown(numbered[0].path)}:{numbered[0].line}: expected the column Step, got a table without it, "
          f"{'which is left out' if is_left_out else 'whose rows are numbered'}")
    if is_left_out:
        return [run for run in runs if run.at is not None or not run.names]
    count = 0
    for run in numbered:
        run.steps, run.dt = array("q", range(count, count + len(run.steps))), None
        count += len(run.steps)
    return runs


def read_log(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None) -> Log:
    """Reads the thermo tables of a log of LAMMPS or LIGGGHTS, and returns them as a Log. Needs numpy alone.

    paths  the log, or what the program printed on the screen, plain or .gz; a list of logs, in the order in which they were written
    dt     the time of one timestep, greater than 0, in the unit of the run. None: the log says it, by its commands `timestep` and
           `units` or by LAMMPS's line "Time step". If the timestep changes, times go on from those of the run before. After
           `reset_timestep` to a smaller timestep they begin at 0. A column Time counts if it differs by more than rounding, as with
           `fix dt/reset`. If the log says nothing, times are timesteps.

    The function reads thermo_style one, multi, custom and yaml, of any number of runs, with columns that differ. It skips other lines
    between the rows. Names of columns may have blanks, as after `thermo_modify colname`. Four things are left out with a warning: a
    last row that ends early, because a simulation may be writing it; lines of numbers that are no rows of their table; tables without
    rows that fit their header; tables without the column Step, if others have it. If none has it, the rows are numbered from 0.

    Raises FileNotFoundError if there is no such file; vtkgranular.Error with path, line and column if a row has a word in place of a
    number, if a file is binary or empty, if a line has 4 MiB or more, if the content of a compressed log exceeds 256 MiB and 200 times
    its size, and if it has no table with rows; vtkgranular.ArgumentError for a dt that cannot be.
    """
    given = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    if not given:
        raise c.ArgumentError("expected at least one log, got none")
    if dt is not None and not 0 < float(dt) < math.inf:
        raise c.ArgumentError(f"expected a dt that is finite and greater than 0, got {dt}")
    names = [os.path.abspath(os.fsdecode(path)) for path in given]
    rows: list[_Run] = []
    for name in names:
        rows += _Reader(name, rows[-1] if rows else None).read()  # a log that begins with a restart file may not tell its timestep
    rows = _number_rows(rows)
    times, runs, start = _times(rows, dt), [], 0
    for run in rows:
        runs.append(LogTable([run], times[start:start + len(run.steps)]))
        start += len(run.steps)
    return Log(names, runs, LogTable(rows, times, has_numbers=True))
