# SPDX-License-Identifier: BSD-3-Clause
"""Thermo tables of logs are the numbers that Python reads in known lines, and those that the same runs wrote into other files."""
import bz2
import functools
import gzip
import importlib.util
import lzma
import os
import pickle
import re
import sys
import tracemalloc
import types
import warnings

import vtkgranular as vg

assert not {"numpy", "vtkmodules", "paraview", "pandas"} & {name.split(".")[0] for name in sys.modules}, "import vtkgranular imports these"

import numpy  # noqa: E402
from text_files import told, written  # noqa: E402

ROOT = os.environ["GRANULAR_ROOT"]
DATA = os.path.join(os.environ["GRANULAR_DATA"], "good", "log")


def raises(kind, call, *words):
    try:
        call()
    except Exception as error:  # noqa: BLE001
        assert type(error) is kind, (type(error), error)
        assert all(word in str(error) for word in words), error
        return error
    raise AssertionError(f"expected {kind}")
read = functools.partial(told, vg.read_log)


def zstandard(content):
    """A frame of Zstandard (RFC 8878) with one block that is stored as it is."""
    return b"\x28\xb5\x2f\xfd\0\x58" + (len(content) << 3 | 1).to_bytes(3, "little") + content


def lines_of(name):
    with open(os.path.join(DATA, name)) as stream:
        return stream.read().split("\n")


def table_of(lines, first, last):
    """Rows of known lines, which are counted from 1. Other output in these lines has words, or two numbers."""
    rows = [line.split() for line in lines[first - 1:last]]
    are_rows = [row for row in rows if len(row) > 2 and all(re.fullmatch("[-+0-9.e]+", word) for word in row)]
    return numpy.array([[float(word) for word in row] for row in are_rows])


def same(array, numbers):
    assert numpy.array_equal(array, numbers, equal_nan=True), (array, numbers)


def near(array, numbers, digits):
    """Printed with some digits, these numbers are the others."""
    assert len(array) == len(numbers) > 0
    assert all(f"{one:.{digits}g}" == f"{other:.{digits}g}" for one, other in zip(array, numbers)), (array, numbers)


# ---- LAMMPS: known lines of the file ----
lammps = os.path.join(DATA, "lammps.txt")
lines = lines_of("lammps.txt")
PRINTED = "lammps.txt:52: expected 6 numbers in a row, got 2; lines like this are left out: 9"
log = read(lammps, PRINTED)
assert [len(run) for run in log.runs] == [6, 10, 4, 4, 2] and [run.line for run in log.runs] == [50, 99, 147, 235, 269]
one, custom, multi, again, minimal = log.runs
assert lines[49].split() == one.columns and one.columns == "Step Temp E_pair E_mol TotEng Press".split()
numbers = table_of(lines, 51, 65)
assert numbers.shape == (6, 6)
for i, name in enumerate(one):
    same(one[name], numbers[:, i])
assert one["Step"].dtype == numpy.int64 and one["Temp"].dtype == float and not one["Temp"].flags.writeable
# Step is not the first column, and two columns have the same name
assert lines[98].split() == "Time Step Elapsed Temp Press Volume Volume".split()
assert custom.columns == "Step Time Elapsed Temp Press Volume Volume#2".split()
numbers = table_of(lines, 100, 117)
assert numbers.shape == (10, 7)
for i, name in enumerate("Time Step Elapsed Temp Press Volume Volume#2".split()):
    same(custom[name], numbers[:, i])
# blocks: in the third one the names and values are those of its lines
assert multi.steps.tolist() == [190, 200, 210, 220] and multi.columns[:3] == ["Step", "CPU", "TotEng"]
block = lines[lines.index("210 is a step, temperature 1.655") + 1:][:5]
assert block[0].split()[2] == "210"
words = " ".join(block[1:]).split()
assert len(words) == 36 and [multi[name][2] for name in words[::3]] == [float(word) for word in words[2::3]]
assert numpy.isinf(again["v_large"]).all() and numpy.isnan(again["v_none"]).all()
assert minimal.steps.tolist() == [225, 250]  # run ... pre no: names of columns without the line before them

# ---- LAMMPS: what fix ave/time wrote of the same runs ----
first, second = (numpy.loadtxt(os.path.join(DATA, name)) for name in ("lammps.ave", "lammps_again.ave"))
for run, others, digits in ((one, first, 8), (custom, first, 8), (again, second, 10), (minimal, second, 10)):
    chosen = numpy.isin(run.steps, others[:, 0])
    others = others[numpy.isin(others[:, 0], run.steps)]
    assert chosen.any()
    near(run["Temp"][chosen], others[:, 1], digits)
    near(run["Press"][chosen], others[:, 3], digits)
near(one["E_pair"], first[numpy.isin(first[:, 0], one.steps), 2] / 32, 8)
assert numpy.allclose(multi["Temp"], first[numpy.isin(first[:, 0], multi.steps), 1], rtol=0, atol=0.5001e-4)

# ---- all rows, and the last row of each timestep ----
rows = log.all_rows
assert rows.columns[:2] == ["Run", "Step"] and set(rows.columns) == {"Run", *(name for run in log.runs for name in run)}
assert rows["Run"].tolist() == [0] * 6 + [1] * 10 + [2] * 4 + [3] * 4 + [4] * 2
for number, run in enumerate(log.runs):
    for name in rows.columns[1:]:
        part = rows[name][rows["Run"] == number]
        same(part, run[name] if name in run else numpy.full(len(run), numpy.nan))
expected = {}  # by timestep: run and row
for number, run in enumerate(log.runs):
    for row, step in enumerate(run.steps.tolist()):
        expected[step] = number, row
assert log.steps.tolist() == sorted(expected) and len(log) == len(expected) == 21
for row, (step, (number, place)) in enumerate(sorted(expected.items())):
    for name in log.runs[number]:
        same(log[name][row], log.runs[number][name][place])
# timestep 190 ends a run and begins the next one; 200 was begun again, and its columns of the run before do not count
assert log["Press"][log.steps == 190] == 10.425 and log["Time"][log.steps == 190] == 0.58 and log["TotEng"][log.steps == 190] == 0.1892
assert numpy.isnan(log["TotEng"][log.steps == 200]) and log["Temp"][log.steps == 200] == 1.614957971

# ---- times: those that the dump of the same run holds, also after another timestep was chosen ----
with open(os.path.join(DATA, "lammps.dump")) as stream:
    told = re.findall(r"ITEM: TIME\n(\S+)\nITEM: TIMESTEP\n(\d+)\n", stream.read())
for time, step in told[:1] + told[2:]:
    assert numpy.allclose(log.times[log.steps == int(step)], float(time), rtol=1e-15, atol=0), step
assert len(told) == 5 and log.times[log.steps == 120] == 0.44 and log.times[-1] == 0.7
same(one.times, [0, 0.08, 0.16, 0.24, 0.32, 0.4])
numbers = read(lammps, PRINTED, dt=1e-5).times
same(numbers, [float(f"{step}e-5") for step in log.steps])
frames = vg.open(os.path.join(DATA, "..", "grains.dump"), dt=2e-5)
same(read(written("".join(["Step Temp\n", *(f"{step} 1\n" for step in frames.steps)])), dt=2e-5).times, frames.times)

# ---- the screen, another line end, packed logs, and logs one after the other ----
screen = read(os.path.join(DATA, "lammps_screen.txt"), "lammps_screen.txt:32: expected 6")
with open(lammps, "rb") as stream:
    whole = stream.read()
packed = gzip.compress(whole)
half = whole.index(b"clear\n")
logs = [written(whole[:half], "first.txt"), written(whole[half:], "second.txt")]
for other in (screen, read(written(whole.replace(b"\n", b"\r\n")), "made.txt:52"), read(written(packed, "packed.gz"), "packed.gz:52"),
              read(written(bz2.compress(whole), "log.bz2"), "log.bz2:52"), read(written(lzma.compress(whole), "log.xz"), "log.xz:52"),
              read(written(zstandard(whole), "log.zst"), "log.zst:52"), read(logs, "first.txt:52"), pickle.loads(pickle.dumps(log))):
    assert other.columns == log.columns and [run.columns for run in other.runs] == [run.columns for run in log.runs]
    for name in log:
        same(other[name], log[name])
        same(other.all_rows[name], log.all_rows[name])
    same(other.times, log.times)
assert read(logs, "first").paths == [os.path.abspath(name) for name in logs]
assert "first.txt, second.txt: 21 timesteps in 5 runs" in repr(read(logs, "first")) and "first.txt:50" in repr(read(logs, "first").runs[0])

# ---- LIGGGHTS, and what fix print wrote of the same run ----
path = os.path.join(DATA, "liggghts.txt")
log = read(path)
values = {int(row[0]): row[1:] for row in numpy.loadtxt(os.path.join(DATA, "liggghts.values"))}
assert [run.columns for run in log.runs] == ["Step Atoms KinEng CPU".split(), "Step Atoms KinEng rke Volume CPU".split(),
                                             "Step CPU Atoms KinEng".split(), "Step Atoms Time KinEng".split()]
assert [run.steps.tolist() for run in log.runs] == [list(range(0, 1001, 200)), list(range(1000, 1501, 100)), [1500, 1600, 1700],
                                                    [1700, 1800]]
for number, run in enumerate(log.runs):
    for row, step in enumerate(run.steps.tolist()):
        atoms, energy, rotation = values.get(step, (0, 0, 0))
        assert run["Atoms"][row] == atoms
        if number == 2:
            assert run["KinEng"][row] == round(energy, 4)
        else:
            near([run["KinEng"][row]], [energy], 8)
        if "rke" in run:
            near([run["rke"][row]], [rotation], 8)
same(log.times, [float(f"{2 * step}e-5") for step in log.steps])
same(log.runs[3].times, log.runs[3]["Time"])
assert "KinEng" in log and "kineng" not in log and list(log) == log.columns and log == log
error = raises(vg.ColumnError, lambda: log["kineng"], "KinEng", "'kineng'")
assert isinstance(error, KeyError)
if importlib.util.find_spec("pandas"):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # some versions warn when they are imported
        table = log.to_pandas()
    assert list(table.columns) == log.columns and len(table) == len(log)
    same(table["KinEng"].to_numpy(), log["KinEng"])
else:
    sys.modules["pandas"] = types.SimpleNamespace(DataFrame=dict)
    assert list(log.to_pandas()) == log.columns
    same(log.to_pandas()["KinEng"], log["KinEng"])

# ---- wherever a log ends, its rows are the first ones of the whole log ----
for name in ("lammps.txt", "liggghts.txt"):
    with open(os.path.join(DATA, name), "rb") as stream:
        whole = stream.read()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rows = vg.read_log(os.path.join(DATA, name)).all_rows
        largest = 0
        for size in range(0, len(whole), 7):
            try:
                part = vg.read_log(written(whole[:size])).all_rows
            except vg.Error as error:
                assert largest == 0 and "made.txt" in str(error), error
                continue
            assert largest <= len(part) <= len(rows), size
            largest = len(part)
            for column in part:
                same(part[column], rows[column][:largest])
        assert largest == len(rows)
        # and so it is if the end of compressed data is missing
        packed = gzip.compress(whole)
        for size in range(len(packed) // 2, len(packed) - 8, 101):
            part = vg.read_log(written(packed[:size], "cut.gz")).all_rows
            assert 0 < len(part) <= len(rows)
            for column in part:
                same(part[column], rows[column][:len(part)])
MEMORY = "Memory usage per processor = 4 Mbytes\n"
TABLE = "Step Temp Press \n       0 1 2 \n      10 3 4 \n      20 5 6 \n"
for pack, name in ((gzip.compress, "gzip"), (bz2.compress, "bzip2"), (lzma.compress, "xz"), (zstandard, "Zstandard")):
    read(written(pack(TABLE.encode())[:-9], "cut"), f"cut: expected complete {name} data")

# ---- the form of newer versions of LAMMPS, by their documentation: centred names, and yaml ----
numbers = [[0, 1.5, -2], [10, float("inf"), 3e-7]]
log = read(written("LAMMPS (2 Aug 2023)\ntimestep 0.5\nPer MPI rank memory allocation (min/avg/max) = 4 | 4 | 4 Mbytes\n"
                   "   Step          Temp          v_a      \n         0   1.5           -2            \n"
                   "WARNING: something (src/fix.cpp:1)\n        10   inf            3e-07         \nLoop time of 1 on 1 procs\n"))
same(numpy.column_stack([log[name] for name in ("Step", "Temp", "v_a")]), numbers)
same(log.times, [0, 5])
for names in ("'Step', 'Temp', 'v_a[1]', ", "Step, Temp, v_a[1], ", "Step, Temp, v_a[1]"):
    log = read(written(f"Per MPI rank memory allocation (min/avg/max) = 4 | 4 | 4 Mbytes\n---\nkeywords: [{names}]\ndata:\n"
                       "  - [0, 1.5, -2, ]\nWARNING: something\n  - [10, inf, 3e-07]\n...\nLoop time of 1 on 1 procs\n"))
    same(numpy.column_stack([log[name] for name in ("Step", "Temp", "v_a[1]")]), numbers)
BLOCKS = ("------------ Step              0 ----- CPU =            0 (sec) -------------\nTemp     =   1.5 v_a      =     -2\n"
          "------------ Step             10 ----- CPU =          0.5 (sec) -------------\nTemp     =   inf v_a      =     3e-7\n")
log = read(written(BLOCKS))
same(numpy.column_stack([log[name] for name in ("Step", "Temp", "v_a")]), numbers)
assert log["CPU"].tolist() == [0, 0.5]
assert len(read(written(BLOCKS.replace("v_a", "\nv_a").rsplit("\n", 2)[0] + "\n"), "made.txt:5: the last block ends early")) == 1

# ---- small files, and siblings of their kinds: columns, timesteps, times, and the last column of each run ----
PER, LOOP = "Per MPI rank memory allocation (min/avg/max) = 4 | 4 | 4 Mbytes\n", "Loop time of 1 on 1 procs for 100 steps with 10 atoms\n"
NO_STEP = "made.txt:{}: expected the column Step, got a table without it, "
FILES = {"renamed": ([("Step|Kinetic Energy|Time", [0, 50, 100], [0, 0.25, 0.5], [0, 0.25, 0.5])],),
         "named_1": ([("Step|Atoms|KinEng|1|Volume", [100, 200], [0.001, 0.002], [0.001, 0.001])],),
         "second_named_1": ([("Step|Atoms|KinEng|Volume", [0, 100], [0, 0.001], [0.001, 0.001]),
                             ("Step|Atoms|KinEng|1|Volume", [100, 200], [0.001, 0.002], [0.001, 0.001])],),
         "no_step": ([("Step|KinEng|Volume", [0, 1], [0, 1], [0.001, 0.001])], "no_step.txt:6: expected the column Step"),
         "neb": ([("Step|MaxReplicaForce|MaxAtomForce|EBF|EBR|RDT|RD1|PE1|RD2|PE2|11|12", [0, 100], [0, 100], [-3.05, -3.05])],)}
SIBLINGS = (  # text, runs, what is told; | stands for the end of a table, and M and P for lines about memory
    ("M  Step nan inf \n  0 1 2 \n  5 3 4 \n|", [("Step|nan|inf", [0, 5], [0, 5], [2, 4])]),
    ("M  1e5 Step Volume \n  0.5 20 1 \n  0.5 30 2 \n|", [("Step|1e5|Volume", [20, 30], [20, 30], [1, 2])]),
    ("timestep 2\nP  timestep Step \n  0.5 0 \n  0.75 10 \n|", [("Step|timestep", [0, 10], [0, 20], [0.5, 0.75])]),
    ("P  1 Step \n  7 0 \n|run 10 pre no\n  1 Step \n  8 0 \n  9 10 \n|",
     [("Step|1", [0], [0], [7]), ("Step|1", [0, 10], [0, 10], [8, 9])]),
    ("P  Step E \nWARNING: x\nFor more information see https://docs.lammps.org/err0008 (src/thermo.cpp:533)\n  0 1 \n|",
     [("Step|E", [0], [0], [1])]),
    ("P  Step E \n  0 1 \nStep by\n  1.5 2 \n  10 3 \n|", [("Step|E", [0, 10], [0, 10], [1, 3])],
     "expected a row after timestep 0, got '1.5 2'"),
    # tables without Step, and runs without a table
    ("M  KinEng Volume \n  1 2 \n  3 4 \n|M  KinEng \n  5 \n|",
     [("Step|KinEng|Volume", [0, 1], [0, 1], [2, 4]), ("Step|KinEng", [2], [2], [5])],
     NO_STEP.format(2) + "whose rows are numbered; line 7: expected the column Step"),
    ("units si\nM  Time KinEng \n  0.5 1 \n  0.75 3 \n", [("Step|Time|KinEng", [0, 1], [0.5, 0.75], [1, 3])], NO_STEP.format(3)),
    ("timestep 0.5\nM  Step E \n  0 1 \n  10 2 \n|M  Time E \n  5 2 \n  10 3 \n|",
     [("Step|E", [0, 10], [0, 5], [1, 2]), ("Step|Time|E", [10, 20], [5, 10], [2, 3])], NO_STEP.format(8) + "whose column Time counts"),
    ("M  Temp Press \n  1 2 \n  3 4 \n|M  E \n  5 \n|M  Step E \n  0 1 \n|", [("Step|E", [0], [0], [1])],
     NO_STEP.format(2) + "which is left out; line 7: expected the column Step, got a table without it, which is left out"),
    ("M  Step E \n  0 1 \n|run 10\n|run 10\n|", [("Step|E", [0], [0], [1])],
     "made.txt:6: expected a table for each of 3 lines 'Loop time', got none before line 6, 8"),
    ("M  Step E \n  0 1 \n|M  Step F \n|", [("Step|E", [0], [0], [1])],
     "made.txt:6: expected rows of numbers below the columns Step F, got none"),
    # the last dt that is seen, until the next command `timestep`
    ("timestep 1\nP  Step Dt \n  0 1 \n  10 2 \n  20 4 \n|P  Step E \n  20 1 \n  30 2 \n|timestep 1\nP  Step E \n  30 2 \n  40 1 \n|",
     [("Step|Dt", [0, 10, 20], [0, 10, 30], [1, 2, 4]), ("Step|E", [20, 30], [30, 70], [1, 2]), ("Step|E", [30, 40], [70, 80], [2, 1])]),
    ("timestep 1\nP  Step Time \n  0 0 \n  10 10 \n  20 40 \n|reset_timestep 0\nP  Step E \n  0 1 \n  10 2 \n|",
     [("Step|Time", [0, 10, 20], [0, 10, 40], [0, 10, 40]), ("Step|E", [0, 10], [0, 30], [1, 2])]),
    ("timestep 1.25\nP  Step Time \n  0 0 \n  1 1.2 \n  2 2.5 \n|P  Step E \n  2 1 \n  4 2 \n|",  # rounded, but not another one
     [("Step|Time", [0, 1, 2], [0, 1.25, 2.5], [0, 1.2, 2.5]), ("Step|E", [2, 4], [2.5, 5], [1, 2])]),
    ("Step F1 F2 RD1 PE1 ... RDN PEN\n0 1 2 0 5 0.5 6 1 7 \nClimbing replica = 3\nStep F1 F2 RD1 PE1 ... RDN PEN\n1 1 2 0 5 0.5 6 1 8",
     [("Step|F1|F2|RD1|PE1|6|7|8|9", [0], [0], [7]), ("Step|F1|F2|RD1|PE1|6|7|8|9", [1], [1], [8])]))
for text, runs, *told in (*((name, *rest) for name, rest in FILES.items()), *SIBLINGS):
    made = re.sub("^[MP]  ", lambda found: (MEMORY if found[0][0] == "M" else PER) + "  ", text.replace("|", LOOP), flags=re.MULTILINE)
    log = read(os.path.join(DATA, text + ".txt") if text in FILES else written(made), *told)
    found = [("|".join(run.columns), run.steps.tolist(), run.times.tolist(), run[[*run][-1]].tolist()) for run in log.runs]
    assert found == runs, (text, found)

# ---- all styles of LAMMPS of 2026: line, timesteps, times, and ends of the last column, which were read by eye ----
lines, log = lines_of("styles.txt"), read(os.path.join(DATA, "styles.txt"))
DT, SHOWN = 3.42893519140375e-05, 0.0594396750150454  # the last ones that a run shows before fix dt/reset ends
STYLES = ((55, 0, 300, 0.015, "Press", 2.0248251, 0.84679908), (90, 300, 600, 0.03, "v_tons", 3.0869289e-06, 3.0869289e-06),
          (126, 600, 800, 0.04, "step_size", 5e-05, 5e-05), (161, 800, 1000, 0.044, "Press", 4.1985, 5.3035),
          (206, 1000, 1200, 0.048, "v_tons", 0, 0), (246, 1200, 1400, 0.052, "Press", 4.89549930098869, 5.14139767632874),
          (284, 1400, 1600, SHOWN, "c_1", 1.57250148053089e-05, 3.03553975675085e-05),
          (320, 1600, 1700, SHOWN + 100 * DT, "c_1", 3.03554e-05, 4.62403e-05),
          (352, 1700, 1800, SHOWN + 200 * DT, "c_1", 4.62403e-05, 5.38449e-05),
          (405, 1800, 1820, SHOWN + 220 * DT, "c_1", 5.3844863e-05, 5.3844863e-05),
          (472, 0, 200, 200 * DT, "KinEng", 12.862204, 1.6902153e-05))
assert len(log.runs) == len(STYLES)
for run, (line, first, last, time, name, begin, end) in zip(log.runs, STYLES):
    assert (run.line, *run.steps[[0, -1]], *run[name][[0, -1]]) == (line, first, last, begin, end) and run.columns[-1] == name, run
    assert abs(run.times[-1] - time) < 1e-9, (line, run.times)
    if lines[line - 1].split()[0] == "Step" and "energy of motion" not in run:
        numbers = table_of(lines, line + 1, line + 1 + len(run) + 2)
        assert lines[line - 1].split() == run.columns and numbers.shape == (len(run), len(run.columns)), run
        for i, name in enumerate(run):
            same(run[name], numbers[:, i])
assert log.runs[7].columns == log.runs[6].columns == ["Step", "Dt", "Time", "energy of motion", "c_1"]

# ---- other output that looks like rows or names ----
log = read(written("Memory usage per processor = 4 Mbytes\n    Step Temp Press \n       0 1 2 \n10 7 8\n      10 3 4 \n30\nERROR x\n"
                   "      20 5 6\nStep by step\n20 steps\n      30 7 8\nLoop time of 1\nStep aside\n40 1\n"),
           "made.txt:4: expected a row after timestep 0, got '10 7 8'; lines like this are left out: 3")
same(numpy.column_stack([log["Step"], log["Press"]]), [[0, 2], [10, 4], [20, 6], [30, 8]])
log = read(written("Step Temp Press\n0 1 2\n10 3 4\nStep Temp\n5 1.5\n15 2.5\n"))  # a form by hand, and a run that does not end
assert [run.columns for run in log.runs] == [["Step", "Temp", "Press"], ["Step", "Temp"]] and log.steps.tolist() == [0, 5, 10, 15]
log = read(written(" Step A_rather_long_name\n  999990 1.5\n99999990 2.5\n99999995 1_0\n100000000 3.5\n"),
           "made.txt:4: expected a row after timestep 99999990, got '99999995 1_0'")
assert log["A_rather_long_name"].tolist() == [1.5, 2.5, 3.5]
log = read(written(TABLE.replace("20 5 6", "10 5 6")), "made.txt:4: expected a row after timestep 10, got '10 5 6'")
assert log.steps.tolist() == [0, 10] and log["Press"].tolist() == [2, 4]
log = read(written("Step Temp\n9007199254740993 1\n9007199254740994 2\n"))
assert log.steps.tolist() == [9007199254740993, 9007199254740994]
# at the end of a run, columns go on into the next run, also over runs of no steps, but not over rows that were begun again
text = TABLE + "Loop time of 1\nStep Temp\n20 7\nLoop time of 1\nStep Temp\n20 8\n30 9\nLoop time of 1\n"
log = read(written(text))
same(numpy.column_stack([log[name] for name in log]), [[0, 1, 2], [10, 3, 4], [20, 8, 6], [30, 9, numpy.nan]])
same(read(written(text + "Step Temp\n10 1\n20 2\n"))["Press"], [2, numpy.nan, numpy.nan, numpy.nan])
# names that repeat, and tables with columns of their own: memory for the numbers of the log, and not for rows times columns
log = read(written(MEMORY + "Step a a#2" + " a" * 6000 + "\n0" + " 1" * 6002 + "\n"))
assert log.columns == ["Step", "a", "a#2", *(f"a#{i}" for i in range(3, 6003))] and log["a#6002"].tolist() == [1]
OWN = "------------ Step {0:14} ----- CPU = {1:12} (sec) -------------\nboth = 1.5 own{1} = {1}\n"
for text in ("".join(OWN.format(10 * i, i) for i in range(3000)),
             "".join(f"Step both own{i}\n{10 * i} 1.5 {i}\n{10 * i + 10} 1.5 {i}\nLoop time of 1\n" for i in range(3000)),
             "".join(f"Step both own{i}\n10 1.5 {i}\nLoop time of 1\n" for i in range(3000))):
    tracemalloc.start()
    log = read(written(text))
    assert tracemalloc.get_traced_memory()[1] < 30e6
    tracemalloc.stop()
    assert numpy.nansum(log["own2998"]) in (2998, 2 * 2998) and (log["both"] == 1.5).all() and "own2999" in log.columns
same(log["own7"], [7])  # of the last row of a timestep, with the columns of the runs that end there

# ---- renamed columns, whose names may have blanks; tables without Step ----
ROWS = "         0   1.5            -2\n        10   2.5            -3\nLoop time of 1 on 1 procs\n"
for header in ("   Step      Kinetic Energy      v_a       \n", "   Step           E_x      Kinetic Energy\n"):
    for before in (PER, "run 10 pre no\n"):
        log = read(written(before + header + ROWS))
        assert log.columns == re.split(" {2,}", header.strip()) and log["Kinetic Energy"][0] in (1.5, -2)
RENAMED = 'thermo_modify line one colname 2 "Kinetic Energy" colname pe \'Potential, all of it\'\n'
log = read(written(RENAMED + PER + "   Step     Kinetic Energy Potential, all of it \n" + ROWS))
assert log.columns == ["Step", "Kinetic Energy", "Potential, all of it"] and log.steps.tolist() == [0, 10]
log = read(written(PER + "---\nkeywords: ['Step', 'Kinetic Energy', 'Potential, all of it', ]\ndata:\n  - [0, 1.5, -2, ]\n...\n"))
assert log.columns == ["Step", "Kinetic Energy", "Potential, all of it"]
log = read(written('thermo_modify colname temp "Kinetic Energy"\n' + BLOCKS.replace("Temp    ", "Kinetic Energy")))
assert log["Kinetic Energy"].tolist() == [1.5, numpy.inf] and log["v_a"].tolist() == [-2, 3e-7]
for column in ("step", "1", "-6"):
    log = read(written(f'thermo_modify colname {column} "MD step"\n' + PER + "  MD step         E_x            E_y\n" + ROWS))
    assert log.steps.tolist() == [0, 10] and log.columns == ["Step", "E_x", "E_y"]
# a renamed column by its number is the timestep if the style says so, until the next style or `default`
NAMED = "thermo_style custom {}\nthermo_modify colname {} MD\n"
COLUMNS = PER + "         MD           E_x            E_y\n" + ROWS
for before in (NAMED.format("step ke pe", 1), NAMED.format("step ke pe", -3)):
    assert read(written(before + COLUMNS)).columns == ["Step", "E_x", "E_y"]
for before in (NAMED.format("ke step pe", 1), NAMED.format("step ke pe", 1) + "thermo_style custom step ke pe\n",
               NAMED.format("step ke pe", 1) + "thermo_modify colname default\n"):
    assert read(written(before + COLUMNS), "without it, whose rows are numbered")["MD"].tolist() == [0, 10]
log = read(written(BLOCKS.replace("v_a      =     -2\n", "v_a      =     -2\nNeighbor list builds = 5\n")))
assert log.columns == ["Step", "CPU", "Temp", "v_a"]
EMPTY = "expected rows of numbers below the columns Step RDN PEN, got none: the table is left out"
read(written(TABLE + "Loop time of 1\nStep RDN PEN\n0 1 2 3\n10 4 5 6\n"), "made.txt:6: " + EMPTY)
read(written(MEMORY + TABLE + f"Loop time of 1\n{MEMORY} Step RDN PEN\nERROR x\nLAMMPS (1 Jan 2026)\n"), "made.txt:8: " + EMPTY)

# ---- times go on after another timestep, also where a run begins again before it; 0 after `reset_timestep` to a smaller one ----
RESET = "units si\nfix 1 all dt/reset 1 1e-9 1e-3 0.01\nStep Time \n 0 0 \n 10 1e-7 \n 20 1.5e-7 \n"
PART = "timestep {}\nStep Temp\n{} 1\n{} 2\nLoop time of 1\n".format
for text, times in ((RESET, [[0, 1e-7, 1.5e-7]]), ("units si\n" + TABLE, [[0, 1e-7, 2e-7]]), ("Step Time \n 0 0 \n 10 3 \n", [[0, 3]]),
                    ("Step Time \n 0 0 \n 10 3 \nLoop time of 1\nStep Temp \n 20 5\n", [[0, 3], [6]]),
                    (PART(0.1, 0, 10) + PART(0.2, 10, 20) + PART(0.1, 5, 15) + PART(0.3, 15, 16), [[0, 1], [1, 3], [0.5, 1.5], [1.5, 1.8]]),
                    (PART(0.1, 0, 10) + "reset_timestep 5\n" + PART(0.1, 5, 15) + PART(0.2, 15, 16), [[0, 1], [0, 1], [1, 1.2]]),
                    (PART(0.1, 0, 10) + "reset_timestep 20\n" + PART(0.2, 20, 30), [[0, 1], [2, 4]]),
                    (PART(0.1, 0, 10) + "reset_timestep 20 time 7\n" + PART(0.2, 20, 30) + PART(0.1, 30, 40), [[0, 1], [7, 9], [9, 10]]),
                    ("timestep 0.1\nStep Time\n0 0\n10 0.5\nLoop time of 1\n" + PART(0.2, 10, 20), [[0, 0.5], [0.5, 2.5]])):
    assert [run.times.tolist() for run in read(written(text)).runs] == times, text
logs = [written(PART(0.1, 0, 10), "first.txt"), written("reset_timestep 5\n" + PART(0.1, 5, 15), "second.txt")]
assert [run.times.tolist() for run in read(logs).runs] == [[0, 1], [0, 1]]
assert read(written(RESET), dt=2e-8).times.tolist() == [0, 2e-7, 4e-7] and read(logs, dt=1).all_rows.times.tolist() == [0, 10, 5, 15]

# ---- a last row without a line feed counts, but not if digits may be missing ----
BARE, YAML = TABLE.replace(" \n", "\n"), "keywords: ['Step', 'Temp', ]\ndata:\n  - [0, 1.5, ]\n  - [10, 2.5, ]"
for text, rows, is_whole in ((TABLE[:-1], 3, True), (TABLE[:-2], 3, True), (TABLE[:-3], 2, False), (TABLE[:-4], 2, False),
                             (TABLE + "Loop time of 1", 3, True),
                             (BARE[:-1], 3, True), (BARE[:-2] + "  ", 2, False), (BARE.replace("6", "6.25")[:-4], 3, True),
                             (BARE[:-3], 2, False), ("Step Temp\n0 1.25\n10 2", 2, True), ("Step Temp\n0 1", 1, True),
                             (BLOCKS[:-1], 2, True), (BLOCKS[:-2], 1, False), (BLOCKS[:-9], 1, False), (YAML, 2, True),
                             (YAML[:-1], 1, False), (YAML[:-3], 1, False)):
    assert len(read(written(text), *[] if is_whole else ["ends early and is left out"])) == rows, text
for text, rows in ((TABLE[:-2], 3), (BLOCKS[:-1], 2)):
    assert len(read(written(gzip.compress(text.encode()), "made.gz"))) == rows, text

# ---- what cannot be ----
DIGITS = "9" * 5000  # more than Python turns into a number
for text, line, column, *words in (
        (TABLE.replace("3 4", "3 four"), 3, "Press", "column 'Press': expected a number, got 'four'"),
        (TABLE.replace("10 3 4", "1x 3 4"), 3, "Step", "'1x'"), (MEMORY + TABLE.replace("0 1 2", "0 one 2"), 3, "Temp", "'one'"),
        (TABLE.replace("0 1 2", "0 one 2"), 1, "", "expected rows of numbers"), (BLOCKS.replace("inf", "many"), 4, "Temp", "'many'"),
        ("", 0, "", "expected a log, got an empty file"), (gzip.compress(b""), 0, "", "expected a log, got an empty file"),
        (TABLE[:20], 1, "", "expected rows of numbers", "Step Temp Press"), (TABLE[:22], 1, "", "expected rows of numbers"),
        ("units si\nrun 10\n", 0, "", "expected a thermo table", "Step", "got 2 lines"),
        ("Step Temp\n9223372036854775808 1\n", 2, "Step", "9223372036854775808"),
        (f"Step Temp\n0 1\n{DIGITS} 1\n", 3, "Step", "got 5000 digits"),
        (BLOCKS.replace("10 -", f"{DIGITS} -"), 3, "Step", "got 5000 digits"),
        (BLOCKS.replace("10 -", "-9223372036854775809 -"), 3, "Step", "got -922337203685477580")):
    error = raises(vg.Error, lambda: vg.read_log(written(text)), f"made.txt{f':{line}' if line else ''}: ", *words)  # noqa: B023
    assert (error.path, error.line, error.column) == (os.path.abspath("made.txt"), line, column), error
for text, count in ((MEMORY + TABLE.replace("0 1 2", "0 1"), 2), (TABLE.replace("10 3 4", "10 3"), 2),
                    (TABLE.replace("10 3 4", "10 3 4 5"), 4)):
    notice = f"made.txt:3: expected 3 numbers in a row, got {count}; lines like this are left out: 1"
    assert read(written(text), notice).steps[-1] == 20 and len(read(written(text), notice)) == 2
binary = os.path.join(DATA, "..", "grains.bin")
error = raises(vg.Error, lambda: vg.read_log(binary), "grains.bin: expected the text of a log, got a binary file")
assert error.byte >= 0
raises(vg.Error, lambda: vg.read_log(written(b"\x28\xb5\x2f\xfd0000", "log.zst")), "log.zst", "Zstandard")
damaged = bytearray(gzip.compress(whole))
damaged[len(damaged) // 2] ^= 0xff
raises(vg.Error, lambda: vg.read_log(written(bytes(damaged), "damaged.gz")), "damaged.gz: expected gzip data")
raises(FileNotFoundError, lambda: vg.read_log("nowhere.txt"), "nowhere.txt")
raises(IsADirectoryError, lambda: vg.read_log("."))
for dt in (0, -1, float("nan"), float("inf")):
    raises(vg.ArgumentError, lambda: vg.read_log(path, dt=dt), "dt", str(dt))  # noqa: B023
raises(vg.ArgumentError, lambda: vg.read_log([]), "at least one log")
raises(vg.ArgumentError, lambda: vg.read_log(path, dt=1e306), "finite times")
# a long line behind the pairs of a block costs time in proportion to its length, or this would not end
long = BLOCKS.split("\n")
log = read(written("\n".join([*long[:2], "a" * (1 << 20), *long[2:]])))
assert log.steps.tolist() == read(written(BLOCKS)).steps.tolist()
# a column of the log's own is no number of a run
log = read(written(TABLE.replace("Press", "Run")))
assert log["Run"].tolist() == log.all_rows["Run"].tolist() == log.runs[0]["Run"].tolist() and log["Run"].dtype == float, log.columns
assert log["Run"][0] == 2

# bytes of any kind are a log or an error
random = numpy.random.default_rng(1)
for _ in range(300):
    changed = bytearray(whole)
    for at in random.integers(0, len(whole), 20):
        changed[at] = random.integers(0, 256)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            vg.read_log(written(bytes(changed)))
        except vg.Error as error:
            assert error.path.endswith("made.txt")

# ---- the page of the guide ----
with open(os.path.join(ROOT, "docs", "guide", "logs.md")) as stream:
    page = stream.read()
(script,) = [block for block in re.findall(r"^```py\n(.*?)^```$", page, re.MULTILINE | re.DOTALL) if "read_log" in block]
os.makedirs("logs", exist_ok=True)
os.chdir("logs")
with open("log.liggghts", "wb") as stream:
    stream.write(whole)
exec(compile(script, "logs.md", "exec"), {"vg": vg})
print("logs are the numbers of their tables")
