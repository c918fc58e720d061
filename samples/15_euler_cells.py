# SPDX-License-Identifier: BSD-3-Clause
"""How densely are particles packed, and where is the surface of the heap? Averages over cells tell."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data"
particles = vg.reader(data / "grains.dump", dt=2e-5)

# Cells of 10 mm: an image with cell data. Each cell gets the part of each sphere inside it.
cells = GranularEulerAverage(Input=particles, CellCounts=[10, 10, 15])
fields = CellDatatoPointData(Input=cells)
middle = Slice(Input=fields, SliceType="Plane")
vg.set_properties(middle.SliceType, Origin=[0, 0, 0.075], Normal=[0, 1, 0])
surface = Contour(Input=fields, ContourBy=["POINTS", "volumefraction"], Isosurfaces=[0.3])

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 3)
strip.SplitHorizontal(2, 1 / 2)
views = []
for place, text in ((1, "particles"), (5, "volume fraction"), (6, "where it is 0.3")):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    view.ViewTime = 4000 * 2e-5  # each view has its own
    Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
    Show(OutputPort(particles, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    views.append(view)
vg.show(particles, views[0], color="radius").SetScalarBarVisibility(views[0], False)
GetColorTransferFunction("radius").ApplyPreset(vg.preset("Cool to Warm"))
shown = Show(middle, views[1], Ambient=1, Diffuse=0)
ColorBy(shown, ("POINTS", "volumefraction"))
colors = GetColorTransferFunction("volumefraction")
colors.ApplyPreset(vg.preset("Cool to Warm"))
colors.RescaleTransferFunction(0, 0.6)
vg.set_properties(GetScalarBar(colors, views[1]), Title="", ComponentTitle="", HorizontalTitle=1,
                  WindowLocation="Any Location", Position=[0.86, 0.25], ScalarBarLength=0.5,
                  **vg.label_format("%.1f"))
shown.SetScalarBarVisibility(views[1], True)
shown = Show(surface, views[2])
ColorBy(shown, None)
vg.set_properties(shown, AmbientColor=[0.27, 0.45, 0.7], DiffuseColor=[0.27, 0.45, 0.7])
vg.show(particles, views[2]).Opacity = 0.15
for view in views:
    Render(view)  # the first picture moves the camera
    vg.set_properties(view, CameraPosition=[0.22, -0.36, 0.19], CameraFocalPoint=[0, 0, 0.066],
                      CameraViewUp=[0, 0, 1])
strip.SetSize(1200, 480)
SaveScreenshot("euler_cells.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")


def fetch(**properties):
    """The values of all cells by name."""
    vg.set_properties(cells, **properties)
    cells.UpdatePipeline(4000 * 2e-5)
    arrays = servermanager.Fetch(cells).GetCellData()
    return {name: np.array(arrays.GetArray(name)) for name in ("v_avg", "volumefraction")}


# Compare with the text: the volume of all spheres, without the parts below the ground, which are outside.
frame = (data / "grains.dump").read_text().split("ITEM: ATOMS ")[-1].splitlines()
column = dict(zip(frame[0].split(), np.array([row.split() for row in frame[1:]], float).T))
radius, below = column["radius"], np.clip(column["radius"] - column["z"], 0, None)
solid = (4 / 3 * np.pi * radius**3 - np.pi * below**2 * (radius - below / 3)).sum()
overlap = fetch()["volumefraction"]
volume = 0.1 * 0.1 * 0.15 / len(overlap)
assert abs(overlap.sum() * volume - solid) < 1e-12 * solid
print(f"{len(radius)} particles have {solid * 1e6:.4f} ml in {len(overlap)} cells; fullest cell: {overlap.max():.3f}")

# LIGGGHTS gives the whole particle to the cell of its centre: small cells are ragged then.
centre = fetch(Weights="Centre")["volumefraction"]
print(f"by centres: {(centre == 0).sum()} cells are empty, not {(overlap == 0).sum()}; "
      f"fullest cell: {centre.max():.3f}")
assert centre.max() > overlap.max()

# Average over all frames: one image, with v_avg weighted by mass.
mean = fetch(Weights="Overlap", TimeAverage=1)
print(f"over all frames: {mean['volumefraction'].max():.3f} in the fullest cell, "
      f"and at most {np.linalg.norm(mean['v_avg'], axis=1).max():.2f} m/s")

# Files in the format of LIGGGHTS, one per timestep.
cells.TimeAverage = 0
vg.save(cells, "cells_*.euler", WriteTimeSteps=1)
print("written:", *sorted(path.name for path in Path.cwd().glob("cells_*.euler")))
