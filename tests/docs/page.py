# SPDX-License-Identifier: BSD-3-Clause
"""Runs the script of a page in a folder where `samples` lies, as a reader would: its python blocks in their order, as one script, and
then its blocks for the shell that begin with the command `granular`.

What stands in a block without a language must be printed, and each picture that the page shows from its folder `pictures` must
be made: by the page, or by the sample of its name. Without VTK, `granular show` must say so, and there are no pictures.
"""
import contextlib
import importlib.util
import io
import os
import re
import runpy
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

HAS_VTK = importlib.util.find_spec("vtkmodules") is not None


def blocks(text, language):
    """(line, content) of the fenced blocks of a language."""
    for match in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        if match.group(1) == language:
            yield text.count("\n", 0, match.start(2)), match.group(2)


def colours(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

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
commands = [block for _, block in blocks(text, "sh") if block.startswith("granular ")]
assert script or commands, f"{page} has no script"
missing = [name for name in ("matplotlib", "scipy") if f"from {name}" in script and not importlib.util.find_spec(name)]
missing += ["voro++"] if '"voro++"' in script and not shutil.which("voro++") else []
if missing:
    print(f"skipped: {', '.join(missing)} is not installed")
    raise SystemExit
warnings.filterwarnings("ignore", module=".*(matplotlib|pyparsing)")  # others' code
if not os.path.exists("samples"):
    os.symlink(root / "samples", "samples")

if "GRANULAR_COMMAND" in os.environ:
    os.environ["PATH"] = os.path.dirname(os.environ["GRANULAR_COMMAND"]) + ":" + os.environ["PATH"]
printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    if script:
        Path("script.py").write_text(script)
        runpy.run_path("script.py", run_name="__main__")
for block in commands:
    python = f'"{sys.executable}"' if os.path.exists(sys.executable) else ""  # pvpython names one that may not be there
    shell = f'granular() {{ {python} "$GRANULAR_COMMAND" "$@"; }}\n{block}'
    done = subprocess.run(["bash", "-e", "-c", shell], capture_output=True, text=True)
    can_run = HAS_VTK or "granular show" not in block
    assert done.returncode == 0 if can_run else "expected VTK or ParaView" in done.stderr, (block, done.stdout, done.stderr)
    printed.write(done.stdout)
for line, expected in blocks(text, ""):
    assert expected.strip("\n") in printed.getvalue(), f"{page}:{line}: expected {expected!r}, got {printed.getvalue()!r}"
for name in re.findall(r"!\[[^]]*\]\(pictures/([^)]*\.png)\)", text) if HAS_VTK else ():
    if (root / "samples" / name).with_suffix(".py").exists():
        continue
    assert os.path.exists(name), f"{page} shows {name} and does not make it"
    assert colours(name) > 3, f"{name} is empty"
print(printed.getvalue())
