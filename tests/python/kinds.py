# SPDX-License-Identifier: BSD-3-Clause
"""Each kind of data can be opened and written: particles, cells, subdomains, contacts and bonds, bonded particles of restart and data
files. What is read is what plain readings of the files say."""
import os
import warnings
from fractions import Fraction

import numpy

import plain_data
import plain_euler
import plain_local
import plain_restart
import vtkgranular as vg

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
SAMPLES = os.path.join(os.environ["GRANULAR_ROOT"], "samples", "data")


def content(path):
    with open(path, "rb") as stream:
        return stream.read()


# Euler cells: a series of files, by values; written again as LIGGGHTS wrote them
run = vg.open(os.path.join(SAMPLES, "euler_*.vtk"), dt=2e-5)
assert run.kind == "euler" and run.steps.tolist() == [1000, 2000, 3000, 4000]
for frame in run:
    path = os.path.join(SAMPLES, f"euler_{frame.step}.vtk")
    text = plain_euler.read(path)
    assert numpy.array_equal(frame.points, text["centres"])
    for name in plain_euler.ARRAYS:
        assert numpy.array_equal(frame[name].reshape(frame.rows, -1), text[name]), name
    vg.write("cells.euler", frame)
    assert content("cells.euler") == content(path)
cells = {"points": [[0.5, 0.5, 0.5], [1.5, 0.5, 0.5]], "v_avg": [[1, 2, 3], [1 / 3, 0, 0]], "volumefraction": [0.25, 1 / 3],
         "radius": [0.1, 0.2], "pressure": [1e-300, 5.0]}
vg.write("mine.euler", cells)
mine = vg.open("mine.euler")[0]
for name, values in cells.items():
    assert numpy.array_equal(mine.points if name == "points" else mine[name], numpy.asarray(values, dtype=float)), name

# subdomains
run = vg.open(os.path.join(GOOD, "decomposition_*.vtk"))
assert run.kind == "decomposition" and len(run) == 2
frame = run[0]
assert frame["lo"].shape == frame["hi"].shape == (frame.rows, 3) and (frame["hi"] > frame["lo"]).all()
volume = numpy.prod(frame["hi"] - frame["lo"], axis=1).sum()
assert abs(volume / numpy.prod(frame["hi"].max(axis=0) - frame["lo"].min(axis=0)) - 1) < 1e-12  # they fill the box
vg.write("public.decomposition", frame, dialect="PUBLIC")
assert content("public.decomposition") == content(os.path.join(GOOD, "decomposition_1000.vtk"))
vg.write("inl.decomposition", frame)  # without counts nothing in the file says that these are subdomains
assert vg.kind_of("inl.decomposition") is None
again = vg.open("inl.decomposition", kind="decomposition")[0]
assert all(numpy.array_equal(again[name], frame[name]) for name in ("lo", "hi"))
subdomains = {"lo": [[0.0, 0, 0], [1, 0, 0]], "hi": [[1.0, 1, 1], [2, 1, 1]], "nlocal": [10, 20]}
vg.write("mine.decomposition", subdomains)
mine = vg.open("mine.decomposition")[0]
assert mine["nlocal"].tolist() == [10, 20] and mine["hi"].tolist() == subdomains["hi"]

# contacts and bonds
path = os.path.join(SAMPLES, "bonds", "chain_bonds.dump")
run = vg.open(path, preset="BondTypeIdsForce")
texts = plain_local.read(path)
assert run.kind == "local" and len(run) == len(texts)
for frame, text in zip(run, texts):
    assert frame.step == text.timestep and frame.rows == len(text.rows)
    for name in frame:
        if name in text.names:
            assert numpy.array_equal(frame[name], text.column(name)), name
vg.write("bonds.dump", run)
own, first = ([line for line in content(name).splitlines() if not line.startswith(b"ITEM: BONDS")] for name in ("bonds.dump", path))
assert own == first  # but for the names of the columns, which the preset knows
try:
    run[0].points
except vg.ColumnError as error:
    assert "positions" in str(error) and "id1" in str(error), error
else:
    raise AssertionError("ends of bonds that only have ids")
lines = {"id1": [1, 2], "id2": [2, 3], "points": [[[0, 0, 0], [1, 0, 0]], [[1, 0, 0], [1, 1.5, 0]]], "force": [0.1, -2e-300]}
vg.write("mine.bonds", lines, step=5)
mine = vg.open("mine.bonds")[0]
assert mine.step == 5 and numpy.array_equal(mine.points, lines["points"]) and mine["force"].tolist() == lines["force"]

# rows by hand, as programs and manuals have them: the last row, and what is said of all frames and arrays together
for name, options, last, said in (
        ("unnamed.local", {"column_map": "bond_id btype id1 id2"}, {"bond_id": 3, "btype": 2, "id1": 6, "id2": 8}, ""),
        ("angles.local", {}, {"atype": 1, "aatom1": 2, "aatom2": 3, "aatom3": 4}, "(preset AsNamed)"),
        ("ovito.local", {}, {"id1": 2, "id2": 3, "btype": 2}, ""),
        ("broken.local", {}, {"f_brk": [12, 13, 150, 4, 4, 4]}, "(preset AsNamed)"),
        ("broken.local", {"column_map": "id1 id2 time x y z"}, {"id1": 12, "id2": 13, "time": 150, "x": 4, "y": 4, "z": 4}, ""),
        ("broken.txt", {"column_map": "time id1 id2"}, {"time": 293, "id1": 1815, "id2": 1816}, "the rows have no header")):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        run = vg.open(os.path.join(GOOD, "local", name), **options)
        found = [{column: frame[column] for column in frame} for frame in run][-1]
    assert run.kind == "local" and {column: values[-1].tolist() for column, values in found.items()} == last, (name, found)
    assert len(told) == bool(said) and all(said in str(remark.message) for remark in told), (name, [str(remark.message) for remark in told])
    if name == "broken.local":
        assert [frame.rows for frame in run] == [0, 2, 1]
KEYWORDS = ("pos vel id force force_normal force_tangential torque torque_normal torque_tangential history contactArea delta contactPoint "
            "ms_id")  # 43 columns, of which the last 3 were not dumped
try:
    vg.open(os.path.join(GOOD, "local", "cut_contacts.dump"), column_map=KEYWORDS)[0]["delta"]
except vg.Error as error:
    assert "got 0.0203972, in the column c_cp[39] that is taken for ms_id1" in str(error), error
else:
    raise AssertionError("other columns taken for the last ones")
with open("drawn.local", "w") as stream:  # a column that lines have, too, is that of the file
    stream.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: ENTRIES x1 y1 z1 x2 y2 z2 length\n0 0 0 0 0 2 7\n")
assert vg.open("drawn.local")[0]["length"].tolist() == [7]

# a restart file: particles, and the bonds between them
path = os.path.join(SAMPLES, "restart", "fibres.20000.restart")
run = vg.open(path)
frame, text = run[0], plain_restart.Restart(path)
assert run.kind == "restart" and frame.step == 20000 and frame.rows == len(text.records)
places = {plain_restart.whole(record[4]): record[1:4] for record in text.records}
for number, point in zip(frame["id"].tolist(), frame.points.tolist()):
    assert tuple(point) == tuple(places[number]), number
bonds = frame.bonds
assert bonds.rows > 0 and set(bonds["id1"].tolist()) | set(bonds["id2"].tolist()) <= set(places)
for id1, id2, (first, second) in zip(bonds["id1"].tolist(), bonds["id2"].tolist(), bonds.points.tolist()):
    assert tuple(first) == tuple(places[id1])
vg.write("fibres.bonds", bonds)
vg.write("fibres.dump", frame)
again = vg.open("fibres.bonds")[0]
assert sorted(zip(again["id1"], again["id2"])) == sorted(zip(bonds["id1"], bonds["id2"]))
assert numpy.array_equal(vg.open("fibres.dump")[0].points, frame.points)
numbered = vg.open(path, history_layout="numbered")[0].bonds
assert "force_normal" in bonds and "force_normal" not in numbered
assert numpy.array_equal(numbered["history2"], bonds["force_normal"][:, 1])

# a data file
path = os.path.join(SAMPLES, "bonds", "chain.data")
run = vg.open(path, atom_style="molecular")
frame, atoms = run[0], plain_data.Data(path).rows("Atoms")
assert run.kind == "data" and frame.rows == len(atoms)
for number, point in zip(frame["id"].tolist(), frame.points.tolist()):
    assert all(value in atoms[number] for value in point), (number, point)
assert len(frame.bonds["id1"]) == len(plain_data.Data(path).rows("Bonds"))

run = vg.open(os.path.join(GOOD, "data_file", "hybrid_labels.data"), atom_style="hybrid sphere bond")
assert (run[0].type_names, run[0].bonds.type_names) == (["grain", "shell"], ["weak", "strong"])

# a bond of 8 across a box of 10: as the file has it, or by the nearest image where the axis is periodic
with open("across.data", "w") as stream:
    stream.write("title\n\n2 atoms\n1 bonds\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\nAtoms # bond\n\n1 0 1 9 5 5\n2 0 1 1 5 5\n\n"
                 "Bonds\n\n1 1 1 2\n")
across = vg.open("across.data", boundary="p f f")
assert across[0].box.boundary == "pp ff ff" and across[0].bonds["length"].tolist() == [2]
assert across.read(0, periodic_lines="as_written").bonds["length"].tolist() == [8] == vg.open("across.data")[0].bonds["length"].tolist()
parts = across.read(0, periodic_lines="split").bonds
assert parts.points.tolist() == [[[9, 5, 5], [10, 5, 5]], [[0, 5, 5], [1, 5, 5]]] and parts.rows == 2
assert parts["length"].tolist() == [2, 2] and parts["id1"].tolist() == [1, 1] and parts["bond_id"].tolist() == [1, 1]
vg.write("across.bonds", parts)  # a bond is a bond again
assert vg.open("across.bonds")[0]["id2"].tolist() == [2]

# a tilted box: the file has its own bounds, not those around it, and corner and edges are rounded once
bounds, tilts = (("1000.1", "1000.4"), ("-0.3", "0.4"), ("7", "7.7")), ("-0.07", "0.05", "-0.03")
with open("tilted.data", "w") as stream:
    stream.write("title\n\n1 atoms\n1 atom types\n")
    stream.writelines(f"{lo} {hi} {axis}lo {axis}hi\n" for (lo, hi), axis in zip(bounds, "xyz"))
    stream.write(f"{' '.join(tilts)} xy xz yz\n\nAtoms # atomic\n\n1 1 1000.2 0 7.1\n")
box = vg.open("tilted.data")[0].box
xy, xz, yz = map(float, tilts)
edge = [float(Fraction(float(hi)) - Fraction(float(lo))) for lo, hi in bounds]
assert box.origin.tolist() == [float(lo) for lo, _ in bounds]
assert box.vectors.tolist() == [[edge[0], 0, 0], [xy, edge[1], 0], [xz, yz, edge[2]]]


def bytes_read():
    """Bytes that this process has read from files so far."""
    with open("/proc/self/io") as counts:
        return int(next(line for line in counts if line.startswith("rchar:")).split()[1])


# a file is looked through when it is opened, not again for its frame; records are read for the list of arrays, and twice for the frame
with open("large.data", "w") as stream:
    stream.write("title\n\n50000 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # atomic\n\n")
    stream.writelines(f"{number} 1 0.5 0.25 0.125\n" for number in range(1, 50001))
for path, most in ("large.data", 1.1), (os.path.join(SAMPLES, "restart", "fibres.20000.restart"), 3.1):
    run = vg.open(path)
    before = bytes_read()
    points = run[0].points
    read = (bytes_read() - before) / os.path.getsize(path)
    assert len(points) and 0.9 < read < most, (path, read)
print("all kinds")
