# SPDX-License-Identifier: BSD-3-Clause
"""The tables that LAMMPS and LIGGGHTS write beside dumps as numpy arrays: averages of fixes, and what `fix print` writes."""
from __future__ import annotations

import os
import re
from array import array
from typing import TYPE_CHECKING, Any

from . import _library as c
from ._lines import Lines
from ._log import LogTable, expect_dt, last_of_each
from ._log_runs import _numbers, names_of, unique_names
from ._run import _warn
from ._series import _times

if TYPE_CHECKING:
    import numpy
    import pandas

#: Lines of a table. The group that a line has names the method that takes it.
_LINE = re.compile(rb"""\s*(?:
    \#(?P<comment>.*?)
    |keywords:\s*\[(?P<keywords>.*)\]
    |(?P<mark>---|data:|\.\.\.)
    |(?P<block>-?\d+):
    |(?:-\s+\[)?(?P<row>.*?)\]?
)\s*""", re.VERBOSE)
#: The columns of timesteps, in small letters.
_STEPS = ("step", "timestep")
#: A title that names no columns.
_FIX_PRINT = "Fix print output for fix"


class Table(LogTable):
    """A table of a fix, from vtkgranular.read_table, with each timestep once, in ascending order.

    table["c_ke"]             a column, float64, shape (steps,). Where each timestep has rows of its own, as of layers or bins, their
                              columns have the shape (steps, rows): nan behind the last row of a timestep with fewer rows
    table.columns             the names of the columns, as the file spells them; numbers from 1 where it has no names; the second one of
                              the same name is "NAME#2"
    table.steps, table.times  timesteps, int64, and times: see vtkgranular.read_table
    len(table)                the number of timesteps
    table.path, table.line    the file, and the line of the first row, from 1
    """

    def __init__(self, path: str, line: int, arrays: dict[str, numpy.ndarray], steps: numpy.ndarray, times: numpy.ndarray):
        self.path, self.line, self.columns, self.steps, self.times, self._arrays = path, line, [*arrays], steps, times, arrays
        for each in (steps, times, *arrays.values()):
            each.flags.writeable = False

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the rows as a pandas.DataFrame, with the columns of timesteps repeated for each row of a timestep."""
        import numpy
        import pandas

        rows = next((each.shape[1] for each in self._arrays.values() if each.ndim > 1), 1)
        return pandas.DataFrame({name: each.ravel() if each.ndim > 1 else numpy.repeat(each, rows) for name, each in self._arrays.items()})


class _TableReader(Lines):
    """Reads the numbers of all lines, and then what they mean.

    titles, names  the words of the lines that begin with #, and the names of columns that stand elsewhere
    values         the numbers of all lines, one line after the other
    counts, lines  how many numbers each line has, and the number of the line
    heads          the places in `counts` of lines that are the timestep of the lines that follow
    """

    def __init__(self, path: str):
        super().__init__(path, "table")
        self.titles: list[list[str]] = []
        self.names: list[str] = []
        self.values, self.counts, self.lines, self.heads = array("d"), array("q"), array("q"), array("q")

    def read(self) -> None:
        while self.following:
            self.advance()
            if not self.line.endswith(b"\n"):
                self.notes.append((self.number, "the last line ends early and is left out"))
                break
            found: Any = _LINE.fullmatch(self.line)
            getattr(self, "_on_" + found.lastgroup)(found[found.lastgroup])
        if not self.counts:
            self.fail(f"expected rows of numbers below the names of their columns, got none in {self._ahead} lines")

    def _on_comment(self, text: bytes) -> None:
        words = os.fsdecode(text).split()
        if not self.counts:
            self.titles.append(words)
        elif words not in self.titles:  # which a run that goes on repeats
            self.fail(f"expected rows, or the first lines again, got '# {' '.join(words)}'", self.number)

    def _on_keywords(self, text: bytes) -> None:
        self._name(names_of(text))

    def _on_mark(self, _: bytes) -> None:
        """A line of YAML that says nothing of the table."""

    def _on_block(self, text: bytes) -> None:
        if self.counts and not self.heads:
            self.fail(f"expected a row as before, got the timestep {os.fsdecode(text)}", self.number)
        self.heads.append(len(self.counts))
        self._add([float(text)])

    def _on_row(self, text: bytes) -> None:
        words = text.replace(b",", b" ").split()
        numbers = _numbers(words)
        if numbers:
            self._add(numbers)
            return
        names = [name.strip("\"' ") for name in os.fsdecode(text).split("," if b"," in text else None)]
        if not self.counts and not self.names or names == self.names:
            self._name(names)
            return
        at = next((i for i, word in enumerate(words) if not _numbers([word])), 0)
        self.fail(f"column {at + 1}: expected a number, got {os.fsdecode(words[at] if words else text)!r}", self.number, str(at + 1))

    def _name(self, names: list[str]) -> None:
        if self.counts and names != self.names:
            self.fail(f"expected the columns {' '.join(self.names)} again, got {' '.join(names)}", self.number)
        self.names = names

    def _add(self, numbers: list[float]) -> None:
        self.values.extend(numbers)
        self.counts.append(len(numbers))
        self.lines.append(self.number)

    # ---- what the numbers mean ----
    def _find_heads(self) -> int:
        """Finds the lines of timesteps, where they say how many rows follow. Returns the number of lines that are whole."""
        counts = self.counts
        has_title = any(word.startswith("Number-of-") for words in self.titles[-2:-1] for word in words)
        is_flat = counts[:1] == counts[1:2] or any(len(names) == counts[0] for names in (self.names, *self.titles[-1:]))
        if self.heads or not has_title and (is_flat or len(counts) < 2):
            return len(counts)
        line = first = 0
        while line < len(counts):
            rows = self.values[first + 1] if counts[line] == counts[0] > 1 else -1.0
            if not rows.is_integer() or rows < 0:
                got = " ".join(f"{value:g}" for value in self.values[first:first + counts[line]])
                self.fail(f"expected a timestep and its number of rows, {max(2, counts[0])} numbers, got {got}", self.lines[line])
            end = line + 1 + int(rows)
            if end > len(counts):
                break
            self.heads.append(line)
            first += sum(counts[line:end])
            line = end
        return line

    def _part(self, is_row: numpy.ndarray, ways: list[list[str]], first: str) -> tuple[list[str], numpy.ndarray]:
        """Returns the names of columns, the first of `ways` with as many, and the numbers of some lines."""
        import numpy

        lines, counts = numpy.flatnonzero(is_row), numpy.array(self.counts[:len(is_row)])
        count = int(counts[lines[0]]) if len(lines) else 0
        wrong = lines[counts[lines] != count]
        if len(wrong):
            self.fail(f"expected a row of {count} numbers, got {counts[wrong[0]]}", self.lines[wrong[0]])
        numbered = [first, *map(str, range(2, count + 1))][:count]
        names = next((way for way in ways if len(way) == count and " ".join(way[:5]) != _FIX_PRINT), numbered)
        return names, numpy.array(self.values[:counts.sum()])[numpy.repeat(is_row, counts)].reshape(len(lines), count)

    def table(self, dt: float | None) -> Table:
        """Returns the table of what was read."""
        import numpy

        whole, in_yaml = self._find_heads(), self.counts[0] == 1
        heads, sizes = self.heads, numpy.diff([*self.heads, whole]) - 1
        if in_yaml and len(sizes) > 1 and sizes[-1] < sizes[-2]:
            whole, heads, sizes = heads[-1], heads[:-1], sizes[:-1]
        if whole < len(self.counts):
            self.notes.append((self.lines[whole], "the last timestep ends early and is left out"))
        if whole == 0:
            self.fail("expected a timestep with all of its rows, got none", self.lines[0])
        is_head = numpy.full(whole, not heads)
        is_head[heads] = True
        titles = [self.names, *self.titles[-1:]]
        names, values = self._part(is_head, [["Step"], *self.titles[-2:-1]] if heads else titles, "Step" if heads else "1")
        at = next((i for i, name in enumerate(names) if name.lower() in _STEPS), None)
        if at is None:
            self.notes.append((self.lines[0], "expected a column Step or TimeStep, got a table without it, whose rows are numbered"))
        with numpy.errstate(invalid="ignore"):
            steps = numpy.arange(len(values), dtype=numpy.int64) if at is None else values[:, at].astype(numpy.int64)
        wrong = values[:, at][steps != values[:, at]] if at is not None else ()
        if len(wrong):
            self.fail(f"column {names[at]!r}: expected timesteps, got {wrong[0]}", column=names[at])
        kept = last_of_each(steps)
        columns = [*values[kept].T]
        if heads:
            own, rows = self._part(~is_head, titles, "1")
            padded = numpy.full((len(sizes), int(sizes.max()), rows.shape[1]), numpy.nan)
            padded[numpy.arange(padded.shape[1]) < sizes[:, None]] = rows
            names, columns = names + own, columns + [padded[kept, :, i] for i in range(len(own))]
        steps = steps[kept]
        times = numpy.array(_times(steps.tolist(), dt) if dt else steps, dtype=float)
        arrays = {name: numpy.ascontiguousarray(each) for name, each in zip(unique_names(names), columns)}
        return Table(self.path, self.lines[0], arrays, steps, times)


def read_table(path: str | os.PathLike[str], dt: float | None = None) -> Table:
    """Reads a table that LAMMPS or LIGGGHTS writes beside dumps, and returns it as a Table. Needs numpy alone.

    path  the file of `fix ave/time`, `ave/chunk`, `ave/spatial`, `ave/histo`, `ave/correlate` or `print`, also in YAML or with commas;
          plain or .gz, .bz2, .xz, .zst
    dt    the time of one timestep, greater than 0, in the unit of the run. None: times are timesteps

    If a timestep repeats, the last row counts. A warning tells of rows without timesteps, which are numbered, and of a last line or timestep
    that ends early. Raises vtkgranular.Error with path, line and column for a word in place of a number, and a row of another length.
    """
    expect_dt(dt)
    reader = _TableReader(os.path.abspath(os.fsdecode(path)))
    reader.read()
    table = reader.table(dt)
    for line, text in reader.notes:
        _warn(reader.where(line) + text)
    return table
