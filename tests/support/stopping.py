# SPDX-License-Identifier: BSD-3-Clause
"""Algorithms that are cancelled in the middle of their work."""
import contextlib


@contextlib.contextmanager
def stopped(algorithm, report):
    """Cancels the algorithm at so many reports of its progress from now on; 0: never."""
    left = [report]

    def count(*_):
        left[0] -= 1
        if left[0] == 0:
            algorithm.SetAbortExecute(1)

    mark = algorithm.AddObserver("ProgressEvent", count)
    yield
    algorithm.RemoveObserver(mark)
