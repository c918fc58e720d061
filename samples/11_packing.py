# SPDX-License-Identifier: BSD-3-Clause
"""Particles without a file: random ones of two sizes, and a lattice, as dumps for simulations."""
import itertools
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

# Small and large particles at random positions: 20 % of a box that is periodic in x and y.
random = GranularPackingSource(NumberOfGrains=0, SolidFraction=0.2, BoxLengths=[0.1, 0.1, 0.15],
                               Boundary="pp pp ff", Radii="Two", Radius=0.0025,
                               SecondRadius=0.004, SecondShare=0.25, Speed=0.05, Seed=7)

# A crystal with gaps of a tenth of a diameter, in the same box.
lattice = GranularPackingSource(Arrangement="FaceCentredCubic", NumberOfGrains=0, Spacing=1.1,
                                BoxLengths=[0.1, 0.1, 0.15], Boundary="pp pp ff", Radii="One",
                                Radius=0.004)

# Both programs read these dumps like their own:
#   read_dump random.LIGGGHTS 0 x y z vx vy vz radius box yes add yes
#   read_dump random.LAMMPS 0 x y z vx vy vz box yes add keep
# 17 digits, so that no rounding makes particles touch.
sources = {"random": random, "lattice": lattice}
for (name, source), dialect in itertools.product(sources.items(), ("LIGGGHTS", "LAMMPS")):
    vg.save(source, f"{name}.{dialect}", Dialect=dialect, NumberFormat="%.17g",
            Columns="id type x y z vx vy vz radius")

strip = CreateLayout()
strip.SplitHorizontal(0, 0.5)
for place, (name, source) in zip((1, 2), sources.items()):
    view = CreateRenderView(OrientationAxesVisibility=0)
    AssignViewToLayout(view, strip, place)
    vg.set_properties(view, CameraPosition=[0.28, -0.32, 0.22], CameraFocalPoint=[0.052, 0.05, 0.073],
                      CameraViewUp=[0, 0, 1])
    vg.show(source, view, color="radius")
    Show(OutputPort(source, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    Show(Text(Text=name), view, WindowLocation="Upper Center", FontSize=18)
vg.set_properties(GetColorTransferFunction("radius"), ColorSpace="Diverging", RGBPoints=[0.0025, 0.27, 0.45, 0.7, 0.004, 0.95, 0.6, 0.2])
strip.SetSize(1000, 600)
SaveScreenshot("packings.png", strip, SeparatorWidth=0, OverrideColorPalette="WhiteBackground")

# Check the text: no particles overlap in either file, not even across the periodic faces.
for name, dialect in itertools.product(sources, ("LIGGGHTS", "LAMMPS")):
    header, *rows = Path(f"{name}.{dialect}").read_text().split("ITEM: ATOMS ")[-1].splitlines()
    table = np.array([row.split() for row in rows], float)
    column = dict(zip(header.split(), table.T))
    apart = np.array([np.subtract.outer(column[axis], column[axis]) for axis in "xyz"])
    apart[:2] -= 0.1 * np.round(apart[:2] / 0.1)
    gap = np.sqrt((apart**2).sum(axis=0)) - np.add.outer(column["radius"], column["radius"])
    closest = gap[np.triu_indices(len(rows), 1)].min()
    filled = (4 / 3 * np.pi * column["radius"]**3).sum() / (0.1 * 0.1 * 0.15)
    assert closest > 0 and column["id"].tolist() == list(range(1, len(rows) + 1))
    print(f"{name:7} for {dialect:8}: {len(rows)} particles fill {filled:.1%} of the box, "
          f"the closest two are {closest * 1e6:.3g} micrometres apart")
