# SPDX-License-Identifier: BSD-3-Clause
"""Does the stress in a bed at rest bear the weight above it, and how much of it do the side walls hold?"""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "continuum"
# The same particles between four walls, and in a box that is periodic in x and y.
BEDS = {"bed": ("pos id force force_normal force_tangential torque delta contactPoint",
                "pos wall_id force force_normal force_tangential torque delta"),
        "periodic_bed": ("pos id force delta contactPoint", "pos wall_id force delta")}
SIDE, TOP, LAYER, GRAVITY = 0.03, 0.038, 0.002, 9.81


def above(heights, values, z):
    """The sum of values above a height z, as the mean over a layer around it."""
    return (np.clip((heights - z[:, None]) / LAYER + 0.5, 0, 1) * values).sum(axis=1)


def table(name, pressure, z):
    """A table for a chart, with the height in mm."""
    np.savetxt(name + ".csv", np.column_stack((pressure, 1000 * z)), delimiter=",", header="pressure,height", comments="")
    return CSVReader(FileName=[name + ".csv"])


sources, curves = {}, {}
for name, (of_contacts, of_walls) in BEDS.items():
    particles = vg.reader(data / f"{name}.dump.gz")
    contacts = vg.reader(data / f"{name}_contacts.dump.gz", ColumnMap=of_contacts)
    walls = vg.reader(*data.glob(f"{name}_walls.dump*"), ColumnMap=of_walls)
    # A row for each layer. Each contact gives a layer the part of its line in it.
    profile = GranularProfile(Input=particles, Lines=contacts, Walls=walls, Layers=round(TOP / LAYER),
                              Bounds=[-SIDE / 2, SIDE / 2, -SIDE / 2, SIDE / 2, 0, TOP])
    bed, touched, layers = (vg.fetch(source) for source in (particles, walls, profile))

    z = layers["position"]
    pressure = -layers["sigma"][:, 2]
    weight = bed["points"][:, 2], GRAVITY * bed["mass"] / SIDE**2
    side = touched["mesh"] > 0  # mesh 0 is the floor; the second end of a line is the particle
    held = touched["points"][1::2, 2][side], touched["force"][side, 2] / SIDE**2
    lacks = above(*weight, z) - pressure
    error = np.abs(lacks - above(*held, z)).max() / pressure.max()
    assert error < 1e-8

    fine = np.linspace(0, TOP, 381)
    sources[name] = particles, walls
    curves[name] = [table(f"{name}_{what}", values, heights) for what, values, heights in (
        ("weight", above(*weight, fine), fine), ("pressure", pressure, z), ("held", above(*held, fine), fine), ("lacks", lacks, z))]
    total, floor, sides = (1000 * force.sum() for force in (GRAVITY * bed["mass"], touched["force"][~side, 2],
                                                            touched["force"][side, 2]))
    print(f"{name}: weight {total:.3f} mN, floor {floor:.3f} mN, side walls {sides:.3f} mN; "
          f"balance at any height to {error:.0e} of the largest pressure")

strip = CreateLayout()
strip.SplitHorizontal(0, 1 / 3)
strip.SplitHorizontal(2, 1 / 2)

# The bed at the scale of the charts: contacts with side walls by their vertical force.
view = CreateRenderView(OrientationAxesVisibility=0)
AssignViewToLayout(view, strip, 1)
particles, walls = sources["bed"]
vg.set_properties(vg.show(particles, view), AmbientColor=[0.6] * 3, DiffuseColor=[0.6] * 3, Opacity=0.12)
vertical = Calculator(Input=walls, AttributeType="Cell Data", ResultArrayName="vertical", Function="1000*force_Z")
at_sides = Threshold(Input=vertical, Scalars=["CELLS", "mesh"], LowerThreshold=1, UpperThreshold=4)
tubes = Show(Tube(Input=ExtractSurface(Input=at_sides), Radius=0.0005, NumberofSides=20), view)
ColorBy(tubes, ("CELLS", "vertical"))
colors = GetColorTransferFunction("vertical")
colors.ApplyPreset(vg.preset("Cool to Warm"))
colors.RescaleTransferFunction(-3, 3)
vg.set_properties(GetScalarBar(colors, view), Title="vertical force of side walls [mN]", ComponentTitle="",
                  Orientation="Horizontal", WindowLocation="Upper Center", ScalarBarLength=0.6, ScalarBarThickness=10,
                  AddRangeLabels=0, UseCustomLabels=1, CustomLabels=[-3, 0, 3], **vg.label_format("%.0f"))
tubes.SetScalarBarVisibility(view, True)
Show(Outline(Input=Box(XLength=SIDE, YLength=SIDE, ZLength=TOP, Center=[0, 0, TOP / 2])), view, AmbientColor=[0.3] * 3,
     DiffuseColor=[0.3] * 3)
Render(view)
vg.set_properties(view, CameraParallelProjection=1, CameraPosition=[0, -0.1, 0.0212], CameraFocalPoint=[0, 0, 0.0212],
                  CameraViewUp=[0, 0, 1], CameraParallelScale=0.0259)

DARK, RED, GREEN = (0.2, 0.2, 0.2), (0.84, 0.15, 0.16), (0.17, 0.63, 0.17)
bed, periodic = curves["bed"], curves["periodic_bed"]
for place, title, shown in (
        (5, "pressure [Pa]", ((bed[0], "weight above", DARK, False), (bed[1], "-sigma zz", RED, True))),
        (6, "difference [Pa]", ((bed[2], "held by side walls above", DARK, False), (bed[3], "weight above + sigma zz", RED, True),
                                (periodic[3], "the same without side walls", GREEN, True)))):
    chart = CreateView("XYChartView")
    AssignViewToLayout(chart, strip, place)
    vg.set_properties(chart, BottomAxisTitle=title, LeftAxisTitle="height [mm]", LegendLocation="TopRight",
                      LeftAxisUseCustomRange=1, LeftAxisRangeMinimum=0, LeftAxisRangeMaximum=45)
    for source, label, color, points in shown:
        vg.set_properties(Show(source, chart, "XYChartRepresentation"), UseIndexForXAxis=0, XArrayName="pressure",
                          SeriesVisibility=["height"], SeriesLabel=["height", label],
                          SeriesColor=["height", *map(str, color)], SeriesLineThickness=["height", "2"],
                          SeriesLineStyle=["height", "0" if points else "1"], SeriesMarkerSize=["height", "7"],
                          SeriesMarkerStyle=["height", "4" if points else "0"])
strip.SetSize(1200, 500)
SaveScreenshot("weight_of_a_bed.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")
