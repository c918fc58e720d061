# SPDX-License-Identifier: BSD-3-Clause
"""The table of kinds of files and options of readers against the core, and against what cmake/reader_options.py has made of it."""
import os
import sys

import tree

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cmake"))
from reader_options import TABLE, load, made  # noqa: E402


def check_core(root):
    """The kinds of the core have the numbers of the table."""
    for kind in load(root)["kind"]:
        path = f"core/granular/runs/{kind['c'].lower()}_kind.cpp"
        if f".number = {kind['number']}," not in tree.read(root, path):
            yield path, 1, f"expected .number = {kind['number']}, as {TABLE} has it"


def check(root):
    yield from check_core(root)
    for path, text in made(root).items():
        there = tree.read(root, path)
        if there != text:
            lines = zip(there.splitlines() + [""], text.splitlines() + [""])
            line = next((i for i, (a, b) in enumerate(lines, 1) if a != b), 1)
            yield path, line, f"is not what {TABLE} says: python3 cmake/reader_options.py . write"


if __name__ == "__main__":
    tree.run(check)
