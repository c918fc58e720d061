# SPDX-License-Identifier: BSD-3-Clause
"""From dump to dump: keep some of the grains with a filter of ParaView, and write them back."""
import gzip
import re
import struct
import sys
from pathlib import Path

import granular
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")

# The grains that are large.
reader = OpenDataFile(path)
large = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=0.003,
                  UpperThreshold=1)

# All frames in one file; the end of the name says what kind of file. SaveData knows these ends,
# granular.save takes any name, and raises if something goes wrong. The columns are those of
# grains.dump, and in the dialect of LIGGGHTS so are the bytes of each line.
SaveData("large.dump", large, WriteTimeSteps=1, Dialect="LIGGGHTS")
granular.save(large, "large.dump.gz", WriteTimeSteps=1, Dialect="LIGGGHTS")

# Binary, of LAMMPS, all 16 digits and the names of the columns in it: new ones may be added.
speed = Calculator(Input=large, Function="mag(v)", ResultArrayName="speed")
granular.save(speed, "large.bin", WriteTimeSteps=1, Columns="id type x y z radius speed")

# One text file a frame, the step for the *, digits as needed.
granular.save(speed, "large_*.txt", WriteTimeSteps=1, NumberFormat="shortest",
              Columns="id type xs ys zs speed")
steps = granular.files("large_*.txt")

LoadPalette("WhiteBackground")
strip = CreateLayout()
strip.SplitHorizontal(0, 0.5)
colors = GetColorTransferFunction("speed")
for place, title, file in (1, "grains.dump", path), (2, "large.bin", "large.bin"):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    SetProperties(view, ViewTime=2000, CameraPosition=[0.25, -0.41, 0.21],
                  CameraFocalPoint=[0, 0, 0.063], CameraViewUp=[0, 0, 1])
    source = OpenDataFile(file)
    granular.show(source, view, color="v" if file == path else "speed")
    Show(OutputPort(source, 1), view)
    Show(Text(Text=title), view, WindowLocation="Upper Center", FontSize=16)
for name in "v", "speed":
    colors = GetColorTransferFunction(name)
    colors.ApplyPreset("Plasma (matplotlib)")
    colors.RescaleTransferFunction(0, 1.5)
SetProperties(GetScalarBar(colors, view), Title="speed [m/s]", ComponentTitle="", Visibility=1,
              AutomaticLabelFormat=0, LabelFormat="%.1f", RangeLabelFormat="%.1f",
              WindowLocation="Any Location", Position=[0.86, 0.3])
strip.SetSize(1000, 560)
SaveScreenshot("before_after.png", strip, SeparatorWidth=0)

# The same from the text: its own lines, without those of small grains.
expected, last = "", []
for frame in re.split(r"(?=ITEM: TIMESTEP\n)", Path(path).read_text())[1:]:
    lines = frame.splitlines(keepends=True)
    names = lines[8].split()[2:]
    last = [line for line in lines[9:] if float(line.split()[names.index("radius")]) >= 0.003]
    lines[3] = f"{len(last)}\n"
    expected += "".join(lines[:9] + last)
assert Path("large.dump").read_text() == expected
assert gzip.open("large.dump.gz", "rt").read() == expected

# And the files that were written, read back: the binary one names its columns itself.
times = list(reader.TimestepValues)
assert list(OpenDataFile(steps).TimestepValues) == times and len(steps) == len(times)
back = OpenDataFile("large.bin")
assert list(back.TimestepValues) == times
for time in times:
    for source in speed, back:
        source.UpdatePipeline(time)
    for name in ("id", "type", "radius", "speed") if speed.PointData.keys() else ():
        assert back.PointData[name].GetRange() == speed.PointData[name].GetRange(), (name, time)
    assert back.GetDataInformation().GetBounds() == speed.GetDataInformation().GetBounds()

content = Path("large.bin").read_bytes()
rows, = struct.unpack_from("<q", content, 8 + 10 + 8 + 8)
print(f"{len(last)} grains are large; see before_after.png")
