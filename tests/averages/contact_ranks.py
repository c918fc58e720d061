# SPDX-License-Identifier: BSD-3-Clause
"""Contacts in cells, profiles and at points: any number of ranks find the bits of one."""
import numpy
import vtkgranular as vg
from contact_averages import ALL, GAUSSIAN, OVERLAP, POINTS, PROFILE, Averages
from paraview.simple import *
from vtkmodules.vtkFiltersSources import vtkPlaneSource

import plain_contacts as plain

CORNERS = {"Origin": (-0.015, 0.001, 0), "Point1": (0.015, 0.001, 0), "Point2": (-0.015, 0.001, 0.036)}
for name in ("bed", "periodic_bed", "moving"):
    particles = GranularDumpReader(FileNames=[plain.path(name)])
    lines, walls = (GranularLocalReader(FileNames=[plain.path(name + what)], ColumnMap=plain.COLUMNS[name + what])
                    for what in ("_contacts", "_walls"))
    step = plain.steps(name)[-1]
    ports = {"Input": particles, "Lines": lines, "Walls": walls}
    plane = Plane(**CORNERS, XResolution=8, YResolution=9)
    source = vtkPlaneSource()
    for corner, place in CORNERS.items():
        getattr(source, f"Set{corner}")(*place)
    source.SetResolution(8, 9)
    at_points = Averages(name, "PointAverage", KernelWidth=0.004)
    at_points.filter.SetPointsConnection(source.GetOutputPort())
    cells = {"CellCounts": (4, 3, 5), "KernelWidth": 0.004}
    layers = {"Layers": 5, "KernelWidth": 0.004}
    cases = [(make(**ports, **settings, Weights=weights), Averages(name, Weights=number, OutputType=kind, **cells))
             for weights, number in (("Overlap", OVERLAP), ("Gaussian", GAUSSIAN))
             for make, settings, kind in ((GranularEulerAverage, {**cells, "Output": "Points"}, POINTS), (GranularProfile, layers, PROFILE))]
    for proxy, alone in cases + [(GranularPointAverage(**ports, Points=plane, KernelWidth=0.004), at_points)]:
        proxy.Arrays = ALL
        proxy.UpdatePipeline(step)
        found, expected = vg.fetch(proxy, time=step), alone.update(step)
        for array in ALL:
            values = numpy.asarray(found[array]).reshape(len(expected[array]), -1)
            assert (values == expected[array]).all(), (name, array)
print("the same")
