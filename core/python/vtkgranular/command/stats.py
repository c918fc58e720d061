# SPDX-License-Identifier: BSD-3-Clause
"""Prints statistics of each frame and column: count, least, largest, mean and sum; kinetic energy and granular temperature."""
from __future__ import annotations

import argparse
import csv
import math
import sys
from typing import Any, Iterator

from . import add_files, add_frames, chosen, json_text, open_run
from .info import file_faults, tell_faults
from .progress import Bar

MORE = """Sums are exact: rounded once, after the last term. With velocities and masses (or radii and densities) there are also the \
kinetic energy sum(m v^2) / 2, the granular temperature sum(m |v - V|^2) / (3 sum(m)), where V is the mean velocity by mass, and the \
centre of mass; rotation is not in them. Values that are not numbers are left out of all but count."""

HEADER = ("step", "time", "column", "count", "min", "max", "mean", "sum")


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of stats."""
    add_files(parser)
    add_frames(parser)
    parser.add_argument("--columns", metavar="NAMES", help="columns: 'id v radius' (default: all)")
    parser.add_argument("--csv", action="store_true", help="prints CSV with all digits instead of a table")
    parser.add_argument("--quiet", "-q", action="store_true", help="no bar")


def column_row(values: Any) -> tuple[Any, ...]:
    """Returns count, least, largest, mean and sum of a column; the sum is that of the exact values, rounded once."""
    import numpy

    count = len(values)
    if values.dtype.kind in "UO":
        return count, "", "", "", ""
    if values.dtype.kind == "f":
        values = values[numpy.isfinite(values)]
    if not len(values):
        return count, "", "", "", ""
    try:
        total: Any = math.fsum(values) if values.dtype.kind == "f" else sum(values.tolist())
    except OverflowError:
        total = float(values.sum())
    return count, values.min().item(), values.max().item(), total / len(values), total


def masses_of(frame: Any) -> Any:
    """Returns the masses of particles, or None."""
    import numpy

    if "mass" in frame:
        return frame["mass"]
    if "radius" in frame and "density" in frame:
        return 4 / 3 * numpy.pi * frame["radius"] ** 3 * frame["density"]
    return None


def mechanics(frame: Any) -> Iterator[tuple[str, int, float]]:
    """Yields name, count and value of energy, temperature and centre of mass; nothing where a value is not finite."""
    import numpy

    mass = masses_of(frame)
    if mass is None or not frame.rows or not frame._has_points() or frame._is_lines():
        return
    used = [mass, frame.points.ravel(), *([frame["v"].ravel()] if "v" in frame else [])]
    if not all(numpy.isfinite(values).all() for values in used):
        return
    total = math.fsum(mass)
    if not total > 0:
        return
    for i, axis in enumerate("xyz"):
        yield f"centre of mass {axis}", len(mass), math.fsum(mass * frame.points[:, i]) / total
    if "v" not in frame:
        return
    velocity = frame["v"]
    yield "kinetic energy", len(mass), 0.5 * math.fsum((mass[:, None] * velocity * velocity).ravel())
    mean = [math.fsum(mass * velocity[:, i]) / total for i in range(3)]
    apart = velocity - mean
    yield "granular temperature", len(mass), math.fsum((mass[:, None] * apart * apart).ravel()) / (3 * total)


def rows_of(frame: Any, wanted: list[str] | None) -> Iterator[tuple[Any, ...]]:
    """Yields the rows of a frame without step and time."""
    from .._run import component_columns

    for name, values in component_columns(frame).items():
        if wanted is None or name in wanted:
            yield (name, *column_row(values))
    if wanted is None:
        for name, count, value in mechanics(frame):
            yield name, count, "", "", value, ""


def document_of(frame: Any, wanted: list[str] | None) -> dict[str, Any]:
    """Returns the rows of a frame for JSON."""
    of_columns, of_frame = {}, {}
    for name, *numbers in rows_of(frame, wanted):
        named = dict(zip(HEADER[3:], (None if number == "" else number for number in numbers)))
        if named["sum"] is None and named["mean"] is not None:
            of_frame[name.replace(" ", "_")] = named["mean"]
        else:
            of_columns[name] = named
    return {"step": frame.step, "time": frame.time, "rows": frame.rows, "columns": of_columns, **of_frame}


def run(arguments: argparse.Namespace) -> None:
    """Prints the statistics."""
    wanted = arguments.columns.replace(",", " ").split() if arguments.columns else None
    with open_run(arguments) as opened:
        frames = chosen(opened, arguments.frames)
        if wanted and len(frames):
            from .._run import arrays_of
            asked, wanted = wanted, arrays_of(frames[0], wanted)[1]
        else:
            asked = None
        tell_faults(opened)
        if arguments.json and arguments.csv:
            raise ValueError("expected one of --csv and --json, got both")
        documents = []
        table = csv.writer(sys.stdout, lineterminator="\n")
        if arguments.csv:
            table.writerow(HEADER)
        with Bar(opened, arguments.quiet or sys.stdout.isatty()) as bar:
            for i, number in enumerate(frames._numbers()):
                frame = opened._part(number, columns=asked, threads=arguments.threads).read(bar.within(i, len(frames)))
                if arguments.json:
                    documents.append(document_of(frame, wanted))
                    continue
                if not arguments.csv:
                    print(f"step {frame.step}, time {frame.time:g}, {frame.rows} rows")
                    print(f"  {'column':22}" + "".join(f"{word:>15}" for word in HEADER[3:]))
                for name, *numbers in rows_of(frame, wanted):
                    if arguments.csv:
                        table.writerow([frame.step, repr(frame.time), name, *numbers])
                    else:
                        print(f"  {name:22}" + "".join(f"{number if isinstance(number, (str, int)) else f'{number:.8g}':>15}"
                                                       for number in numbers))
        if arguments.json:
            print(json_text({"given": arguments.files, "faults": file_faults(opened), "frames": documents}))
