# SPDX-License-Identifier: BSD-3-Clause
"""Read a binary dump, name its columns, and see the digits that the text of the same run has lost."""
import struct
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data"
path, text_path = sys.argv[1:3] if sys.argv[2:] else (data / "grains.bin", data / "grains.dump")

# LIGGGHTS does not write the names of columns into a binary file: take them from the input script.
names = "id type x y z ix iy iz vx vy vz radius"
binary = vg.reader(path, ColumnNames=names)
text = vg.reader(text_path)
assert list(binary.TimestepValues) == list(text.TimestepValues)

# The distance of the 6 digits of the text from where a particle was: the last one of 0.0999999 m is worth
# 0.1 micrometres, that of 0.100000 m ten times as much.
shift = PythonCalculator(Input=[binary, text], ArrayName="shift",
                         Expression="mag(inputs[0].Points - inputs[1].Points) * 1e9")
view = GetActiveViewOrCreate("RenderView")
vg.set_properties(view, ViewSize=[640, 680], OrientationAxesVisibility=0, ViewTime=2000,
                  CameraPosition=[0.014, -0.36, 0.13], CameraFocalPoint=[0.014, 0, 0.073],
                  CameraViewUp=[0, 0, 1])
particles = vg.show(shift, view, color="shift")
particles.SetScalarBarVisibility(view, True)
Show(OutputPort(binary, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3, LineWidth=2)
colors = GetColorTransferFunction("shift")
colors.ApplyPreset(vg.preset("Plasma"))
colors.RescaleTransferFunction(0, 500)
vg.set_properties(GetScalarBar(colors, view), Title="lost by the text [nm]", ComponentTitle="",
                  **vg.label_format("%.0f"),
                  WindowLocation="Any Location", Position=[0.83, 0.3])
SaveScreenshot("lost.png", view, CompressionLevel="9", OverrideColorPalette="WhiteBackground")


def rounded(numbers, digits):
    """The numbers as a text with so many digits holds them; 17 are exact."""
    return np.char.mod(f"%.{digits}g", numbers).astype(float)


# Decode all frames from the bytes, without ParaView. Each rank wrote a chunk of a frame.
content, at = Path(path).read_bytes(), 0
while at < len(content):
    step, *_, width, chunks = struct.unpack_from("<2q i 6i 6d 2i", content, at)
    at, rows = at + 100, [np.empty(0)]
    for _ in range(chunks):
        count, = struct.unpack_from("<i", content, at)
        rows.append(np.frombuffer(content, "<f8", count, at + 4))
        at += 4 + 8 * count
    column = dict(zip(names.split(), np.concatenate(rows).reshape(-1, width).T))
    for source, digits in (binary, 17), (text, 6):
        source.UpdatePipeline(step)
        frame = FetchData(source)[0]
        for numbers, wanted in ((frame.GetPoints().GetData(), ["x", "y", "z"]),
                                (frame.GetPointData().GetArray("v"), ["vx", "vy", "vz"]),
                                (frame.GetPointData().GetArray("id"), ["id"])):
            exact = np.ravel([column[name] for name in wanted], order="F")
            assert np.array_equal(np.ravel(numbers), rounded(exact, digits))


def overlaps(digits):
    """How far each two particles of the last frame reach into each other."""
    *centres, radius = (rounded(column[name], digits) for name in ("x", "y", "z", "radius"))
    distance = np.sqrt(sum(np.subtract.outer(centre, centre)**2 for centre in centres))
    return np.add.outer(radius, radius) - distance


touching = np.triu(overlaps(17) > 0, 1)
wrong = abs(overlaps(6) / overlaps(17) - 1)[touching] > 0.01
print(f"{touching.sum()} pairs of particles touch at step {step}: the text has the overlap, and so")
print(f"the force, wrong by more than 1 % for {wrong.sum()} of them; see lost.png")
