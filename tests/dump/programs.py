# SPDX-License-Identifier: BSD-3-Clause
"""Takes the name of another program - lammps, liggghts or ase -, writes dumps in many forms, has the
program read them, and compares all that it got with the numbers that there were before writing."""
import importlib.util
import os
import random
import shutil
import subprocess
import sys

import numpy
import plain_dump
from paraview.simple import OpenDataFile

import vtkgranular as vg

ATOMS, STEPS = 300, (7, 120000)
LOW = numpy.array([-1.5, 0.25, 2.0])
BOXES = {"straight": numpy.array([[5.0, 0, 0], [0, 4.0, 0], [0, 0, 6.0]]),
         "tilted": numpy.array([[5.0, 0, 0], [1.75, 4.0, 0], [-1.25, 0.625, 6.0]])}
CUSTOM = [{"Columns": f"id type {columns} vx vy vz radius"} for columns in
          ("x y z", "xs ys zs", "x y z ix iy iz", "xs ys zs ix iy iz", "xu yu zu", "xsu ysu zsu")]
ATOM = [{"Style": "Atom", "Scaled": scaled, "Image": image} for scaled in (0, 1) for image in (0, 1)]
# Programs compute with numbers of up to 30; all else is the same bit by bit.
TOLERANCES = {"x": 2e-14, "v": 1e-14}


def columns_of(form):
    if "Columns" in form:
        return form["Columns"].split()
    return ("id type " + ("xs ys zs" if form["Scaled"] else "x y z") +
            (" ix iy iz" if form["Image"] else "")).split()


def make_frames(box):
    """For each step the values of the atoms, by id."""
    chance, frames = random.Random(4711), {}

    def three(number):
        return numpy.array([[number() for _ in "xyz"] for _ in range(ATOMS)])

    for step in STEPS:
        frames[step] = {
            "type": numpy.array([chance.randint(1, 2) for _ in range(ATOMS)]),
            "x": LOW + three(lambda: chance.uniform(0.001, 0.999)) @ box,
            "image": three(lambda: chance.randint(-3, 3)),
            "v": three(lambda: chance.gauss(0, 1)),
            "radius": numpy.array([chance.uniform(0.01, 0.02) for _ in range(ATOMS)])}
    return frames


def write_plain(path, box, frames):
    """As text with all digits, ids in no order: what the plugin reads before it writes."""
    (lx, _, _), (xy, ly, _), (xz, yz, lz) = box.tolist()
    tilts = (xy, xz, yz) if xy else ()
    bounds = numpy.array([LOW + [min(0, xy, xz, xy + xz), min(0, yz), 0],
                          LOW + [lx + max(0, xy, xz, xy + xz), ly + max(0, yz), lz]]).T.tolist()
    with open(path, "w", encoding="ascii") as file:
        for step, atoms in frames.items():
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{ATOMS}\nITEM: BOX BOUNDS ")
            file.write("xy xz yz pp pp pp\n" if tilts else "pp pp pp\n")
            for axis in range(3):
                file.write(" ".join(map(repr, [*bounds[axis], *tilts[axis:axis + 1]])) + "\n")
            file.write("ITEM: ATOMS id type x y z ix iy iz vx vy vz radius\n")
            for i in random.Random(step).sample(range(ATOMS), ATOMS):
                values = [atoms[name][i] for name in ("type", "x", "image", "v", "radius")]
                words = [word for value in values for word in numpy.ravel(value).tolist()]
                file.write(" ".join(map(str, [i + 1, *words])) + "\n")


def simulate(program, script):
    """Runs LAMMPS or LIGGGHTS, and gives what they have at each step: got_STEP.txt, a dump."""
    with open("in.read", "w", encoding="ascii") as file:
        file.write(script)
    done = subprocess.run([program, "-log", "none", "-in", "in.read"], capture_output=True,
                          text=True, timeout=60)
    assert done.returncode == 0, script + done.stdout[-2000:] + done.stderr[-2000:]
    lists = {"type": ["type"], "x": ["x", "y", "z"], "image": ["ix", "iy", "iz"],
             "v": ["vx", "vy", "vz"], "radius": ["radius"]}
    got = {}
    for step in STEPS:
        frame, = plain_dump.read(f"got_{step}.txt")
        os.remove(f"got_{step}.txt")
        order = frame.numbers("id").argsort()
        assert frame.numbers("id")[order].tolist() == list(range(1, ATOMS + 1)), f"{frame.rows} atoms"
        origin, box = frame.box()
        got[step] = {"origin": origin, "box": box, **{
            name: numpy.squeeze(frame.stack(columns)[order]) for name, columns in lists.items()}}
    return got


# A box that is not that of the file, which takes its place.
REGION = {"straight": "block 0 9 0 9 0 9", "tilted": "prism 0 9 0 9 0 9 1 1 1"}
GOT = "id type x y z ix iy iz vx vy vz radius"


def fields_of(columns, *more):
    return " ".join(["x y z"] + [word for word in columns if word in (*GOT.split()[5:11], *more)])


def read_lammps(path, columns, shape):
    got = simulate("lmp", f"""
atom_style sphere
region all {REGION[shape]}
create_box 2 all
""" + "".join(f"""
read_dump {path} {step} {fields_of(columns)} box yes replace no purge yes add keep
write_dump all custom got_{step}.txt {GOT} modify format float %.17g
""" for step in STEPS))
    for values in got.values():
        del values["radius"]  # is none of the fields that it reads
    return got


def read_liggghts(path, columns, shape):
    return simulate("liggghts", f"""
atom_style sphere
atom_modify sort 0 0
communicate single vel yes
region all {REGION[shape]}
create_box 2 all
neighbor 0.1 bin
""" + "".join(f"""
read_dump {path} {step} {fields_of(columns, "radius")} box yes replace no purge yes add yes
dump got all custom 1 got_{step}.txt {GOT}
dump_modify got format "%d %d %.17g %.17g %.17g %d %d %d %.17g %.17g %.17g %.17g"
run 0
undump got
""" for step in STEPS))


def read_ase(path, columns, shape):
    import ase.io
    kind = {"format": "lammps-dump-binary", "colnames": columns} if path.endswith(".bin") else \
        {"format": "lammps-dump-text"}
    images, got = ase.io.read(path, index=":", units="metal", **kind), {}
    assert len(images) == len(STEPS)
    for step, atoms in zip(STEPS, images):
        got[step] = {"origin": atoms.get_celldisp().ravel(), "box": atoms.get_cell()[:],
                     "type": atoms.get_atomic_numbers(), "x": atoms.get_positions()}
        if columns[2].startswith("xs"):
            got[step]["x"] += LOW  # it places these in a cell whose corner is 0
        if "vx" in columns:
            got[step]["v"] = atoms.get_velocities() * (1e-12 * ase.units.second)
    return got


# How, the command, and what is tried. LIGGGHTS as Debian has it reads neither compressed nor binary
# dumps, needs the radius, and numbers the atoms that it adds, for which files are sorted; LAMMPS of
# 2021 reads no binary dumps, not even its own.
BOTH = ("LIGGGHTS", "LAMMPS")
PROGRAMS = {
    "lammps": (read_lammps, "lmp", {"txt": BOTH, "gz": ("LAMMPS",)}, CUSTOM + ATOM),
    "liggghts": (read_liggghts, "liggghts", {"txt": BOTH}, CUSTOM[:4]),
    "ase": (read_ase, None, {"txt": BOTH, "gz": BOTH, "bin": BOTH}, CUSTOM + ATOM)}


def compare(path, got, atoms, columns, box):
    """What a program got, and what there was; returns the largest difference of a coordinate."""
    atoms = {**atoms, "origin": LOW, "box": box}
    unwrapped = columns[2].endswith("u")
    if unwrapped and "image" not in got:  # else the program has wrapped and counted
        atoms["x"] = atoms["x"] + atoms["image"] @ box
    if not unwrapped and "ix" not in columns:
        atoms["image"] = numpy.zeros_like(atoms["image"])
    if "vx" not in columns:
        got.pop("v", None)
    for name, values in got.items():
        assert values.shape == atoms[name].shape, (path, name)
        apart = abs(values - atoms[name]).max()
        assert apart <= TOLERANCES.get(name, 0), (path, name, apart)
    return abs(got["x"] - atoms["x"]).max()


def main(name):
    read, command, ends, forms = PROGRAMS[name]
    if not (shutil.which(command) if command else importlib.util.find_spec(name)):
        print(f"skipped: {name} is not installed")
        return
    count, largest = 0, 0
    for shape, box in BOXES.items():
        frames = make_frames(box)
        write_plain(f"{shape}.dump", box, frames)
        source = OpenDataFile(os.path.abspath(f"{shape}.dump"))
        for form in forms:
            columns = columns_of(form)
            for end, dialects in ends.items():
                for dialect in dialects:
                    path = f"{shape}_{len(form)}_{'_'.join(columns)}_{dialect}.{end}"
                    vg.save(source, path, writer="GranularDumpWriter", Dialect=dialect, WriteTimeSteps=1, **form,
                            NumberFormat="%.17g", SortById=name == "liggghts")
                    for step, got in read(path, columns, shape).items():
                        largest = max(largest, compare(path, got, frames[step], columns, box))
                        count += 1
    print(f"{name} read {count} frames, coordinates to within {largest:.1g}")


main(sys.argv[1])
