# SPDX-License-Identifier: BSD-3-Clause
"""Runs the script of a page: its python blocks in their order, in a folder where `samples` lies, as a reader would.

What stands in a block without a language after them must be printed, and each picture that the page shows from its folder
`pictures` must be made.
"""
import contextlib
import io
import os
import re
import sys
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def blocks(text, language):
    """(line, content) of the fenced blocks of a language."""
    for match in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        if match.group(1) == language:
            yield text.count("\n", 0, match.start(2)), match.group(2)


def colours(path):
    png = vtkPNGReader()
    png.SetFileName(path)
    png.Update()
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    return len({tuple(pixel // 32) for pixel in pixels})


page = Path(sys.argv[1]).resolve()
root = Path(__file__).resolve().parents[2]
text = page.read_text()
script = ""
for line, block in blocks(text, "python"):
    script += "\n" * (line - script.count("\n")) + block  # lines have the numbers of the page
assert script, f"{page} has no script"
if not os.path.exists("samples"):
    os.symlink(root / "samples", "samples")

printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    exec(compile(script, page, "exec"), {"__name__": "__main__"})
for line, expected in blocks(text, ""):
    assert expected in printed.getvalue(), f"{page}:{line}: expected {expected!r}, got {printed.getvalue()!r}"
for name in re.findall(r"!\[[^]]*\]\(pictures/([^)]*\.png)\)", text):
    assert os.path.exists(name), f"{page} shows {name} and does not make it"
    assert colours(name) > 3, f"{name} is empty"
print(printed.getvalue())
