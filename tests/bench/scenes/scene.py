# SPDX-License-Identifier: BSD-3-Clause
"""What the studies of scenes share: a packing whose true values are known, times in turns, and blocks of Markdown.

The packing is a block of an FCC lattice that is stretched by 5 % along x, in a box of length 1: the part of a box of 10^6
particles that is 4 lattice cells high, and so 63,504 particles with radii from 4.7e-3 to 5.3e-3. Each particle is displaced by up to 1e-3
lattice constants, so that no coordinate is a short decimal. Its doubles are the truth. Errors are differences of two
doubles near each other, which a subtraction gives exactly (Sterbenz); where an origin was subtracted from points, the
subtraction is compensated."""
import argparse
import statistics
import tempfile
import time
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject

import vtkgranular as vg

LATTICE = 63  # cells of the lattice along the box
STRAIN = 0.05
SPACING = 1 / (LATTICE * (1 + STRAIN) + 1)
NEAREST = SPACING / 2 ** 0.5
RADIUS = NEAREST / 2     # of the largest particles
SMALLEST = 0.9 * RADIUS  # errors of positions are told in units of it
COLUMNS = ("id", "type", "x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz", "radius")


class Study:
    """How much is to be measured, and what is told: blocks of Markdown, and pictures."""

    def __init__(self, options, folder):
        self.quick, self.large, self.out, self.folder = options.quick, options.large, Path(options.out), Path(folder)

    def pick(self, for_full, for_quick):
        return for_quick if self.quick else for_full

    def check(self, truth, what):
        if not truth:
            raise SystemExit(f"wrong result: {what}")

    def block(self, name, *paragraphs):
        """Writes NAME.md: a paragraph is a text, or the lines of a table."""
        lines = [text if isinstance(text, str) else "\n".join(text) for text in paragraphs]
        (self.out / f"{name}.md").write_text("\n\n".join(lines) + "\n", encoding="utf-8")

    def picture(self, name, draw):
        """Writes NAME.png, if matplotlib is there; draw(pyplot) returns a figure."""
        try:
            import matplotlib
            matplotlib.use("Agg")
            from matplotlib import pyplot
        except ImportError:
            return
        draw(pyplot).savefig(self.out / f"{name}.png", dpi=100)


def table(head, rows):
    """Lines of Markdown; None is an empty cell."""
    cells = [["" if cell is None else str(cell) for cell in row] for row in (head, *rows)]
    lines = ["| " + " | ".join(row) + " |" for row in cells]
    return [lines[0], "|---" + "|--:" * (len(head) - 1) + "|", *lines[1:]]


def scientific(value):
    return "0" if value == 0 else f"{value:.1e}".replace("e-0", "e-").replace("e+0", "e+")


def main(study_of):
    """Runs a study: program [--quick | --large] --out FOLDER. Fails where a result is wrong, never on time."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--out", required=True)
    options = parser.parse_args()
    vtkObject.GlobalWarningDisplayOff()  # writers warn of lost digits, which are what is measured here
    with tempfile.TemporaryDirectory() as folder:
        study_of(Study(options, folder))


class Rounds:
    """Contenders that take turns; a time is the median over rounds, a ratio the median of ratios within a round."""

    def __init__(self, rows, clock=time.process_time):
        self.rows, self.clock, self.contenders, self.samples = rows, clock, {}, {}

    def add(self, name, work, prepare=None):
        self.contenders[name] = (work, prepare)
        self.samples[name] = []

    def run(self, rounds):
        names = list(self.contenders)
        for turn in range(rounds):
            for k in range(len(names)):
                name = names[(k + turn) % len(names)]
                work, prepare = self.contenders[name]
                prepared = prepare() if prepare else ()
                start = self.clock()
                work(*prepared)
                self.samples[name].append(self.clock() - start)

    def ns(self, name):
        """Nanoseconds a row."""
        return 1e9 * statistics.median(self.samples[name]) / self.rows

    def ratio(self, name, baseline):
        return statistics.median(a / b for a, b in zip(self.samples[name], self.samples[baseline]))


class Packing:
    """The true values: doubles, by column; pairs of rows that are neighbours along the stretched diagonals."""

    def __init__(self, lo=0.0, layers=7, lattice=LATTICE):
        random = numpy.random.default_rng(7)
        sites = numpy.array([(0, 0, 0), (.5, .5, 0), (.5, 0, .5), (0, .5, .5)])
        grid = numpy.stack(numpy.meshgrid(*(numpy.arange(n) for n in (lattice, lattice, layers)), indexing="ij"), -1)
        site = (grid.reshape(-1, 1, 3) + sites).reshape(-1, 3)
        moved = site + 1e-3 * random.uniform(-1, 1, site.shape)
        self.lo, self.hi = lo, lo + 1.0
        self.points = lo + SPACING * (0.5 + moved * (1 + STRAIN, 1, 1))
        self.v = 0.1 * random.standard_normal(site.shape)
        self.f = 1e-3 * random.lognormal(0, 1.5, site.shape) * random.choice((-1, 1), site.shape)
        self.radius = RADIUS * random.uniform(0.9, 1, len(site))
        self.rows = len(site)
        first = numpy.arange(0, self.rows, 4)
        self.pairs = (first, first + 1)  # sites (0, 0, 0) and (.5, .5, 0) of a cell
        self.strain = self.strain_of(self.points)

    def strain_of(self, points):
        """Of the pairs: length / length in the lattice at rest - 1."""
        difference = points[self.pairs[1]].astype(numpy.longdouble) - points[self.pairs[0]]
        return numpy.sqrt((difference ** 2).sum(1)) / NEAREST - 1

    def write(self, path, text="%.17g"):
        """A dump custom by Python alone."""
        word = (lambda value: repr(float(value))) if text == "shortest" else (lambda value: text % value)
        bounds = f"{self.lo:.17g} {self.hi:.17g}\n"
        with open(path, "w", encoding="ascii") as out:
            out.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{self.rows}\nITEM: BOX BOUNDS pp pp pp\n"
                      f"{3 * bounds}ITEM: ATOMS {' '.join(COLUMNS)} \n")
            values = numpy.column_stack((self.points, self.v, self.f, self.radius)).tolist()
            for row, reals in enumerate(values, 1):
                out.write(f"{row} 1 {' '.join(map(word, reals))} \n")
        return path


def open_dump(path, **properties):
    """A reader of one thread that has looked at the headers."""
    reader = vg.vtkGranularDumpReader()
    reader.AddFileName(str(path))
    for name, value in {"Threads": 1, **properties}.items():
        getattr(reader, "Set" + name)(*value if isinstance(value, (tuple, list)) else (value,))
    reader.UpdateInformation()
    return reader


def read_again(reader):
    """Reads the frame again: a property of the pipeline alone has changed."""
    reader.Modified()
    reader.Update()
    if reader.GetErrorCode():
        raise SystemExit("a file could not be read: nothing would be quicker")
    return reader.GetOutput()


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def array_of(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def difference(points, truth, origin=(0.0, 0.0, 0.0)):
    """points + origin - truth, as if without rounding: truth - origin is a double and its rest."""
    origin = numpy.asarray(origin)
    high = truth - origin
    virtual = truth - high
    low = (truth - (high + virtual)) + (virtual - origin)
    return (points.astype(float) - high) - low


def lengths(vectors):
    return numpy.sqrt((numpy.asarray(vectors, dtype=numpy.longdouble) ** 2).sum(1))


def largest(error):
    """The largest magnitude of numbers, or length of vectors."""
    return float((lengths(error) if numpy.ndim(error) == 2 else numpy.abs(error)).max())
