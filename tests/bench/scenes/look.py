# SPDX-License-Identifier: BSD-3-Clause
"""Looking at a scene: what double and single points and PointOrigin cost and lose, against the distance from the origin."""
from fractions import Fraction

import numpy

from scene import (SMALLEST, SPACING, Packing, Rounds, difference, main, open_dump, points_of, read_again, tell_error)

POWERS = range(13)
TIMED = 3  # the power of ten at which times are taken
# name: properties; 'origin' stands for the centre of the box
WAYS = {
    "double": {},
    "double, PointOrigin": {"PointOrigin": "origin"},
    "single": {"PointPrecision": 0},
    "single, PointOrigin": {"PointPrecision": 0, "PointOrigin": "origin"},
}
ULP = 2.0 ** -52


def distances(study):
    for power in POWERS:
        lo = 10.0 ** power if power else 0.0
        packing = Packing(lo, layers=study.pick(4, 1), lattice=study.pick(63, 8))
        path = packing.write(study.folder / f"at_1e{power}.dump")
        centre = (lo + 0.5,) * 3
        times = Rounds()
        for name, wanted in WAYS.items():
            properties = {key: centre if value == "origin" else value for key, value in wanted.items()}
            reader = open_dump(path, **properties)
            points = points_of(read_again(reader))
            error = difference(points, packing.points, properties.get("PointOrigin", (0, 0, 0)))
            case = f"{name}; box at 1e{power}" if power else f"{name}; box at 0"
            tell_error(study, case, "position", error, SMALLEST, "radius")
            # Half a step of the double, and of the float, that the point is rounded to.
            steps = numpy.spacing(numpy.abs(points)).astype(float) / 2
            study.check((numpy.abs(error) <= steps * (1 + 1e-9) + 1e-300).all(), case)
            if power == TIMED:
                times.add(name, lambda reader=reader: read_again(reader))
                study.tell(name, "points", points.nbytes / packing.rows, "B/particle")
                study.tell(name, "data", 1024 * reader.GetOutput().GetActualMemorySize() / packing.rows, "B/particle")
        if power == TIMED:
            times.run(study.pick(7, 1))
            for name in WAYS:
                study.tell(name, "read", 1e9 * times.time(name) / packing.rows, "ns/particle")
                study.tell(name, "read against double", times.ratio(name, "double"), "1")
        path.unlink()


# bounds of the box along x, y, z, and tilts xy xz yz, of doubles that are exact in text
BOXES = {
    "flat": ((0, 1), (0, 1), (0, 1), (0, 0, 0)),
    "flat, far": ((1e6, 1e6 + 1), (-1e6, -1e6 + 1), (1e6, 1e6 + 1), (0, 0, 0)),
    "tilted": ((-0.1, 1.2), (0.3, 1.3), (7, 8.5), (0.4, -0.3, 0.45)),
    "tilted, far": ((1e6, 1e6 + 1), (-1e6, -1e6 + 1), (1e6, 1e6 + 1), (0.49, -0.37, 0.42)),
}


def outside(xy, xz, yz):
    """xlo_bound - xlo and so on, and xhi_bound - xhi: documentation of LAMMPS, "Triclinic simulation boxes"."""
    xy, xz, yz = Fraction(xy), Fraction(xz), Fraction(yz)
    return (min(0, xy, xz, xy + xz), min(0, yz), 0), (max(0, xy, xz, xy + xz), max(0, yz), 0)


def scaled_positions(study, crossings):
    """Scaled coordinates become positions: all arithmetic of the truth in fractions."""
    random = numpy.random.default_rng(3)
    rows = study.pick(20_000, 500)
    for box, (*bounds, (xy, xz, yz)) in BOXES.items():
        scaled = random.uniform(0, 1, (rows, 3)).tolist()
        images = random.integers(-crossings, crossings, (rows, 3), endpoint=True).tolist()
        below, above = outside(xy, xz, yz)
        told = [(float(axis[0] + below[k]), float(axis[1] + above[k])) for k, axis in enumerate(bounds)]
        is_tilted = any((xy, xz, yz))
        lines = [(*pair, tilt) if is_tilted else pair for pair, tilt in zip(told, (xy, xz, yz))]
        text = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(rows),
                "ITEM: BOX BOUNDS " + ("xy xz yz " if is_tilted else "") + "pp pp pp"]
        text += [" ".join(map(repr, line)) for line in lines]
        # What the file says of the box is the truth: corner and lengths from its numbers, in fractions.
        lo = [Fraction(told[k][0]) - below[k] for k in range(3)]
        hi = [Fraction(told[k][1]) - above[k] for k in range(3)]
        edges = ((hi[0] - lo[0], 0, 0), (Fraction(xy), hi[1] - lo[1], 0), (Fraction(xz), Fraction(yz), hi[2] - lo[2]))
        truth = [[lo[k] + sum((Fraction(s) + n) * edge[k] for s, n, edge in zip(where, image, edges)) for k in range(3)]
                 for where, image in zip(scaled, images)]
        text.append("ITEM: ATOMS id type xs ys zs ix iy iz ")
        text += [" ".join(map(str, (i, 1, *map(repr, where), *image)))
                 for i, (where, image) in enumerate(zip(scaled, images), 1)]
        path = study.folder / "scaled.dump"
        path.write_text("\n".join(text) + "\n", encoding="ascii")
        points = points_of(read_again(open_dump(path, Coordinates=1))).tolist()
        wrong = [float(abs(Fraction(x) - t)) / float(numpy.spacing(abs(float(t)))) if t else float(abs(Fraction(x)))
                 for row, true in zip(points, truth) for x, t in zip(row, true)]
        case = f"{box}, unwrapped after up to 2^{crossings.bit_length() - 1} crossings"
        tell_error(study, case, "position", wrong, 1, "ulp")
        study.check(max(wrong) <= 0.5 + 1e-9, f"{case}: {max(wrong)} ulp")


def layer(study):
    """A layer of particles in a plane, far away, for a picture: where they are, in single precision, and with PointOrigin."""
    lo = 3e5
    packing = Packing(lo, layers=1)
    path = packing.write(study.folder / "layer.dump")
    origin = (lo + 0.5,) * 3
    shown = packing.points[:, 2] < lo + SPACING * 0.6
    single = points_of(read_again(open_dump(path, PointPrecision=0))).astype(float) - lo
    near = points_of(read_again(open_dump(path, PointPrecision=0, PointOrigin=origin))).astype(float) + 0.5
    for name, points in (("single", single), ("single, PointOrigin", near)):
        for axis, k in (("x", 0), ("y", 1)):
            values = points[shown, k] / SPACING
            for i in numpy.flatnonzero((packing.points[shown, :2] < lo + 9 * SPACING).all(1)):
                study.tell("layer", f"{name}, {axis} of {i}", values[i], "lattice constants")


def study_of(study):
    distances(study)
    layer(study)
    scaled_positions(study, 2 ** 20)


main(study_of)
