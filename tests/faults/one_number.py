# SPDX-License-Identifier: BSD-3-Clause
"""A wrong number in a file changes that number alone: files of each format with one number changed to others, to nan and to a word.

Everything that is read must be bit for bit as before, but for what the number says itself: one value, the point that it is a
coordinate of, or an id, and the velocities and bonds that a data file gives to that id. What is no number must be an error with the
line and the place, or change nothing. Arguments: how many changes of each file (default 40), the seed."""
import os
import random
import re
import struct
import sys
import warnings

import numpy

import vtkgranular as vg

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
NUMBER = re.compile(rb"(?<![^\s])[-+0-9.][-+0-9.eE]*(?![^\s])")
TEXTS = [b"0", b"1", b"7", b"-3", b"2.5", b"1e-3", b"123456789", b"-1e300", b"nan", b"inf", b"word", b"0x10", b"1,5"]
NO_NUMBERS = TEXTS[-3:]
DOUBLES = [struct.pack("<d", value) for value in (0.0, 1.0, 7.0, -3.0, 2.5, 1e300, float("nan"), float("inf"), 5e-324)]

TOGETHER = ({"diameter", "radius"}, {"type", "mass"})  # arrays of one column: masses are those of types

PLAIN = "id type x y z vx vy vz fx fy fz radius q"

# A text, and the word of the last line before its rows.
TEXT_FILES = [
    ("ortho_plain.dump", b"ITEM: ATOMS"),
    ("tri_scaled_image.dump", b"ITEM: ATOMS"),
    ("tri_unwrapped.dump", b"ITEM: ATOMS"),
    ("grains_1000.dump", b"ITEM: ATOMS"),
    ("local/contacts.dump", b"ITEM: ENTRIES"),
    ("local/chain_bonds.dump", b"ITEM: BONDS"),
    ("data_file/sphere.data", b"Atoms"),
    ("data_file/full.data", b"Atoms"),
    ("data_file/full.data", b"\nBonds"),
    ("data_file/ellipsoid.data", b"Velocities"),
    ("euler_1000.vtk", b"LOOKUP_TABLE"),
    ("euler/parallel_2000.vtk", b"POINTS"),
    ("decomposition/hexahedra_42.vtk", b"nlocal"),
]
# A file of doubles in memory order, and names of its columns.
BINARY_FILES = [("ortho_custom.bin", ""), ("plain.bin", PLAIN), ("restart/style_sphere.restart", "")]


def content(path, column_names=""):
    """All that is read of the first frame with rows: arrays by name, each a row per line; and what was said."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        run = vg.open(path, column_names=column_names)
        whole = run[next((i for i in range(len(run)) if run[i].rows), 0)].read()
        read = {name: numpy.array(whole[name]) for name in whole.keys()}
        try:
            read["points"] = numpy.array(whole.points)
        except vg.ColumnError:
            pass  # a file without positions
        if run.kind in ("data", "restart"):
            read |= {"bonds " + name: numpy.array(whole.bonds[name]) for name in whole.bonds.keys()}
    return read, " ".join(str(each.message) for each in said)


def differences(before, after):
    """(array, row, how many of its components) of all rows that are not the same; None: other arrays or numbers of rows."""
    if before.keys() != after.keys():
        return None
    found = []
    for name, was in before.items():
        now = after[name]
        if now.dtype == float and was.dtype.kind == "i":
            was = was.astype(float)  # one is no integer: a warning says that the column is kept as doubles
        if was.shape != now.shape or was.dtype != now.dtype:
            return None
        if len(was):
            was, now = ([repr(value) for value in each] if each.dtype.kind in "UO" else each.reshape(len(each), -1).view("u1").tolist()
                        for each in (was, now))
            found += [(name, row) for row in range(len(was)) if was[row] != now[row]]
    return found


def without_joined(read):
    """What a data file does not give to ids."""
    return {name: array for name, array in read.items() if name not in ("v", "omega", "angmom") and not name.startswith("bonds ")}


def without_bond(read, fewer):
    """Less the bond that the other one has not: a particle of it is not there, as a warning says."""
    names = [name for name in read if name.startswith("bonds ")]
    left = len(fewer[names[0]]) if names else 0
    if not names or len(read[names[0]]) != left + 1:
        return read
    row = next((row for row in range(left) if any(read[name][row] != fewer[name][row] for name in names)), left)
    return read | {name: numpy.delete(read[name], row, axis=0) for name in names}


def text_places(bytes_, word):
    """Where the numbers of the first rows are: begin and end of each."""
    for marker in re.finditer(re.escape(word) + rb".*\n", bytes_):
        following = re.search(rb"\n[A-Za-z]", bytes_[marker.end() - 1:])
        end = marker.end() - 1 + following.start() if following else len(bytes_)
        places = [match.span() for match in NUMBER.finditer(bytes_, marker.end(), end)]
        if places:
            return places
    raise AssertionError("no rows")


def binary_places(bytes_, read):
    """The same of doubles: those of the first chunk, which begins with an id and a type, or those of a position on."""
    first = struct.pack("<dd", read["id"][0], read["type"][0])
    if first in bytes_:
        begin = bytes_.index(first)
        end = begin + 8 * struct.unpack_from("<i", bytes_, begin - 4)[0]
    else:
        begin = bytes_.index(struct.pack("<3d", *read["points"][0]))
        end = len(bytes_) - (len(bytes_) - begin) % 8
    return [(at, at + 8) for at in range(begin, end, 8)]


def judge(path, column_names, before, given, is_number):
    """"error", "same" or "changed"; raises for anything else."""
    try:
        after, said = content(path, column_names)
    except vg.Error as error:
        is_other = path.endswith(".vtk") and "got a VTK file" in str(error)  # no longer cells of ours
        assert is_other or re.search(re.escape(path) + "[:@][0-9]+", str(error)), f"an error without its place: {error}"
        return "error"
    if path.endswith(".data") and differences({"id": before["id"]}, {"id": after["id"]}):
        only_id = differences(before, after) == [("id", row) for _, row in differences({"id": before["id"]}, {"id": after["id"]})]
        assert only_id or "id of another one" in said or "left out" in said, f"{given!r} changed what belongs to an id in silence"
        before, after = without_joined(before), without_joined(after)
    shorter = without_bond(before, after)
    changed = differences(shorter, after)
    assert changed is not None, f"other arrays after {given!r}"
    values = {name for name, _ in changed}
    rows = {row for _, row in changed}
    missing = shorter is not before
    assert not missing or "left out" in said, f"{given!r} left out a bond in silence"
    assert len(rows) + missing <= 1 and (len(values) <= 1 or values in TOGETHER), f"{given!r} changed {changed}"
    assert is_number or not (changed or missing), f"{given!r}, which is no number, changed {changed}"
    return "changed" if changed or missing else "same"


def main(changes=40, seed=1):
    folder = os.path.abspath("one_number")
    os.makedirs(folder, exist_ok=True)
    for name, of in TEXT_FILES + BINARY_FILES:
        is_text = isinstance(of, bytes)
        column_names = "" if is_text else of
        with open(os.path.join(GOOD, name), "rb") as file:
            good = file.read()
        path = os.path.join(folder, os.path.basename(name))
        before, _ = content(os.path.join(GOOD, name), column_names)
        places = text_places(good, of) if is_text else binary_places(good, before)
        chance = random.Random(f"{seed} {name} {of}")
        outcomes = {"error": 0, "same": 0, "changed": 0}
        for _ in range(changes):
            begin, end = chance.choice(places)
            given = chance.choice(TEXTS if is_text else DOUBLES)
            with open(path, "wb") as file:
                file.write(good[:begin] + given + good[end:])
            is_number = not is_text or given not in NO_NUMBERS
            try:
                outcomes[judge(path, column_names, before, given, is_number)] += 1
            except AssertionError as error:
                raise AssertionError(f"{name}: bytes {begin} to {end}, {good[begin:end]!r}: {error}") from None
        print(f"{name}: {len(places)} numbers, {outcomes}")
        assert outcomes["changed"] > 0, "no number could be changed"


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
