# SPDX-License-Identifier: BSD-3-Clause
"""README's first script, as it stands there, makes a picture of particles, a file and arrays."""
import fnmatch
import os
import re
import subprocess
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

root = Path(__file__).parents[2]
text = (root / "README.md").read_text()
script = re.search(r"## The first script\n\n```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL).group(1)
if not os.path.exists("samples"):
    os.symlink(root / "samples", "samples")
exec(script)

assert open("last.dump").read().startswith("ITEM: TIMESTEP\n4000\n") and arrays["points"].shape == (1200, 3)
png = vtkPNGReader()
png.SetFileName("grains.png")
png.Update()
pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
colored = (pixels.max(axis=1) - pixels.min(axis=1)) > 60
assert 0.02 < colored.mean() < 0.9, colored.mean()  # particles, neither a dot nor a wall of color
assert len({tuple(pixel // 32) for pixel in pixels[colored]}) > 20  # of many speeds

# and the plugin is where README says
plugin = re.search(r"`build/release/(lib\S+Granular\.so)`", text).group(1)
assert fnmatch.fnmatch(os.environ["PV_PLUGIN_PATH"], "*/" + str(Path(plugin).parents[1])), plugin

# and the file that a shell sources says so to what it starts
build = Path(os.environ["PV_PLUGIN_PATH"]).parents[2]
clean = {"PATH": os.environ["PATH"]}
seen = subprocess.run(["sh", "-c", f". '{build}/environment' && env"], env=clean, check=True,
                      capture_output=True, text=True).stdout
assert f"PV_PLUGIN_PATH={os.environ['PV_PLUGIN_PATH']}\n" in seen, seen
assert "PYTHONPATH=" in seen, seen
