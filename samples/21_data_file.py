# SPDX-License-Identifier: BSD-3-Clause
"""The start of a simulation: the particles, bonds and box of a data file."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "bonds"
# This file lacks the comment `Atoms # bond`, which would give the style.
chains = vg.reader(data / "chain.data", AtomStyle="bond")
bonds = OutputPort(chains, 1)

view = CreateRenderView(OrientationAxesVisibility=0, ViewSize=[1000, 500])
beads = Show(chains, view, Representation="Grains", GrainScale=0.3, GrainRadiusArray="")
ColorBy(beads, ("POINTS", "mol"))
shown = Show(Tube(Input=bonds, Radius=0.12), view)
ColorBy(shown, ("CELLS", "btype"))
for name in ("mol", "btype"):
    GetColorTransferFunction(name).ApplyPreset(vg.preset("Cool to Warm"))
Show(OutputPort(chains, 2), view, AmbientColor=[0.4] * 3, DiffuseColor=[0.4] * 3)
Render(view)
vg.set_properties(view, CameraParallelProjection=1, CameraPosition=[0, -60, 12], CameraFocalPoint=[0, 0, 0],
                  CameraViewUp=[0, 0, 1], CameraParallelScale=9)
SaveScreenshot("data_file.png", view, OverrideColorPalette="WhiteBackground")

particles, lines = (servermanager.Fetch(chains, idx=port) for port in (0, 1))
lengths = np.array(lines.GetCellData().GetArray("length"))
assert particles.GetNumberOfPoints() == 100 and lines.GetNumberOfCells() == 96
# The image counts tell that chains cross the box along x: no bond is drawn through the whole box.
assert (lengths == 1).all()
print(f"{particles.GetNumberOfPoints()} beads, {len(lengths)} bonds of length {lengths.min()} to {lengths.max()}")
# The rest of the pipeline works with particles from any source.
chains.Stride = 5
chains.UpdatePipeline()
assert chains.GetDataInformation().GetNumberOfPoints() == 20
