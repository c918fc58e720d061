# SPDX-License-Identifier: BSD-3-Clause
"""Bonds across a periodic face, and their elongation."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "bonds"
beads = vg.reader(data / "chain.dump", dt=0.004)
# Columns in the order of the dump command. Rows without positions become lines only with the particles.
bonds = vg.reader(data / "chain_bonds.dump", dt=0.004, Preset="BondTypeIdsForce")
lines = GranularLocalJoin(Input=beads, Lines=OutputPort(bonds, 1), Averages="v", EquilibriumLength=1.05)

strip = CreateLayout()
strip.SplitVertical(0, 1 / 3)
strip.SplitVertical(2, 1 / 2)
time = 500 * 0.004
for place, periodic in ((1, "AsWritten"), (5, "MinimumImage"), (6, "Split")):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = time
    drawn = GranularLocalJoin(Input=beads, Lines=OutputPort(bonds, 1), EquilibriumLength=1.05, PeriodicLines=periodic)
    shown = Show(Tube(Input=drawn, Radius=0.22), view)
    ColorBy(shown, ("CELLS", "strain"))
    GetColorTransferFunction("strain").ApplyPreset(vg.preset("Cool to Warm"))
    GetColorTransferFunction("strain").RescaleTransferFunction(-0.1, 0.1)
    shown.SetScalarBarVisibility(view, False)
    Show(OutputPort(beads, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    Show(Text(Text=periodic), view, WindowLocation="Upper Left Corner", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraParallelProjection=1, CameraPosition=[0, -60, 12], CameraFocalPoint=[0, 0, 0],
                      CameraViewUp=[0, 0, 1], CameraParallelScale=8.5)
strip.SetSize(900, 900)
SaveScreenshot("bonds.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# The simulation wrote the length of its bonds; the lines have the same lengths in all three frames.
for step in 0, 500, 1000:
    lines.UpdatePipeline(step * 0.004)
    arrays = servermanager.Fetch(lines).GetCellData()
    length, dist, strain = (np.array(arrays.GetArray(name)) for name in ("length", "dist", "strain"))
    assert len(length) == 96 and np.allclose(length, dist, rtol=0, atol=2e-4)
    print(f"step {step}: bonds from {length.min():.3f} to {length.max():.3f} long, "
          f"strained by {strain.min():+.3f} to {strain.max():+.3f}")

# The bonds of a data file work as well, because the ids are the same.
pairs = vg.reader(data / "chain.data", AtomStyle="bond")
again = GranularLocalJoin(Input=beads, Lines=OutputPort(pairs, 1))
again.UpdatePipeline(time)
lines.UpdatePipeline(time)
same = [np.sort(np.array(servermanager.Fetch(of).GetCellData().GetArray("length"))) for of in (again, lines)]
assert np.array_equal(*same)
