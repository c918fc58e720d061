# SPDX-License-Identifier: BSD-3-Clause
"""Which particles bear the load? Particles coloured by the stress of their contacts, and the strong forces as tubes."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "continuum"
particles = vg.reader(data / "bed.dump.gz")
# LIGGGHTS numbers the columns of dump local. The keywords of the computes say what they hold.
contacts = vg.reader(data / "bed_contacts.dump.gz",
                     ColumnMap="pos id force force_normal force_tangential torque delta contactPoint")
walls = vg.reader(data / "bed_walls.dump.gz", ColumnMap="pos wall_id force force_normal force_tangential torque delta")

sums = GranularContactSums(Input=particles, Lines=contacts, Walls=walls)
sums.Arrays = ["coordination", "contact_force", "contact_stress", "principal_stress", "rattler"]
# The largest principal stress comes first. The last one is the strongest compression, which is negative.
pressed = Calculator(Input=sums, ResultArrayName="compression", Function="-principal_stress_Z")
half = Calculator(Input=pressed, ResultArrayName="half", Function="0.5*radius")
behind = Clip(Input=pressed, ClipType="Plane")
vg.set_properties(behind.ClipType, Origin=[0, 0, 0], Normal=[0, -1, 0])


def tubes(lines, least):
    """Tubes of the forces from the least one on: the section is the force. Tubes take their radius from a point array."""
    strength = Calculator(Input=lines, AttributeType="Cell Data", ResultArrayName="strength", Function="mag(force)")
    strong = Threshold(Input=strength, Scalars=["CELLS", "strength"], LowerThreshold=least, UpperThreshold=1)
    section = Calculator(Input=ExtractSurface(Input=strong), AttributeType="Cell Data", ResultArrayName="thickness",
                         Function="0.0035*sqrt(strength)")
    return Tube(Input=CellDatatoPointData(Input=section), Scalars=["POINTS", "thickness"], VaryRadius="By Absolute Scalar",
                NumberofSides=12)


mean = np.linalg.norm(np.vstack([vg.fetch(lines)["force"] for lines in (contacts, walls)]), axis=1).mean()

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 2)
box = Outline(Input=Box(XLength=0.03, YLength=0.03, ZLength=0.036, Center=[0, 0, 0.018]))
colors = GetColorTransferFunction("compression")
colors.AutomaticRescaleRangeMode = "Never"
colors.ApplyPreset(vg.preset("RdOrYl"), True)
colors.InvertTransferFunction()
colors.RescaleTransferFunction(40, 4000)
colors.MapControlPointsToLogSpace()
colors.UseLogScale = 1
for place, spheres, radius, text in ((1, behind, "radius", "the half behind: largest pressure on each particle"),
                                       (2, half, "half", "all particles at half their size, and the forces above the mean")):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    shown = vg.show(spheres, view, radius=radius, color="compression")
    for lines in (contacts, walls) if place == 2 else ():
        tube = Show(tubes(lines, mean), view, AmbientColor=[0.6] * 3, DiffuseColor=[0.6] * 3)
        ColorBy(tube, None)
    Show(box, view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraPosition=[0.022, -0.106, 0.042], CameraFocalPoint=[0.0015, 0, 0.0172],
                      CameraViewUp=[0, 0, 1], CameraViewAngle=26)
colors.RescaleTransferFunction(40, 4000)  # the display has set it to the values of the frame
vg.set_properties(GetScalarBar(colors, view), Title="pressure [Pa]", ComponentTitle="", HorizontalTitle=1,
                  WindowLocation="Any Location", Position=[0.86, 0.3], ScalarBarLength=0.45, AddRangeLabels=0,
                  UseCustomLabels=1, CustomLabels=[40, 100, 200, 500, 1000, 2000, 4000], **vg.label_format("%g"))
shown.SetScalarBarVisibility(view, True)
strip.SetSize(1200, 600)
SaveScreenshot("particle_stress.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")


# At rest the contacts of a particle bear its weight.
arrays = vg.fetch(sums)
assert np.abs(arrays["contact_force"][:, 2] - 9.81 * arrays["mass"]).max() < 1e-8
# Together the stresses are branch vector times force on its first particle, summed over the contacts. A wall is the second one.
lines, touched = vg.fetch(contacts), vg.fetch(walls)
branches = np.vstack((lines["points"][1::2] - lines["points"][0::2], touched["points"][0::2] - touched["points"][1::2]))
forces = np.vstack((lines["force"], touched["force"]))
assert np.allclose(arrays["contact_stress"][:, :3].sum(axis=0), (branches * forces).sum(axis=0), rtol=1e-12)
pressure = -arrays["principal_stress"][:, 2]
print(f"{len(forces)} contacts, {arrays['mean_coordination']:.2f} for each particle; {arrays['rattler'].sum()} rattlers; "
      f"largest pressure on a particle: {pressure.min():.0f} to {pressure.max():.0f} Pa")
