# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run by a pattern, as simulation codes spell it."""
from __future__ import annotations

import os

from . import _library as c


def files(*patterns: str | os.PathLike[str]) -> list[str]:
    """Returns the names of the files of a run, absolute and in the order of their numbers.

    patterns  as in the `dump` command: '*' stands for the timestep and '%' for the rank; '?' and [..] as in a shell. Where some
              files have numbers for '*', these are found, and where none has, all that fit: "run_*.dump" finds run_100.dump,
              but not run_first.dump beside it. Plain and compressed files go together: "post/*.dump" also finds
              post/100.dump.gz and post/100.dump.zst.

    Names of folders that are there stand for themselves: "run [3]/*.dump" finds the files in the folder "run [3]". The boundingBox files
    of LIGGGHTS are left out. Call it again, and set FileNames, when a running simulation has added files. Raises FileNotFoundError if
    a pattern fits no file, and OSError for what is not a file, or a folder that cannot be listed.
    """
    library, names = c.library(), c.c_void_p()
    if not patterns:
        return []
    given = [os.fspath(pattern) for pattern in patterns]
    library.granular_find_files(c.texts(given), len(given), c.byref(names))
    try:
        return [c.text(library.granular_name_at(names, i)) for i in range(library.granular_name_count(names))]
    finally:
        library.granular_free_names(names)
