# SPDX-License-Identifier: BSD-3-Clause
"""Averages of the runs with contacts through the classes of the library, and a second opinion on them by numpy alone."""
import itertools

import numpy

import plain_contacts as plain
import vtkgranular as vg
from contact_sums import arrays_of, local_of, reader_of
from said import said_by

CENTRE, OVERLAP, GAUSSIAN, LUCY, HEAVISIDE = range(5)
POINTS, IMAGE, PROFILE = range(3)
ALL_SPACE, INSIDE = range(2)
ROWS = ("tilted", "tilted_granular")  # periodic in all directions: contacts without places, no walls
SUPPORT = {GAUSSIAN: 3, LUCY: 2, HEAVISIDE: 1}  # in widths
ALL = ["v_avg", "volumefraction", "radius", "pressure", "sigma", "tau", "density", "momentum", "granular_temperature",
       "coordination", "fabric", "sigma_kinetic", "tau_kinetic", "sigma_contact", "tau_contact"]


def change(algorithm, **properties):
    for name, value in properties.items():
        getattr(algorithm, f"Set{name}")(*value if isinstance(value, (tuple, list)) else (value,))


class Averages:
    """A filter after the readers of a run. kind: EulerAverage or PointAverage."""

    def __init__(self, name, kind="EulerAverage", lines=True, walls=True, on=tuple(ALL), **properties):
        self.particles = reader_of("Dump", name)
        self.filter = getattr(vg, "vtkGranular" + kind)()
        self.filter.SetController(None)
        self.filter.SetInputConnection(0, self.particles.GetOutputPort())
        if lines:
            self.lines = local_of(name + "_contacts")
            self.filter.SetLinesConnection(self.lines.GetOutputPort(1 if name in ROWS else 0))
        if walls and name not in ROWS:
            self.walls = local_of(name + "_walls")
            self.filter.SetWallsConnection(self.walls.GetOutputPort())
        self.choose(on)
        self.said = said_by(self.filter)
        change(self.filter, **properties)

    def choose(self, on):
        selection = self.filter.GetArraySelection()
        for name in ALL:
            (selection.EnableArray if name in on else selection.DisableArray)(name)

    def output(self, step=None, **properties):
        """Whatever is said is kept in `said`."""
        self.said.clear()
        change(self.filter, **properties)
        self.filter.UpdateInformation()
        if step is None:
            self.filter.Update()
        else:
            self.filter.UpdateTimeStep(step)
        return self.filter.GetOutputDataObject(0)

    def update(self, step=None, **properties):
        """The arrays by name, two-dimensional; nothing is said."""
        output = self.output(step, **properties)
        assert self.said == [], self.said
        return tables_of(output)


def tables_of(output):
    if output.IsA("vtkTable"):
        attributes = output.GetRowData()
    else:
        attributes = output.GetPointData() if output.IsA("vtkPointSet") else output.GetCellData()
    return {name: values.reshape(len(values), -1) for name, values in arrays_of(attributes).items()}


class Run:
    """Particles, and all contacts as lines: start, branch, force, ends that count; forces of walls are reversed."""

    def __init__(self, name, step, lines=True, walls=True):
        self.particles = plain.Particles(name, step)
        parts = []
        if lines:
            pairs = plain.Contacts(name + "_contacts", step)
            start = self.particles.x[self.particles.rows(pairs.ids[0])] if name in ROWS else pairs.ends[:, 0]
            parts.append((start, plain.branches(self.particles, pairs)[0], pairs.force, 2))
        if walls and name not in ROWS:
            rows = plain.Contacts(name + "_walls", step)
            parts.append((rows.ends[:, 0], rows.ends[:, 1] - rows.ends[:, 0], -rows.force, 1))
        self.start, self.branch, self.force = (numpy.concatenate([part[i] for part in parts]) for i in range(3))
        self.counted = numpy.concatenate([numpy.full(len(part[0]), part[3]) for part in parts])
        self.virial = plain.products(self.branch, self.force)
        self.normals = self.branch / numpy.linalg.norm(self.branch, axis=1)[:, None]
        self.size = numpy.diag(self.particles.vectors)
        self.periodic = (pairs if lines else rows).periodic
        self.v = self.particles.frame.stack(["vx", "vy", "vz"])

    def images(self):
        """What to add for each image."""
        most = 1 if (numpy.diag(self.size) == self.particles.vectors).all() else 2  # in a tilted box others come near
        return [numpy.array(each) @ self.particles.vectors for each in
                itertools.product(*(range(-most, most + 1) if flag else (0,) for flag in self.periodic))]

    def wrapped(self):
        """Particles moved between the planes that are the lengths of the box apart, the last axis first."""
        x = self.particles.x.copy()
        for axis in (2, 1, 0):
            x -= numpy.floor((x[:, axis] - self.particles.origin[axis]) / self.size[axis])[:, None] * self.particles.vectors[axis]
        return x


def parts_by_length(run, lo, hi, counts):
    """The part of each line in each cell, x fastest: from slabs along the axes; contacts by cells."""
    parts = numpy.zeros((len(run.start), numpy.prod(counts)))
    for image in run.images():
        spans = []
        for axis in range(3):
            faces = lo[axis] + numpy.arange(counts[axis] + 1) * ((hi[axis] - lo[axis]) / counts[axis])
            with numpy.errstate(divide="ignore"):
                cuts = (faces - (run.start[:, axis] + image[axis])[:, None]) / run.branch[:, axis, None]
            first, last = numpy.minimum(cuts[:, :-1], cuts[:, 1:]), numpy.maximum(cuts[:, :-1], cuts[:, 1:])
            spans.append((numpy.clip(first, 0, 1), numpy.clip(last, 0, 1)))
        from_, to = (numpy.broadcast_arrays(spans[2][end][:, :, None, None], spans[1][end][:, None, :, None],
                                            spans[0][end][:, None, None, :]) for end in (0, 1))
        part = numpy.minimum.reduce(to) - numpy.maximum.reduce(from_)
        parts += numpy.maximum(part, 0).reshape(len(parts), -1)
    return parts


def kernel(kind, width, square):
    """At distances whose squares are given."""
    q = numpy.sqrt(square) / (2 * width)
    shape = {GAUSSIAN: numpy.exp(-2 * q**2), LUCY: (1 + 3 * q) * (1 - q)**3, HEAVISIDE: 1.0}[kind]
    return numpy.where(square < (SUPPORT[kind] * width)**2, shape, 0.0)


def volume_of(kind, width):
    """The integral over all space, by a fine sum."""
    r, weights = numpy.polynomial.legendre.leggauss(60)
    r = SUPPORT[kind] * width * (r + 1) / 2
    inside = kernel(kind, width, r**2)
    return (weights * 4 * numpy.pi * r**2 * inside).sum() * SUPPORT[kind] * width / 2
