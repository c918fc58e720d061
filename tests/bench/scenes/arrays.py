# SPDX-License-Identifier: BSD-3-Clause
"""Arrays without a viewer: reading into numpy against other programs, what Python adds to the C interface, and conversions against
reading and writing alone. Time on the wall, all cores, opening included where it says so."""
import importlib.util
import time

import numpy

import granular
from scene import COLUMNS, LATTICE, Packing, Rounds, main

CONVERTED = "id type x y z radius"


def arrays_of(packing):
    return {"id": numpy.arange(1, packing.rows + 1), "type": numpy.ones(packing.rows, int), "points": packing.points, "v": packing.v,
            "f": packing.f, "radius": packing.radius}


def read_pandas(path):
    import pandas
    return pandas.read_csv(path, sep=" ", skiprows=9, header=None, usecols=range(len(COLUMNS)))


def read_ase(path):
    from ase.io import read
    return read(path, format="lammps-dump-text", units="metal")


def add_readers(study, path, packing):
    """All columns of one large frame, opening included."""
    times, slow = Rounds(time.perf_counter), Rounds(time.perf_counter)
    times.add("granular.open, all columns", lambda: granular.open(path)[0].read())
    times.add("granular.open, all columns, 1 thread", lambda: granular.open(path).read(threads=1))
    if importlib.util.find_spec("pandas"):
        frame = read_pandas(path)
        study.check((frame[5].to_numpy() == granular.open(path)[0]["v"][:, 0]).all(), "pandas and granular")
        times.add('pandas.read_csv, sep=" "', lambda: read_pandas(path))
    times.run(study.pick(3, 1))
    if importlib.util.find_spec("ase"):
        slow.add("ASE, lammps-dump-text", lambda: read_ase(path))
        slow.run(1)
    ours = times.time("granular.open, all columns")
    for rounds in (times, slow):
        for case in rounds.contenders:
            study.tell(case, "time", 1e9 * rounds.time(case) / packing.rows, "ns/particle")
            study.tell(case, "against granular.open", rounds.time(case) / ours, "1")


def add_view(study, path, packing):
    """One array of an open run: numpy's view, and the C interface alone."""
    run, times = granular.open(path), Rounds(time.perf_counter)
    times.add("array v of an open run", lambda: run[0]["v"])
    times.add("the same by the C interface", lambda: run._read(0, ["v"], False, {}, None))
    times.run(study.pick(15, 1))
    for case in times.contenders:
        study.tell(case, "time", 1e9 * times.time(case) / packing.rows, "ns/particle")
        study.tell(case, "against the C interface", times.ratio(case, "the same by the C interface"), "1")


def add_conversions(study, packing):
    """Ten frames; a conversion does both, and reads the next frame while it writes."""
    path, arrays = str(study.folder / "series.dump"), arrays_of(packing)
    with granular.Writer(path, numbers="%g") as writer:
        for step in range(10):
            writer.write(arrays, box=granular.Box((0, 0, 0), (1, 1, 1), boundary="pp pp pp"), step=step)
    out = {ending: str(study.folder / f"out.dump{ending}") for ending in ("", ".zst")}
    run, times = granular.open(path), Rounds(time.perf_counter)
    frames = [frame.read() for frame in granular.open(path)]
    times.add("read: all columns", lambda: [run[i].read() for i in range(10)])
    times.add("write: six columns of text", lambda: granular.write(out[""], frames, columns=CONVERTED))
    times.add("write: Zstandard", lambda: granular.write(out[".zst"], frames))
    times.add("convert: six columns of text", lambda: granular.write(out[""], run, columns=CONVERTED))
    times.add("convert: Zstandard", lambda: granular.write(out[".zst"], run))
    times.run(study.pick(3, 1))
    for case in times.contenders:
        study.tell(case, "time", 1e9 * times.time(case) / packing.rows / 10, "ns/particle")
    for what in ("six columns of text", "Zstandard"):
        alone = times.time("read: all columns") + times.time(f"write: {what}")
        study.tell(f"convert: {what}", "against reading and writing", times.time(f"convert: {what}") / alone, "1")
        study.tell(f"convert: {what}", "against writing", times.ratio(f"convert: {what}", f"write: {what}"), "1")


def study_of(study):
    packing = Packing(layers=study.pick(LATTICE, 1), lattice=study.pick(LATTICE, 8))
    path = str(study.folder / "frame.dump")
    granular.write(path, arrays_of(packing), box=granular.Box((0, 0, 0), (1, 1, 1), boundary="pp pp pp"), numbers="%g")
    add_readers(study, path, packing)
    add_view(study, path, packing)
    add_conversions(study, Packing(layers=study.pick(6, 1), lattice=study.pick(LATTICE, 8)))


main(study_of)
