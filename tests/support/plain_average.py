# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on averages of grains over cells, written with the simplest means and sharing no code."""
import numpy


def particles(frame):
    """What a frame of plain_dump has, as averages need it."""
    return {"x": frame.stack(["x", "y", "z"]), "v": frame.stack(["vx", "vy", "vz"]),
            "radius": frame.numbers("radius"), "mass": frame.numbers("mass")}


def faces(lo, hi, count):
    return numpy.append(lo + numpy.arange(count) * ((hi - lo) / count), hi)


def _find(along, places):
    """The cells between such faces: lo <= x < hi, with the last face in the last cell; -1: none."""
    cells = numpy.searchsorted(along, places, side="right") - 1
    cells[places == along[-1]] = len(along) - 2
    cells[cells > len(along) - 2] = -1
    return cells


def by_centres(particles, lo, hi, counts, periodic):
    """Grain, cell and share of each grain whose centre is in a cell."""
    indices = []
    for axis in range(3):
        places = particles["x"][:, axis].copy()
        if axis in periodic:  # by whole lengths of the box, which is the grid's
            length = hi[axis] - lo[axis]
            places -= length * numpy.floor((places - lo[axis]) / length)
        indices.append(_find(faces(lo[axis], hi[axis], counts[axis]), places))
    i, j, k = indices
    inside = (i >= 0) & (j >= 0) & (k >= 0)
    cells = (k * counts[1] + j) * counts[0] + i
    return numpy.flatnonzero(inside), cells[inside], numpy.ones(inside.sum())


def by_slabs(particles, axis, lo, hi, count, periodic):
    """Of cells that are slabs, as wide as all grains: a sphere below a plane is a cap."""
    along, radius = faces(lo, hi, count), particles["radius"]
    parts = []
    for image in (-1, 0, 1) if periodic else (0,):
        places = particles["x"][:, axis] + image * (hi - lo)
        height = numpy.clip(radius + along[:, None] - places, 0, 2 * radius)
        below = height**2 * (3 * radius - height) / (4 * radius**3)
        cell, particle = numpy.nonzero(numpy.diff(below, axis=0) > 0)
        parts.append((particle, cell, numpy.diff(below, axis=0)[cell, particle]))
    return [numpy.concatenate(part) for part in zip(*parts)]


def sums(particles, shares, size):
    """Mass and momentum in each cell."""
    particle, cell, share = shares
    weight = share * particles["mass"][particle]
    momentum = [numpy.bincount(cell, weight * particles["v"][particle, k], size) for k in range(3)]
    return numpy.bincount(cell, weight, size), numpy.column_stack(momentum)


def divide(above, below):
    """0 where nothing is below."""
    return numpy.divide(above, below, out=numpy.zeros_like(above), where=below > 0)


def values(particles, shares, size, volume):
    """The arrays of the cells, which have that volume, by name."""
    particle, cell, share = shares
    mass, momentum = sums(particles, shares, size)
    velocity = divide(momentum, mass[:, None])
    apart = particles["v"][particle] - velocity[cell]
    solid = 4 / 3 * numpy.pi * particles["radius"][particle]**3
    energy = numpy.bincount(cell, share * particles["mass"][particle] * (apart**2).sum(axis=1), size)
    found = {"v_avg": velocity, "volumefraction": numpy.bincount(cell, share * solid, size) / volume,
             "radius": divide(numpy.bincount(cell, share * particles["radius"][particle], size),
                              numpy.bincount(cell, share, size)),
             "pressure": energy / volume / 3}
    return {name: rows.reshape(size, -1) for name, rows in found.items()}


def _rounding(numbers, digits=6):
    """How far numbers may be from those that were printed with so many digits."""
    size = numpy.floor(numpy.log10(abs(numbers), out=numpy.full(numbers.shape, -numpy.inf), where=numbers != 0))
    return 0.5 * 10.0 ** (size + 1 - digits)


def uncertainty(particles, shares, size):
    """How far v_avg may be from that of the simulation, which printed its grains with six digits."""
    particle, cell, share = shares
    mass, momentum = sums(particles, shares, size)
    apart = abs(particles["v"][particle] - divide(momentum, mass[:, None])[cell])
    of_masses = share[:, None] * _rounding(particles["mass"])[particle, None] * apart
    of_velocities = (share * particles["mass"][particle])[:, None] * _rounding(particles["v"])[particle]
    terms = of_masses + of_velocities
    return divide(numpy.column_stack([numpy.bincount(cell, terms[:, k], size) for k in range(3)]), mass[:, None])


def shared(shares, owners, size):
    """Which cells have grains of several owners."""
    particle, cell, _ = shares
    seen = numpy.zeros((size, owners.max() + 1), bool)
    seen[cell, owners[particle]] = True
    return seen.sum(axis=1) > 1
