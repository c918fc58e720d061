# SPDX-License-Identifier: BSD-3-Clause
"""What the rules share: the files of the tree, C++ without comments, and how a complaint looks."""
import os
import re
import sys

SKIPPED_FOLDERS = {"build", "install", "__pycache__"}
# Files of other programs, kept byte for byte.
DATA_FOLDERS = ("tests/data/", "samples/data/", "tests/fuzz/corpus/")


def files(root):
    """Paths below root, relative, with '/', sorted; without builds, hidden folders but .ci, data."""
    found = []
    for folder, names, leaves in os.walk(root):
        names[:] = [name for name in names if name not in SKIPPED_FOLDERS
                    and (not name.startswith(".") or name == ".ci")]
        for leaf in leaves:
            path = os.path.relpath(os.path.join(folder, leaf), root).replace(os.sep, "/")
            if not path.startswith(DATA_FOLDERS) and not path.endswith((".pyc", "~", ".swp")):
                found.append(path)
    return sorted(found)


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="surrogateescape",
              newline="") as stream:
        return stream.read()


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


# Comments, raw strings, strings, characters. A quote between digits is a digit separator: the first
# alternative takes whole numbers and names, so that such a quote never starts a character.
_TOKEN = re.compile(
    r"""(?P<raw>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)")"""
    r"""|(?P<word>[A-Za-z_]\w*|\.?[0-9](?:'?[\w.])*)"""
    r"""|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)"""
    r"""|(?P<string>"(?:\\.|[^"\\\n])*")"""
    r"""|(?P<character>'(?:\\.|[^'\\\n])*')""", re.DOTALL)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def strip(code, strings=True):
    """C++ with its comments, and the inside of its strings if asked for, turned into blanks: every
    character that is left stands where it stood."""
    def replace(match):
        if match.group("comment") is not None:
            return _blank(match.group())
        if match.group("word") is not None or not strings:
            return match.group()
        text = match.group()
        first = text.index('"') if '"' in text and match.group("character") is None else 0
        return text[:first + 1] + _blank(text[first + 1:-1]) + text[-1]
    return _TOKEN.sub(replace, code)


def string_literals(code):
    """(offset, inside) of the ordinary string literals of C++ code without comments."""
    return [(match.start(), match.group()[1:-1]) for match in _TOKEN.finditer(code)
            if match.group("string") is not None]


def closing(code, offset):
    """Offset of the bracket that closes the one at offset, in stripped code; len(code) if none."""
    depth = 0
    for match in re.compile(r"[][(){}]").finditer(code, offset):
        depth += 1 if match.group() in "([{" else -1
        if depth == 0:
            return match.start()
    return len(code)


def run(check):
    """main() of a rule: check(root) gives (path, line, text) in any order."""
    if len(sys.argv) != 2:
        sys.exit("usage: " + os.path.basename(sys.argv[0]) + " top-of-the-source-tree")
    complaints = sorted(set(check(sys.argv[1])))
    for path, line, text in complaints:
        print(f"{path}:{line}: {text}")
    sys.exit(1 if complaints else 0)
