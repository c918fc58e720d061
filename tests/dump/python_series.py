# SPDX-License-Identifier: BSD-3-Clause
"""write_series: geometry of a run on the clock of its dumps."""
import json
import os
import stat
import warnings
from fractions import Fraction

import vtkgranular as vg


def fails(kind, text, *args, **options):
    try:
        vg.write_series(*args, **options)
    except kind as error:
        assert text in str(error), (text, str(error))
    else:
        raise AssertionError(f"no {kind.__name__}: {text}")


os.makedirs("post", exist_ok=True)
solid = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 {0}\nvertex 1 0 {0}\nvertex 0 1 {0}\n" \
    "endloop\nendfacet\nendsolid a\n"
files = []
for step in (2000, 0, 10000, 1000):
    files.append(f"post/mesh2_{step}.stl")
    with open(files[-1], "w") as file:
        file.write(solid.format(step / 1000))

path = vg.write_series(files, 2e-5)
assert path == "post/mesh2.stl.series", path
with open(path) as file:
    series = json.load(file)
assert series == {"file-series-version": "1.0", "files": [
    {"name": f"mesh2_{step}.stl", "time": float(step * Fraction("2e-5"))} for step in (0, 1000, 2000, 10000)]}, series
umask = os.umask(0)
os.umask(umask)
assert stat.S_IMODE(os.stat(path).st_mode) == 0o666 & ~umask

# names are relative to the series file, wherever that is
other = vg.write_series(files, 1, "run.stl.series")
with open(other) as file:
    assert json.load(file)["files"][1] == {"name": "post/mesh2_1000.stl", "time": 1000}
assert not [name for name in os.listdir(".") + os.listdir("post") if name.endswith(".tmp")]

# the clock of the readers: 3 x 1e-5 is 3e-05; steps that share a double are told apart, with a warning
def times(steps, dt):
    names = [f"post/clock_{step}.stl" for step in steps]
    for name in names:
        with open(name, "w") as file:
            file.write("")
    with open(vg.write_series(names, dt)) as file:
        return [entry["time"] for entry in json.load(file)["files"]]


assert times(range(101), 1e-5) == [float(Fraction(step, 100000)) for step in range(101)]
with warnings.catch_warnings(record=True) as messages:
    warnings.simplefilter("always")
    assert times((2**53, 2**53 + 1, 2**53 + 2), 1) == [2.0**53, 2.0**53 + 2, 2.0**53 + 4]
assert len(messages) == 1 and "2 of 3 steps" in str(messages[0].message), messages
assert messages[0].filename == __file__, messages[0].filename
fails(ValueError, "dt must give finite times, got 1e+306 for step 1000", files, 1e306)

# names without a suffix
for name in ("wall.0", "wall.50"):
    with open(name, "w") as file:
        file.write("")
assert vg.write_series(["wall.50", "wall.0"], 1) == "wall.series"

fails(ValueError, "no files", [], 1)
fails(ValueError, "no step number in the file name: post/mesh.stl", ["post/mesh.stl"], 1)
fails(ValueError, "step 1000 occurs twice", files + ["other/mesh_1000.stl"], 1)
fails(ValueError, "dt must be finite and greater than 0, got 0", files, 0)
fails(ValueError, "dt must be finite and greater than 0, got nan", files, float("nan"))
fails(ValueError, "must end in '.series'", files, 1, "run.json")
fails(FileNotFoundError, "post/mesh2_5.stl: no such file or folder", ["post/mesh2_5.stl"], 1)
fails(OSError, "", files, 1, "no/such/folder/run.stl.series")
with open(path) as file:
    assert json.load(file) == series  # what failed left it alone

try:
    from paraview.simple import OpenDataFile
except ImportError:
    pass
else:
    stl = OpenDataFile(os.path.abspath(path))
    assert list(stl.TimestepValues) == [0, 0.02, 0.04, 0.2], stl.TimestepValues
    stl.UpdatePipeline(0.04)
    assert stl.GetDataInformation().GetBounds()[4] == 2
