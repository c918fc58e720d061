# SPDX-License-Identifier: BSD-3-Clause
"""VTK's XML files without appended data."""
from __future__ import annotations

import base64
import mmap
import os
import re
from typing import IO

# A name with '>' matches none of these: VTK finds no inline data behind it, and its file stays as it is.
_ARRAY = re.compile(rb'<((?:Data)?Array) ([^>]*?)format="appended"([^>]*?) *offset="(\d+)" *(/?)>')
_PART = 3 << 20  # bytes that become base64 at a time: a multiple of 3


def put_inline(path: str, declaration: bytes = b"") -> None:
    """Moves the raw appended data of a VTK file into its arrays, as base64, behind a declaration of XML. Other files stay as they are.

    Appended data are no XML: some versions of libexpat refuse them, raw and base64 alike. VTK writes inline data itself, but ends the
    program when a disk is full then.
    """
    with open(path, "rb") as stream:
        if not os.path.getsize(path):
            return
        with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as old:
            end = old.find(b'<AppendedData encoding="raw"')
            head = old[:max(end, 0)]
            arrays = list(_ARRAY.finditer(head))
            if not arrays or head.count(b'format="appended"') != len(arrays):
                return
            with open(path + ".inline", "wb") as new:
                new.write(declaration)
                _write(old, head, old.find(b"_", end) + 1, arrays, new)
    os.replace(path + ".inline", path)


def _write(old: mmap.mmap, head: bytes, data: int, arrays: list[re.Match[bytes]], new: IO[bytes]) -> None:
    """Writes the head with the data of each array in its place."""
    order = "big" if b'byte_order="BigEndian"' in head else "little"
    width = 8 if b'header_type="UInt64"' in head else 4
    is_compressed = b' compressor="' in head

    def encode(first: int, last: int) -> None:
        for at in range(first, last, _PART):
            new.write(base64.b64encode(old[at:min(at + _PART, last)]))

    def number(at: int) -> int:
        return int.from_bytes(old[at:at + width], order)  # type: ignore[arg-type]

    done = 0
    for array in arrays:
        kind, before, behind, offset, is_empty = array.groups()
        new.write(head[done:array.start()] + b"<" + kind + b" " + before + b'format="binary"' + behind + b">\n")
        at = data + int(offset)
        if is_compressed:  # a header of its own: blocks, their sizes, and the bytes of each
            blocks = number(at)
            first = at + (3 + blocks) * width
            encode(at, first)
            encode(first, first + sum(number(at + (3 + block) * width) for block in range(blocks)))
        else:
            encode(at, at + width + number(at))
        new.write(b"\n" + (b"</" + kind + b">" if is_empty else b""))
        done = array.end()
    new.write(head[done:].rstrip() + b"\n</VTKFile>\n")
