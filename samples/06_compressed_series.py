# SPDX-License-Identifier: BSD-3-Clause
"""One run in many files, some of them compressed: they open as one series."""
import gzip
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

folder = Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).parent / "data/compressed"
packed = sorted(folder.glob("*.dump.gz"))

# The contents of a file count, not its name: compressed and plain files may be mixed.
plain = Path(packed[1].stem)  # ortho_000050.dump
plain.write_bytes(gzip.decompress(packed[1].read_bytes()))
files = [packed[0], plain, packed[2]]

# The files may come in any order: frames are ordered by timestep. A step is 0.005 in units lj.
reader = vg.reader(reversed(files), dt=0.005)
times = list(reader.TimestepValues)
assert times == [0, 0.25, 0.5]

# A crystal melts. Each atom keeps the colour of its first layer, because ids increase with z.
strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 3)
strip.SplitHorizontal(2, 1 / 2)
for place, time, file in zip((1, 5, 6), times, files):
    view = CreateRenderView(OrientationAxesVisibility=0, CameraParallelProjection=1)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=time, CameraPosition=[14, -60, 20], CameraViewUp=[0, 0, 1])
    vg.show(reader, view, radius=0.5, color="id")
    Show(OutputPort(reader, 1), view, LineWidth=2)
    Show(Text(Text=f"t = {time}\n{file.name}"), view, WindowLocation="Upper Center", FontSize=15)
    ResetCamera(view)
    view.CameraParallelScale = 7.4
colors = GetColorTransferFunction("id")
colors.ApplyPreset(vg.preset("Viridis"))
colors.RescaleTransferFunction(1, 500)
strip.SetSize(1200, 440)
SaveScreenshot("melting.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# The same from the text, unpacked by Python: "id type xs ys zs", coordinates in units of the box.
for time, file in zip(times, packed):
    bounds, rows = gzip.open(file, "rt").read().split("ITEM: ")[-2:]
    low, high = np.array(bounds.split()[-6:], float).reshape(3, 2).T
    table = np.array(rows.split()[6:], float).reshape(-1, 5)
    reader.UpdatePipeline(time)
    atoms = FetchData(reader)[0]
    points = np.array(atoms.GetPoints().GetData())
    assert np.array_equal(atoms.GetPointData().GetArray("id"), table[:, 0])
    assert np.allclose(points, low + table[:, 2:] * (high - low), rtol=0, atol=1e-14)

saved = 1 - sum(file.stat().st_size for file in packed) / \
    sum(len(gzip.decompress(file.read_bytes())) for file in packed)
print(f"{len(packed)} files of {len(table)} atoms, {saved:.0%} smaller than text; see melting.png")
