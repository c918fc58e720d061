# SPDX-License-Identifier: BSD-3-Clause
"""Watch a run while the simulation writes it: each look finds the frames that are complete."""
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

# LAMMPS pours particles into a box and pauses after each frame, as if there were more to compute.
# If it is not installed, a script copies grains.dump in bursts that end inside lines and words.
POUR = """
units si
atom_style sphere
boundary p p f
newton off
comm_modify vel yes
neighbor 0.002 bin
timestep 4e-5
region box block -0.05 0.05 -0.05 0.05 0 0.15
create_box 1 box
pair_style gran/hooke/history 2000 NULL 2000 NULL 0.5 1
pair_coeff * *
fix move all nve/sphere
fix down all gravity 9.81 vector 0 0 -1
fix floor all wall/gran hooke/history 2000 NULL 2000 NULL 0.5 1 zplane 0 NULL
region top cylinder z 0 0 0.03 0.12 0.15
fix pour all pour 2000 1 4711 region top diam range 0.005 0.007 dens 2500 2500 vol 0.4 50 vel &
    -0.1 0.1 -0.1 0.1 -1
dump run all custom 400 run.dump id type x y z vx vy vz radius
run 10000 every 400 "shell sleep 0.1"
"""
COPY = """
import sys, time
text = open(sys.argv[1]).read()
with open("run.dump", "w") as run:
    for at in range(0, len(text), 10007):
        run.write(text[at:at + 10007])
        run.flush()
        time.sleep(0.05)
"""
lmp = shutil.which("lmp")
if lmp and " pour " in subprocess.run([lmp, "-h"], capture_output=True, text=True).stdout:
    Path("in.pour").write_text(POUR)
    command = [lmp, "-in", "in.pour", "-log", "log.pour", "-screen", "none"]
else:
    command = ["python3", "-c", COPY, str(Path(__file__).parent / "data/grains.dump")]

view = GetActiveViewOrCreate("RenderView")
Render(view)  # the first picture takes longest, and moves the camera
camera = dict(CameraPosition=[0.25, -0.41, 0.21], CameraFocalPoint=[0, 0, 0.063],
              CameraViewUp=[0, 0, 1])
vg.set_properties(view, ViewSize=[360, 480], OrientationAxesVisibility=0, **camera)


def ready(path):
    """True if there is something to open: the first frame is complete once the second begins."""
    return path.exists() and path.read_text().count("ITEM: TIMESTEP") > 1


run = Path("run.dump")
run.unlink(missing_ok=True)
give_up = time.monotonic() + 60
writer = subprocess.Popen(command)
try:
    while not ready(run) and writer.poll() is None and time.monotonic() < give_up:
        time.sleep(0.02)
    assert ready(run), f"{command[0]} has written no frame"
    reader = vg.reader(run, RefreshOnUpdate=1)  # every update looks at the file again
    vg.show(reader, view, color="v")
    Show(OutputPort(reader, 1), view)
    colors = GetColorTransferFunction("v")
    colors.ApplyPreset(vg.preset("Plasma"))
    colors.RescaleTransferFunction(0, 1.5)

    seen, looks, running = {}, 0, True
    while running:
        assert time.monotonic() < give_up, "the run does not end"
        running = writer.poll() is None  # asked first, so that the last look is after the end
        looks += 1
        GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
        GetAnimationScene().GoToLast()
        SaveScreenshot("newest.png", view, OverrideColorPalette="WhiteBackground")
        frame, frames = FetchData(reader)[0], len(reader.TimestepValues)
        step = frame.GetFieldData().GetArray("timestep").GetValue(0)
        points = np.array(frame.GetPoints().GetData()).reshape(-1, 3)
        if step not in seen:
            print(f"look {looks:2}: frame {frames:2} is the newest, with {len(points):4} particles")
            seen[step] = looks, frames, points
        time.sleep(0.3)
finally:
    writer.kill()
    writer.wait()

# Four of the looks.
strip = CreateLayout()
for place in 0, 1, 2:  # halves, and the halves of these: places 3 to 6
    strip.SplitHorizontal(place, 0.5)
for i, place in enumerate((3, 4, 5, 6)):
    step = sorted(seen)[(len(seen) - 1) * i // 3]
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=step, **camera)
    vg.show(reader, view, color="v")
    Show(OutputPort(reader, 1), view)
    Show(Text(Text="look {}: frame {}".format(*seen[step])), view, WindowLocation="Upper Center")
colors.RescaleTransferFunction(0, 1.5)
vg.set_properties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="", Visibility=1,
                  Orientation="Horizontal", WindowLocation="Lower Center", **vg.label_format("%.1f"))
strip.SetSize(1200, 480)
SaveScreenshot("looks.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# Compare with the text: no frame is missing, and every frame seen on the way was complete.
written = {}
for frame in run.read_text().split("ITEM: TIMESTEP\n")[1:]:
    header, *rows = frame.split("ITEM: ATOMS ")[1].splitlines()
    table = np.array([row.split() for row in rows], float).reshape(-1, len(header.split()))
    written[int(frame.split()[0])] = table[:, [header.split().index(x) for x in "xyz"]]
assert list(reader.TimestepValues) == list(written) and writer.returncode == 0
assert all(np.array_equal(points, written[step]) for step, (*_, points) in seen.items())
print(f"all {len(written)} frames were found; see looks.png")
