# SPDX-License-Identifier: BSD-3-Clause
"""Which contacts carry the weight of a bed of particles? Tubes show them, thick and red where the force is large."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "bonds"
particles = vg.reader(data / "settled_grains.dump.gz")
# The columns are called c_fc[1] and so on. Without a Preset the reader finds their meaning and reports it.
contacts = vg.reader(data / "settled_contacts.dump.gz", Preset="ContactsForce")

# Tubes take their radius from a point array. Each line has two points of its own, so no values mix.
strength = Calculator(Input=contacts, AttributeType="Cell Data", ResultArrayName="strength", Function="mag(force)")
thickness = Calculator(Input=strength, AttributeType="Cell Data", ResultArrayName="thickness", Function="0.12*strength")
chains = Tube(Input=CellDatatoPointData(Input=thickness), Scalars=["POINTS", "thickness"],
              VaryRadius="By Absolute Scalar", NumberofSides=12)

view = CreateRenderView(ViewSize=[1000, 500], OrientationAxesVisibility=0)
grey = vg.show(particles, view)
vg.set_properties(grey, AmbientColor=[0.6] * 3, DiffuseColor=[0.6] * 3, Opacity=0.1)
shown = Show(chains, view)
ColorBy(shown, ("POINTS", "strength"))
GetColorTransferFunction("strength").ApplyPreset(vg.preset("Cool to Warm"))
shown.SetScalarBarVisibility(view, True)
vg.set_properties(GetScalarBar(GetColorTransferFunction("strength"), view), Title="force [N]", ComponentTitle="",
                  HorizontalTitle=1, **vg.label_format("%.3f"))
Show(OutputPort(particles, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
Render(view)
vg.set_properties(view, CameraPosition=[0.04, -0.16, 0.07], CameraFocalPoint=[0.004, 0, 0.006],
                  CameraViewUp=[0, 0, 1])
SaveScreenshot("force_chains.png", view, OverrideColorPalette="WhiteBackground")

# The forces on a particle that does not touch the ground: its weight and its contacts, opposite at both ends.
rows = servermanager.Fetch(contacts, 0).GetCellData()
id1, id2, force = (np.array(rows.GetArray(name)) for name in ("id1", "id2", "force"))
points = servermanager.Fetch(particles, 0)
ids, radius, mass, f = (np.array(points.GetPointData().GetArray(name)) for name in ("id", "radius", "mass", "f"))
height = np.array(points.GetPoints().GetData())[:, 2]
row = {number: index for index, number in enumerate(ids)}
total = np.zeros((len(ids), 3))
np.add.at(total, [row[number] for number in id1], force)
np.add.at(total, [row[number] for number in id2], -force)
total[:, 2] -= 9.81 * mass
above = height > radius
assert np.abs(total - f)[above].max() < 1e-7 * np.abs(force).max()
print(f"{len(id1)} contacts of {len(ids)} particles; the largest force is {np.abs(force).max():.3f} N, "
      f"{np.abs(force).max() / (9.81 * mass.mean()):.0f} times the weight of a particle")
