# SPDX-License-Identifier: BSD-3-Clause
"""Grains that fall into a box, some of them with tails: paths of the last hundredths of a second, and all the way of a few."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "time"
particles = vg.reader(data / "falling.dump.gz", dt=2e-5)

# 40 particles at random: the last eight frames before the time of the view, at any time.
tails = GranularTrajectories(Input=particles, NumberOfSamples=40, Tail=8)
# Three particles from the first frame to the last. The box is periodic in x and y, and paths go on outside.
whole = GranularTrajectories(Input=particles, Ids="17 100 200")

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 3)
strip.SplitHorizontal(2, 1 / 2)
moments = (0.06, 0.1, particles.TimestepValues[-1])
for place, moment in zip((1, 5, 6), moments):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = moment  # each view has its own
    last = moment == moments[-1]
    vg.show(particles, view).Opacity = 0.05 if last else 0.2
    shown = Show(Tube(Input=whole if last else tails, Radius=0.0006), view)
    ColorBy(shown, ("POINTS", "speed"))
    colors = GetColorTransferFunction("speed")
    colors.ApplyPreset(vg.preset("Cool to Warm"))
    colors.RescaleTransferFunction(0, 1.5)
    vg.set_properties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="", HorizontalTitle=1, ScalarBarLength=0.3,
                      WindowLocation="Lower Right Corner", **vg.label_format("%.1f"))
    shown.SetScalarBarVisibility(view, last)
    Show(OutputPort(particles, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    text = "all the way of three grains" if last else f"{moment:.2f} s"
    Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraPosition=[0.16, -0.32, 0.16], CameraFocalPoint=[0, 0, 0.072], CameraViewUp=[0, 0, 1])
strip.SetSize(1200, 600)
SaveScreenshot("tails.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# A tail is the end of the whole path: nine places, eight steps.
paths = servermanager.Fetch(whole)
assert paths.GetNumberOfCells() == 3 and paths.GetNumberOfPoints() == 3 * len(particles.TimestepValues)
tails.UpdatePipeline(moments[1])
drawn = servermanager.Fetch(tails)
times = np.array(drawn.GetPointData().GetArray("time"))
assert drawn.GetNumberOfCells() == 40 and drawn.GetNumberOfPoints() == 40 * 9 and np.isclose(times.max(), moments[1])
length = np.array(paths.GetCellData().GetArray("length"))
print("three grains went", ", ".join(f"{1000 * way:.0f}" for way in length), "mm")
