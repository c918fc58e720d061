# SPDX-License-Identifier: BSD-3-Clause
"""granular check: files of real runs are sound, and each kind of damage is said in words, with an exit status for scripts."""
import json
import os
import shutil

from command import GOOD, SAMPLES, content, granular

SOURCE = os.path.join(SAMPLES, "grains.dump")


def check(*arguments, status):
    told = json.loads(granular("check", "--json", *arguments, status=status)[0])
    assert bool(told["faults"]) == bool(status)
    return told


for name in ("grains.dump", "ortho_plain.dump", "tri_plain.dump", "restart/fibres.restart", "euler_*.vtk", "decomposition_*.vtk",
             "data_file/sphere.data", "pieces_*.%.dump", "ortho_*.dump.gz"):
    check(os.path.join(GOOD, name), status=0)
said, _ = granular("check", SOURCE)
assert said.endswith("5 frames, 4800 rows, nothing is wrong\n"), said
assert granular("check", "--quiet", SOURCE) == ("", "")
said, _ = granular("check", os.path.join(GOOD, "data_file", "line.data"))
assert "line.data:14: sections that are not read: Lines (1 rows)\n" in said and said.endswith("1 rows, no fault in what was read\n"), said

HEADER = "ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{rows}\nITEM: BOX BOUNDS {bounds}\n0 1\n0 1\n0 1\nITEM: ATOMS id type x y z radius\n"


def dump(name, *frames, bounds="ff ff ff"):
    with open(name, "w", encoding="ascii") as out:
        for i, rows in enumerate(frames):
            out.write(HEADER.format(step=i, rows=len(rows), bounds=bounds) + "".join(row + "\n" for row in rows))
    return name


sound = ["1 1 0.512345678 0.5 0.5 0.1", "2 1 0.112345678 0.2 0.3 0.1"]
for frames in ((sound, sound), (["1 1 0.5 0.2 0.3 0.01"], ["1 1 0.512345678 0.2 0.3 0.01"])):  # the first frame of the second is a lattice
    assert check(dump("sound.dump", *frames), status=0)["remarks"] == []
for what, frames, words in (
        ("an id twice", [sound + ["1 1 0.9 0.9 0.9 0.1"]], "1 ids occur more than once: 1"),
        ("not a number", [["1 1 0.512345678 nan 0.5 0.1"]], "1 values of points are NaN"),
        ("infinite", [["1 1 0.5 0.5 0.5 inf"]], "1 values of radius are NaN or infinite"),
        ("radius 0", [["1 1 0.5 0.5 0.5 0"]], "1 radii are not positive"),
        ("far outside", [["1 1 0.5 1.75 0.5 0.1"]], "outside the box along y, by 0.75"),
        ("outside", [sound, ["1 1 0.5 1.25 0.5 0.1"]], "step 1: 1 particles are outside the box along y, by 0.25 at most"),
        ("a word", [["1 1 0.5 zero 0.5 0.1"]], "column 'y'")):
    faults = check(dump("damaged.dump", *frames), status=1)["faults"]
    assert any(words in fault for fault in faults), (what, faults)
for what, frames, bounds, words in (
        ("outside a fixed box, as in a silo that empties", [sound, [sound[0], "2 1 0.112345678 0.2 -0.19 0.1"]], "ff ff ff",
         "step 1: 1 particles are outside the box along z, by 0.19 at most"),
        ("in several frames", [sound, ["1 1 0.512345678 1.05 0.5 0.1"], ["1 1 0.512345678 1.1 0.5 0.1"]], "ff ff ff",
         "2 frames have particles outside the box along y; the first: step 1: 1 particles, by 0.1 at most"),
        ("outside a periodic box", [["1 1 0.5 1.25 0.5 0.1"]], "pp pp pp", "outside the box along y"),
        ("ids that go", [sound, sound[:1]], "ff ff ff", "1 ids are not in the frame after; first at step 1: 2"),
        ("ids that come", [sound[:1], sound], "ff ff ff", "1 ids come in a later frame"),
        ("few digits", [["1 1 0.512 0.123 0.345 0.01"]], "ff ff ff", "positions have 3 digits: each is wrong by up to 5 % of the smallest radius")):
    remarks = check(dump("remarkable.dump", *frames, bounds=bounds), status=0)["remarks"]
    assert any(words in remark for remark in remarks), (what, remarks)

# scaled coordinates, and a far box that LIGGGHTS prints with six digits: half of the last one is 5 radii
with open("far.dump", "w", encoding="ascii") as out:
    out.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n" + 3 * "1000.12 1000.32\n"
              + "ITEM: ATOMS id type xs ys zs radius \n1 1 0.512345 0.5 0.123456 0.001 \n")
(remark,) = check("far.dump", status=0)["remarks"]
assert "moves points by up to 0.005 along x, where the smallest radius is 0.001" in remark, remark
assert 'dump_modify ID format "%d %d %.12g ..."' in remark, remark  # LIGGGHTS knows no `format float`

# files that end early, also compressed; timesteps that repeat; pieces that are missing or cut; no file of the kind
text = content(SOURCE)
with open("cut.dump", "wb") as out:
    out.write(text[:400000])
faults = check("cut.dump", status=1)["faults"]
assert len(faults) == 1 and "cut.dump:3637: expected 1200 rows, got 72" in faults[0], faults
packed = content(os.path.join(GOOD, "ortho_000050.dump.gz"))
with open("cut.dump.gz", "wb") as out:
    out.write(packed[: len(packed) // 2])
assert "expected the end of the gzip data" in " ".join(check("cut.dump.gz", status=1)["faults"])
with open("twice.dump", "wb") as out:
    out.write(text + text)
assert "5 frames have the timestep of an earlier one" in check("twice.dump", status=1)["faults"][0]
shutil.rmtree("pieces", ignore_errors=True)
shutil.copytree(os.path.join(SAMPLES, "pieces"), "pieces")
os.remove("pieces/pieces_2000.2.dump")
with open("pieces/pieces_3000.1.dump", "r+b") as out:
    out.truncate(3000)
faults = "\n".join(check("pieces/pieces_*.%.dump", status=1)["faults"])
assert "expected 4 pieces of timestep 2000, got 3 (none for 2)" in faults and "pieces_3000.1.dump:1: expected 122 rows, got 62" in faults, faults
for name in set(os.listdir(os.path.join(GOOD, "..", "bad"))) - {"coordinates_missing.dump"}:  # which only points need
    check(os.path.join(GOOD, "..", "bad", name), "--kind", "dump", status=1)
granular("check", "nowhere.dump", status=1)
granular("check", SOURCE, "--frames", "9", status=2)
print("check")
