# SPDX-License-Identifier: BSD-3-Clause
"""Arrays and frames as files: the text that a simulation code would print, all digits, whole files or the old ones."""
import gzip
import os
import shutil
import warnings

import numpy

import plain_dump
import vtkgranular as vg

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")


def text_of(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rt", encoding="ascii") as stream:
        return stream.read()


def raises(kind, call, *words):
    try:
        call()
    except kind as error:
        assert all(word in str(error) for word in words), error
        return
    raise AssertionError(f"expected {kind}")


# arrays: types, words, vectors, the order of the columns
arrays = {"id": [7, 5], "element": ["Fe", "Cu"], "points": [[0.5, 1, 1.5], [2, 2.5, 0.1]], "v": [[1, 0, 0], [0, -1e-300, 3]],
          "type": numpy.array([1, 2], dtype=numpy.uint8)}
box = vg.Box(lo=(0, 0, 0), hi=(3, 4, 5), boundary="pp pp ff")
vg.write("mine.dump", arrays, box=box, step=42, dialect="LIGGGHTS", columns="id element x y z v", sort=True)
assert text_of("mine.dump") == (
    "ITEM: TIMESTEP\n42\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n0 3\n0 4\n0 5\n"
    "ITEM: ATOMS id element x y z vx vy vz \n5 Cu 2 2.5 0.1 0 -1e-300 3 \n7 Fe 0.5 1 1.5 1 0 0 \n")
vg.write("mine.dump", arrays, box=box, step=1, time=0.25, units="si", dialect="LAMMPS",
         columns=["id", "type", "x", "y", "z"])
assert text_of("mine.dump").startswith("ITEM: UNITS\nsi\nITEM: TIME\n0.25\nITEM: TIMESTEP\n1\n"), text_of("mine.dump")
for name in ("int8", "int16", "int32", "int64", "uint16", "uint32", "uint64", "float32", "float64", "bool"):
    values = numpy.array([0, 1]).astype(name)
    vg.write("types.dump", {"id": [1, 2], "type": [1, 1], "points": numpy.eye(3)[:2], "c_a": values}, box=box)
    assert vg.open("types.dump")[0]["c_a"].tolist() == values.astype(float).tolist(), name
big = numpy.array([2 ** 62 + 1, -2 ** 63])
vg.write("types.dump", {"id": big, "type": [1, 1], "points": numpy.eye(3)[:2]}, box=box)
assert vg.open("types.dump")[0]["id"].tolist() == big.tolist()

# integers that no double holds come back, wherever they stand; others are doubles, as in files of any program
rows = 30000
ids, eye = numpy.arange(1, rows + 1), numpy.zeros((rows, 3))
long = {"type": numpy.full(rows, 2 ** 31), "c_a": numpy.arange(rows), "c_n": numpy.zeros((rows, 2), int), "c_b": numpy.arange(rows)}
long["c_a"][-1], long["c_n"][7, 1], long["c_n"][rows // 2, 0] = 2 ** 53 + 1, -2 ** 53 - 1, 2 ** 63 - 1
for threads in (1, 3):
    for path in ("long.dump", "long.dump.gz"):
        vg.write(path, {"id": ids, "points": eye, **long}, box=box)
        frame = vg.open(path, threads=threads)[0]
        assert all(numpy.array_equal(frame[name], long[name]) for name in long), path
        assert [frame[name].dtype.name for name in long] == ["int64", "int64", "int64", "float64"]
        half = vg.open(path).read(0, stride=2, threads=threads)
        assert all(numpy.array_equal(half[name], long[name][1::2]) for name in long), path
for name in ("type", "c_a"):
    raises(vg.Error, lambda: vg.write("long.bin", {"id": [1], "points": [[0, 0, 0]], name: [2 ** 53 + 1]}, box=box),  # noqa: B023
           name, "a double can hold")
with open("mixed.dump", "w") as stream:
    stream.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z c_a\n"
                 "1 0 0 0 9007199254740993\n2 0 0 0 1\n3 0 0 0 0.5\n")
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    assert vg.open("mixed.dump")[0]["c_a"].tolist() == [2.0 ** 53, 1, 0.5]
    assert "column 'c_a': expected an integer, got '0.5'; the column is kept as doubles" in str(caught[0].message)

# memory as numpy has it: not contiguous, of the other byte order, of Fortran's order
spread = numpy.random.default_rng(1).random((20, 6))[::2, ::2]
vg.write("memory.dump", {"id": numpy.arange(1, 11)[::-1], "type": [1] * 10, "points": numpy.asfortranarray(spread),
                         "c_b": spread[:, 0].astype(">f8")}, box=box)
frame = vg.open("memory.dump")[0]
assert numpy.array_equal(frame.points, spread) and numpy.array_equal(frame["c_b"], spread[:, 0])

# every digit comes back; tilted and general boxes too
random = numpy.random.default_rng(2)
hard = random.integers(0, 2 ** 64, 3000, dtype=numpy.uint64).view(float)
hard = hard[numpy.isfinite(hard)][:2700].reshape(-1, 3)
for path in ("hard.dump", "hard.dump.gz", "hard.dump.zst", "hard.lammpsbin"):
    tilted = vg.Box(lo=(-1, -2, -3), hi=(1, 2, 3), tilts=(0.1, -0.2, 0.3), boundary="pp pp pp")
    vg.write(path, {"id": numpy.arange(len(hard)), "type": numpy.ones(len(hard), int), "points": hard, "v": hard[::-1]}, box=tilted)
    frame = vg.open(path)[0]
    assert numpy.array_equal(frame.points, hard) and numpy.array_equal(frame["v"], hard[::-1]), path
    assert frame.box == tilted and frame.box.tilts.tolist() == [0.1, -0.2, 0.3]
general = vg.Box(origin=(0.5, 0, 0), vectors=[(2, 1, 0), (-1, 2, 0), (0, 0, 3)], boundary="pp pp pp")
vg.write("general.dump", {"id": [1], "type": [1], "points": [[0.5, 0.5, 0.5]]}, box=general, dialect="LAMMPS")
read = vg.open("general.dump")[0].box
assert numpy.array_equal(read.vectors, general.vectors) and numpy.array_equal(read.origin, general.origin)

# files of real runs get their bytes back, with any number of threads; parts of them are what a plain reading has
for name in ("grains.dump", "ortho_plain.dump", "ortho_scaled.dump", "tri_image.dump", "tri_plain.dump", "chain.dump"):
    for threads in (1, 2, 5):
        vg.write("again.dump", vg.open(os.path.join(GOOD, name)), threads=threads)
        assert text_of("again.dump") == text_of(os.path.join(GOOD, name)), name
run = vg.open(os.path.join(GOOD, "grains.dump"))
vg.write("step_*.dump.gz", run[1:])
assert sorted(name for name in os.listdir() if name.startswith("step_")) == ["step_1000.dump.gz", "step_2000.dump.gz"]
vg.write("some.dump", run, columns="id x y z")
for some, all_ in zip(plain_dump.read("some.dump"), plain_dump.read(os.path.join(GOOD, "grains.dump"))):
    assert list(some.columns) == ["id", "x", "y", "z"] and some.columns["y"] == all_.columns["y"]
vg.write("kept.dump", (run.read(i, stride=3) for i in range(len(run))))
assert [frame.rows for frame in plain_dump.read("kept.dump")] == [sum(int(word) % 3 == 0 for word in text.columns["id"])
                                                                  for text in plain_dump.read(os.path.join(GOOD, "grains.dump"))]
seen = []
vg.write("progress.dump", run, progress=seen.append)
assert seen == sorted(seen) and seen[-1] <= 1 and len(seen) > 2, seen

# what cannot be, and the old file
with open("old.dump", "w") as stream:
    stream.write("old")
point = [[0.0, 0, 0]]
for data, kind, words in (
        ({"id": [1, 2], "points": point}, vg.ArgumentError, ("'points'", "2 rows", "1")),
        ({"points": numpy.zeros((1, 2, 2, 2))}, vg.ArgumentError, ("'points'", "shape")),
        ({"points": point, "v": numpy.array([1j])}, vg.ArgumentError, ("'v'", "complex128")),
        ({"points": [[0.0, 0]]}, vg.ArgumentError, ("'points'", "three", "got 2")),
        ({"v": [[1.0, 2, 3]]}, vg.Error, ("points",)),
        ({"points": point, "x": [7.0]}, vg.ArgumentError, ("'x'", "beside 'points'")),
        ({"points": point, "xu": [7.0]}, vg.ArgumentError, ("'xu'", "beside 'points'")),
        ({"points": point, "c": [[1.0, 2]], "c[1]": [3.0]}, vg.ArgumentError, ("'c[1]'", "columns of its own", "'c'")),
        ({"points": point, "vx": [1.0], "v": [[1.0, 2, 3]]}, vg.ArgumentError, ("'v'", "'vx'")),
        ({"points": point, "m": numpy.ma.array([1.0], mask=[True])}, vg.ArgumentError, ("'m'", "masked")),
        ({"points": point, "id": [1.5]}, vg.Error, ("'id'", "whole numbers", "1.5")),
        ({"points": point, "id": [numpy.nan]}, vg.Error, ("'id'", "whole numbers", "nan"))):
    raises(kind, lambda: vg.write("old.dump", data, box=box), *words)  # noqa: B023
    assert text_of("old.dump") == "old", data
raises(vg.Error, lambda: vg.write("old.dump", {"id": [1], "type": [1], "points": point}, box=box, columns="id radius"), "radius")
raises(vg.ArgumentError, lambda: vg.write("old.dump", {"points": point}, box=box, dialect="VASP"), "LIGGGHTS", "'VASP'")
raises(vg.Error, lambda: vg.write("old.dump", {"points": point}, box=box, numbers="%d"), "%d")
raises(OSError, lambda: vg.write("nowhere/new.dump", {"points": point}, box=box), "nowhere")
raises(vg.Cancelled, lambda: vg.write("old.dump", run, progress=lambda fraction: False))
raises(ZeroDivisionError, lambda: vg.write("old.dump", run, progress=lambda fraction: 1 / 0))
try:
    with vg.Writer("old.dump") as writer:
        writer.write(run[1])
        raise KeyboardInterrupt
except KeyboardInterrupt:
    pass
assert text_of("old.dump") == "old"
raises(ValueError, lambda: writer.write(run[1]), "finished")
assert not [name for name in os.listdir() if "tmp" in name or ".granular" in name], os.listdir()

# a frame that failed in the middle is not published; frames of contacts and of particles are not mixed up; nothing replaces no file
damaged = text_of(os.path.join(GOOD, "grains.dump")).replace(" 0.0025 ", " zero ", 1)
with open("damaged.dump", "w") as stream:
    stream.write(damaged)
raises(vg.Error, lambda: vg.write("old.dump", vg.open("damaged.dump")), "damaged.dump")
contacts = vg.open(os.path.join(GOOD, "local", "contacts.dump"), preset="ContactsForce")
raises(vg.ArgumentError, lambda: vg.write("old.bonds", run[1], style="local"), "lines", "particles")
vg.write("contacts.dump", [contacts[-1]])
assert "ITEM: ENTRIES" in text_of("contacts.dump") or "ITEM: NUMBER OF ATOMS" not in text_of("contacts.dump")
raises(vg.ArgumentError, lambda: vg.write("old.dump", run[3:]), "at least one frame")
raises(vg.ArgumentError, lambda: vg.write("old.dump", [{"points": point}]), "dict")
assert text_of("old.dump") == "old"
vg.write("none.bonds", {"id1": [], "id2": [], "points": numpy.zeros((0, 2, 3))})
assert vg.open("none.bonds")[0].rows == 0
vg.write("single.bonds", {"id1": [1], "id2": [2], "points": numpy.ones((1, 2, 3), numpy.float32)})
vg.write("words.dump", {"id": [1], "type": [1], "element": numpy.array([b"Fe"]), "points": point}, box=box)
assert vg.open("words.dump")[0]["element"].tolist() == ["Fe"]

# a part of a frame is written as it is: nothing is made up
vg.write("few.dump", run.read(1, columns="id radius"))
few, all_ = plain_dump.read("few.dump")[0], plain_dump.read(os.path.join(GOOD, "grains.dump"))[1]
assert list(few.columns) == ["id", "x", "y", "z", "radius"], few.columns.keys()
assert all(few.columns[name] == all_.columns[name] for name in few.columns)

# rows by a mask, indices and slices, as numpy has them: their lines of the file, with its digits, in every form
source = plain_dump.read(os.path.join(GOOD, "grains.dump"))[-1]
frame, types, heights = run[-1], source.numbers("type"), source.numbers("z")
for rows in (types == 2, [5, 3, -1], slice(None, None, 7), (types == 1) & (heights > 0.01), []):
    part = frame[rows]
    vg.write("rows.dump", part)
    places = numpy.arange(len(types))[rows]
    assert all(list(map(plain_dump.read("rows.dump")[0].columns[name].__getitem__, range(len(places)))) ==
               [words[place] for place in places] for name, words in source.columns.items()), rows
    assert part.rows == len(part["vx"]) == len(part.points) == len(places) and part[:2].rows == len(places[:2]) and part.step == frame.step
    vg.write("rows.csv", part, columns="id vx radius")
    assert text_of("rows.csv") == "id,vx,radius\n" + "".join(
        f"{int(source.columns['id'][i])},{float(source.columns['vx'][i])!r},{float(source.columns['radius'][i])!r}\n" for i in places), rows
for rows in (5, [0.5], numpy.ones(3, bool), [1200], [[1]]):
    raises(IndexError, lambda: frame[rows])  # noqa: B023
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    for name in ("local/contacts.dump", "euler_1000.vtk", "decomposition_1000.vtk", "tri_image.dump"):
        of_file = vg.open(os.path.join(GOOD, name))
        for path, each in (("whole", of_file), ("rows", [frame[:] for frame in of_file])):
            vg.write(f"{path}.any", each, style={"dump": "custom"}.get(of_file.kind, of_file.kind))
        assert text_of("whole.any") == text_of("rows.any"), name

# tables and numpy: all digits, several frames with their times, a file for each
hard = numpy.concatenate([hard.ravel(), [-0.0, 5e-324, numpy.nan, -numpy.inf]])
single = (numpy.arange(len(hard)) / 3).astype(">f4")
given = {"id": numpy.arange(len(hard)), "c_a": hard, "c_b": single[:, None], "word": ["a,\"b"] * len(hard), "tau": numpy.ones((len(hard), 3))}
vg.write("all.csv", given)
assert text_of("all.csv").startswith("id,c_a,c_b,word,tau_XY,tau_XZ,tau_YZ\n")
table = numpy.genfromtxt("all.csv", delimiter=",", names=True, usecols=(0, 1, 2))
assert table["c_a"].tobytes() == hard.tobytes() and table["c_b"].astype(">f4").tobytes() == single.tobytes()
vg.write("all.npz", {**given, "points": numpy.ones((len(hard), 3))}, step=7, box=box)
arrays_back = numpy.load("all.npz")
assert arrays_back["c_a"].tobytes() == hard.tobytes() and arrays_back["step"] == 7 and arrays_back["points"].shape == (len(hard), 3)
vg.write("run.csv", run, columns="id x")
table = numpy.genfromtxt("run.csv", delimiter=",", names=True)
assert table.dtype.names == ("step", "time", "id", "x") and set(table["step"]) == {1000, 2000}  # the first frame is empty
assert all(numpy.array_equal(table["x"][table["step"] == each.step], each["x"]) for each in run[1:])
vg.write("run_*.csv", run, columns="id x", sort=True)
assert text_of("run_0.csv") == "id,x\n" and numpy.array_equal(numpy.genfromtxt("run_2000.csv", delimiter=",", names=True)["id"], sorted(frame["id"]))
for data, path, kind, words in (
        (run, "none.npz", ValueError, ("* for the timestep", "none.npz")), ([frame, frame], "none_*.npz", ValueError, ("two of step 2000",)),
        ([frame, of_file[0]], "none.csv", vg.ArgumentError, ("none.csv", "step 0", "choose columns")), ([], "none.csv", vg.ArgumentError, ("none",)),
        ({"points": [[0.0, 0]]}, "none.csv", vg.ArgumentError, ("'points'", "3 numbers"))):
    raises(kind, lambda: vg.write(path, data), *words)  # noqa: B023
    assert not os.path.exists(path), path
raises(vg.ArgumentError, lambda: vg.write("none.csv", run, numbers="%.3g", label="ROWS"), "none.csv: expected no numbers, label")

# names that say nothing of the format, and the files that are read
for name in ("a.xyz", "a.csv.gz"):
    raises(vg.ArgumentError, lambda: vg.write(name, run[1]), "ends in one of", name)  # noqa: B023
    assert not os.path.exists(name)
vg.write("any.name", run[1], style="custom")
for step in (0, 1):
    vg.write(f"own_{step}.dump", arrays, box=box, step=step)
before = [text_of(f"own_{step}.dump") for step in (0, 1)]
vg.write("own_*.dump", vg.open("own_*.dump"))
assert [text_of(f"own_{step}.dump") for step in (0, 1)] == before

# files that are read are replaced last, under any of their names: each frame is there afterwards
shutil.rmtree("inputs", ignore_errors=True)
os.makedirs("inputs/post")
os.chdir("inputs")
os.symlink("post", "link")
for steps in ((0, 1, 2), (3, 4)):
    with vg.Writer(f"post/run_{steps[0]}.dump") as writer:
        for step in steps:
            writer.write(arrays, box=box, step=step)
vg.write("link/run_*.dump", vg.open("post/run_*.dump"))
names = [f"run_{step}.dump" for step in range(5)]
assert sorted(os.listdir("post")) == names
assert [vg.open(f"post/{name}").steps.tolist() for name in names] == [[0], [1], [2], [3], [4]]

# one whose last frame a simulation is writing, and pieces of frames, are not replaced
with open("post/run_4.dump", "a") as stream:
    stream.write("ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n")
for rank in range(4):
    shutil.copy(os.path.join(GOOD, f"pieces_1000.{rank}.dump"), f"post/piece.{rank}.dump")
os.symlink("post/run_4.dump", "four.dump")
before = {name: text_of(f"post/{name}") for name in os.listdir("post")}
for pattern, name, why in (("post/run_*.dump", "link/run_*.dump", "not complete"), ("post/run_*.dump", "four.dump", "not complete"),
                           ("post/piece.%.dump", "link/piece.%.dump", "rest of its frames"),
                           ("post/piece.%.dump", "link/piece.3.dump", "rest of its frames")):
    raises(vg.ArgumentError, lambda: vg.write(name, vg.open(pattern)), "one that is read", why)  # noqa: B023
    assert {name: text_of(f"post/{name}") for name in os.listdir("post")} == before, name
os.chdir("..")
raises(PermissionError if os.getuid() else OSError, lambda: vg.write("/proc/new.dump", arrays, box=box), "/proc/new.dump")

# root leaves a user's file the user's
if os.getuid() == 0:
    for name, write in (("user.dump", lambda: vg.write("user.dump", run[1])),
                        ("user.series", lambda: vg.write_series("step_1000.dump.gz", 1, "user.series"))):
        with open(name, "w"):
            pass
        os.chown(name, 1234, 2345)
        write()
        assert (os.stat(name).st_uid, os.stat(name).st_gid) == (1234, 2345) and os.path.getsize(name) > 0, name

# time and units of a file are kept
vg.write("units.dump", {"id": [1], "type": [1], "points": point}, box=box, units="si", time=0.25)
vg.write("kept.dump", vg.open("units.dump"))
assert text_of("kept.dump") == text_of("units.dump") and "ITEM: UNITS" in text_of("kept.dump") and "ITEM: TIME\n" in text_of("kept.dump")

# notices are warnings, at the line of who called
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    vg.write("bounds.dump", arrays, box=[(0, 3), (0, 4), (0, 5)])
    assert "boundaries" in str(caught[-1].message) and vg.open("bounds.dump")[0].box.hi.tolist() == [3, 4, 5]
    vg.write("no_box.dump", {"id": [1, 2], "type": [1, 1], "points": [[0.0, 0, 0], [1, 1, 1]]})
assert caught and all(each.filename == __file__ for each in caught), [str(each) for each in caught]
# words that would break a line are refused, in one line
arrays["element"] = ["Fe", "H\nx"]
raises(vg.Error, lambda: vg.write("broken.dump", arrays, box=box), r"got 'H\nx'")
raises(vg.ArgumentError, lambda: vg.write("broken.dump", run[1], dialect="a\nb"), r"got 'a\nb'")
print("written")
