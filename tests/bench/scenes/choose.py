# SPDX-License-Identifier: BSD-3-Clause
"""Only what the scene needs: time and memory against the part of a frame, or of a run, that is kept."""
import numpy

from scene import Packing, Rounds, main, open_dump, points_of, read_again

ARRAYS = ("id", "type", "v", "f", "radius")
ALL = "everything"


def open_some(path, arrays=ARRAYS, **properties):
    reader = open_dump(path, **properties)
    for name in ARRAYS:
        reader.GetPointDataArraySelection().SetArraySetting(name, name in arrays)
    return reader


def study_of(study):
    packing = Packing(layers=study.pick(21, 1), lattice=study.pick(63, 8))
    text = packing.write(study.folder / "one.dump", "%g")
    # name: (part of the values or particles that is kept, reader)
    region = lambda part: {"RegionOfInterest": (0, part, -1, 2, -1, 2)}  # noqa: E731
    choices = {ALL: (1, open_some(text))}
    for count, arrays in ((9, ("id", "v", "f", "radius")), (7, ("v", "radius")), (4, ("radius",)), (3, ())):
        name = "columns: " + " ".join(("points", *arrays))
        values = 3 + sum({"v": 3, "f": 3}.get(array, 1) for array in arrays)
        choices[name] = (values / 12, open_some(text, arrays))
    for stride in (2, 5, 10, 100):
        choices[f"Stride {stride}"] = (1 / stride, open_some(text, Stride=stride))
    for part in (0.5, 0.1, 0.01):
        kept = float((packing.points[:, 0] <= part).mean())
        choices[f"RegionOfInterest {part:g} of the box"] = (kept, open_some(text, **region(part)))
    choices["Vertices None"] = (1, open_some(text, Vertices=0))
    choices["points of every 10th, single, Vertices None"] = (
        0.3 / 12, open_some(text, (), Stride=10, Vertices=0, PointPrecision=0))
    times = Rounds()
    for name, (kept, reader) in choices.items():
        data = read_again(reader)
        study.tell(name, "kept", kept, "1")
        study.tell(name, "memory", 1024 * data.GetActualMemorySize() / packing.rows, "B/particle")
        times.add(name, lambda reader=reader: read_again(reader))
    some, whole = (points_of(read_again(choices[name][1])) for name in ("Stride 5", ALL))
    study.check(numpy.array_equal(some, whole[4::5]), "Stride")
    inside = points_of(read_again(choices["RegionOfInterest 0.1 of the box"][1]))
    study.check(len(inside) == int((numpy.round(packing.points[:, 0], 6) <= 0.1).sum()), "RegionOfInterest")
    times.run(study.pick(7, 1))
    whole = study.cases[ALL]["memory:B/particle"]
    for name in choices:
        study.tell(name, "read", 1e9 * times.time(name) / packing.rows, "ns/particle")
        study.tell(name, "read against everything", times.ratio(name, ALL), "1")
        study.tell(name, "memory against everything", study.cases[name]["memory:B/particle"] / whole, "1")
    frames_of_many(study)


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
        for step in range(frames):
            reader.UpdateTimeStep(float(step))

    def again(frames):
        reader.Modified()
        show(frames)

    times = Rounds()
    times.add("all", lambda: again(20))
    times.add("one", lambda: again(1))
    times.add("open", lambda: open_some(path))
    times.run(study.pick(5, 1))
    for name, case in (("all", "20 frames of 20"), ("one", "1 frame of 20"), ("open", "opening: index of 20 frames")):
        study.tell(case, "kept", {"all": 1, "one": 1 / 20, "open": 1}[name], "1")
        study.tell(case, "read", 1e9 * times.time(name) / packing.rows / 20, "ns/particle")
        study.tell(case, "read against all", times.ratio(name, "all"), "1")


main(study_of)
