# SPDX-License-Identifier: BSD-3-Clause
"""Open a dump, go to its last frame, and see the particles as spheres of their own size."""
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")

reader = vg.reader(path, dt=2e-5)  # seconds, the timestep of the input script

view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [760, 680]
view.OrientationAxesVisibility = 0
GetAnimationScene().GoToLast()

# The first output holds the particles. Their colour is the length of the velocity v.
particles = vg.show(reader, view, color="v")
colors = GetColorTransferFunction("v")
colors.ApplyPreset(vg.preset("Plasma"))
colors.RescaleTransferFunction(0, 1.5)
legend = GetScalarBar(colors, view)
vg.set_properties(legend, Title="speed [m/s]", ComponentTitle="", HorizontalTitle=1,
                  WindowLocation="Any Location", Position=[0.84, 0.35], ScalarBarLength=0.4,
                  UseCustomLabels=1, CustomLabels=[0.5, 1.0], **vg.label_format("%.1f"))
particles.SetScalarBarVisibility(view, True)

# The second output: the box of the simulation.
gray = [0.3, 0.3, 0.3]
Show(OutputPort(reader, 1), view, AmbientColor=gray, DiffuseColor=gray, LineWidth=2)

Show(AnnotateTimeFilter(reader, Format="t = {time:.2f} s"), view,
     WindowLocation="Any Location", Position=[0.82, 0.85], FontSize=20)

vg.set_properties(view, CameraPosition=[0.22, -0.30, 0.19], CameraFocalPoint=[0.02, 0.01, 0.069],
                  CameraViewUp=[0, 0, 1])
SaveScreenshot("grains.png", view, CompressionLevel="9", OverrideColorPalette="WhiteBackground")

# Compare with the text of the last frame, without ParaView.
header, *rows = Path(path).read_text().split("ITEM: ATOMS ")[-1].splitlines()
column = dict(zip(header.split(), np.array([row.split() for row in rows], dtype=float).T))
speed = np.sqrt(column["vx"]**2 + column["vy"]**2 + column["vz"]**2)
shown = reader.PointData
assert reader.GetDataInformation().GetNumberOfPoints() == len(rows)
assert shown["radius"].GetRange() == (column["radius"].min(), column["radius"].max())
assert np.allclose(shown["v"].GetRange(-1), (speed.min(), speed.max()), rtol=1e-15)
assert reader.GetDataInformation().GetBounds()[4] == column["z"].min()

print(f"{len(rows)} particles of radius {column['radius'].min():g} to {column['radius'].max():g} m")
print(f"at t = {view.ViewTime:g} s they move at up to {speed.max():.2f} m/s; see grains.png")
