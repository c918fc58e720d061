# SPDX-License-Identifier: BSD-3-Clause
"""Only what the scene needs: time and memory against the part of a frame, or of a run, that is kept."""
import numpy

from scene import Packing, Rounds, main, open_dump, points_of, read_again, table

ARRAYS = ("id", "type", "v", "f", "radius")
ALL = "everything"
TENTH = "RegionOfInterest 0.1 of the box"
REGION = (0, 0.1, -1, 2, -1, 2)
# name: arrays, properties
CHOICES = {
    ALL: (ARRAYS, {}),
    "columns: points v radius": (("v", "radius"), {}),
    "columns: points": ((), {}),
    "Stride 2": (ARRAYS, {"Stride": 2}),
    "Stride 5": (ARRAYS, {"Stride": 5}),
    "Stride 100": (ARRAYS, {"Stride": 100}),
    TENTH: (ARRAYS, {"RegionOfInterest": REGION}),
    "Vertices None": (ARRAYS, {"Vertices": 0}),
    "points of every 10th, single, Vertices None": ((), {"Stride": 10, "Vertices": 0, "PointPrecision": 0}),
}


def open_some(path, arrays=ARRAYS, **properties):
    reader = open_dump(path, **properties)
    for name in ARRAYS:
        reader.GetPointDataArraySelection().SetArraySetting(name, name in arrays)
    return reader


def study_of(study):
    packing = Packing(layers=study.pick(21, 1), lattice=study.pick(63, 8))
    text = packing.write(study.folder / "one.dump", "%g")
    readers = {name: open_some(text, arrays, **properties) for name, (arrays, properties) in CHOICES.items()}
    times, memory, points = Rounds(packing.rows), {}, {}
    for name, reader in readers.items():
        data = read_again(reader)
        memory[name] = 1024 * data.GetActualMemorySize() / packing.rows
        points[name] = points_of(data)
        times.add(name, lambda reader=reader: read_again(reader))
    study.check(numpy.array_equal(points["Stride 5"], points[ALL][4::5]), "Stride")
    study.check(len(points[TENTH]) == int((numpy.round(packing.points[:, 0], 6) <= 0.1).sum()), "RegionOfInterest")
    times.run(study.pick(5, 1))
    study.block("choose", "333,396 particles as above, text of %g. One thread, processor time.",
                table(["choice", "read ns/particle", "against everything", "memory B/particle", "against everything"],
                      [[f"`{name}`", f"{times.ns(name):.0f}", f"{times.ratio(name, ALL):.2f}", f"{memory[name]:.0f}",
                        f"{memory[name] / memory[ALL]:.2f}"] for name in readers]), *frames_of_many(study))


def frames_of_many(study):
    """One frame of a file of 20: opening indexes all, showing reads one."""
    packing = Packing(layers=study.pick(3, 1), lattice=study.pick(63, 8))
    frame = packing.write(study.folder / "frame.dump", "%g").read_text(encoding="ascii")
    path = study.folder / "run.dump"
    with open(path, "w", encoding="ascii") as out:
        for step in range(20):
            out.write(frame.replace("ITEM: TIMESTEP\n0\n", f"ITEM: TIMESTEP\n{step}\n", 1))
    reader = open_some(path)

    def show(frames):
        reader.Modified()
        for step in range(frames):
            reader.UpdateTimeStep(float(step))

    times = Rounds(20 * packing.rows)
    times.add("20 frames of 20", lambda: show(20))
    times.add("1 frame of 20", lambda: show(1))
    times.add("opening: index of 20 frames", lambda: open_some(path))
    times.run(study.pick(5, 1))
    return ["A file of 20 frames:", table(["choice", "ns a particle of the run", "against all"], [
        [f"`{name}`", f"{times.ns(name):.1f}", f"{times.ratio(name, '20 frames of 20'):.3f}"] for name in times.contenders])]


main(study_of)
