# SPDX-License-Identifier: BSD-3-Clause
"""Load only what a picture needs: fewer columns, fewer particles, a part of the box."""
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")

reader = vg.reader(path)
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().GoToLast()


def load(what, **properties):
    """Sets properties of the reader; prints and returns how many particles and KiB it then loads."""
    vg.set_properties(reader, **properties)
    reader.UpdatePipeline(view.ViewTime)
    loaded = reader.GetDataInformation()
    print(f"{what:30} {loaded.GetNumberOfPoints():5} particles {loaded.GetMemorySize():4} KiB")
    return loaded.GetNumberOfPoints(), loaded.GetMemorySize()


# Columns that are not in the list are not even parsed.
everything = load("everything")
columns = load("id, radius and velocity", PointArrayStatus=["id", "radius", "v"])

# Every tenth particle: those with id 10, 20, 30, ..., the same ones in every frame.
tenth = load("  of every tenth particle", Stride=10)

# A slice through the middle: xmin xmax ymin ymax zmin zmax. An axis with min > max is not restricted.
slab = load("  of a slice 14 mm thick", Stride=1, RegionOfInterest=[1, -1, -0.007, 0.007, 1, -1])
SaveData("slice.vtp", reader, DataMode="Binary")  # raw data break with today's libexpat

particles = vg.show(reader, view, color="v")
particles.SetScalarBarVisibility(view, True)
Show(OutputPort(reader, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3, LineWidth=2)
vg.set_properties(view, ViewSize=[640, 640], OrientationAxesVisibility=0, CameraViewUp=[0, 0, 1],
                  CameraPosition=[0.013, -0.36, 0.14], CameraFocalPoint=[0.013, 0, 0.071])
colors = GetColorTransferFunction("v")
colors.ApplyPreset(vg.preset("Plasma"))
colors.RescaleTransferFunction(0, 1.5)
vg.set_properties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="",
                  **vg.label_format("%.1f"),
                  WindowLocation="Any Location", Position=[0.84, 0.3])
SaveScreenshot("slice.png", view, OverrideColorPalette="WhiteBackground")

# Compare with the text of the last frame, and with the file that was written.
header, *rows = Path(path).read_text().split("ITEM: ATOMS ")[-1].splitlines()
column = dict(zip(header.split(), np.array([row.split() for row in rows], dtype=float).T))
assert everything[0] == columns[0] == len(rows) and columns[1] < 0.6 * everything[1]
assert tenth[0] == np.sum(column["id"] % 10 == 0)
assert slab[0] == np.sum(abs(column["y"]) <= 0.007)
written = OpenDataFile("slice.vtp")
assert sorted(written.PointData.keys()) == ["id", "radius", "v"]
assert written.GetDataInformation().GetNumberOfPoints() == slab[0]
