# SPDX-License-Identifier: BSD-3-Clause
"""The memory that readers keep for the next frame."""
from __future__ import annotations

import os

_VARIABLE = "GRANULAR_POOL_MIB"


def pool_limit() -> int | None:
    """Returns the MiB of memory that a reader may keep for its next frame, or None for the default.

    The environment variable GRANULAR_POOL_MIB holds it. Raises ValueError if it holds no whole number of at least 0.
    """
    text = os.environ.get(_VARIABLE)
    if not text:
        return None
    mib = int(text)
    if mib < 0:
        raise ValueError(f"{_VARIABLE} must be at least 0, got {text}")
    return mib


def set_pool_limit(mib: int | None) -> None:
    """Sets the MiB of memory that a reader may keep for its next frame.

    mib  a whole number of at least 0, else ValueError. None: the default, an eighth of the machine's memory.

    It holds for readers of this process that have not read a frame yet; for a pvserver, the environment variable GRANULAR_POOL_MIB where
    the server starts. Fresh memory is slow; what two frames did not need is given back, and all with the reader.
    """
    if mib is None:
        os.environ.pop(_VARIABLE, None)
        return
    if int(mib) != mib or mib < 0:
        raise ValueError(f"the limit must be a whole number of MiB, at least 0, got {mib}")
    os.environ[_VARIABLE] = str(int(mib))
