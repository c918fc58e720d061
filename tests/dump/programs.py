# SPDX-License-Identifier: BSD-3-Clause
"""Takes the name of another program - lammps, liggghts or ase -, writes dumps in every form, has the
program read them, and compares all that it got with the numbers that were there before writing."""
import importlib.util
import itertools
import os
import random
import shutil
import subprocess
import sys

import numpy
import plain_dump
from paraview.simple import OpenDataFile

import granular

ATOMS, STEPS = 300, (7, 120000)
LOW = numpy.array([-1.5, 0.25, 2.0])
BOXES = {"straight": [[5.0, 0, 0], [0, 4.0, 0], [0, 0, 6.0]],
         "tilted": [[5.0, 0, 0], [1.75, 4.0, 0], [-1.25, 0.625, 6.0]]}


def make_frames(box):
    """For each step, by id: type, x, image, v; and the order in which the ids are in the file."""
    chance, frames = random.Random(4711), {}
    for step in STEPS:
        order = chance.sample(range(ATOMS), ATOMS)
        inside = numpy.array([[chance.uniform(0.001, 0.999) for _ in "xyz"] for _ in range(ATOMS)])
        frames[step] = {
            "type": numpy.array([chance.randint(1, 2) for _ in range(ATOMS)]),
            "x": LOW + inside @ box,
            "image": numpy.array([[chance.randint(-3, 3) for _ in "xyz"] for _ in range(ATOMS)]),
            "v": numpy.array([[chance.gauss(0, 1) for _ in "xyz"] for _ in range(ATOMS)])}, order
    return frames


def write_plain(path, box, frames):
    """As text with all digits: what the plugin reads before it writes."""
    (lx, _, _), (xy, ly, _), (xz, yz, lz) = box.tolist()
    tilts = (xy, xz, yz) if xy else ()
    lows = LOW + [min(0, xy, xz, xy + xz), min(0, yz), 0]
    highs = LOW + [lx + max(0, xy, xz, xy + xz), ly + max(0, yz), lz]
    with open(path, "w", encoding="ascii") as file:
        for step, (atoms, order) in frames.items():
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{ATOMS}\nITEM: BOX BOUNDS ")
            file.write("xy xz yz pp pp pp\n" if tilts else "pp pp pp\n")
            for axis in range(3):
                file.write(" ".join(map(repr, [float(lows[axis]), float(highs[axis]),
                                               *tilts[axis:axis + 1]])) + "\n")
            file.write("ITEM: ATOMS id type x y z ix iy iz vx vy vz\n")
            for i in order:
                words = [i + 1, atoms["type"][i], *atoms["x"][i].tolist(), *atoms["image"][i],
                         *atoms["v"][i].tolist()]
                file.write(" ".join(map(str, words)) + "\n")


def run(program, script):
    with open("in.read", "w", encoding="ascii") as file:
        file.write(script)
    done = subprocess.run([program, "-in", "in.read", "-log", "none"], capture_output=True,
                          text=True, timeout=60)
    assert done.returncode == 0, script + done.stdout[-2000:] + done.stderr[-2000:]


def read_dump(program, head, last, path, columns, step):
    """Has LAMMPS or LIGGGHTS read a frame and dump what it has then, with 17 digits."""
    words = columns.split()
    fields = [word for word in ("ix", "iy", "iz", "vx", "vy", "vz") if word in words]
    run(program, head + f"read_dump {path} {step} x y z {' '.join(fields)} {last}\n")
    frame, = plain_dump.read("got.txt")
    got = frame.stack("id type x y z ix iy iz vx vy vz".split())
    got = got[got[:, 0].argsort()]
    assert got[:, 0].tolist() == list(range(1, ATOMS + 1)), f"{len(got)} atoms"
    origin, box = frame.box()
    return {"type": got[:, 1], "x": got[:, 2:5], "box": box, "origin": origin,
            **({"image": got[:, 5:8]} if "ix" in fields else {}),
            **({"v": got[:, 8:11]} if "vx" in fields else {})}


def lammps(path, columns, step, tilted):
    region = "prism 0 9 0 9 0 9 1 1 1" if tilted else "block 0 9 0 9 0 9"
    head = f"atom_style atomic\nregion all {region}\ncreate_box 2 all\nmass * 1\n"
    last = ("box yes purge yes replace no add keep\nwrite_dump all custom got.txt id type x y z ix iy iz "
            "vx vy vz modify format float %.17g")
    return read_dump("lmp", head, last, path, columns, step)


def liggghts(path, columns, step, tilted):
    region = "prism 0 9 0 9 0 9 1 1 1" if tilted else "block 0 9 0 9 0 9"
    scaled = "yes" if "xs" in columns.split() else "no"
    head = f"""atom_style sphere
boundary p p p
newton off
communicate single vel yes
region all {region}
create_box 2 all
neighbor 0.1 bin
pair_style none
"""
    last = f"""box yes purge yes replace no add yes scaled {scaled}
dump got all custom 1 got.txt id type x y z ix iy iz vx vy vz
dump_modify got format "%d %d %.17g %.17g %.17g %d %d %d %.17g %.17g %.17g"
run 0"""
    return read_dump("liggghts", head, last, path, columns, step)


def ase(path, columns, step, tilted):
    """ASE comes with a Python that need not be ParaView's, but is Debian's as well."""
    import ase.io
    binary = path.endswith(".bin")
    kind = {"format": "lammps-dump-binary", "colnames": columns.split()} if binary else \
        {"format": "lammps-dump-text"}
    images = ase.io.read(path, index=":", units="metal", **kind)
    assert len(images) == len(STEPS)
    atoms = images[STEPS.index(step)]
    got = {"type": atoms.get_atomic_numbers(), "x": atoms.get_positions(),
           "box": atoms.get_cell()[:], "origin": atoms.get_celldisp().ravel()}
    if "vx" in columns.split():
        got["v"] = atoms.get_velocities() / ase.units.Ang * (1e-12 * ase.units.second)
    return got


#          what it is called, what it reads, columns, and digits to which x is the same
PROGRAMS = {"lammps": (lammps, "lmp"), "liggghts": (liggghts, "liggghts"), "ase": (ase, None)}


def main(name):
    read, command = PROGRAMS[name]
    there = shutil.which(command) if command else importlib.util.find_spec(name)
    if not there:
        print(f"skipped: {name} is not installed")
        return
    for shape, box in BOXES.items():
        box = numpy.array(box)
        frames = make_frames(box)
        write_plain(f"{shape}.dump", box, frames)
        source = OpenDataFile(os.path.abspath(f"{shape}.dump"))
        for x, image, v in itertools.product(("x y z", "xs ys zs"), ("", " ix iy iz"), ("", " vx vy vz")):
            columns = "id type " + x + image + v
            for dialect, end in itertools.product(("LIGGGHTS", "LAMMPS"), ("txt", "bin", "gz")):
                path = f"{shape}_{columns.replace(' ', '')}_{dialect}.{end}"
                granular.save(source, path, Columns=columns, Dialect=dialect, WriteTimeSteps=1,
                              NumberFormat="%.17g")
                for step in STEPS:
                    try:
                        got = read(path, columns, step, shape == "tilted")
                        want = frames[step][0]
                        for key, value in got.items():
                            w = box if key == "box" else LOW if key == "origin" else want[key]
                            err = abs(value - w).max()
                            print(path, step, key, err)
                    except Exception as e:
                        print("FAIL", path, step, type(e), str(e)[-600:])


main(sys.argv[1])
