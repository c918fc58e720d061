# SPDX-License-Identifier: BSD-3-Clause
"""Reads everything, and says in words what is wrong.

A fault makes the exit status 1; a remark does not."""
from __future__ import annotations

import argparse
import contextlib
from typing import Any

from .._library import shown
from . import WRONG, add_files, add_frames, chosen, json_text, notices, open_run
from .info import file_faults, oddities
from .progress import Bar

MORE = """Faults, which make the exit status 1: frames that end early or cannot be read, missing pieces, timesteps that repeat in a \
file, ids that repeat in a frame, NaN and infinite numbers, radii that are not positive, particles farther outside than codes let them go: \
half a box length, or at a fixed boundary a diameter (without radii a twentieth of the box). \
Remarks: what the reader says, steps at odd distances, empty frames, ids that vanish or come, particles a little outside the box, positions \
with few digits."""

FEW_DIGITS = 1e-2  # of the smallest radius
FAR, FAR_AT_FIXED = 0.5, 0.05  # of the length of the box


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of check."""
    add_files(parser)
    add_frames(parser)
    parser.add_argument("--quiet", "-q", action="store_true", help="prints nothing where nothing is wrong, and no bar")


def some(values: Any, most: int = 5) -> str:
    """Returns the first of many values."""
    listed = ", ".join(str(value) for value in values[:most])
    return listed + (", ..." if len(values) > most else "")


class Checker:
    """What one frame after another tells."""

    def __init__(self) -> None:
        self.faults: list[str] = []
        self.remarks: list[str] = []
        self._ids: Any = None
        self._gone = self._new = 0
        self._first_gone = ""
        self._coarse: dict[str, tuple[float, int, int]] = {}  # unit of the first digit over the radius, its step, digits; by form
        self._outside: dict[str, list[tuple[str, int, float]]] = {}  # a little, along each axis

    def run(self, run: Any) -> None:
        """Looks at files and timesteps."""
        self.faults += file_faults(run)
        self.remarks += oddities(run.steps, run.rows)

    def frame(self, frame: Any) -> None:
        """Looks at a frame."""
        where = f"step {frame.step}"
        self._numbers(frame, where)
        if "id" in frame:
            self._look_at_ids(frame["id"], where)
        of_particles = frame._kind in ("dump", "data", "restart")
        if "radius" in frame and of_particles:
            wrong = int((frame["radius"] <= 0).sum())
            if wrong:
                self.faults.append(f"{where}: {wrong} radii are not positive")
        if frame.rows and of_particles and frame._has_points():
            self._positions(frame, where)

    def _numbers(self, frame: Any, where: str) -> None:
        import numpy

        arrays = {name: frame[name] for name in frame}
        if frame.rows and frame._has_points():
            arrays["points"] = frame.points
        for name, values in arrays.items():
            if values.dtype.kind == "f":
                wrong = int(numpy.count_nonzero(~numpy.isfinite(values)))
                if wrong:
                    kind = "NaN" if numpy.isnan(values).sum() == wrong else "NaN or infinite"
                    self.faults.append(f"{where}: {wrong} values of {name} are {kind}")

    def _look_at_ids(self, ids: Any, where: str) -> None:
        import numpy

        unique, counts = numpy.unique(ids, return_counts=True)
        if len(unique) < len(ids):
            self.faults.append(f"{where}: {int((counts > 1).sum())} ids occur more than once: {some(unique[counts > 1].tolist())}")
        if self._ids is not None and len(self._ids):
            gone = numpy.setdiff1d(self._ids, unique, assume_unique=True)
            self._gone += len(gone)
            self._new += len(numpy.setdiff1d(unique, self._ids, assume_unique=True))
            if len(gone) and not self._first_gone:
                self._first_gone = f"{where}: {some(gone.tolist())}"
        self._ids = unique

    def _positions(self, frame: Any, where: str) -> None:
        import numpy

        points = frame.points
        least, largest = (float(frame["radius"].min()), float(frame["radius"].max())) if "radius" in frame else (0.0, 0.0)
        box = frame.box
        if box is not None and abs(numpy.linalg.det(box.vectors)) > 0:
            parts = (points - box.origin) @ numpy.linalg.inv(box.vectors)
            beyond = numpy.maximum(-parts, parts - 1)
            kinds = (box.boundary.split() + ["", "", ""])[:3]
            for axis, name in enumerate("abc" if any(box.tilts) else "xyz"):
                outside = beyond[:, axis] > 1e-12
                count = int(outside.sum())
                if not count:
                    continue
                length, most = float(numpy.linalg.norm(box.vectors[axis])), float(beyond[outside, axis].max())
                # codes take particles away, or put them back, when they have moved so far that neighbours are looked for
                fixed = "f" in kinds[axis]
                if most > FAR or (fixed and most * length > (2 * largest or FAR_AT_FIXED * length)):
                    self.faults.append(f"{where}: {count} particles are outside the box along {name}, by {most * length:g} at most" +
                                       (", where the box is fixed" if fixed else ""))
                else:
                    self._outside.setdefault(name, []).append((where, count, most * length))
        if least > 0:
            self._digits(frame, least)

    def _digits(self, frame: Any, radius: float) -> None:
        """How wrong the digits of the text leave the largest coordinate. Round numbers, as of a lattice, have fewer in single frames."""
        import numpy

        for form in ("x y z", "xu yu zu", "xs ys zs"):
            for name in (name for name in form.split() if frame.digits.get(name)):
                largest = float(numpy.nanmax(numpy.abs(frame[name])))
                edge = numpy.linalg.norm(frame.box.vectors["xyz".index(name[0])]) if name[1:] == "s" and frame.box else 1.0
                if 0 < largest < numpy.inf:
                    unit, step, digits = self._coarse.get(form, (0.0, 0, 0))
                    here = float(edge) * 10.0 ** float(numpy.floor(numpy.log10(largest))) / radius
                    self._coarse[form] = (*max((unit, step), (here, frame.step)), max(digits, frame.digits[name]))

    def finish(self, said: list[str]) -> None:
        """Adds what all frames together tell, and what was said while they were read."""
        for text in said:
            wrong = (": expected " in text and ", got " in text) or "left out" in text
            if not any(text.partition(": ")[2] in fault for fault in self.faults):
                (self.faults if wrong else self.remarks).append(text)
        for name, frames in self._outside.items():
            first, count, _ = frames[0]
            several = f"{len(frames)} frames have particles outside the box along {name}; the first: {first}: {count} particles"
            self.remarks.append((f"{first}: {count} particles are outside the box along {name}" if len(frames) == 1 else several) +
                                f", by {max(frame[2] for frame in frames):g} at most")
        if self._gone:
            self.remarks.append(f"{self._gone} ids are not in the frame after; first at {self._first_gone}")
        if self._new:
            self.remarks.append(f"{self._new} ids come in a later frame")
        part, digits, step = max(((0.5 * unit * 10.0 ** (1 - digits), digits, step) for unit, step, digits in self._coarse.values()),
                                 default=(0, 0, 0))
        if part > FEW_DIGITS:
            self.remarks.append(f"positions have {digits} digits: each is wrong by up to {100 * part:.2g} % of the smallest radius (step "
                                f"{step}); `dump_modify ID format \"%d %d %.12g ...\"`, a format for each column, keeps more")


def run(arguments: argparse.Namespace) -> int:
    """Checks the files, and returns the exit status."""
    checker, count, rows = Checker(), 0, 0
    with notices() as said:
        try:
            with open_run(arguments) as opened, Bar(opened, arguments.quiet) as bar:
                frames = chosen(opened, arguments.frames)
                count, rows = len(frames), int(frames.rows.clip(min=0).sum())
                checker.run(opened)
                for i in range(count):
                    try:
                        checker.frame(frames[i].read(bar.within(i, count)))
                    except RuntimeError as error:
                        checker.faults.append(str(error))
        except RuntimeError as error:
            checker.faults.append(str(error))
    checker.finish(said)
    found = {"given": arguments.files, "frames": count, "rows": rows, "faults": checker.faults, "remarks": checker.remarks}
    if arguments.json:
        text = json_text(found)
    else:
        part = any("not read: " in remark for remark in checker.remarks)
        fine = "no fault in what was read" if part else "nothing is wrong"
        faults = {0: fine, 1: "1 fault"}.get(len(checker.faults), f"{len(checker.faults)} faults")
        text = "\n".join([*("fault: " + fault for fault in checker.faults), *("remark: " + remark for remark in checker.remarks),
                          f"{shown(' '.join(arguments.files))}: {count} frames, {rows} rows, {faults}"])
    if arguments.json or checker.faults or not arguments.quiet:
        with contextlib.suppress(BrokenPipeError):  # the status tells of faults that nobody reads
            print(text)
    return WRONG if checker.faults else 0
