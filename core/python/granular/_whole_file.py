# SPDX-License-Identifier: BSD-3-Clause
"""Files that appear when they are complete."""
from __future__ import annotations

import contextlib
import os
from typing import Iterator


@contextlib.contextmanager
def whole_file(path: str, ending: str = "") -> Iterator[str]:
    """Yields the name of a temporary file beside a path. It replaces the old file at the end, and is removed after an error.

    ending  of the temporary name, for programs that look at it
    """
    temporary = f"{path}.{os.getpid()}.tmp{ending}"
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
