# SPDX-License-Identifier: BSD-3-Clause
"""A tilted periodic box: scaled, absolute and unwrapped coordinates, and a box far from zero."""
import sys
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/tri_scaled_image.dump")


def points_of(source):
    source.UpdatePipeline(1e9)  # the last frame
    return np.array(FetchData(source)[0].GetPoints().GetData())


# One file, three forms of its coordinates. Orange atoms have left the box through a periodic face.
strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 3)
strip.SplitHorizontal(2, 1 / 2)
points = {}
for place, form, radius in (1, "Scaled", 0.036), (5, "Absolute", 0.3), (6, "Unwrapped", 0.3):
    reader = vg.reader(path, Coordinates=form)
    points[form], corners = points_of(reader), points_of(OutputPort(reader, 1))
    view = CreateRenderView(OrientationAxesVisibility=0, CameraParallelProjection=1)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, ViewTime=1e9, CameraPosition=[8, -60, 16], CameraViewUp=[0, 0, 1])
    vg.show(reader, view, radius=radius, color="image")
    Show(OutputPort(reader, 1), view, LineWidth=2)
    Show(Text(Text=form), view, WindowLocation="Upper Center", FontSize=20)
    ResetCamera(view)
vg.set_properties(GetColorTransferFunction("image"), ColorSpace="Diverging", RGBPoints=[0, 0.55, 0.66, 0.78, 1, 0.93, 0.45, 0.1])
strip.SetSize(1200, 420)
SaveScreenshot("forms.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# The same by hand. Bounds are "lo hi tilt" of what encloses the box, a row is id type s image.
text = Path(path).read_text()
bounds, rows = [section.partition("\n")[2] for section in text.split("ITEM: ")[-2:]]
hull = np.array(bounds.split(), float).reshape(3, 3)
(xlo, xhi, xy), (ylo, yhi, xz), (zlo, zhi, yz) = hull
low = np.array([xlo - min(0, xy, xz, xy + xz), ylo - min(0, yz), zlo])
high = np.array([xhi - max(0, xy, xz, xy + xz), yhi - max(0, yz), zhi])
box = np.diag(high - low) + [[0, 0, 0], [xy, 0, 0], [xz, yz, 0]]  # rows: the vectors a, b, c
s, image = np.split(np.array(rows.split(), float).reshape(-1, 8)[:, 2:], 2, axis=1)
inside = (points["Absolute"] - low) @ np.linalg.inv(box)
assert np.allclose(inside, s, atol=1e-14) and inside.min() >= 0 and inside.max() < 1
assert np.allclose(points["Unwrapped"], low + (s + image) @ box, atol=1e-13)
assert np.array_equal(points["Scaled"], s) and np.allclose(corners[6], low + box.sum(axis=0))
print(f"{len(s)} atoms in the box, {np.sum(image.any(axis=1))} have crossed a face; see forms.png")

# A million lengths away, single precision needs a PointOrigin near the points. Without it they move
# by 0.03, and the reader warns.
away = [f"{lo!r} {hi!r} {tilt!r}\n" for lo, hi, tilt in (hull + [1e6, 1e6, 0]).tolist()]
Path("far.dump").write_text(text.replace(bounds, "".join(away)))
single = vg.reader("far.dump", PointPrecision="Single", PointOrigin=[1e6] * 3)
error = abs(points_of(single) - points["Absolute"]).max()
print(f"far away in single precision, PointOrigin 1e+06: largest error {error:.1g}")
assert 1e-8 < error < 1e-6
