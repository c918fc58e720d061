# SPDX-License-Identifier: BSD-3-Clause
"""A bonded block falls and breaks: which bonds broke, where they were, and how large the fragments are."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "time"
beads = vg.reader(data / "block.dump.gz", dt=0.002)
# Rows without positions become lines with the particles.
local = vg.reader(data / "block_bonds.dump.gz", dt=0.002, Preset="BondTypeIds")
bonds = GranularLocalJoin(Input=beads, Lines=OutputPort(local, 1))

# The first output has the particles with their fragments, the second the bonds of both frames: `change` is 2 for those that
# are no longer there, and they are where they were.
since_start = GranularCompare(Input=beads, Lines=bonds, Reference="First")
since_last = GranularCompare(Input=beads, Lines=bonds, Reference="Previous")
broken = Threshold(Input=OutputPort(since_last, 1), Scalars=["CELLS", "change"], LowerThreshold=2, UpperThreshold=2)
cracks = Tube(Input=ExtractSurface(Input=broken), Radius=0.15)

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 2)
times = beads.TimestepValues
for place, moment in ((1, times[4]), (2, times[9])):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = moment  # each view has its own
    shown = Show(since_start, view, GaussianRadius=0.5, ShaderPreset="Sphere")
    shown.SetRepresentationType("Point Gaussian")
    ColorBy(shown, ("POINTS", "fragment_size"))
    if moment == times[4]:
        shown.Opacity = 0.15
        Show(cracks, view, AmbientColor=[0.8, 0, 0], DiffuseColor=[0.8, 0, 0])
    Show(Text(Text="bonds that have just broken" if moment == times[4] else "fragments"), view, WindowLocation="Upper Center", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraPosition=[18, -53, 17], CameraFocalPoint=[1.5, 0, 9], CameraViewUp=[0, 0, 1])
colors = GetColorTransferFunction("fragment_size")
colors.ApplyPreset(vg.preset("Viridis"), True)
colors.RescaleTransferFunction(1, 742)
colors.MapControlPointsToLogSpace()
colors.UseLogScale = 1
vg.set_properties(GetScalarBar(colors, view), Title="particles of the fragment", ComponentTitle="", Orientation="Horizontal",
                  WindowLocation="Lower Center", ScalarBarLength=0.5, **vg.label_format("%.0f"))
shown.SetScalarBarVisibility(view, True)
strip.SetSize(1200, 600)
SaveScreenshot("breaking_block.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

for moment in times[::3]:
    arrays = vg.fetch(since_start, time=moment)
    change = vg.fetch(since_start, port=1, time=moment)["change"]
    numbers, sizes = np.unique(arrays["fragment"], return_counts=True)
    assert (sizes == arrays["fragment_size"][np.searchsorted(arrays["id"], numbers)]).all()  # the number is the smallest id
    print(f"time {moment:.1f}: {np.count_nonzero(change == 2)} of {len(change)} bonds are broken; {len(sizes)} fragments, "
          f"the largest of {sizes.max()} particles")
assert len(sizes) > 10 and sizes.sum() == 742
