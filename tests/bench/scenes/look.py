# SPDX-License-Identifier: BSD-3-Clause
"""Looking at a scene: what double and single points and PointOrigin cost and lose, against the distance from the origin."""
import numpy

from scene import SMALLEST, Packing, Rounds, difference, largest, main, open_dump, points_of, read_again, scientific, table

PLACES = {"0": 0.0, "1e3": 1e3, "1e5": 1e5, "1e7": 1e7}
TIMED = "1e3"
# name: properties; 'origin' stands for the centre of the box
WAYS = {
    "double": {},
    "single": {"PointPrecision": 0},
    "single, PointOrigin": {"PointPrecision": 0, "PointOrigin": "origin"},
}


def study_of(study):
    rows = {name: [f"`{name}`"] for name in WAYS}
    errors = {name: [] for name in WAYS}
    for place, lo in PLACES.items():
        packing = Packing(lo, layers=study.pick(4 if place == TIMED else 1, 1), lattice=study.pick(63, 8))
        path = packing.write(study.folder / f"at_{place}.dump")
        times, readers = Rounds(packing.rows), {}
        for name, wanted in WAYS.items():
            properties = {key: (lo + 0.5,) * 3 if value == "origin" else value for key, value in wanted.items()}
            reader = readers[name] = open_dump(path, **properties)
            points = points_of(read_again(reader))
            error = difference(points, packing.points, properties.get("PointOrigin", (0, 0, 0)))
            # half a step of the double, or of the float, that the point is rounded to
            steps = numpy.spacing(numpy.abs(points)).astype(float) / 2
            study.check((numpy.abs(error) <= steps * (1 + 1e-9) + 1e-300).all(), f"{name}; box at {place}")
            errors[name].append(scientific(largest(error) / SMALLEST))
            times.add(name, lambda reader=reader: read_again(reader))
        if place == TIMED:
            times.run(study.pick(5, 1))
            for name, reader in readers.items():
                data = read_again(reader)
                rows[name] += [points_of(data).nbytes // packing.rows, f"{1024 * data.GetActualMemorySize() / packing.rows:.0f}",
                               f"{times.ns(name):.0f}"]
    study.block("look", "The packing above, text of 17 digits. Errors are the largest of point + PointOrigin, in smallest radii.",
                table(["points", "B/particle of points", "of all arrays", "read ns/particle", *(f"error at {place} [radii]" for place in PLACES)],
                      [rows[name] + errors[name] for name in WAYS]))


main(study_of)
