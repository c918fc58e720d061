# SPDX-License-Identifier: BSD-3-Clause
"""Other programs on the same files: the time of each, and how far its numbers are from those in the file."""
import importlib.util
import re
import resource
import shutil
import subprocess

import numpy
from vtkmodules.vtkIOInfovis import vtkDelimitedTextReader
from vtkmodules.util.numpy_support import vtk_to_numpy

from scene import Packing, Rounds, array_of, main, open_dump, points_of, read_again

OURS = "vtk-granular, 1 thread"
PLACE = 1e3  # of the box


def read_ours(path):
    data = read_again(open_dump(path))
    return numpy.column_stack((points_of(data), array_of(data, "v"), array_of(data, "f")))


def read_loadtxt(path):
    return numpy.loadtxt(path, skiprows=9, usecols=range(2, 11))


def read_fromstring(path):
    with open(path, encoding="ascii") as stream:
        for _ in range(9):
            stream.readline()
        return numpy.fromstring(stream.read(), sep=" ").reshape(-1, 12)[:, 2:11]


def read_pandas(path):
    import pandas
    return pandas.read_csv(path, sep=" ", skiprows=9, header=None, usecols=range(2, 11)).to_numpy()


def read_pandas_exact(path):
    import pandas
    return pandas.read_csv(path, sep=" ", skiprows=9, header=None, usecols=range(2, 11),
                           float_precision="round_trip").to_numpy()


def read_ase(path):
    from ase.io import read
    return read(path, format="lammps-dump-text", units="metal").positions  # its units of length, so that none are changed


def read_mdanalysis(path):
    import MDAnalysis
    atoms = MDAnalysis.Universe(path, format="LAMMPSDUMP", topology_format="LAMMPSDUMP").atoms
    return atoms.positions + PLACE  # it moves the corner of the box to the origin


def read_vtk(path):
    reader = vtkDelimitedTextReader()
    with open(path, encoding="ascii") as stream:
        reader.SetInputString("".join(stream.readlines()[9:]))
    reader.ReadFromInputStringOn()
    reader.SetFieldDelimiterCharacters(" ")
    reader.DetectNumericColumnsOn()
    reader.MergeConsecutiveDelimitersOn()
    reader.Update()
    table = reader.GetOutput()
    return numpy.column_stack([vtk_to_numpy(table.GetColumn(k)) for k in range(2, 11)])


# name: (function, module that must be there)
READERS = {
    OURS: (read_ours, None),
    "numpy.fromstring": (read_fromstring, None),
    "numpy.loadtxt": (read_loadtxt, None),
    "pandas.read_csv": (read_pandas, "pandas"),
    "pandas.read_csv, round_trip": (read_pandas_exact, "pandas"),
    "VTK, vtkDelimitedTextReader": (read_vtk, None),
    "ASE, lammps-dump-text": (read_ase, "ase"),
    "MDAnalysis, LAMMPSDUMP": (read_mdanalysis, "MDAnalysis"),
}


def run_lammps(study, path, packing):
    """Returns true if LAMMPS has read all particles by read_dump."""
    script = study.folder / "in.read"
    script.write_text(f"""units si
atom_style sphere
region box block {packing.lo} {packing.hi} {packing.lo} {packing.hi} {packing.lo} {packing.hi}
create_box 1 box
read_dump {path} 0 x y z vx vy vz fx fy fz box yes add yes replace no purge yes
""", encoding="ascii")
    done = subprocess.run(["lmp", "-in", str(script), "-log", str(study.folder / "log")], capture_output=True, text=True,
                          check=False, cwd=study.folder)
    found = re.search(r"(\d+) atoms after read", done.stdout)
    return done.returncode == 0 and bool(found) and int(found.group(1)) == packing.rows


def study_of(study):
    packing = Packing(PLACE, layers=study.pick(1, 1), lattice=study.pick(63, 8))
    truth = numpy.column_stack((packing.points, packing.v, packing.f))
    paths = {text: str(packing.write(study.folder / f"{text[1:]}.dump", text)) for text in ("%g", "%.17g")}
    told = {text: numpy.array([[float(text % value) for value in row] for row in truth.tolist()]) for text in paths}
    times = Rounds()
    for name, (read, module) in READERS.items():
        if module and not importlib.util.find_spec(module):
            study.tell(name, "not installed", 1, "1")
            continue
        for text, path in paths.items():
            values = read(path)
            true = told[text][:, :values.shape[1]]
            used = ~numpy.isnan(values).any(0)
            wrong = numpy.abs(values[:, used] - true[:, used])
            ulps = wrong / numpy.spacing(numpy.abs(true[:, used]))
            study.tell(f"{name}; {text}", "wrong values", (wrong > 0).mean(), "1")
            study.tell(f"{name}; {text}", "error, largest", ulps.max(), "ulp")
            times.add(f"{name}; {text}", lambda read=read, path=path: read(path))
    study.check(study.cases[f"{OURS}; %.17g"]["wrong values:1"] == 0, OURS)
    times.run(study.pick(3, 1))
    for case in times.contenders:
        study.tell(case, "read", 1e9 * times.time(case) / packing.rows, "ns/particle")
        study.tell(case, "read against ours", times.ratio(case, f"{OURS}; {case.split('; ')[1]}"), "1")
    if shutil.which("lmp"):
        spent = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])  # noqa: E731
        start = spent()
        study.check(run_lammps(study, paths["%g"], packing), "LAMMPS read_dump")
        study.tell("LAMMPS, read_dump (whole program); %g", "read", 1e9 * (spent() - start) / packing.rows, "ns/particle")
    else:
        study.tell("LAMMPS, read_dump", "not installed", 1, "1")


main(study_of)
