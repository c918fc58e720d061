# SPDX-License-Identifier: BSD-3-Clause
"""A bar on a terminal: how much is done, how fast, and how long it takes."""
from __future__ import annotations

import sys
import time
from typing import Any


class Bar:
    """Shows progress on stderr if that is a terminal, ten times a second at most.

        with Bar(run) as bar:
            for i, frame in enumerate(frames):
                frame.read(bar.within(i, len(frames)))
    """

    def __init__(self, run: Any, quiet: bool = False):
        self._size = sum(size for _, size, *_ in run._file_facts())  # in bytes
        self._shown = not quiet and sys.stderr.isatty()
        self._start = time.monotonic()
        self._last = 0.0
        self._width = 0

    def within(self, number: int, total: int) -> Any:
        """Returns a function for the progress of one of several parts of equal size."""
        return lambda fraction: self.show((number + fraction) / max(1, total))

    def show(self, fraction: float) -> None:
        """Shows that a fraction from 0 to 1 is done."""
        now = time.monotonic()
        if not self._shown or (now - self._last < 0.1 and fraction < 1):
            return
        self._last = now
        passed = now - self._start
        left = passed * (1 - fraction) / fraction if fraction > 0 else 0
        done = int(30 * fraction)
        rate = self._size * fraction / passed / 1e6 if passed > 0 else 0
        line = f"[{'#' * done}{'.' * (30 - done)}] {100 * fraction:3.0f} %  {rate:.0f} MB/s  {left:.0f} s left"
        sys.stderr.write("\r" + line.ljust(self._width))
        sys.stderr.flush()
        self._width = len(line)

    def __enter__(self) -> Bar:
        return self

    def __exit__(self, *_: Any) -> None:
        if self._width:
            sys.stderr.write("\r" + " " * self._width + "\r")
            sys.stderr.flush()
