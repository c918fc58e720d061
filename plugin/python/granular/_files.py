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


def files(*patterns: str | os.PathLike[str]) -> list[str]:
    """Returns the names of the files of a run, absolute and in the order of their numbers.

    patterns  as in the `dump` command: '*' stands for the timestep and '%' for the rank; '?' and [..] as in a shell. Plain and
              compressed files go together: "post/*.dump" also finds post/a.dump.gz and post/a.dump.zst.

    The names are what granular.reader, OpenDataFile and the property FileNames take. The boundingBox files of LIGGGHTS and kept
    indices (.granular.idx) are left out. Call it again, and set FileNames, when a running simulation has added files.
    Raises FileNotFoundError if a pattern fits no file.
    """
    found = set()
    for pattern in patterns:
        pattern = os.fspath(pattern).replace("%", "*")
        names = [name for ending in ("", ".gz", ".zst") for name in glob.glob(pattern + ending)
                 if os.path.isfile(name) and "boundingBox" not in os.path.basename(name)
                 and not name.endswith(".granular.idx")]
        if not names:
            raise FileNotFoundError(f"no file fits the pattern: {pattern}")
        found.update(os.path.abspath(name) for name in names)
    return sorted(found, key=_numbers_in_order)
