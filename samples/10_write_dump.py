# SPDX-License-Identifier: BSD-3-Clause
"""From dump to dump: keep some particles with a filter; write all frames as text, gzip and binary."""
import gzip
import re
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")

# Only the large particles. The output of a filter still has the timesteps, box and columns of the dump.
reader = vg.reader(path)
large = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=0.003,
                  UpperThreshold=1)

# The ending of the name chooses text, compressed text or binary. The text has the lines that LIGGGHTS
# wrote. vg.save is SaveData for any name, and raises an error if writing fails.
SaveData("large.dump", large, WriteTimeSteps=1, Dialect="LIGGGHTS")
vg.save(large, "large.dump.gz", WriteTimeSteps=1, Dialect="LIGGGHTS")

# Binary files hold all digits and, in the dialect LAMMPS, the names of their columns.
# New columns are possible.
faster = Calculator(Input=large, Function="mag(v)", ResultArrayName="speed")
vg.save(faster, "large.bin", WriteTimeSteps=1, Columns="id type x y z v radius speed")

strip = CreateLayout()
strip.SplitHorizontal(0, 0.5)
for place, file, color in (1, path, "v"), (2, "large.bin", "speed"):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=2000, CameraPosition=[0.20, -0.33, 0.19],
                      CameraFocalPoint=[0.006, 0, 0.070], CameraViewUp=[0, 0, 1])
    shown = vg.reader(file)
    vg.show(shown, view, color=color)
    Show(OutputPort(shown, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    Show(Text(Text=Path(file).name), view, WindowLocation="Upper Center", FontSize=18)
    colors = GetColorTransferFunction(color)
    colors.ApplyPreset(vg.preset("Plasma"))
    colors.RescaleTransferFunction(0, 1.5)
vg.set_properties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="", Visibility=1,
                  **vg.label_format("%.1f"),
                  WindowLocation="Any Location", Position=[0.86, 0.3])
strip.SetSize(1000, 560)
SaveScreenshot("before_and_after.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# Compare with the text: its lines, without the lines of small particles.
expected = ""
for frame in re.split(r"(?=ITEM: TIMESTEP\n)", Path(path).read_text())[1:]:
    lines = frame.splitlines(keepends=True)
    names = lines[8].split()[2:]
    kept = [line for line in lines[9:] if float(line.split()[names.index("radius")]) >= 0.003]
    lines[3] = f"{len(kept)}\n"
    expected += "".join(lines[:9] + kept)
assert Path("large.dump").read_text() == expected
assert gzip.open("large.dump.gz", "rt").read() == expected

# The binary file reads back bit by bit.
back = vg.reader("large.bin")
times = list(reader.TimestepValues)
assert list(back.TimestepValues) == times
for time in times:
    for source in faster, back:
        source.UpdatePipeline(time)
    written, read = FetchData(faster)[0], FetchData(back)[0]
    assert read.GetNumberOfPoints() == written.GetNumberOfPoints()
    if read.GetNumberOfPoints():
        assert np.array_equal(read.GetPoints().GetData(), written.GetPoints().GetData())
        for name in "id", "type", "v", "radius", "speed":
            arrays = [data.GetPointData().GetArray(name) for data in (written, read)]
            assert None not in arrays and np.array_equal(*arrays), (name, time)
sizes = ", ".join(f"{name} {Path(name).stat().st_size}"
                  for name in ("large.dump", "large.dump.gz", "large.bin"))
print(f"{len(kept)} particles are large; bytes: {sizes}; see before_and_after.png")
