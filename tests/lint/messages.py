# SPDX-License-Identifier: BSD-3-Clause
"""The text of an error of the core starts in lower case and ends without a full stop: the place goes
in front of it and more may follow. Keywords of a file format keep their spelling (ITEM: ATOMS)."""
import re

import tree

# What makes an error or a notice: in the core, `throw SomethingError(...)` and functions so named.
_THROW = re.compile(r"\bthrow\s+(?:granular::)?\w*Error\s*([({])")


def first_argument(code, first, last):
    """Offset behind the first argument of the argument list (first, last)."""
    offset = first
    while offset < last:
        if code[offset] in "([{":
            offset = tree.closing(code, offset)
        elif code[offset] == ",":
            return offset
        offset += 1
    return last


def complaints_of(text):
    """(offset, what) for every error text of one source."""
    code = tree.strip(text)
    plain = tree.strip(text, strings=False)
    for match in _THROW.finditer(code):
        first = match.end()
        last = first_argument(code, first, tree.closing(code, match.start(1)))
        argument = plain[first:last]
        literals = [(first + offset, inside) for offset, inside in tree.string_literals(argument)
                    if inside.strip()]
        if not literals:
            continue
        offset, inside = literals[0]
        starts = not code[first:offset].replace("std::string(", "").strip(" \n\t(")
        word = re.match(r"[A-Za-z]+", inside)
        if starts and word and word.group()[0].isupper() and not (
                word.group().isupper() and len(word.group()) > 1):
            yield offset, f'error text starts in upper case: "{inside}"'
        offset, inside = literals[-1]
        ends = argument.rstrip().rstrip(")").rstrip().endswith(inside + '"')
        if ends and inside.rstrip().endswith(".") and not inside.rstrip().endswith(".."):
            yield offset, f'error text ends with a full stop: "{inside}"'


def check(root):
    for path in tree.files(root):
        if re.match(r"core/.*\.(h|cpp|inc)$", path):
            text = tree.read(root, path)
            for offset, what in complaints_of(text):
                yield path, tree.line_of(text, offset), what


if __name__ == "__main__":
    tree.run(check)
