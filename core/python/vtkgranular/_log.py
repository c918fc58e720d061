# SPDX-License-Identifier: BSD-3-Clause
"""The thermo tables in logs of LAMMPS and LIGGGHTS as numpy arrays: lines (_lines) become runs (_log_runs), and runs become tables here."""
from __future__ import annotations

import math
import os
from array import array
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Iterable, Iterator

from . import _library as c
from ._log_runs import LogReader, LogRun
from ._run import _warn

if TYPE_CHECKING:
    import numpy
    import pandas


class LogTable:
    """The rows of one run, or all rows, in the order of the log.

    table["KinEng"]           a column, shape (rows,), float64; "Step" and "Run" are int64. The arrays are read-only.
    table.columns             the names of the columns, as the log spells them; the second one of the same name is "NAME#2"
    table.steps, table.times  timesteps and times: see vtkgranular.read_log
    len(table)                the number of rows
    table.path, table.line    the log, and its line with the names of the columns, from 1; of all rows, those of the first run
    """

    def __init__(self, runs: list[LogRun], times: numpy.ndarray, is_all: bool = False):
        names = dict.fromkeys(["Step", *(name for run in runs for name in run.names)])
        self._has_numbers = is_all and "Run" not in names  # the log's own column counts
        self.columns = ["Run", *names] if self._has_numbers else [*names]
        self._runs, self.times, self.path, self.line = runs, times, runs[0].path, runs[0].line
        # arrays are made when they are asked for: the runs of a log may have more columns together than rows with values
        self._arrays: dict[str, Any] = dict.fromkeys(self.columns)
        self.steps, times.flags.writeable = self["Step"], False

    def _column(self, name: str) -> numpy.ndarray:
        import numpy

        if name == "Run" and self._has_numbers:
            return numpy.repeat(numpy.arange(len(self._runs)), [len(run.steps) for run in self._runs])
        return numpy.concatenate([run.column(name) for run in self._runs])

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
        return len(self.times)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the rows as a pandas.DataFrame with the same columns."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self})

    def to_vtk(self) -> Any:
        """Returns a vtkTable with the column "time" and all others. Where a timestep has several rows, each is a column of its own, "vz 1".
        Needs VTK."""
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonDataModel import vtkTable

        table = vtkTable()
        for name, values in (("time", self.times), *((name, self[name]) for name in self if name != "time")):
            for own, column in zip(row_names(name, values), values.T if values.ndim > 1 else [values]):
                made = numpy_to_vtk(column.copy(), deep=True)
                made.SetName(own.encode(errors="replace").decode())
                table.AddColumn(made)
        return table

    def __repr__(self) -> str:
        return f"<{len(self)} rows from {os.path.basename(self.path)}:{self.line}: {' '.join(self)}>"


def row_names(name: str, values: numpy.ndarray) -> list[str]:
    """Returns the names of the columns of a vtkTable that a column becomes."""
    return [name] if values.ndim == 1 else [f"{name} {row + 1}" for row in range(values.shape[1])]


def last_of_each(steps: numpy.ndarray) -> numpy.ndarray:
    """Returns the places of the last row of each timestep, in the order of timesteps."""
    import numpy

    order = numpy.argsort(steps, kind="stable")
    return order[numpy.append(steps[order][1:] != steps[order][:-1], True)]


class Log(LogTable):
    """The thermo output of a simulation, from vtkgranular.read_log: a LogTable with each timestep once, in ascending order.

    log.runs      a LogTable for each run
    log.all_rows  a LogTable of all rows in the order of the log; its column "Run" counts from 0
    log.paths     the logs, absolute

    If a timestep repeats, the last row counts, as the last frame of a restarted run does. At a timestep where one run ends and the
    next one begins, columns that only the run before has keep their values. A value that a run does not print is nan.
    """

    def __init__(self, paths: list[str], runs: list[LogRun], times: list[numpy.ndarray]):
        import numpy

        self.paths, self.runs = paths, [LogTable([run], own) for run, own in zip(runs, times)]
        self.all_rows = LogTable(runs, numpy.concatenate(times), is_all=True)
        self._kept = last_of_each(self.all_rows.steps)
        super().__init__(runs, self.all_rows.times[self._kept])

    def _column(self, name: str) -> numpy.ndarray:
        values, steps, start = self.all_rows._column(name), self.all_rows.steps, 0
        for before, run in zip(self.runs, self.runs[1:]):
            start += len(before)
            # the first row of a run is of the state in which the run before ended
            if name not in run and steps[start] == steps[start - 1]:
                values[start] = values[start - 1]
        return values[self._kept]

    def __repr__(self) -> str:
        names = ", ".join(os.path.basename(path) for path in self.paths)
        return f"<log {names}: {len(self)} timesteps in {len(self.runs)} runs, columns {' '.join(self)}>"


def _times(runs: list[LogRun], dt: float | None) -> list[numpy.ndarray]:
    """Returns the times of each run: the doubles nearest to begin + size x timesteps, or a column Time that differs by more than rounding.

    Where the size changes, times go on from those of the runs before. The last dt in a column Dt, or Time over Step, holds for the runs
    that follow, until a command chooses another one.
    """
    import numpy

    def exact(run: LogRun, start: int, begin: Fraction, size: Fraction) -> numpy.ndarray:
        below = math.lcm(begin.denominator, size.denominator)
        return (((numpy.array(run.steps, object) - start) * int(size * below) + int(begin * below)) / below).astype(float)

    if dt is not None:
        try:
            return [exact(run, 0, Fraction(0), Fraction(repr(float(dt)))) for run in runs]
        except OverflowError:
            raise c.ArgumentError(f"{runs[0].path}: expected a dt that gives finite times, got {dt}") from None
    size, all_times = None, []
    clocks: list[tuple[int, Fraction, Fraction]] = []  # first timestep, its time, and size, of runs that later ones may follow
    for before, run in zip([None, *runs], runs if any(run.at is not None for run in runs) else []):
        steps, start = numpy.array(run.steps), run.steps[0]
        is_reset = run.reset[:1] == (start,) and (len(run.reset) > 1 or before is not None and start < before.last)
        clocks = [] if is_reset else clocks
        size = Fraction(repr(run.dt)) if run.dt else size
        first, time, old = next((clock for clock in reversed(clocks) if clock[0] <= start), (0, Fraction(0), size))
        begin = Fraction(repr((*run.reset, 0.0)[1])) if is_reset else time + (old or 0) * (start - first)
        times = numpy.full(len(steps), math.nan) if size is None else exact(run, start, begin, size)
        sizes, printed, known = run.column("Dt"), run.column("Time"), float(size or 0)
        is_sized = not run.blocks and bool((numpy.isfinite(sizes) & (sizes > 0)).all())  # blocks print four decimals
        if is_sized and (abs(sizes - known) > 1e-5 * known).any():
            times = (sizes[0] * start if size is None else times[0]) + numpy.append(0, numpy.cumsum(numpy.diff(steps) * sizes[:-1]))
            known = sizes[-1]
        # one unit of the last digit of the column
        digit = min((10.0 ** int(Decimal(repr(x)).as_tuple().exponent) for x in printed[-20:].tolist() if math.isfinite(x)), default=0.0)
        is_other = numpy.isfinite(printed) & ~(abs(times - printed) <= numpy.maximum(1e-5 * abs(printed), 0.51 * digit))
        times = numpy.where(is_other, printed, times)
        if is_other[-1] and len(steps) > 1 and not is_sized:
            past, count = printed[-1] - printed[-2], steps[-1] - steps[-2]
            known = past / count if past > 0 and not abs(past - known * count) <= 1e-5 * printed[-1] + digit else known
        if known and math.isfinite(known) and math.isfinite(times[-1]) and (is_other[-1] or known != float(size or 0)):
            size = Fraction(repr(float(known)))
            begin = Fraction(repr(float(times[-1]))) - size * (run.last - start)
        clocks += [] if size is None else [(start, begin, size)]
        all_times.append(times)
    for others in (all_times, [run.column("Time") for run in runs]):
        if others and all(numpy.isfinite(times).all() for times in others):
            return others
    return [numpy.array(run.steps, dtype=float) for run in runs]


def _with_steps(readers: list[LogReader], given: float | None) -> list[LogRun]:
    """Returns the runs. Rows without Step are numbered if no table has it; else their column Time counts, or the tables are left out."""
    import numpy

    dt, last, has_steps = given, -1, any(run.at is not None for reader in readers for run in reader.runs)
    for reader in readers:
        for run in reader.runs:
            dt = given or run.dt or dt
            if run.at is None:
                steps, text = range(last + 1, last + 1 + len(run.steps)), "whose rows are numbered"
                if has_steps:
                    exact = run.column("Time") / (dt or math.nan)
                    steps = numpy.rint(exact)
                    is_next = (abs(exact - steps) < 0.01).all() and (numpy.diff(steps) > 0).all() and last in (-1, steps[0])
                    steps, text = (map(int, steps), "whose column Time counts") if is_next else ((), "which is left out")
                run.steps = array("q", steps)
                reader.notes.append((run.line, f"expected the column Step, got a table without it, {text}"))
            run.last = last = run.steps[-1] if run.steps else last
    return [run for reader in readers for run in reader.runs if run.steps]


def expect_dt(dt: float | None) -> None:
    """Raises ArgumentError for a time of a timestep that cannot be."""
    if dt is not None and not 0 < float(dt) < math.inf:
        raise c.ArgumentError(f"expected a dt that is finite and greater than 0, got {dt}")


def read_log(paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float | None = None) -> Log:
    """Reads the thermo tables of a log of LAMMPS or LIGGGHTS, and returns them as a Log. Needs numpy alone.

    paths  the log, or what the program printed on the screen, plain or .gz, .bz2, .xz, .zst; a list of logs in their order
    dt     the time of one timestep, greater than 0, in the unit of the run. None: the log says it, by its commands `timestep`,
           `units` and `reset_timestep`, or a column Time or Dt; if it says nothing, times are timesteps

    The function reads thermo_style one, multi, custom and yaml, and the tables of NEB, of any number of runs. Columns may have any names. If
    no table has the column Step, rows are numbered from 0. One warning a file tells what is left out, such as a last row that ends early.

    Raises FileNotFoundError; vtkgranular.Error with path, line and column if a row has a word in place of a number, if a file is binary or
    empty, if a line has 4 MiB or more, if the content of a compressed log exceeds 256 MiB and 200 times its size, and without rows.
    """
    given = [paths] if isinstance(paths, (str, bytes, os.PathLike)) else list(paths)
    if not given:
        raise c.ArgumentError("expected at least one log, got none")
    expect_dt(dt)
    readers = [LogReader(os.path.abspath(os.fsdecode(path))) for path in given]
    for reader in readers:
        reader.read()
    runs = _with_steps(readers, dt)
    for reader in readers:
        if reader.notes:
            (line, text), *others = reader.notes
            _warn("; ".join([reader.where(line) + text, *(f"line {line}: {text}" if line else text for line, text in others)]))
    return Log([reader.path for reader in readers], runs, _times(runs, dt))
