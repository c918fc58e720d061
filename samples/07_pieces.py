# SPDX-License-Identifier: BSD-3-Clause
"""One file per rank (% in the name of the dump): the pieces of each step become one frame."""
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data"
folder = Path(sys.argv[1]) if sys.argv[1:] else data / "pieces"
whole = Path(sys.argv[2]) if sys.argv[2:] else data / "grains.dump"

# All files in one list: 5 timesteps of 4 ranks, by the pattern of the dump command. Their names tell
# that they are pieces; other names need RepeatedSteps="Merge". If a piece is missing, its timestep
# is left out, and a warning names it.
files = [Path(file) for file in vg.files(folder / "pieces_*.%.dump")]
particles = vg.reader(files, dt=2e-5)
assert particles.RepeatedSteps == "Auto" and len(files) == 4 * len(particles.TimestepValues)

# The particles come rank by rank, so the number of particles in each file gives their ranks.
counts = {}
for file in files:
    step, process = map(int, file.stem.split("_")[1].split("."))
    counts.setdefault(step, [0] * 4)[process] = int(file.read_text().splitlines()[3])
owners = ProgrammableFilter(Input=particles, CopyArrays=1, Script=f"""
import numpy
counts = {counts}[int(inputs[0].FieldData["timestep"][0])]
output.PointData.append(numpy.repeat(numpy.arange(4), counts), "process")
""")

strip = CreateLayout()
for place in 0, 1, 2:  # halves, and the halves of these: places 3 to 6
    strip.SplitHorizontal(place, 0.5)
for place, step in zip((3, 4, 5, 6), sorted(counts)[1:]):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=step * 2e-5, CameraPosition=[0.25, -0.41, 0.21],
                      CameraFocalPoint=[0, 0, 0.063], CameraViewUp=[0, 0, 1])
    vg.show(owners, view, color="process")
    Show(OutputPort(particles, 1), view)
    title = " + ".join(map(str, counts[step]))
    Show(Text(Text=f"{view.ViewTime:g} s: {title}"), view, WindowLocation="Upper Center")
colors = GetColorTransferFunction("process")
vg.set_properties(colors, InterpretValuesAsCategories=1,
                  Annotations=[text for i in range(4) for text in (str(i), str(i))],
                  IndexedColors=[0.27, 0.45, 0.7, 0.95, 0.6, 0.2, 0.3, 0.65, 0.45, 0.75, 0.3, 0.3])
vg.set_properties(GetScalarBar(colors, view), Title="process", ComponentTitle="", Visibility=1,
                  Orientation="Horizontal", WindowLocation="Lower Center")
strip.SetSize(1200, 480)
SaveScreenshot("pieces.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# Compare with the text: the last frame equals that of the run in one file, in the order of the pieces.
names = "id", "type", "x", "y", "z", "radius"


def rows_of(path):
    header, *rows = path.read_text().split("ITEM: ATOMS ")[-1].splitlines()
    column = dict(zip(header.split(), np.array([row.split() for row in rows], float).T))
    return np.array([column[name] for name in names]).T


pieces = np.concatenate([rows_of(file) for file in files if file.match(f"*_{step}.*")])
particles.UpdatePipeline(view.ViewTime)
frame = FetchData(particles)[0]
arrays = [frame.GetPointData().GetArray(name) for name in ("id", "type", "radius")]
points = np.array(frame.GetPoints().GetData())
assert np.array_equal(np.column_stack(arrays[:2] + [points, arrays[2]]), pieces)
one_file = rows_of(whole)
assert np.array_equal(pieces[pieces[:, 0].argsort()], one_file[one_file[:, 0].argsort()])
print(f"{len(files)} files are {len(counts)} frames; see pieces.png")
