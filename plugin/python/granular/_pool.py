# SPDX-License-Identifier: BSD-3-Clause
"""The memory that readers keep for the next frame."""
from __future__ import annotations

import os

_VARIABLE = "GRANULAR_POOL_MIB"


def pool_limit() -> int | None:
    """How many MiB of memory a reader may keep for its next frame, as an int, or None for the default:
    an eighth of the machine's memory. It is what the environment variable GRANULAR_POOL_MIB says.
    Raises ValueError if that is no such number.
    """
    text = os.environ.get(_VARIABLE)
    if not text:
        return None
    mib = int(text)
    if mib < 0:
        raise ValueError(f"{_VARIABLE} must be at least 0, got {text}")
    return mib


def set_pool_limit(mib: int | None) -> None:
    """Sets how many MiB of memory a reader may keep for its next frame: 0 for none, None for the
    default. It holds for readers of this process that have not read a frame yet. With a pvserver set the
    environment variable GRANULAR_POOL_MIB where the server starts instead.

    Memory is kept because that of a frame before costs a fraction of what fresh memory does. It goes
    when two frames did not need it, and with the reader.
    Raises ValueError if mib is not a whole number of at least 0.
    """
    if mib is None:
        os.environ.pop(_VARIABLE, None)
        return
    if int(mib) != mib or mib < 0:
        raise ValueError(f"the limit must be a whole number of MiB, at least 0, got {mib}")
    os.environ[_VARIABLE] = str(int(mib))
