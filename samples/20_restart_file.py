# SPDX-License-Identifier: BSD-3-Clause
"""The contents of a restart file: particles in full precision, and bonds with forces and torques."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "restart"
fibres = vg.reader([data / f"fibres.{step}.restart" for step in (10000, 20000, 40000)], dt=1e-6)
bonds = OutputPort(fibres, 1)

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 2)
views = []
for place, time in ((1, 0.01), (2, 0.04)):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = time
    display = Show(fibres, view, AmbientColor=[0.85] * 3, DiffuseColor=[0.85] * 3, Opacity=0.25)
    ColorBy(display, ("POINTS", ""))
    # The history holds the bending moment of each bond.
    moment = Calculator(Input=bonds, AttributeType="Cell Data", ResultArrayName="bending moment [N m]",
                        Function="mag(torque_tangential)")
    shown = Show(Tube(Input=moment, Radius=0.0004), view)
    ColorBy(shown, ("CELLS", "bending moment [N m]"))
    shown.SetScalarBarVisibility(view, False)
    Show(OutputPort(fibres, 2), view, AmbientColor=[0.4] * 3, DiffuseColor=[0.4] * 3)
    Show(Text(Text=f"{1000 * time:.0f} ms"), view, WindowLocation="Upper Left Corner", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraPosition=[0.03, -0.055, 0.02], CameraFocalPoint=[0.0095, 0.001, 0],
                      CameraViewUp=[0, 0, 1])
    views.append(view)
colours = GetColorTransferFunction("bending moment [N m]")
colours.ApplyPreset(vg.preset("Cool to Warm"))
colours.RescaleTransferFunction(0, 8e-6)
strip.SetSize(1200, 500)
SaveScreenshot("restart_file.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

for time in 0.01, 0.02, 0.04:
    fibres.UpdatePipeline(time)
    particles, lines = (servermanager.Fetch(fibres, idx=port) for port in (0, 1))
    positions = {int(number): np.array(particles.GetPoint(row))
                 for row, number in enumerate(np.array(particles.GetPointData().GetArray("id")))}
    arrays = {name: np.array(lines.GetCellData().GetArray(name))
              for name in ("id1", "id2", "length", "damage", "equilibrium_length", "torque_tangential")}
    assert len(positions) == 87 and lines.GetNumberOfCells() == 8 * 9 + 7 and (arrays["damage"] == 1).all()
    # A fibre is held at its first particle, and bends most there.
    moments = np.linalg.norm(arrays["torque_tangential"], axis=1)
    fibre = (arrays["id1"] <= 10) & (arrays["id2"] <= 10)
    print(f"{1000 * time:.0f} ms: the first fibre's end is {-1000 * positions[10][2]:.2f} mm down, "
          f"bent by {1e6 * moments[fibre].max():.2f} uN m at particle {arrays['id1'][fibre][moments[fibre].argmax()]}, "
          f"bonds are stretched by {(arrays['length'] / arrays['equilibrium_length'] - 1).max():.1e} at most")
