# SPDX-License-Identifier: BSD-3-Clause
"""Dumps that other codes and people write: right values, or words that say what to do. Each is read by Run, and looked at by the command."""
import os
import re
import sys
import warnings

import vtkgranular as vg

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "support"))
from command import granular  # noqa: E402

ODD = os.path.join(os.environ["GRANULAR_DATA"], "odd")
BOX = "ITEM: BOX BOUNDS pp pp ff\n0 10\n0 10\n0 20\n"
ROWS = "1 1 1 2 3\n2 1 4 5 6\n"
POINTS = [[1, 2, 3], [4, 5, 6]]


def text(columns="id type x y z", rows=ROWS, box=BOX, step="ITEM: TIMESTEP\n0\n", count=2, more=""):
    return f"{step}ITEM: NUMBER OF ATOMS\n{count}\n{box}ITEM: ATOMS {columns}\n{rows}{more}"


def write(name, content, age=0):
    with open(name, "w", encoding="ascii") as file:
        file.write(content)
    stamp = os.stat(name).st_mtime - age
    os.utime(name, (stamp, stamp))
    return name


def lists(values):
    return values.tolist() if hasattr(values, "tolist") else values


BONDS = "ITEM: NUMBER OF BONDS\n1\nITEM: BONDS id1 id2\n1 2\n"
LATER = "ITEM: TIMESTEP\n100\n"
TRIPLE = [[0.1, 0.2, 0.3], [-0.1, 0, 0.25], [0, 0, -1]]

# a file of tests/data/odd or a text, options, the warnings or the error as patterns, and what each frame has
CASES = [
    ("comment_between_frames.dump", {}, [], [{"v": TRIPLE, "radius": [0.5, 0.4, 0.45]}] * 2),
    (text(more="# the end\n\n# of all\n"), {}, [], [{"points": POINTS}]),
    ("# by my code\n" + text(rows="1 1 1 2 3 # glass\n2 1 4 5 6\n"), {}, [], [{"points": POINTS}]),
    (text(rows="1 1 1 2 3\n# half\n2 1 4 5 6\n", more=text(step=LATER)), {}, [":11: expected a row, got '# half'; the frame is left out"],
     [{"points": POINTS}]),
    ("no_last_line_feed.dump.gz", {}, [], [{"radius": [0.5, 0.4, 0.45]}] * 2),
    ("type_in_words.dump", {}, [], [{"type": ["Si", "O"], "radius": [0.5, 0.4]}]),
    (text(rows="1 1 1 2 3\n2 O 4 5 6\n"), {}, ":11: column 'type': expected a number, got 'O'", []),
    ("tilt_behind_boundaries.dump", {}, ":5: expected BOX BOUNDS, xy xz yz if each line has a tilt .*, got 'ITEM: BOX BOUNDS pp pp pp 2.0", []),
    (text(box=BOX.replace("pp pp ff", "xy pp pp")), {}, ":5: expected BOX BOUNDS, xy xz yz if", []),
    (text(box="ITEM: BOX BOUNDS pp pp\n0 10\n0 10\n"), {}, [":8: the box has no bounds along z: it goes from -0.5 to 0.5"],
     [{"box": [[0, 0, -0.5], [10, 10, 0.5]], "points": POINTS}]),
    (text(step="ITEM: TIMESTEP\n0.05\n"), {}, ":2: expected an integer timestep, and a time under ITEM: TIME, got '0.05'", []),
    (text(step="ITEM: TIME\n0.05\n"), {}, ":9: expected ITEM: TIMESTEP before ITEM: ATOMS, got none", []),
    ("vx_vy.dump", {}, [], [{"vx": [1, 0], "vy": [0.5, -1]}]),
    ("row_long.dump", {}, ":23: expected 9 words in a row, got 10$", [{"v": TRIPLE}]),
    (text(rows="1 1 1 2 3 x\n2 1 4 5 6\n"), {}, ":10: expected 5 words in a row, got 6$", []),
    ("no_headers.dump", {"column_names": "id type x y z"}, ["rows without headers: all rows are one frame"], [{"points": POINTS, "box": None}]),
    ("no_headers.dump", {"column_map": "id type x y z"}, ["rows without headers"], [{"id": [1, 2]}]),
    ("no_headers.dump", {}, ":1: expected ITEM: TIMESTEP, UNITS or TIME, or column_names for rows without headers, got '1 1 1 2 3'", []),
    ("no_headers.dump", {"column_names": "id x y z"}, "expected 4 words in a row, as in column_names, got 5", []),
    (ROWS + "2 1 7 8 9\n1 1 0 0 0\n", {"column_names": "id type x y z"}, ["2 frames of 2 rows, told apart by ids that come again"],
     [{"points": POINTS, "step": 0}, {"points": [[7, 8, 9], [0, 0, 0]], "step": 1}]),
    (ROWS + "2 1 7 8 9\n3 1 0 0 0\n", {"column_names": "id type x y z"}, ["all rows are one frame"], [{"id": [1, 2, 2, 3]}]),
    ("rows_with_commas.dump", {}, r":10: expected 5 words in a row, separated by blanks, got values separated by commas: '1,1,1\.5,2,3'", []),
    (text(rows="1, 1, 1.5, 2, 3\n2, 1, 4, 5, 6\n"), {}, ":10: .* separated by commas: '1, 1, 1.5, 2, 3'", []),
    ("no_coordinates.dump", {}, [], [{"radius": [0.5, 0.4], "c_pe": [3.25, -1]}, {"radius": [0.5, 0.4], "c_pe": [3.5, -2]}]),
    ("step_twice.dump", {}, [":12: timestep 0 comes again in this file; the last frame of a timestep is shown"],
     [{"points": [[3, 3, 3], [4, 4, 4]]}, {"points": [[5, 5, 5], [6, 6, 6]]}]),
    ("vector_from_zero.dump", {}, [], [{"f_a": [[7, 8, 9], [10, 11, 12]]}]),
    (text("id x y z v_b[0] v_b[2]"), {}, ":10: expected 6 words in a row, got 5", []),
    ("atoms_and_bonds.dump", {}, [":13: the rows behind 'ITEM: NUMBER OF BONDS' are passed over in the whole file"],
     [{"radius": [0.5] * 3}] * 2),
    ("atoms_and_bonds.dump", {"kind": "local", "column_map": "bond_id btype id1 id2"}, ["'ITEM: NUMBER OF ATOMS' are passed over"],
     [{"id2": [2, 3]}] * 2),
    (text() + LATER + BONDS + text(step=LATER) + LATER + BONDS, {}, ["'ITEM: NUMBER OF BONDS' are passed over"], [{"points": POINTS}] * 2),
    (text(step="ITEM: TIMESTEP\n0\n" + BONDS), {"kind": "dump"}, ["'ITEM: NUMBER OF BONDS' are passed over"], [{"points": POINTS}]),
    ("no_box.dump", {}, [], [{"radius": [0.5, 0.5], "points": [[1, 1, 0], [3, 3, 0]], "box": None}] * 2),
    (text("id type xs ys zs", box=""), {}, ":1: expected a box", []),
]

for number, (source, options, said, frames) in enumerate(CASES):
    path = os.path.join(ODD, source) if "\n" not in source else write(f"case_{number}.dump", source)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        error = ""
        try:
            run = vg.open(path, **options)
            for frame, wanted in zip(run, frames if isinstance(said, list) else frames + [{}]):
                if isinstance(said, str) and not wanted:
                    frame.read()
                for name, values in wanted.items():
                    got = frame.points if name == "points" else getattr(frame, name) if name in ("box", "step") else frame[name]
                    got = [got.lo.tolist(), got.hi.tolist()] if isinstance(got, vg.Box) else lists(got)
                    assert got == values, (source, name, got, values)
            assert isinstance(said, str) or len(run) == len(frames), (source, len(run))
        except vg.Error as raised:
            error = str(raised)
    if isinstance(said, str):
        assert re.search(said, error), (source, said, error)
    else:
        texts = [str(each.message) for each in told]
        assert not error and len(texts) == len(said), (source, error, texts)
        assert all(re.search(pattern, words) for pattern, words in zip(said, texts)), (source, texts)

# a plain file without its last line feed: by its age
whole = open(os.path.join(ODD, "no_last_line_feed.dump"), encoding="ascii").read()
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    old = write("old.dump", whole, age=7300)
    assert vg.open(old)[0]["radius"].tolist() == [0.5, 0.4, 0.45]
    assert [str(each.message).partition(": ")[2] for each in told] == \
        ["the last row has no line feed; it counts, because the file was written to 2 h ago"]
    run = vg.open(write("growing.dump", whole[:-1], age=7300))
    write("growing.dump", whole + "1\n", age=7200)  # the last row was not whole
    assert run.refresh()[0]["radius"].tolist() == [0.5, 0.4, 0.451]
try:
    vg.open(write("young.dump", whole))
except vg.Error as error:
    assert re.search(r"got 2, and a last line without its line feed in a file that was written to \d+ s ago$", str(error)), error
else:
    raise AssertionError("a file that may be growing was taken as it is")
assert "2 frames" in granular("check", os.path.join(ODD, "no_last_line_feed.dump.gz"))[0]

# without coordinates: all doors but those that need points
run = vg.open(os.path.join(ODD, "no_coordinates.dump"))
frame = run[0]
assert list(frame) == ["id", "type", "radius", "c_pe"] and "x" not in frame and "points" not in frame
assert run.read(1, columns="c_pe")["c_pe"].tolist() == [3.5, -2]
for wanted in (lambda: frame.points, frame.to_vtk):
    try:
        wanted()
    except vg.Error as error:
        assert "expected a file with positions, got one with id, type, radius, c_pe" in str(error), error
    else:
        raise AssertionError("points out of nothing")
assert "nothing is wrong" in granular("check", os.path.join(ODD, "no_coordinates.dump"))[0]
assert "c_pe" in granular("stats", os.path.join(ODD, "no_coordinates.dump"))[0]
for ending in ("csv", "npz"):
    granular("convert", os.path.join(ODD, "no_coordinates.dump"), f"out_*.{ending}")
assert open("out_10.csv", encoding="ascii").read() == "id,type,radius,c_pe\n1,1,0.5,3.5\n2,2,0.4,-2.0\n"

# three frames of 10 rows, one behind the other
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    run = vg.open(os.path.join(ODD, "no_headers_ids.dump"), column_names="id x y z radius")
assert run.rows.tolist() == [10] * 3 and all(sorted(frame["id"].tolist()) == list(range(1, 11)) for frame in run)
