# SPDX-License-Identifier: BSD-3-Clause
"""Says what files hold: frames, steps, times, columns with types, box, dialect, size, and what is odd about them.

Only headers are read, so large files take no longer than the search for their frames."""
from __future__ import annotations

import argparse
import os
from collections import Counter
from typing import Any

from .._folder import Folder, span, steps_text
from .._library import shown
from . import add_files, json_text, notices, open_run, say

MORE = "Only headers are read: large files take no longer than the search for their frames."


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of info."""
    add_files(parser)


def size_text(size: float) -> str:
    """Returns a number of bytes as people write it."""
    for unit in ("bytes", "kB", "MB", "GB"):
        if size < 1000:
            return f"{size:.3g} {unit}" if unit != "bytes" else f"{size:.0f} bytes"
        size /= 1000
    return f"{size:.4g} TB"


def facts(run: Any) -> dict[str, Any]:
    """Returns what is known of a run from the headers of its frames."""
    steps, rows = run.steps, run.rows
    last = len(run) - 1
    while last > 0 and rows[last] == 0:
        last -= 1
    files = run._file_facts()
    found: dict[str, Any] = {"kind": run.kind, "files": len(files), "bytes": sum(size for _, size, *_ in files), "frames": len(run),
                             **dict.fromkeys(("steps", "times", "rows"), []), **dict.fromkeys(("dialect", "units", "label"), ""),
                             "types": [], "bond_types": [], "box": None, "columns": [], "file_columns": []}
    if len(run):
        frame = run[last]
        box = frame.box
        found |= {"steps": steps.tolist(), "times": run.times.tolist(), "rows": rows.tolist(), "dialect": frame.dialect,
                  "units": frame.units, "label": frame.label, "types": frame.type_names,
                  "bond_types": frame.bonds.type_names if run.kind == "data" else [],
                  "box": box and {"lo": box.lo.tolist(), "hi": box.hi.tolist(), "tilts": box.tilts.tolist(),
                                  "origin": box.origin.tolist(), "vectors": box.vectors.tolist(), "boundary": box.boundary},
                  "columns": [column._asdict() for column in run.columns], "file_columns": frame.columns}
    found["odd"] = file_faults(run) + oddities(steps, rows)
    return found


def file_faults(run: Any) -> list[str]:
    """Returns what the files hold that is not shown: frames that end early, and timesteps that come again."""
    found = []
    for path, _, _, repeated, defect in run._file_facts():
        # a restart file of several ranks is known by its base; a rank may have no contacts to write
        usual = "one of several processes" in defect or (run.kind == "local" and "got an empty file" in defect)
        if defect and not usual:
            found.append(defect if defect.startswith(shown(path)) else f"{shown(path)}: {defect}")
        if repeated:
            found.append(f"{shown(path)}: {repeated} frames have the timestep of an earlier one in this file, and the last one counts")
    return found


def tell_faults(run: Any) -> None:
    """Says what files hold that is not shown, for commands that go on."""
    for text in file_faults(run):
        say(text)


def oddities(steps: Any, rows: Any) -> list[str]:
    """Returns what one would not expect of the frames."""
    found = []
    if not len(steps):
        return ["there are no frames"]
    gaps = steps[1:] - steps[:-1]
    if len(gaps) > 1 and (gaps != gaps[0]).any():
        usual = Counter(gaps.tolist()).most_common(1)[0][0]
        odd = [i for i, gap in enumerate(gaps) if gap != usual]
        found.append(f"{len(odd)} of {len(gaps)} frames do not follow the one before after {usual} steps; the first: "
                     f"{steps[odd[0]]} to {steps[odd[0] + 1]}")
    empty = int((rows == 0).sum())
    if empty:
        found.append(f"{empty} of {len(rows)} frames are empty; the first: step {steps[(rows == 0).argmax()]}")
    return found


def print_facts(found: dict[str, Any], name: str) -> None:
    """Prints what was found in words."""
    dialect = f", {found['dialect']}" if found.get("dialect") else ""
    files = "1 file" if found["files"] == 1 else f"{found['files']} files"
    lines = [("kind", found["kind"] + dialect), ("size", f"{files}, {size_text(found['bytes'])}"), ("frames", str(found["frames"]))]
    if found["frames"]:
        rows = sorted(found["rows"])
        steps = found["steps"]
        lines.append(("steps", steps_text(steps)))
        if found["times"] != steps:
            lines.append(("times", span(found["times"], "g")))
        lines.append(("rows", span(rows)))
        lines += [(word, found[word]) for word in ("units", "label") if found[word]]
        for word, types in (("types", found["types"]), ("of bonds", found["bond_types"])):
            lines += [(word, ", ".join(f"{i} {name}" for i, name in enumerate(types, 1) if name))] if types else []
        box = found["box"]
        if box:
            edges = [f"{lo:g} to {hi:g}" for lo, hi in zip(box["lo"], box["hi"])]
            tilts = f", tilts {' '.join(f'{tilt:g}' for tilt in box['tilts'])}" if any(box["tilts"]) else ""
            lines.append(("box", ", ".join(edges) + tilts + (f", {box['boundary']}" if box["boundary"] else "")))
        names = [column["name"] for column in found["columns"]]
        width = max(map(len, names), default=0)
        is_si = found["units"] == "si" or (found["dialect"] != "LAMMPS" and not found["units"])
        for i, column in enumerate(found["columns"]):
            parts = f" x {column['components']}" if column["components"] > 1 else ""
            unit = f" [{column['unit']}]" if is_si and column["unit"] not in ("", "-") else ""
            lines.append(("columns" if i == 0 else "", f"{column['name']:{width}}  {column['type'] + parts:11}  "
                          f"{column['meaning']}{unit}".rstrip()))
    lines += [("odd" if i == 0 else "", text) for i, text in enumerate(found["odd"])]
    print(name)
    for word, text in lines:
        print(f"  {word:9}{shown(text)}")


def folder_facts(folder: Folder) -> dict[str, Any]:
    """Returns what is known of a folder."""
    return {"dt": folder.dt, "dt_path": folder.dt_path, "remarks": folder.remarks, "series": [
        {"name": each.name, "kind": each.kind, "about": each.about, "files": len(each.files), "bytes": each.bytes, "steps": each.steps,
         "times": each.times(folder.dt), "columns": each.columns} for each in folder.values()]}


def run(arguments: argparse.Namespace) -> None:
    """Prints what the files hold, or what is in a folder."""
    if len(arguments.files) == 1 and os.path.isdir(arguments.files[0]):
        folder = Folder(arguments.files[0], arguments.dt)
        print(json_text({"given": arguments.files, **folder_facts(folder)}) if arguments.json else folder)
        return
    with notices() as said, open_run(arguments) as opened:
        found = facts(opened)
    found["odd"] = said + found["odd"]
    if arguments.json:
        print(json_text({"given": arguments.files, **found}))
    else:
        print_facts(found, shown(" ".join(arguments.files)))
