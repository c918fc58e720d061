# SPDX-License-Identifier: BSD-3-Clause
"""Paths in a box far from the origin, whose dumps have scaled coordinates of all digits: with PointOrigin nothing is lost, from
files and through a filter, as exact fractions say."""
import runpy
import sys
from fractions import Fraction

if __name__ == "__main__":  # where the scripts of filters leave names such as split
    runpy.run_path(__file__, run_name="apart")
    sys.exit()

import numpy
from paraview.simple import *

import plain_paths

FAR, STEPS, PARTICLES = 1000000000, 5, 20
ORIGIN = [FAR, -FAR, 3 * FAR]
random = numpy.random.default_rng(3)
start = random.random((PARTICLES, 3))
walk = numpy.cumsum(1e-6 * random.standard_normal((STEPS, PARTICLES, 3)), axis=0)
scaled = start + walk  # a few leave the box
images = numpy.floor(scaled).astype(int)
inside = scaled - images
places = [[[Fraction(x) + int(i) for x, i in zip(*row)] for row in zip(*frame)] for frame in zip(inside, images)]  # less ORIGIN


def frame(step):
    bounds = "".join(f"{lo} {lo + 1}\n" for lo in ORIGIN)
    rows = "".join(f"{k + 1} 1 {' '.join('%.17g' % x for x in inside[step, k])} {' '.join(map(str, images[step, k]))}\n"
                   for k in range(PARTICLES))
    return (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{PARTICLES}\nITEM: BOX BOUNDS pp pp pp\n{bounds}"
            f"ITEM: ATOMS id type xs ys zs ix iy iz\n{rows}")


with open("far.dump", "w", encoding="ascii") as out:
    out.write("".join(map(frame, range(STEPS))))

moved = [[[b - a for a, b in zip(*pair)] for pair in zip(places[0], now)] for now in places]
msd = [float(sum(x * x for row in rows for x in row) / PARTICLES) for rows in moved]
assert 1e-12 < msd[1] < 1e-11
reader = GranularDumpReader(FileNames=["far.dump"], PointOrigin=ORIGIN)
beside = ProgrammableFilter(Input=reader, Script="self.GetOutput().ShallowCopy(self.GetInput())", CopyArrays=0)
for source in (reader, beside):
    for split in ("Unwrapped", "Split"):
        paths = GranularTrajectories(Input=source, PeriodicLines=split)
        paths.UpdatePipeline()
        data = servermanager.Fetch(paths)
        lines = plain_paths.lines_of(paths.GetClientSideObject().GetOutput())
        if split == "Unwrapped":
            for k in range(PARTICLES):
                (line,) = lines[k + 1]
                for step in range(STEPS):
                    for axis in range(3):
                        assert abs(Fraction(line["points"][step][axis]) - (places[step][k][axis] - int(images[0, k, axis]))) < 2e-16
                        assert abs(Fraction(line["displacement"][step][axis]) - moved[step][k][axis]) < 4e-16
        else:
            points = numpy.array([point for some in lines.values() for line in some for point in line["points"]])
            assert len(points) >= PARTICLES * STEPS and points.min() >= -1e-15 and points.max() <= 1 + 1e-15
    history = GranularHistory(Input=source, MeanSquareDisplacement=1)
    history.UpdatePipeline()
    table = servermanager.Fetch(history)
    found = [table.GetColumnByName("msd").GetValue(step) for step in range(STEPS)]
    assert all(abs(a - b) <= 1e-9 * b for a, b in zip(found, msd)), (found, msd)
