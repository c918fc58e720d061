# SPDX-License-Identifier: BSD-3-Clause
"""Which particles does each rank of ParaView hold? Four ranks show their shares as boxes."""
import csv
import sys
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data"


def show(name):
    particles = vg.reader(data / "grains.dump")
    # Mode Ranks: the bounds of the particles of each rank. A piece of a dump is a part of its lines, wherever
    # their particles are. D3 (Redistribute Data Set) sends each particle to the rank of its neighbours.
    near = D3(Input=particles)
    shares = {"as they are read": (particles, GranularDecomposition(Input=particles, Mode="Ranks")),
              "redistributed": (near, GranularDecomposition(Input=near, Mode="Ranks"))}
    strip = CreateLayout()
    strip.SplitHorizontal(0, 0.5)
    for place, (text, (inside, boxes)) in zip((1, 2), shares.items()):
        view = CreateRenderView(OrientationAxesVisibility=0)
        AssignViewToLayout(view, strip, place)
        view.ViewTime = 2000
        with_ranks, rank = vg.process_ids(inside)
        vg.show(with_ranks, view, color=rank)
        outline = Show(boxes, view, Representation="Wireframe", LineWidth=4)
        ColorBy(outline, ("CELLS", "proc"))
        Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
        Render(view)  # the first picture moves the camera
        vg.set_properties(view, CameraPosition=[0.22, -0.35, 0.20], CameraFocalPoint=[0, 0, 0.07],
                          CameraViewUp=[0, 0, 1])
    for name_of_ranks in rank, "proc":
        colors = GetColorTransferFunction(name_of_ranks)
        vg.set_properties(colors, InterpretValuesAsCategories=1,
                          Annotations=[text for i in range(4) for text in (str(i), str(i))],
                          IndexedColors=[0.27, 0.45, 0.7, 0.95, 0.6, 0.2, 0.3, 0.65, 0.45, 0.75, 0.3, 0.3])
    HideScalarBarIfNotNeeded(colors, view)
    strip.SetSize(1000, 560)
    SaveScreenshot(f"{name}.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")
    for text, (_, boxes) in shares.items():
        boxes.UpdatePipeline(2000)
        SaveData("shares.csv", boxes, FieldAssociation="Cell Data")  # of all processes
        with open("shares.csv") as file:
            counts = [int(row["nlocal"]) for row in csv.DictReader(file)]
        imbalance = max(counts) / (sum(counts) / 4)
        print(f"{text}: {counts} particles, imbalance {imbalance:.2f}")
        assert sum(counts) == 1200


if len(sys.argv) > 1:
    show(sys.argv[1])
else:
    print(vg.pvbatch(__file__, "four", ranks=4), end="")
