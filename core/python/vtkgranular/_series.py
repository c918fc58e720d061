# SPDX-License-Identifier: BSD-3-Clause
"""Times for the files of a run that hold none."""
from __future__ import annotations

import json
import math
import os
import re
import warnings
from fractions import Fraction
from typing import Iterable

from ._library import shown
from ._whole_file import whole_file


def _stem_and_suffix(name: str) -> tuple[str, str]:
    """'mesh_100.stl' -> ('mesh_100', '.stl'), but 'dump.100' -> ('dump.100', '')."""
    stem, suffix = os.path.splitext(name)
    return (stem, suffix) if re.search("[A-Za-z]", suffix) else (name, "")


def _step(file: str) -> int:
    """The last number in the name of a file, without its suffix."""
    stem, _ = _stem_and_suffix(os.path.basename(file))
    numbers = re.findall("[0-9]+", stem)
    if not numbers:
        raise ValueError(f"no step number in the file name: {shown(file)}")
    return int(numbers[-1])


def _default_path(file: str) -> str:
    """'post/mesh_100.stl' -> 'post/mesh.stl.series'."""
    folder, name = os.path.split(file)
    stem, suffix = _stem_and_suffix(name)
    text = re.sub("[0-9]+(?=[^0-9]*$)", "", stem).strip("_.- ")
    return os.path.join(folder, (text or "files") + suffix + ".series")


def _times(steps: list[int], dt: float) -> list[float]:
    """Times of steps in ascending order, by the clock of the readers: the doubles nearest to step x dt as it is written.

    Steps that would share a time are at the next doubles, with a warning."""
    size = Fraction(repr(float(dt)))
    times = []
    shared = []
    for step in steps:
        try:
            time = float(step * size)
        except OverflowError:
            raise ValueError(f"dt must give finite times, got {dt} for step {step}") from None
        if times and time <= times[-1]:
            time = math.nextafter(times[-1], math.inf)
            shared.append(step)
        times.append(time)
    if shared:
        warnings.warn(f"{len(shared)} of {len(times)} steps, the first of them {shared[0]}, are too large for times of their "
                      "own and get the next ones; count steps from 0", stacklevel=3)
    return times


def write_series(files: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], dt: float,
                 path: str | os.PathLike[str] | None = None) -> str:
    """Writes a .series file, which gives ParaView's own readers the times of other files, and returns its path.

    files  names of the files, in any order: mesh_0.stl, mesh_1000.stl, ... The step of each is the last number in its name.
    dt     time of one step, greater than 0: time = step x dt, the double nearest to the product of the decimal numbers. Steps from
           2^53 on that would share a time get the next doubles, with a warning.
    path   the file to write, which ends in '.series'; by default beside the first file and called like it, without the number

    Names in the file are relative to it. An old file is replaced whole or left as it was. Raises ValueError: no files, no number in a name,
    a step that occurs twice, a dt or a path that cannot be; FileNotFoundError if a file does not exist; OSError.
    """
    files = [os.fsdecode(file) for file in ([files] if isinstance(files, (str, bytes, os.PathLike)) else files)]
    if not files:
        raise ValueError("no files")
    if not (math.isfinite(dt) and dt > 0):
        raise ValueError(f"dt must be finite and greater than 0, got {dt}")
    path = _default_path(files[0]) if path is None else os.fsdecode(path)
    if not path.endswith(".series"):
        raise ValueError(f"the path must end in '.series', got {shown(path)}")

    by_step = {}
    for file in files:
        step = _step(file)
        if step in by_step:
            raise ValueError(f"step {step} occurs twice: {shown(by_step[step])} and {shown(file)}")
        try:
            file.encode()
        except UnicodeEncodeError:
            raise ValueError(f"expected a name in UTF-8, as .series files have them, got {shown(file)}") from None
        if not os.path.exists(file):
            raise FileNotFoundError(f"{shown(file)}: no such file or folder")
        by_step[step] = file

    folder = os.path.dirname(os.path.abspath(path))
    steps = sorted(by_step)
    entries = [{"name": os.path.relpath(by_step[step], folder), "time": time}
               for step, time in zip(steps, _times(steps, dt))]
    series = {"file-series-version": "1.0", "files": entries}
    with whole_file(path) as temporary, open(temporary, "w", encoding="utf-8", newline="\n") as out:
        out.write(json.dumps(series, indent=2) + "\n")
    return path
