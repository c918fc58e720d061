# SPDX-License-Identifier: BSD-3-Clause
"""Four ranks write one file together; it has the bytes that one rank would write."""
import sys
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data/grains.dump"


def write(name):
    """An ordinary script: each rank reads, filters and writes a part of the particles."""
    reader = vg.reader(data)
    small = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=0,
                      UpperThreshold=0.003)
    # Gather: the first rank writes for all. MPI-IO: each rank writes its part in place.
    for mode in "Gather", "MPI-IO":
        vg.save(small, f"{name}_{mode}.dump", WriteTimeSteps=1, Dialect="LIGGGHTS",
                ParallelMode=mode)

    view = GetActiveViewOrCreate("RenderView")
    vg.set_properties(view, ViewSize=[560, 600], ViewTime=3000, OrientationAxesVisibility=0)
    with_ranks, rank = vg.process_ids(small)
    vg.show(with_ranks, view, color=rank)
    Show(OutputPort(reader, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    colors = GetColorTransferFunction(rank)
    vg.set_properties(colors, InterpretValuesAsCategories=1,
                      Annotations=[text for i in range(4) for text in (str(i), str(i))],
                      IndexedColors=[0.27, 0.45, 0.7, 0.95, 0.6, 0.2, 0.3, 0.65, 0.45, 0.75, 0.3, 0.3])
    vg.set_properties(GetScalarBar(colors, view), Title="process", ComponentTitle="", Visibility=1)
    Render(view)  # the first picture moves the camera
    vg.set_properties(view, CameraPosition=[0.20, -0.33, 0.19], CameraFocalPoint=[0.008, 0, 0.07],
                      CameraViewUp=[0, 0, 1])
    SaveScreenshot(f"{name}.png", view, OverrideColorPalette="WhiteBackground")


if len(sys.argv) > 1:
    write(sys.argv[1])
else:
    write("one")
    vg.pvbatch(__file__, "four", ranks=4)
    written = {file.read_bytes() for file in Path().glob("*.dump")}
    assert len(written) == 1 and len(list(Path().glob("*.dump"))) == 4

    # Compare with the text of the run: its lines of small particles. The other lines are shorter.
    lines = written.pop().decode().splitlines()
    rows = [line for line in data.read_text().splitlines() if len(line.split()) == 19]
    small = [row for row in rows if float(row.split()[17]) < 0.003]
    assert small == [line for line in lines if len(line.split()) == 19]
    print(f"4 files of {len(lines)} lines are the same; see four.png")
