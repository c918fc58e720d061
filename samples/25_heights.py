# SPDX-License-Identifier: BSD-3-Clause
"""The heights of three grains against time, beside the kinetic energy that the log of the simulation has."""
from pathlib import Path

import numpy as np
import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data" / "time"
particles = vg.reader(data / "falling.dump.gz", dt=2e-5)
ids = [17, 100, 200]

# A table with a row for each frame, and columns for each particle: position (id 17), and so on.
history = GranularHistory(Input=particles, Ids=" ".join(map(str, ids)))
# The log of the same run, two tables of thermo output. Its times are those of the dump.
log = vg.read_log(data / "falling_log.txt")
np.savetxt("energy.csv", np.column_stack((log.times, 1000 * log["KinEng"])), delimiter=",", header="time,energy [mJ]", comments="")
energy = CSVReader(FileName=["energy.csv"])

chart = CreateView("XYChartView")
heights = Show(history, chart, "XYChartRepresentation")
names = [f"position (id {number})_Z" for number in ids]
colors = ((0.12, 0.47, 0.71), (0.17, 0.63, 0.17), (0.58, 0.40, 0.74))


def pairs(names, values):
    return [word for name, value in zip(names, values) for word in (name, str(value))]


vg.set_properties(heights, UseIndexForXAxis=0, XArrayName="time", SeriesVisibility=names,
                  SeriesLabel=pairs(names, (f"grain {number}" for number in ids)),
                  SeriesColor=[word for name, color in zip(names, colors) for word in (name, *map(str, color))],
                  SeriesLineThickness=pairs(names, "222"))
other = Show(energy, chart, "XYChartRepresentation")
vg.set_properties(other, UseIndexForXAxis=0, XArrayName="time", SeriesVisibility=["energy [mJ]"],
                  SeriesPlotCorner=["energy [mJ]", "1"], SeriesColor=["energy [mJ]", "0.84", "0.15", "0.16"],
                  SeriesLineThickness=["energy [mJ]", "2"])
vg.set_properties(chart, LeftAxisTitle="height [m]", BottomAxisTitle="time [s]", RightAxisTitle="kinetic energy [mJ]",
                  LegendLocation="TopRight", ViewSize=[900, 500])
SaveScreenshot("heights.png", chart, ImageResolution=[900, 500], OverrideColorPalette="WhiteBackground")

# The same as numpy arrays.
found = vg.history(particles, ids=ids)
heights = found["position"][:, :, 2]
assert heights.shape == (50, 3) and np.isin(found["timestep"], log.steps).all()
print(f"grains at {', '.join(f'{1000 * height:.1f}' for height in heights[-1])} mm; energy at most "
      f"{1000 * log['KinEng'].max():.1f} mJ, at the end {1000 * log['KinEng'][-1]:.2f} mJ")

# The velocities in the dump have the energy that the log says, to the six digits of the dump.
density = np.array([0, 2500, 1500])
for frame in vg.open(data / "falling.dump.gz"):
    mass = density[frame["type"]] * 4 / 3 * np.pi * frame["radius"] ** 3
    energy = 0.5 * (mass[:, None] * frame["v"] ** 2).sum()
    assert np.isclose(energy, log["KinEng"][log.steps == frame.step][-1], rtol=1e-5)
