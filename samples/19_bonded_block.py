# SPDX-License-Identifier: BSD-3-Clause
"""A bonded block without a file, whole and cut in two: which bonds cross the cut, and how bending strains the others."""
import numpy as np
import vtkgranular as vg
from paraview.simple import *

block = GranularPackingSource(Arrangement="FaceCentredCubic", NumberOfGrains=0, Radii="One", Radius=0.004,
                              BoxLengths=[0.16, 0.05, 0.05], BondFactor=1.05)
bonds = OutputPort(block, "Bonds")

# The cut is a plane. Particles are on side 1 or -1; a bond with both signs crosses the cut.
sided = Calculator(Input=block, ResultArrayName="side", Function="sign(coordsX - 0.08 + 0.5*(coordsZ - 0.025))")
told = GranularLocalJoin(Input=sided, Lines=bonds, Differences="side")
kept = Threshold(Input=told, Scalars=["CELLS", "side_difference"], LowerThreshold=-0.5, UpperThreshold=0.5)

# Both halves bend and separate. The bonds follow the particles: each line is joined again by the ids of its ends.
bent = Calculator(Input=sided, CoordinateResults=1,
                  Function="(coordsX + 0.008*side)*iHat + coordsY*jHat + (coordsZ - 2*(coordsX - 0.08)^2)*kHat")
before = GranularLocalJoin(Input=sided, Lines=bonds)
after = GranularLocalJoin(Input=bent, Lines=kept)

strip = CreateLayout()
strip.SplitHorizontal(0, 0.5)
for place, particles, lines, text in ((1, sided, before, "whole"), (2, bent, after, "cut and bent")):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.show(particles, view).Opacity = 0.08
    shown = Show(Tube(Input=lines, Radius=0.0007), view)
    ColorBy(shown, ("CELLS", "strain"))
    GetColorTransferFunction("strain").ApplyPreset(vg.preset("Cool to Warm"))
    GetColorTransferFunction("strain").RescaleTransferFunction(-0.2, 0.2)
    shown.SetScalarBarVisibility(view, text != "whole")
    Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
    Render(view)
    vg.set_properties(view, CameraPosition=[0.13, -0.3, 0.14], CameraFocalPoint=[0.08, 0.025, 0.02],
                      CameraViewUp=[0, 0, 1])
strip.SetSize(1200, 480)
SaveScreenshot("bonded_block.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")


def fetch(proxy, *names):
    arrays = servermanager.Fetch(proxy).GetCellData()
    return [np.array(arrays.GetArray(name)) for name in names]


all_bonds, left = len(fetch(before, "strain")[0]), len(fetch(after, "strain")[0])
assert np.abs(fetch(before, "strain")[0]).max() < 1e-12 and 0 < left < all_bonds
assert np.count_nonzero(fetch(told, "side_difference")[0]) == all_bonds - left
strain = fetch(after, "strain")[0]
print(f"{all_bonds} bonds, of which the cut takes {all_bonds - left}; "
      f"the bend strains the others by {strain.min():+.3f} to {strain.max():+.3f}")
