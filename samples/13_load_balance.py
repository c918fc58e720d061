# SPDX-License-Identifier: BSD-3-Clause
"""How evenly are the particles of a parallel run distributed over its ranks, and would other grids be better?"""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data"
particles = vg.reader(data / "grains.dump")

# The run had four ranks, `processors 2 1 2`. Each subdomain is a voxel.
domains = GranularDecomposition(Input=particles, ProcessorGrid=[2, 1, 2])

strip = CreateLayout()
for place, part in ((0, 1 / 4), (2, 1 / 3), (6, 1 / 2)):
    strip.SplitHorizontal(place, part)
for place, step in zip((1, 5, 13, 14), (1000, 2000, 3000, 4000)):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = step  # each view has its own
    vg.show(particles, view)
    voxels = Show(domains, view, Representation="Surface With Edges", Opacity=0.5)
    ColorBy(voxels, ("CELLS", "nlocal"))
    Show(Text(Text=f"step {step}"), view, WindowLocation="Upper Center", FontSize=18)
    Render(view)  # the first picture moves the camera
    vg.set_properties(view, CameraPosition=[0.25, -0.39, 0.19], CameraFocalPoint=[0, 0, 0.06],
                      CameraViewUp=[0, 0, 1])
colors = GetColorTransferFunction("nlocal")
colors.ApplyPreset(vg.preset("Cool to Warm"))
colors.RescaleTransferFunction(0, 600)
vg.set_properties(GetScalarBar(colors, view), Title="particles per rank", ComponentTitle="",
                  WindowLocation="Lower Center", Orientation="Horizontal", ScalarBarLength=0.6,
                  **vg.label_format("%.0f"))
voxels.SetScalarBarVisibility(view, True)
strip.SetSize(1400, 520)
SaveScreenshot("load_balance.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")


def count(**properties):
    """Particles of each rank, and the largest number divided by the mean."""
    vg.set_properties(domains, **properties)
    domains.UpdatePipeline(4000)
    voxels = servermanager.Fetch(domains)
    nlocal = voxels.GetCellData().GetArray("nlocal")
    return (np.array([nlocal.GetValue(process) for process in range(nlocal.GetNumberOfValues())]),
            voxels.GetFieldData().GetArray("imbalance").GetValue(0))


# At the end the particles lie on the ground, and two of the four ranks have nothing to do.
own, imbalance = count()
print(f"2 x 1 x 2: {own.tolist()} particles, imbalance {imbalance:.2f}")
assert own.sum() == 1200 and imbalance > 1.9
side_by_side, better = count(ProcessorGrid=[2, 2, 1])
print(f"2 x 2 x 1: {side_by_side.tolist()} particles, imbalance {better:.2f}")
assert better < 1.1
# Or cut the box where half of the particles lie below.
points = servermanager.Fetch(particles).GetPoints()
height = np.median([points.GetPoint(i)[2] for i in range(points.GetNumberOfPoints())])
cut, balanced = count(ProcessorGrid=[2, 1, 2], ZCuts=[height])
print(f"2 x 1 x 2, cut at half of them: {cut.tolist()} particles, imbalance {balanced:.2f}")
assert balanced < 1.1

# Compare with the text: count the particles of the last frame.
frame = (data / "grains.dump").read_text().split("ITEM: ATOMS ")[-1].splitlines()
x, z = np.array([row.split() for row in frame[1:]], float)[:, [2, 4]].T
owner = 2 * (x >= 0) + (z >= 0.075)
assert np.bincount(owner.astype(int), minlength=4).tolist() == own.tolist()
