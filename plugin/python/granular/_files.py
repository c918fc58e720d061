# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run by a pattern, as simulation codes spell it."""
from __future__ import annotations

import glob
import os
import re


def _numbers_in_order(path: str) -> list[tuple[int, str]]:
    """Sorts name_2 before name_10."""
    return [(int(part), part) if part.isdigit() else (-1, part)
            for part in re.split("([0-9]+)", path)]


def _has_numbers(name: str, pattern: str) -> bool:
    """Returns true if a file that fits a pattern has a number for each '*'."""
    signs = {"*": r"[0-9]+(?:\.[0-9]+)?", "%": ".*", "?": "."}
    parts = re.split(r"(\[[^]]+\]|[*%?])", pattern)
    expression = "".join(signs.get(part) or (part.replace("[!", "[^") if part.startswith("[") and part.endswith("]") else re.escape(part))
                         for part in parts)
    return re.fullmatch(expression, name) is not None


def files(*patterns: str | os.PathLike[str]) -> list[str]:
    """Returns the names of the files of a run, absolute and in the order of their numbers.

    patterns  as in the `dump` command: '*' stands for the timestep and '%' for the rank; '?' and [..] as in a shell. Where some
              files have numbers for '*', these are found, and where none has, all that fit: "run_*.dump" finds run_100.dump,
              but not run_first.dump beside it. Plain and compressed files go together: "post/*.dump" also finds
              post/100.dump.gz and post/100.dump.zst.

    The names are what granular.reader, OpenDataFile and the property FileNames take. The boundingBox files of LIGGGHTS and kept
    indices (.granular.idx) are left out. Call it again, and set FileNames, when a running simulation has added files.
    Raises FileNotFoundError if a pattern fits no file.
    """
    found = set()
    for pattern in map(os.fspath, patterns):
        fitting = [(name, pattern + ending) for ending in ("", ".gz", ".zst")
                   for name in glob.glob(pattern.replace("%", "*") + ending)
                   if os.path.isfile(name) and "boundingBox" not in os.path.basename(name)
                   and not name.endswith(".granular.idx")]
        if not fitting:
            raise FileNotFoundError(f"no file fits the pattern: {pattern}")
        numbered = [name for name, whole in fitting if _has_numbers(os.path.basename(name), os.path.basename(whole))]
        found.update(map(os.path.abspath, numbered or [name for name, _ in fitting]))
    return sorted(found, key=_numbers_in_order)
