# SPDX-License-Identifier: BSD-3-Clause
"""How wide should a smoothing kernel be? A section of a bed at four widths: narrow ones show particles, wide ones blur the surface."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "continuum"
particles = vg.reader(data / "bed.dump.gz")
contacts = vg.reader(data / "bed_contacts.dump.gz",
                     ColumnMap="pos id force force_normal force_tangential torque delta contactPoint")
walls = vg.reader(data / "bed_walls.dump.gz", ColumnMap="pos wall_id force force_normal force_tangential torque delta")
RADIUS, SIDE, WIDTHS = 0.0025, 0.03, (0.5, 1, 2, 4)

# Fields at the points of a plane through the middle of the bed.
section = Plane(Origin=[-0.018, 0, -0.0025], Point1=[0.018, 0, -0.0025], Point2=[-0.018, 0, 0.0455], XResolution=96, YResolution=128)
averages = [GranularPointAverage(Input=particles, Lines=contacts, Walls=walls, Points=section, Kernel="Gaussian",
                                 KernelWidth=width * RADIUS) for width in WIDTHS]
for average in averages:
    average.Arrays = ["volumefraction", "pressure"]  # after it is made, as defaults are on until then
# The circles in which the plane cuts the particles.
spheres = Glyph(Input=particles, GlyphType="Sphere", ScaleArray=["POINTS", "radius"], ScaleFactor=2, GlyphMode="All Points")
vg.set_properties(spheres.GlyphType, ThetaResolution=40, PhiResolution=40)
circles = Slice(Input=spheres)
vg.set_properties(circles.SliceType, Origin=[0, 0, 0], Normal=[0, 1, 0])
box = Outline(Input=Box(XLength=SIDE, YLength=SIDE, ZLength=0.036, Center=[0, 0, 0.018]))
lines = AppendGeometry(Input=[circles, box])

strip = CreateLayout()
strip.SplitVertical(0, 1 / 2)
for half in range(1, 7):
    strip.SplitHorizontal(half, 1 / 2)
for row, (name, title, scheme, labels) in enumerate((("volumefraction", "volume fraction", "PuBu", [0, 0.2, 0.4, 0.6, 0.8]),
                                                     ("pressure", "pressure [Pa]", "RdOr", [0, 100, 200, 300, 400]))):
    colors = GetColorTransferFunction(name)
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ApplyPreset(vg.preset(scheme), True)
    colors.InvertTransferFunction()
    colors.RGBPoints = [*colors.RGBPoints[:1], 1, 1, 1, *colors.RGBPoints[4:]]  # nothing is white
    colors.NumberOfTableValues = 16
    for column, (width, average) in enumerate(zip(WIDTHS, averages)):
        view = CreateRenderView(OrientationAxesVisibility=0)
        AssignViewToLayout(view, strip, 7 + 4 * row + column)
        shown = Show(average, view, Ambient=1, Diffuse=0)
        ColorBy(shown, ("POINTS", name))
        Show(lines, view, Ambient=1, Diffuse=0, AmbientColor=[0.2] * 3, DiffuseColor=[0.2] * 3, LineWidth=1.3)
        Show(Text(Text=f"{width} {'radius' if width == 1 else 'radii'}"), view, WindowLocation="Upper Center", FontSize=14)
        Render(view)
        vg.set_properties(view, CameraParallelProjection=1, CameraPosition=[0, -0.1, 0.0215], CameraFocalPoint=[0, 0, 0.0215],
                          CameraViewUp=[0, 0, 1], CameraParallelScale=0.0245)
        if column == 0:
            vg.set_properties(GetScalarBar(colors, view), Title=title, ComponentTitle="", Orientation="Horizontal",
                              WindowLocation="Any Location", Position=[0.2, 0.83], ScalarBarLength=0.6, ScalarBarThickness=8,
                              AddRangeLabels=0, UseCustomLabels=1, CustomLabels=labels, TitleFontSize=14, LabelFontSize=12,
                              **vg.label_format("%g"))
            shown.SetScalarBarVisibility(view, True)
    colors.RescaleTransferFunction(0, labels[-1])
strip.SetSize(1200, 800)
SaveScreenshot("kernel_width.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# Inside the bed the volume fraction should be one number. At the surface it should fall at once.
variations, falls = [], []
for width, average in zip(WIDTHS, averages):
    fields = vg.fetch(average)
    x, z, fraction = (array.reshape(129, 97) for array in (*fields["points"][:, ::2].T, fields["volumefraction"]))
    middle, heights = fraction[:, abs(x[0]) < 3 * RADIUS], z[:, 0]
    inside = middle[(heights > 3 * RADIUS) & (heights < 9 * RADIUS)]
    high, low = (heights[middle.mean(axis=1) > part * inside.mean()].max() for part in (0.75, 0.25))
    variations.append(inside.std() / inside.mean())
    falls.append((low - high) / RADIUS)
    print(f"width {width} radii: volume fraction {inside.mean():.2f} inside, where it varies by {100 * variations[-1]:.0f} %; "
          f"at the surface it falls from 3/4 to 1/4 of that within {falls[-1]:.1f} radii")
assert variations[0] > 0.5 > 0.1 > variations[1] > variations[2] and falls == sorted(falls)
