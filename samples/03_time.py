# SPDX-License-Identifier: BSD-3-Clause
"""One clock for all: timesteps become seconds, and a mesh in files without times follows."""
import re
import sys
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")
dt = 2e-5  # seconds a step, from the input script

# A dump counts timesteps. TimestepSize turns these into seconds.
particles = vg.reader(path)
steps = [int(step) for step in particles.TimestepValues]
particles.TimestepSize = dt
particles.UpdatePipelineInformation()
times = list(particles.TimestepValues)
assert times == [step * 2 / 100000 for step in steps]  # the nearest doubles: 3000 x 2e-5 is 0.06
print("steps", *steps, "are at", *(f"{time:g}" for time in times), "s")

# Between two frames the earlier one is shown; nothing is interpolated.
particles.UpdatePipeline(0.5 * (times[-2] + times[-1]))
assert particles.FieldData["timestep"].GetRange() == (steps[-2], steps[-2])

# A file with ITEM: TIME has its own clock, here 1.0, 1.1, ... (but ITEM: LABEL is never a time).
text = re.sub(r"ITEM: TIMESTEP\n(\d+)", r"ITEM: TIME\n1.\1\n\g<0>", Path(path).read_text())
Path("with_time.dump").write_text(text)
own = vg.reader("with_time.dump", dt=dt)
assert list(own.TimestepValues) == [float(f"1.{step}") for step in steps]

# STL files hold no time. A .series file gives them one: step x dt. Here: a lid on the particles.
for step, time in zip(steps[-4:], times[-4:]):
    particles.UpdatePipeline(time)
    z = particles.GetDataInformation().GetBounds()[5] + particles.PointData["radius"].GetRange()[1]
    SaveData(f"lid_{step}.stl", Box(XLength=0.1, YLength=0.1, ZLength=0, Center=[0, 0, z]))
lid = OpenDataFile(vg.write_series([f"lid_{step}.stl" for step in steps[-4:]], dt))
assert list(lid.TimestepValues) == times[-4:]
print("lid.stl.series puts the lid on the same clock; see strip.png")

strip = CreateLayout()
for place in 0, 1, 2:  # halves, and the halves of these: places 3 to 6
    strip.SplitHorizontal(place, 0.5)
for place, time in zip((3, 4, 5, 6), times[-4:]):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=time, CameraPosition=[0.25, -0.41, 0.21],
                      CameraFocalPoint=[0, 0, 0.063], CameraViewUp=[0, 0, 1])
    vg.show(particles, view, color="v")
    Show(lid, view, Opacity=0.5)
    Show(OutputPort(particles, 1), view)
    Show(AnnotateTimeFilter(particles, Format="{time:.2f} s"), view, WindowLocation="Upper Center")
colors = GetColorTransferFunction("v")
colors.RescaleTransferFunction(0, 1.5)
colors.ApplyPreset(vg.preset("Plasma"))
vg.set_properties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="", Visibility=1,
                  Orientation="Horizontal", WindowLocation="Lower Center", **vg.label_format("%.1f"))
strip.SetSize(1200, 480)
SaveScreenshot("strip.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")
