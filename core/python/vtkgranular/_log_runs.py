# SPDX-License-Identifier: BSD-3-Clause
"""The runs in a log of LAMMPS or LIGGGHTS.

One table of regular expressions finds the lines that say something of tables. A header begins a run, to which rows add their numbers: lines
of words, lists in YAML, or blocks of `thermo_style multi`.
"""
from __future__ import annotations

import math
import os
import re
from array import array
from collections import Counter
from typing import TYPE_CHECKING, Any, Iterable

from ._lines import Lines

if TYPE_CHECKING:
    import numpy

#: The timesteps that LAMMPS and LIGGGHTS use after the command `units`.
_DEFAULTS = {b"lj": 0.005, b"real": 1.0, b"metal": 0.001, b"si": 1e-8, b"cgs": 1e-8, b"electron": 0.001, b"micro": 2.0, b"nano": 0.00045}
#: The columns of `thermo_style one`, which is the first one.
_ONE = [b"step", b"temp", b"epair", b"emol", b"etotal", b"press"]
#: Lines that say something of tables. The last group of a line names the method that takes it.
_EVENT = re.compile(rb"""\s*(?:
    (?P<end>Loop\s+time|(?:LAMMPS|LIGGGHTS)\s+\()
    |(?P<memory>Per\s+MPI\s+rank\s+memory|Memory\s+usage\s+per\s+processor)\s
    |keywords:\s*\[(?P<keywords>.*)\]
    |-\s+\[(?P<row>.*)\]\s*$
    |-{4,}\s*Step\s+(?P<step>-?\d+)\s+-{2,}\s*(?P<block>CPU\s*=\s*\S+)
    |(?P<command>(?:timestep|Time\s+step\s+:|units)\s+(?P<dt>\S+)
        |reset_timestep\s+(?P<reset>\d+)(?:\s+time\s+(?P<time>\S+))?
        |thermo_style\s+(?P<style>\S.*)
        |thermo_modify\s+(?P<modify>\S.*))
)""", re.VERBOSE)
#: Lines between the one about memory and the header.
_BEFORE_HEADER = re.compile(rb"\s*(?:WARNING|For\s+more\s|---\s*$)")
# `colname 3 "Kinetic Energy"` or `colname default`, and the names in keywords: ['Step', "v_a", c_b[1], ]
_COLNAME = re.compile(rb"""\bcolname\s+(?:(default)(?!\S)|(\S+)\s+(?:"([^"]+)"|'([^']+)'|(\S+)))""")
_KEYWORD = re.compile(rb"""\s*(?:"([^"]*)"|'([^']*)'|([^\s,][^,]*))""")
_LARGEST = (1 << 63) - 1


def names_of(keywords: bytes) -> list[str]:
    """Returns the names in a list of YAML."""
    return [os.fsdecode(b"".join(ways).strip()) for ways in _KEYWORD.findall(keywords)]


def unique_names(names: Iterable[str]) -> list[str]:
    """Returns names for columns: the second one of the same name is NAME#2."""
    counts: Counter[str] = Counter()
    found: dict[str, None] = {}
    for name in names:
        unique = name
        while unique in found:
            counts[name] += 1
            unique = f"{name}#{counts[name] + 1}"
        found[unique] = None
    return [*found]


def _numbers(words: list[bytes]) -> list[float]:
    """Returns the numbers that words spell, or none. Python would take 1_0 for a number, too."""
    try:
        return [] if any(b"_" in word for word in words) else [*map(float, words)]
    except ValueError:
        return []


class LogRun:
    """A header and the rows below it.

    ways       the ways to split the header into names, of which the first row chooses one
    names, at  the names, and the place of Step among them, or None
    values     of all rows, row by row
    blocks     of `thermo_style multi`, whose names may differ: the numbers of the rows that have a name, and their values
    count      the number of names in the last block
    last, end  the last timestep, and the line that holds the end of its row, or the header
    width      the number of words in a row; -1: not known yet, or blocks
    edge       where the first word of the first row ends, if that row is indented
    """

    def __init__(self, path: str, line: int, ways: list[list[str]], end: bytes = b""):
        self.path, self.line, self.ways, self.end, self.last, self.width, self.edge = path, line, ways, end, -1, -1, 0
        self.names: Any = ()
        self.at, self.dt, self.reset = 0, None, ()
        self.steps, self.values, self.blocks = array("q"), array("d"), {}
        self.lack = f"expected rows of numbers below the columns {' '.join(ways[0])}, got none"

    def takes(self, count: int) -> bool:
        """Returns true if a row has so many words. The first row chooses names; `... RDN PEN`, which NEB prints, stands for any number."""
        if self.steps:
            return count == self.width
        words = self.ways[0]
        known = words.index("...") if "..." in words else count + 1
        way = [*words[:known], *map(str, range(known + 1, count + 1))] if known <= count else \
            next((way for way in self.ways if len(way) == count), [])
        self.names, self.at = tuple(unique_names(way)), way.index("Step") if "Step" in way else None
        return bool(way)

    def fits(self, line: bytes, words: list[bytes]) -> bool:
        """Returns true if the line is indented as the first row is. Lines that `fix print` writes are not."""
        return line[:1].isspace() or len(words[0]) >= self.edge

    def is_whole(self, line: bytes) -> bool:
        """Returns true if a line without a line feed can be a whole row: as long as the one before, or of no fixed length."""
        before, is_begun = self.end.rstrip(b"\n"), len(self.steps) > 0
        if line[-1:].isspace() or is_begun and len(line) + before[-1:].isspace() >= len(before):
            return True
        return not (before[-1:].isspace() or self.blocks or is_begun and before[:1].isspace())

    def column(self, name: str) -> numpy.ndarray:
        """Returns a column, nan where the rows have none of this name."""
        import numpy

        if name == "Step":
            return numpy.array(self.steps, dtype=numpy.int64)
        values = numpy.full(len(self.steps), math.nan)
        if name in self.blocks:
            values[self.blocks[name][0]] = self.blocks[name][1]
        elif name in self.names:
            values[:] = self.values[self.names.index(name)::len(self.names)]
        return values


class LogReader(Lines):
    """Finds the runs of a log among its lines."""

    def __init__(self, path: str):
        super().__init__(path)
        self.runs: list[LogRun] = []
        self._run: Any = None  # the one that is read
        self._header: Any = None  # the last one, and the words of the last one below a line about memory
        self._columns: list[bytes] = []
        self._style, self._renamed, self._name, self._dt, self._reset = _ONE, {}, rb"(\S+)", None, ()  # by commands
        self._knows_memory = self._is_named = False  # the log tells its memory; it has a table since the last line "Loop time"
        self._loops, self._missing, self._unfit, self._cut = 0, [], [], ""  # "Loop time" without a table; lines of numbers that are no rows

    def read(self) -> None:
        """Reads the log."""
        while self.following:
            self.advance()
            words, line = self.line.split(), self.line
            if not (self.following or line.endswith(b"\n") or self._is_whole(line, words)):
                self._cut = "line"
            elif not (self._run and self._add(words)):
                self._other(words)
        if not self.runs and self._header:
            self.fail(self._header.lack, self._header.line)
        if not self.runs:
            self.fail("expected a thermo table (a line of columns that begins with Step, or blocks '---- Step 0 ----- CPU = ...'), got "
                      f"{self._ahead} lines without one")
        missing, unfit = self._missing, self._unfit
        if self._cut:
            self.notes.append((self.number, f"the last {self._cut} ends early and is left out"))
        if missing:
            self.notes.append((missing[0], f"expected a table for each of {self._loops} lines 'Loop time', got none before line "
                                           f"{', '.join(map(str, missing))}"))
        if unfit:
            self.notes.append((unfit[0][0], f"expected {unfit[0][1]}; lines like this are left out: {len(unfit)}"))

    def _is_whole(self, line: bytes, words: list[bytes]) -> bool:
        run = self._run
        return not run or bool(_EVENT.match(line)) or bool(_numbers(words)) and run.takes(len(words)) and run.is_whole(line)

    # ---- rows ----
    def _add(self, words: list[bytes]) -> bool:
        """Adds a row to the run, if the words are one."""
        run, line = self._run, self.line
        if len(words) != run.width and not run.takes(len(words)):
            return False
        try:
            step = run.last + 1 if run.at is None else self._step(words[run.at])
            values = [*map(float, words)]
        except ValueError:
            return False
        if step <= run.last or b"_" in line or not run.fits(line, words):
            return False
        if not run.steps:
            run.width, run.edge = len(words), line.index(words[0]) + len(words[0]) if run.at == 0 and line[:1].isspace() else 0
        self._take(step)
        run.values.extend(values)
        return True

    def _step(self, word: bytes) -> int:
        """Returns a timestep. Python refuses thousands of digits."""
        step = int(word[:100])
        if abs(step) > _LARGEST:
            got = os.fsdecode(word) if len(word) <= 100 else f"{len(word)} digits"
            self.fail(f"column 'Step': expected at most {_LARGEST}, got {got}", self.number, "Step")
        return step

    def _take(self, step: int) -> None:
        """Adds a timestep to the run, and the run if it is the first one."""
        run = self._run
        if not run.steps:
            self.runs.append(run)
            run.dt, run.reset, self._dt, self._reset, self._is_named = self._dt, self._reset, None, (), True
        run.steps.append(step)
        run.last, run.end = step, self.line

    def _judge(self, words: list[bytes]) -> None:
        """Judges a line among rows: other output, a damaged row, which is an error, or a line of numbers, which is counted."""
        run, count = self._run, len(words)
        names = run.names or run.ways[0]
        at = names.index("Step") if "Step" in names else 0
        bad = [i for i, word in enumerate(words) if not _numbers([word])]
        if count <= at or not words[at][:1].isdigit() or 2 * len(bad) > count:
            return
        what, got = f"{len(names)} numbers in a row", str(count)
        if count == len(names):
            if bad and 2 * len(bad) < count and run.fits(self.line, words):
                name = names[bad[0]]
                self.fail(f"column {name!r}: expected a number, got {os.fsdecode(words[bad[0]])!r}", self.number, name)
            what, got = f"a row after timestep {run.last}" if run.steps else "a row of numbers", repr(os.fsdecode(self.line.strip()))
        self._unfit.append((self.number, f"{what}, got {got}"))

    # ---- headers ----
    def _other(self, words: list[bytes]) -> None:
        """Takes a line that is no row: an event, a header that repeats, a line that begins with Step and is followed by a row, or any."""
        found, run = _EVENT.match(self.line), self._run
        if found:
            getattr(self, f"_on_{found.lastgroup}")(found)
        elif words == self._columns:
            self._end()
            self._run = self._new()
        elif words[0] == b"Step" and (not run or run.steps) and not any(_numbers([word]) for word in words[1:]):
            table, row = self._new(), self.following.split()
            if _numbers(row) and (self.following[:1].isspace() or not self._knows_memory):
                if not table.takes(len(row)):
                    self._leave_out(table)
                elif table.at is not None and row[table.at].isdigit():
                    self._run = table
        elif run and not run.blocks:
            self._judge(words)

    def _new(self, ways: list[list[bytes]] | None = None) -> LogRun:
        """Returns a run with the header in this line. Names are words, or parts between wide blanks, or told by `thermo_modify colname`.

        The column that is `step` in the style is Step, also if a command has renamed it by its name or place.
        """
        if ways is None:
            words = self.line.split()
            ways = [words, re.split(rb"\s{2,}", self.line.strip()), re.findall(rb"(?<!\S)%b(?!\S)" % self._name, self.line)]
            ways = [way for way in ways if len(way) > 1 or way == words]
        places = [i for place, word in enumerate(self._style) if word == b"step" for i in (place + 1, place - len(self._style))]
        steps = [self._renamed.get(key) for key in (b"step", *(b"%d" % i for i in places))]
        ways = [way if b"Step" in way else [b"Step" if name in steps else name for name in way] for way in ways]
        self._header = LogRun(self.path, self.number, [[os.fsdecode(name) for name in way] for way in ways], self.line)
        return self._header

    def _end(self) -> None:
        """Ends the run. A header without rows is named."""
        run, self._run = self._run, None
        if run and not run.steps:
            self._leave_out(run)

    def _leave_out(self, run: LogRun) -> None:
        self.notes.append((run.line, run.lack + ": the table is left out"))
        self._is_named = True

    # ---- events ----
    def _on_end(self, found: Any) -> None:
        """`Loop time of ...` ends a table, and so does the beginning of another program."""
        self._end()
        if found["end"].startswith(b"Loop"):
            self._missing += [self.number] * (not self._is_named)
            self._is_named, self._loops = False, self._loops + 1

    def _on_memory(self, _: Any) -> None:
        """The names of the columns follow `Per MPI rank memory allocation ...` or `Memory usage per processor ...`."""
        self._end()
        self._knows_memory = True
        while _BEFORE_HEADER.match(self.following):
            self.advance()
        found = _EVENT.match(self.following)
        if self.following and (not found or found["command"]):
            self.advance()
            words = self.line.split()
            self._run, self._columns = self._new(), [] if _numbers(words) else words

    def _on_keywords(self, found: Any) -> None:
        self._end()
        self._run = self._new([[os.fsencode(name) for name in names_of(found["keywords"])]])

    def _on_row(self, found: Any) -> None:
        """Takes a list in YAML. From now on, a line without brackets is no row, unless it is indented."""
        words = found["row"].replace(b",", b" ").split()
        if self._run and not self._add(words):
            self._judge(words)
        elif self._run:
            self._run.edge = math.inf

    def _on_block(self, found: Any) -> None:
        """Adds a block of `thermo_style multi` as a row."""
        step, run = self._step(found["step"]), self._run
        if not run or not run.blocks or step <= run.last:
            self._end()
            run = LogRun(self.path, self.number, [["Step"]])
        block = self._pairs(found["block"], [])
        while self.following.endswith(b"\n") or self.following.split()[::3] == run.end.split()[::3] and run.is_whole(self.following):
            pairs = self._pairs(self.following, {**block, **run.blocks})
            if not pairs:
                break
            self.advance()
            block.update(pairs)
        if not (self.following.endswith(b"\n") or _EVENT.match(self.following) or run.steps and len(block) >= run.count):
            self._cut = "block"
            return
        for name, word in block.items():
            rows, values = run.blocks.setdefault(name, (array("q"), array("d")))
            rows.append(len(run.steps))
            values.append(float(word))
        self._run, run.names, run.count = run, run.blocks, len(block)
        self._take(step)

    def _pairs(self, line: bytes, known: Iterable[str]) -> dict[str, bytes]:
        """Returns the pairs `Name = value` in a line of a block, and none of another line."""
        pattern, pairs = rb"(?<!\S)%b\s*=\s*(\S*)(?!\S)" % self._name, {}
        for key, word in re.findall(pattern, line) if not re.sub(pattern, b"", line).strip() else ():
            name = os.fsdecode(key)
            if not _numbers([word]):
                if name in known and line.endswith(b"\n"):
                    self.fail(f"column {name!r}: expected a number, got {os.fsdecode(word)!r}", self.number + 1, name)
                break
            pairs[name] = word
        pairs.pop("Step", None)
        return pairs

    def _on_command(self, found: Any) -> None:
        """The echo of a command that changes times or names, or LAMMPS's `Time step : 1e-5`."""
        if found["dt"]:
            number = _DEFAULTS.get(found["dt"]) or (_numbers([found["dt"]]) or [0])[0]
            self._dt = number if 0 < number < math.inf else self._dt
        elif found["reset"]:
            self._reset = int(found["reset"][:100]), *filter(math.isfinite, _numbers([found["time"] or b""]))
        elif found["style"]:
            name, *words = found["style"].split()
            self._style, self._renamed = words if name == b"custom" else _ONE, {}
        for is_default, key, *ways in _COLNAME.findall(found["modify"] or b""):
            self._renamed = {} if is_default else {**self._renamed, key: b"".join(ways)}
        self._name = b"(%b)" % b"|".join([*map(re.escape, self._renamed.values()), rb"\S+"])  # that a column may have
