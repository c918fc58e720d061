# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of files of real runs are, bit for bit, the numbers that Python reads in their text."""
import os
import sys
from fractions import Fraction

import vtkgranular as vg

# before plain_dump, which needs numpy itself
assert not {"numpy", "vtkmodules", "paraview", "pandas"} & {name.split(".")[0] for name in sys.modules}, "import vtkgranular imports these"

import numpy  # noqa: E402

import plain_dump  # noqa: E402

SAMPLES = os.path.join(os.environ["GRANULAR_ROOT"], "samples", "data")
SOURCE = os.path.join(SAMPLES, "grains.dump")
BINARY = "id type x y z ix iy iz vx vy vz radius"


def same(array, numbers):
    assert numpy.array_equal(array, numbers), (array[:3], numbers[:3])


expected = plain_dump.read(SOURCE)
run = vg.open(SOURCE, dt=2e-5)
assert len(run) == len(expected) == 5 and run.kind == "dump"
assert run.steps.tolist() == [text.timestep for text in expected] == [0, 1000, 2000, 3000, 4000]
assert run.times.tolist() == [0, 0.02, 0.04, 0.06, 0.08]  # step x dt, the double nearest to the decimal product
assert run.rows.tolist() == [text.rows for text in expected]
for frame, text in zip(run, expected):
    assert (frame.step, frame.rows) == (text.timestep, text.rows)
    assert frame.box.lo.tolist() == [row[0] for row in text.bounds] and frame.box.hi.tolist() == [row[1] for row in text.bounds]
    assert frame.box.boundary == "pp pp ff"
    if not text.rows:
        continue
    for name, parts in (("id", "id"), ("radius", "radius"), ("v", "vx vy vz"), ("f", "fx fy fz"), ("omega", "omegax omegay omegaz"),
                        ("x", "x")):
        same(frame[name].reshape(frame.rows, -1), text.stack(parts.split()))
    same(frame.points, text.stack("xyz"))
    assert frame["id"].dtype == numpy.int64 and frame["v"].dtype == float
    assert frame.columns == list(text.columns)

# one column, no copy: a view of memory that the library made, which stays when the frame, the run and its file are gone
frame = run[4]
velocity = frame["v"]
assert frame["v"] is velocity and not velocity.flags.owndata and not velocity.flags.writeable and velocity.shape == (1200, 3)
copy = velocity.copy()
del frame
run.close()
assert numpy.array_equal(velocity, copy)

# a tilted box with scaled coordinates and image counts: within half a unit in the last place of the exact position
path = os.path.join(SAMPLES, "tri_scaled_image.dump")
text = plain_dump.read(path)[-1]
tilted = vg.open(path)[-1]
(xlo, xhi, xy), (ylo, yhi, xz), (zlo, zhi, yz) = [[Fraction(number) for number in row] for row in text.bounds]
low = [xlo - min(0, xy, xz, xy + xz), ylo - min(0, yz), zlo]
high = [xhi - max(0, xy, xz, xy + xz), yhi - max(0, yz), zhi]
edges = [[high[0] - low[0], 0, 0], [xy, high[1] - low[1], 0], [xz, yz, high[2] - low[2]]]
largest = max(abs(number) for row in text.bounds for number in row)
for row, point in list(zip(text.stack(["xs", "ys", "zs"]).tolist(), tilted.points.tolist()))[::7]:
    for axis in range(3):
        exact = low[axis] + sum(Fraction(row[i]) * edges[i][axis] for i in range(3))
        assert abs(exact - Fraction(point[axis])) <= 4 * sys.float_info.epsilon * largest, (row, point, float(exact))
counts = text.stack(["ix", "iy", "iz"])
same(tilted["image"], counts)
assert tilted.box.vectors.tolist() == [[float(number) for number in edge] for edge in edges]  # each rounded once
moved = vg.open(path).read(coordinates="unwrapped").points - tilted.points
assert numpy.allclose(moved, counts @ tilted.box.vectors, rtol=0, atol=1e-12)

# binary files, compressed files and pieces
text = plain_dump.read_binary(os.path.join(SAMPLES, "grains.bin"), BINARY)[-1]
binary = vg.open(os.path.join(SAMPLES, "grains.bin"), column_names=BINARY)[-1]
same(binary["v"], text.stack(["vx", "vy", "vz"]))
same(binary.points, text.stack("xyz"))
packed = vg.open(os.path.join(SAMPLES, "compressed", "ortho_*.dump.gz"))
assert len(packed) == 3
for frame in packed:
    text = plain_dump.read(os.path.join(SAMPLES, "compressed", f"ortho_{frame.step:06d}.dump.gz"))[0]
    same(frame["id"], text.numbers("id"))
pieces = vg.open(os.path.join(SAMPLES, "pieces", "pieces_*.%.dump"))
for frame in pieces:
    parts = [plain_dump.read(os.path.join(SAMPLES, "pieces", f"pieces_{frame.step}.{rank}.dump"))[0] for rank in range(4)]
    same(frame["id"], numpy.concatenate([part.numbers("id") for part in parts]))
assert len(pieces.files) == 20 and len(vg.open(pieces.files)) == len(pieces) == 5

# parts of a frame: what numpy takes from the whole
whole = vg.open(SOURCE)[4]
assert vg.open(SOURCE).read(4, region=[None, None, (0, 0)]).rows == 0  # a plane, not all
part = vg.open(SOURCE).read(4, columns=["id", "v"], stride=7, region=[(0, 0.03), None, (None, 0.02)])
keep = (whole["id"] % 7 == 0) & (whole.points[:, 0] >= 0) & (whole.points[:, 0] <= 0.03) & (whole.points[:, 2] <= 0.02)
assert 0 < keep.sum() < 200 and list(part) == ["id", "v"]
for name in ("id", "v"):
    assert numpy.array_equal(part[name], whole[name][keep]), name
assert numpy.array_equal(part.points, whole.points[keep])
ordered = vg.open(SOURCE).read(sort=True)
order = numpy.argsort(whole["id"], kind="stable")
assert numpy.array_equal(ordered["id"], whole["id"][order]) and numpy.array_equal(ordered["f"], whole["f"][order])
single = vg.open(SOURCE).read(precision="single", origin=(0.01, 0.02, 0.03))
assert single.points.dtype == numpy.float32
assert numpy.array_equal(single.points, (whole.points - [0.01, 0.02, 0.03]).astype(numpy.float32))
for threads in (1, 3):
    assert numpy.array_equal(vg.open(SOURCE, threads=threads).read(threads=threads).points, whole.points)


def count_calls(columns):
    """The calls of Python's functions that it takes to make a dict of a frame."""
    names = [f"c_{i}" for i in range(columns)]
    with open("wide.dump", "w") as out:
        out.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z "
                  f"{' '.join(names)}\n1 0 0 0 {' '.join(map(str, range(columns)))}\n")
    frame, calls = vg.open("wide.dump")[0], []
    sys.setprofile(lambda _, event, __: calls.append(event))
    found = dict(frame)
    sys.setprofile(None)
    assert list(found) == ["id", *names] and [found[name].item() for name in names] == list(range(columns))
    return len(calls)


assert count_calls(2000) < 6 * count_calls(500)  # in proportion to the columns
# ---- columns that programs spell in several ways -----------------------------------------------------------------------
for name, turns, powers in (("superellipsoids.dump", "quatw quati quatj quatk", "block1 block2"),
                            ("superellipsoids.data", "quatw quati quatj quatk", "block1 block2"),
                            ("by_hand.dump", "quat1 quat2 quat3 quat4", "blockiness1 blockiness2")):
    frame = vg.open(os.path.join(os.environ["GRANULAR_DATA"], "good", "shapes", name))[0]
    for array, words in (("quat", turns), ("blockiness", powers)):
        for i, word in enumerate(words.split()):
            assert (frame[word] == frame[array][:, i]).all() and word in vg._run.component_columns(frame), (name, word)
print("arrays are the numbers of the files")
