# SPDX-License-Identifier: BSD-3-Clause
"""Thermo tables of logs are the numbers that Python reads in known lines, and those that the same runs wrote into other files."""
import gzip
import importlib.util
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


def read(path, *expected, **options):
    """The log, which warns once for each of the texts."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        log = vg.read_log(path, **options)
    told = [str(warning.message) for warning in caught]
    assert len(told) == len(expected) and all(part in text for part, text in zip(expected, told)), told
    assert all(warning.filename == __file__ for warning in caught), caught
    return log


def written(text, name="made.txt"):
    with open(name, "wb") as stream:
        stream.write(text if isinstance(text, bytes) else text.encode())
    return name


def lines_of(name):
    with open(os.path.join(DATA, name)) as stream:
        return stream.read().split("\n")


def table_of(lines, first, last):
    """Rows of known lines, which are counted from 1. Other output in these lines has words, or two numbers."""
    rows = [line.split() for line in lines[first - 1:last]]
    are_rows = [row for row in rows if len(row) > 2 and all(re.fullmatch("[-0-9.e]+", word) for word in row)]
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

# ---- the screen, another line end, gzip, and logs one after the other ----
screen = read(os.path.join(DATA, "lammps_screen.txt"), "lammps_screen.txt:32: expected 6")
with open(lammps, "rb") as stream:
    whole = stream.read()
packed = gzip.compress(whole)
half = whole.index(b"clear\n")
logs = [written(whole[:half], "first.txt"), written(whole[half:], "second.txt")]
for other in (screen, read(written(whole.replace(b"\n", b"\r\n")), "made.txt:52"), read(written(packed, "packed.gz"), "packed.gz:52"),
              read(logs, "first.txt:52"), pickle.loads(pickle.dumps(log))):
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
log = read(written(TABLE[:-4]), "made.txt:4: the last line ends early and is left out")
assert log.steps.tolist() == [0, 10] and log.times.tolist() == [0, 10]
read(written(gzip.compress(TABLE.encode())[:-9], "cut.gz"), "cut.gz: expected complete gzip data")

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
log = read(written("keywords: ['Step', 'Temp', ]\ndata:\n  - [0, 1.5, ]\n  - [10, 2.5"), "made.txt:4: the last line ends early")
assert len(log) == 1
BLOCKS = ("------------ Step              0 ----- CPU =            0 (sec) -------------\nTemp     =   1.5 v_a      =     -2\n"
          "------------ Step             10 ----- CPU =          0.5 (sec) -------------\nTemp     =   inf v_a      =     3e-7\n")
log = read(written(BLOCKS))
same(numpy.column_stack([log[name] for name in ("Step", "Temp", "v_a")]), numbers)
assert log["CPU"].tolist() == [0, 0.5]
log = read(written(BLOCKS.replace("v_a", "\nv_a").rsplit("\n", 2)[0] + "\n"), "made.txt:5: the last block ends early")
assert len(log) == 1

# ---- after the line about memory, any words are the names of columns ----
for name in ("1", "nan", "1e5"):
    for names, row in ((f"Step {name} Volume", "{0} 0.5 {0}"), (f"{name} Step Volume", "0.5 {0} {0}")):
        log = read(written(TABLE + f"Loop time of 1\n{MEMORY}  {names} \n  {row.format(20)} \n  {row.format(30)} \nLoop time of 1\n"))
        assert log.steps.tolist() == [0, 10, 20, 30] and log.runs[1][name].tolist() == [0.5, 0.5]
        assert log.runs[1]["Volume"].tolist() == [20, 30] and log.runs[1].line == 7

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
log = read(written("Memory usage per processor = 4 Mbytes\nTemp Press \n 1 2 \n 3 4 \nLoop time of 1\n" + TABLE),
           "made.txt:2: expected the column Step, got a table without it")
assert log.steps.tolist() == [0, 10, 20]
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
# a column Time counts where the timestep is changed within a run
text = "units si\nfix 1 all dt/reset 1 1e-9 1e-3 0.01\nStep Time \n 0 0 \n 10 1e-7 \n 20 1.5e-7 \n"
assert read(written(text)).times.tolist() == [0, 1e-7, 1.5e-7] and read(written(text), dt=2e-8).times.tolist() == [0, 2e-7, 4e-7]
assert read(written("Step Time \n 0 0 \n 10 3 \n")).times.tolist() == [0, 3]
assert read(written("units si\n" + TABLE)).times.tolist() == [0, 1e-7, 2e-7]
assert read(written("Step Time \n 0 0 \n 10 3 \nLoop time of 1\nStep Temp \n 20 5\n")).times.tolist() == [0, 10, 20]
# times go on after another timestep, also where a run begins again before the change
text = "".join(f"timestep {dt}\nStep Temp\n{first} 1\n{last} 2\nLoop time of 1\n" for dt, first, last in
               ((0.1, 0, 10), (0.2, 10, 20), (0.1, 5, 15), (0.3, 15, 16)))
assert [run.times.tolist() for run in read(written(text)).runs] == [[0, 1], [1, 3], [0.5, 1.5], [1.5, 1.8]]

# ---- renamed columns, whose names may have blanks; tables without Step ----
PER = "Per MPI rank memory allocation (min/avg/max) = 4 | 4 | 4 Mbytes\n"
ROWS = "         0   1.5            -2\n        10   2.5            -3\nLoop time of 1 on 1 procs\n"
for header in ("   Step      Kinetic Energy      v_a       \n", "   Step           E_x      Kinetic Energy\n"):
    for before in (PER, "run 10 pre no\n"):
        log = read(written(before + header + ROWS))
        assert log.columns == re.split(" {2,}", header.strip()) and log["Kinetic Energy"][0] in (1.5, -2)
RENAMED = 'thermo_modify line one colname 2 "Kinetic Energy" colname pe \'Potential, all of it\'\n'
log = read(written(RENAMED + PER + "   Step     Kinetic Energy Potential, all of it \n" + ROWS))
assert log.columns == ["Step", "Kinetic Energy", "Potential, all of it"] and log.steps.tolist() == [0, 10]
log = read(written(PER + "---\nkeywords: ['Step', 'Kinetic Energy', 'Potential, all of it', ]\ndata:\n  - [0, 1.5, -2, ]\n...\nLoop time of 1\n"))
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
NUMBERED = "without it, whose rows are numbered"
log = read(written(MEMORY + "KinEng Volume \n 1 2 \n 3 4 \nLoop time of 1\n" + MEMORY + "KinEng \n 5 \nLoop time of 1\n"), "made.txt:2: expected the")
assert log.steps.tolist() == log.times.tolist() == [0, 1, 2] and log["KinEng"].tolist() == [1, 3, 5] and len(log.runs) == 2
log = read(written("units si\n" + MEMORY + "Time KinEng \n 0.5 1 \n 0.75 3 \n"), NUMBERED)
assert log.times.tolist() == [0.5, 0.75] and log.steps.tolist() == [0, 1]
EMPTY = "expected rows of numbers below the columns Step RDN PEN, got none: the table is left out"
read(written(TABLE + "Loop time of 1\nStep RDN PEN\n0 1 2 3\n10 4 5 6\n"), "made.txt:6: " + EMPTY)
read(written(MEMORY + TABLE + f"Loop time of 1\n{MEMORY} Step RDN PEN\nERROR x\nLAMMPS (1 Jan 2026)\n"), "made.txt:8: " + EMPTY)

# ---- times after reset_timestep: 0 if the timestep becomes smaller; and after a column Time that differs ----
text = "timestep {}\nStep Temp\n{} 1\n{} 2\nLoop time of 1\n"
log = read(written(text.format(0.1, 0, 10) + "reset_timestep 5\n" + text.format(0.1, 5, 15) + text.format(0.2, 15, 16)))
assert [run.times.tolist() for run in log.runs] == [[0, 1], [0, 1], [1, 1.2]]
log = read(written(text.format(0.1, 0, 10) + "reset_timestep 20\n" + text.format(0.2, 20, 30)))
assert log.times.tolist() == [0, 1, 2, 4]
log = read(written(text.format(0.1, 0, 10) + "reset_timestep 20 time 7\n" + text.format(0.2, 20, 30) + text.format(0.1, 30, 40)))
assert log.times.tolist() == [0, 1, 7, 9, 10]
logs = [written(text.format(0.1, 0, 10), "first.txt"), written("reset_timestep 5\n" + text.format(0.1, 5, 15), "second.txt")]
assert [run.times.tolist() for run in read(logs).runs] == [[0, 1], [0, 1]]
same(read(written(text.format(0.1, 0, 10) + "reset_timestep 5\n" + text.format(0.1, 5, 15)), dt=1).all_rows.times, [0, 10, 5, 15])
log = read(written("timestep 0.1\nStep Time\n0 0\n10 0.5\nLoop time of 1\n" + text.format(0.2, 10, 20)))
assert log.times.tolist() == [0, 0.5, 2.5]

# ---- a last row without a line feed, in which nothing can be missing ----
assert read(written(TABLE[:-1])).steps.tolist() == [0, 10, 20]
assert read(written(gzip.compress(TABLE[:-2].encode()), "made.gz"))["Press"].tolist() == [2, 4, 6]
assert len(read(written(gzip.compress(BLOCKS[:-1].encode()), "made.gz"))) == 2
assert len(read(written("keywords: ['Step', 'Temp', ]\ndata:\n  - [0, 1.5, ]\n  - [10, 2.5, ]"))) == 2
assert len(read(written(TABLE + "Loop time of 1"))) == 3
for end in (-2, -3):
    assert len(read(written(TABLE[:end]), "made.txt:4: the last line ends early and is left out")) == 2

# ---- what cannot be ----
error = raises(vg.Error, lambda: vg.read_log(written(TABLE.replace("3 4", "3 four"))), "'four'", "expected a number")
assert (error.path, error.line, error.column) == (os.path.abspath("made.txt"), 3, "Press")
assert str(error).startswith(f"{error.path}:3: column 'Press': ")
error = raises(vg.Error, lambda: vg.read_log(written(TABLE.replace("10 3 4", "1x 3 4"))), "'1x'")
assert (error.line, error.column) == (3, "Step")
error = raises(vg.Error, lambda: vg.read_log(written(MEMORY + TABLE.replace("0 1 2", "0 one 2"))), "made.txt:3", "'one'")
assert error.column == "Temp"
raises(vg.Error, lambda: vg.read_log(written(TABLE.replace("0 1 2", "0 one 2"))), "made.txt:1: expected rows of numbers")
read(written(MEMORY + TABLE.replace("0 1 2", "0 1")), "made.txt:3: expected 3 numbers in a row, got 2; lines like this are left out: 1")
error = raises(vg.Error, lambda: vg.read_log(written(BLOCKS.replace("inf", "many"))), "made.txt:4", "'many'")
assert error.column == "Temp"
log = read(written(TABLE.replace("10 3 4", "10 3")), "made.txt:3: expected 3 numbers in a row, got 2; lines like this are left out: 1")
assert log.steps.tolist() == [0, 20]
read(written(TABLE.replace("10 3 4", "10 3 4 5")), "made.txt:3: expected 3 numbers in a row, got 4")
raises(vg.Error, lambda: vg.read_log(written("")), "made.txt: expected a log, got an empty file")
raises(vg.Error, lambda: vg.read_log(written(gzip.compress(b""), "empty.gz")), "empty.gz: expected a log, got an empty file")
error = raises(vg.Error, lambda: vg.read_log(written(TABLE[:20])), "made.txt:1: expected rows of numbers", "Step Temp Press")
assert error.line == 1
raises(vg.Error, lambda: vg.read_log(written(TABLE[:22])), "made.txt:1: expected rows of numbers")
raises(vg.Error, lambda: vg.read_log(written("units si\nrun 10\n")), "expected a thermo table", "Step", "got 2 lines")
raises(vg.Error, lambda: vg.read_log(written("Step Temp\n9223372036854775808 1\n")), "made.txt:2", "9223372036854775808")
DIGITS = "9" * 5000  # more than Python turns into a number
error = raises(vg.Error, lambda: vg.read_log(written(f"Step Temp\n0 1\n{DIGITS} 1\n")), "made.txt:3", "got 5000 digits")
assert error.column == "Step"
raises(vg.Error, lambda: vg.read_log(written(BLOCKS.replace("10 -", f"{DIGITS} -"))), "made.txt:3", "got 5000 digits")
raises(vg.Error, lambda: vg.read_log(written(BLOCKS.replace("10 -", "-9223372036854775809 -"))), "made.txt:3", "got -922337203685477580")
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
with open(os.path.join(ROOT, "docs", "guide", "arrays.md")) as stream:
    page = stream.read()
(script,) = [block for block in re.findall(r"^```py\n(.*?)^```$", page, re.MULTILINE | re.DOTALL) if "read_log" in block]
os.makedirs("logs", exist_ok=True)
os.chdir("logs")
with open("log.liggghts", "wb") as stream:
    stream.write(whole)
exec(compile(script, "arrays.md", "exec"), {"vg": vg})
print("logs are the numbers of their tables")
