# SPDX-License-Identifier: BSD-3-Clause
"""What is in a folder of a run: series of files by kind, on one clock."""
from __future__ import annotations

import bisect
import glob
import os
import re
import warnings
from typing import Any, Iterator, Mapping

from . import _library as c
from ._log import expect_dt, read_log
from ._run import kind_of, open as open_run
from ._series import _times
from ._table import read_table

#: Files of VTK and of surfaces, by their endings.
MESHES = {".vtk", ".vtp", ".vtu", ".vti", ".vtr", ".vts", ".vtm", ".pvtp", ".pvtu", ".pvti", ".pvtr", ".pvts", ".stl", ".ply"}
#: The kinds of VTK files, by what is in them; the first that fits. Files with a box beside are particles.
_VTK = (("particles", rb'name="Domain"'), ("contacts", rb'(?m)^LINES [1-9]|NumberOfLines="[1-9]'),
        ("walls", rb'(?m)^POLYGONS |^CELL_TYPES |NumberOfPolys="[1-9]|NumberOfCells="[1-9]|^solid|^ply'),
        ("particles", rb'(?m)^(?:SCALARS )?id |Name="id"'))
_ARRAYS = re.compile(rb'(?m)^(?:SCALARS|VECTORS|NORMALS|TENSORS)\s+(\S+)|^(\S+) \d+ \d+ (?:float|double|int|long|vtktypeint64)\s*$'
                     rb'|<P?DataArray[^>]*\bName="(?!Points|connectivity|offsets|types)([^"]+)"')
_LONGEST_HEAD = 1 << 26
_IN_PARAVIEW = ("particles", "contacts", "walls", "other")
#: All kinds, in the order of a listing.
KINDS = ("dump", "particles", "data", "restart", "local", "contacts", "walls", "euler", "grid", "decomposition", "table", "log", "other")


class Series:
    """Files of a run whose names differ in the timestep, `*`, and in the rank, `%`; or one file.

    name     "dump_*.liggghts", without the folder
    kind     of vtkgranular.open, or "particles", "contacts" and "walls" in VTK and STL files, "table", "log" and "other"
    about    of "other", what the file is
    files    absolute, in the order of the numbers in their names
    bytes    of all files
    steps    timesteps; of files that hold one each, as their names have them
    columns  names of the columns or arrays of the largest file
    """

    def __init__(self, name: str, files: list[tuple[str, int]], steps: list[int], has_box: bool):
        self.name, self.files, self.bytes = name, [path for path, _ in files], sum(size for _, size in files)
        self.about, self.columns, self.steps, self._is_guess = "", [], [], False
        sample = max(files, key=lambda file: file[1])[0]  # the first one may be empty
        try:
            self.kind = kind_of(sample) or self._kind(sample, has_box)
        except OSError as error:
            self.kind, self.about = "other", str(error)
        if self.kind in _IN_PARAVIEW:
            self.steps = sorted({*steps}) if self.kind != "other" else []
            return
        try:
            opened = self.open([sample])
            self.columns = [column if isinstance(column, str) else column.name for column in opened.columns]
            is_named = len(files) > 1 and opened.steps.tolist() == [steps[self.files.index(sample)]]
            self.steps = sorted({*steps}) if is_named else (self.open() if len(files) > 1 else opened).steps.tolist()
        except (c.Error, OSError) as error:
            self.about = str(error)
        if self.kind == "table" and (self.columns[:1] == ["1"] or self._is_guess and self.about):
            self.kind, self.about, self.steps, self.columns = "other", "", [], []  # numbers without a title may be anything

    def _kind(self, path: str, has_box: bool) -> str:
        """Finds what a file is that the library does not know."""
        if _ending(path) in MESHES:
            with open(path, "rb") as file:
                head = file.read(_LONGEST_HEAD)
            self.columns = [*dict.fromkeys(os.fsdecode(b"".join(names)) for names in _ARRAYS.findall(head))]
            return "particles" if has_box else next((kind for kind, sign in _VTK if re.search(sign, head)), "other")
        try:
            open_run(path)
        except (c.Error, OSError) as error:
            self.about = str(error).partition(", got ")[2]
        for word, kind in (("read_log", "log"), ("read_table", "table"), (": ", "other")):
            if word in self.about:
                self.about = self.about.split(": ")[0]
                return kind
        self.about, self._is_guess = "", True
        return "table" if self.bytes < _LONGEST_HEAD else "other"  # which may have any title

    def open(self, files: list[str] | None = None, dt: float | None = None) -> Any:
        """Returns the files as a Run, a Table or a Log; None for VTK and STL files, which vtkgranular.reader opens in ParaView."""
        files = files or self.files
        if self.kind in ("log", "table"):
            return read_log(files, dt) if self.kind == "log" else read_table(files[0], dt)
        return None if self.kind in _IN_PARAVIEW else open_run(files, dt)

    def files_at(self, step: int) -> list[str]:
        """Returns the files of a timestep, or of the last one before."""
        count = len(self.files) // max(1, len(self.steps))
        at = max(0, bisect.bisect(self.steps, step) - 1) * count
        return self.files[at:at + count]

    def times(self, dt: float | None) -> list[float]:
        """Returns the times of the timesteps: timesteps without dt. Files that hold times have their own when they are opened."""
        return _times(self.steps, dt) if dt else [float(step) for step in self.steps]

    def __repr__(self) -> str:
        return f"<{self.kind} {self.name}: {len(self.steps)} timesteps>"


def _ending(name: str) -> str:
    return os.path.splitext(re.sub(r"\.(gz|zst)$", "", name))[1].lower()


def _stem(name: str) -> str:
    return name[:len(name) - len(_ending(name))] if not name.endswith((".gz", ".zst")) else _stem(os.path.splitext(name)[0])


def _families(names: list[str]) -> Iterator[tuple[str, list[str], list[int]]]:
    """Yields the pattern, names and timesteps of files whose names differ in numbers.

    A number is that of a rank if it counts from 0 for each value of another one. Of several others the last one is the timestep."""
    shapes: dict[str, list[tuple[tuple[int, ...], str]]] = {}
    for name in names:
        numbers = re.findall(r"\d+", name)
        plain = re.sub(r"\.(gz|zst)$", "", name) if numbers else name
        shapes.setdefault(re.sub(r"\d+", "\0", plain), []).append((tuple(map(int, numbers)), name))
    for shape, found in shapes.items():
        values = [{*column} for column in zip(*(numbers for numbers, _ in found))]
        varying = [at for at, each in enumerate(values) if len(each) > 1]
        ranks = [at for at in varying if len(varying) > 1 and values[at] == {*range(len(values[at]))} and
                 len(found) == len({numbers[:at] + numbers[at + 1:] for numbers, _ in found}) * len(values[at])][:1]
        others = [at for at in varying if at not in ranks]
        step = others[-1] if others else len(values) - 1
        families: dict[tuple[int, ...], list[tuple[int, tuple[int, ...], str]]] = {}
        for numbers, name in found:
            families.setdefault(tuple(numbers[at] for at in others[:-1]), []).append((numbers[step] if numbers else 0, numbers, name))
        for family in families.values():
            family.sort()
            words = re.findall(r"\d+", family[0][2])
            for at, sign in [*((at, "%") for at in ranks), *((at, "*") for at in others[-1:])]:
                words[at] = sign if len(family) > 1 else words[at]
            pieces = shape.split("\0")
            pattern = "".join(a + b for a, b in zip(pieces, [*words, ""]))
            yield pattern if len(family) > 1 else family[0][2], [name for *_, name in family], [number for number, *_ in family if values]


def span(values: list[Any], form: str = "") -> str:
    """Returns 'first to last'."""
    if not values:
        return "none"
    return f"{values[0]:{form}}" if values[0] == values[-1] else f"{values[0]:{form}} to {values[-1]:{form}}"


def steps_text(steps: list[int]) -> str:
    """Returns 'first to last, every so many'."""
    gaps = {b - a for a, b in zip(steps, steps[1:])}
    return span(steps) + (f", every {gaps.pop()}" if len(gaps) == 1 else "")


class Folder(Mapping[str, Series]):
    """What is in a folder of a run: a mapping of names, such as "dump_*.liggghts", to Series.

    path         the folder, absolute
    dt, dt_path  the time of one timestep, and the log that tells it; None and "" if neither the caller nor a log does
    particles    the Series of the particles to show, or None; walls: those of their walls
    remarks      sentences about series that lack timesteps of these particles

    `print(folder)` lists all series.
    """

    def __init__(self, path: str, dt: float | None = None):
        expect_dt(dt)
        self.path, self.dt, self.dt_path, self._given = os.path.abspath(path), dt, "", path
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # who opens the files is told
            self._find_series()
            if dt is None:
                self._find_dt()
        self.particles = self.best("dump", "particles")
        self.walls = self._walls()
        self.remarks = [text for each in self.of("local", "contacts", "walls") for text in [self._lack(each)] if text]

    def _find_series(self) -> None:
        sizes = {entry.name: entry.stat().st_size for entry in os.scandir(self.path) if entry.is_file() and entry.name[0] != "."}
        self._boxes = {re.sub(r"_?boundingBox", "", _stem(name)): name for name in sizes if "boundingBox" in name}
        wholes = {_stem(name) for name in sizes if _ending(name).startswith(".pv")}  # whose pieces have one number more
        self._series: list[Series] = []
        for name, names, steps in _families([name for name in sizes if "boundingBox" not in name]):
            stem = _stem(names[0])
            is_piece = _ending(name).startswith(".vt") and \
                any(stem[:rank.start()] + stem[rank.end():] in wholes for rank in re.finditer(r"_\d+(?=[._]|$)", stem))
            if any(sizes[each] for each in names) and not is_piece:
                has_box = any(_stem(each) in self._boxes for each in names)
                files = [(os.path.join(self.path, each), sizes[each]) for each in names]
                found = Series(name, files, steps, has_box)
                is_one = found.kind not in ("table", "log", "other")  # each table is one of its own
                self._series += [found] if is_one else [Series(each, [file], [], has_box) for each, file in zip(names, files)]
        self._series.sort(key=lambda each: (KINDS.index(each.kind), each.name))

    def _find_dt(self) -> None:
        """Takes the time of a timestep from a log in the folder or the one above, the newest first, if it has one alone."""
        above = glob.glob(os.path.join(glob.escape(os.path.dirname(self.path)), "*"))
        beside = [path for path in above if "log" in os.path.basename(path).lower().split(".") and os.path.isfile(path)]
        for path in sorted([*(each.files[-1] for each in self.of("log")), *beside], key=os.path.getmtime, reverse=True):
            try:
                sizes = {run.dt for run in read_log(path)._runs if run.dt}
            except (c.Error, OSError):
                continue  # of another program
            if len(sizes) == 1:
                self.dt, self.dt_path = sizes.pop(), path
                return

    def _lack(self, series: Series) -> str:
        """Says which timesteps of the particles a series lacks; empty if none, or if it does not move."""
        steps = self.particles.steps if self.particles else []
        missing = sorted({*steps} - {*series.steps}) if len(series.steps) > 1 else []
        return f"{series.name} lacks {len(missing)} of {len(steps)} timesteps of {self.particles.name}, the first {missing[0]}: the file " \
            "before is shown there" if missing else ""

    def _walls(self) -> list[Series]:
        """Returns the walls that move with the particles, those with arrays alone if there are some, as others are the same ones again. If
        none moves so, those that lack timesteps; and if there are none, surfaces without timesteps."""
        found = self.of("walls")
        for is_wanted in (lambda each: "*" in each.name, lambda each: not self._lack(each), lambda each: each.columns):
            found = [each for each in found if is_wanted(each)] or found
        return found or [each for each in [self.particles] if each and each.name.endswith(".vtm")]  # with the walls of custom/vtm

    def box_of(self, path: str) -> list[str]:
        """Returns the file with the box of particles in a VTK file, if there is one."""
        name = self._boxes.get(_stem(os.path.basename(path)))
        return [os.path.join(self.path, name)] if name else []

    def of(self, *kinds: str) -> list[Series]:
        """Returns the series of some kinds."""
        return [each for each in self._series if each.kind in kinds]

    def best(self, *kinds: str) -> Series | None:
        """Returns the series of some kinds with radii or ids of ends, most timesteps and most columns, dumps before VTK files."""
        return max(self.of(*kinds), default=None, key=lambda each: (
            not {"radius", "id1"}.isdisjoint(each.columns), len(each.steps), each.kind == "dump", len(each.columns)))

    def __getitem__(self, name: str) -> Series:
        for each in self._series:
            if each.name == name:
                return each
        raise c.ColumnError(f"{c.shown(self.path)}: expected one of {', '.join(self)}, got {name!r}", self.path)

    def __iter__(self) -> Iterator[str]:
        return iter([each.name for each in self._series])

    def __len__(self) -> int:
        return len(self._series)

    def __str__(self) -> str:
        origin = f" from {os.path.relpath(self.dt_path, self.path)}" if self.dt_path else ""
        lines = [f"{c.shown(self._given)}: time of a timestep {f'{self.dt:g}{origin}' if self.dt else 'not known'}"]
        for each in self._series:
            files = f", {len(each.files)} files" if len(each.files) not in (1, len(each.steps)) else ""
            times = f", times {span(each.times(self.dt), 'g')}" if self.dt and each.steps else ""
            count = "1 timestep" if len(each.steps) == 1 else f"{len(each.steps)} timesteps"
            frames = f"{count}{files}: {steps_text(each.steps)}{times}" if each.steps else each.about or "no timesteps"
            lines += [f"  {each.kind:<13} {c.shown(each.name)}", f"  {'':<15} {frames}"]
            lines += [f"  {'':<15} {' '.join(each.columns)}"] if each.columns else []
        return "\n".join([*lines, *self.remarks])

    def __repr__(self) -> str:
        return f"<folder {self.path}: {', '.join(self)}>"
