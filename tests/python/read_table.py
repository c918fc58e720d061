# SPDX-License-Identifier: BSD-3-Clause
"""Tables of fixes are the numbers that stand in their files, read by eye; and those that the log of the same run has."""
import bz2
import functools
import gzip
import lzma
import os
import sys
import types
import warnings

import vtkgranular as vg

import numpy  # noqa: E402
from text_files import told, written  # noqa: E402

DATA = os.path.join(os.environ["GRANULAR_DATA"], "good")
NUMBERED = "whose rows are numbered"
read = functools.partial(told, vg.read_table)

# file, timesteps, all columns, then (column, shape, place, value); warnings
FILES = (
    ("ave_time.yaml", range(100, 1300, 100), "Step c_er c_maxz", [("c_er", (12,), -1, 0.00013032843647026567)]),
    ("print.txt", range(0, 1300, 100), "ms highest step", [("ms", (13,), 6, 24), ("highest", (13,), 7, 0.022990483)]),
    ("print.csv", range(0, 700, 100), "step ke", [("ke", (7,), 4, 0.340151137)]),
    ("no_names.txt", range(8), "1 2", [("1", (8,), -1, 600)], NUMBERED),
    ("melt.rdf", (50, 100), "TimeStep Number-of-rows Row c_gr[1] c_gr[2] c_gr[3]",
     [("c_gr[2]", (2, 6), (1, 2), 1.62171), ("Row", (2, 6), (0, 5), 6), ("Number-of-rows", (2,), 0, 6)]),
    ("chunk2.profile", (200, 400, 600), "Timestep Number-of-chunks Total-count Chunk Coord1 Coord2 Ncount density/number vz",
     [("Coord2", (3, 4), (0, 1), 6.4633), ("vz", (3, 4), (2, 3), -0.939963), ("Total-count", (3,), 2, 252)]),
    ("speeds.histo", (600, 1200), "TimeStep Number-of-bins Total-counts Missing-counts Min-value Max-value Bin Coord Count Count/Total",
     [("Count", (2, 10), (1, 9), 19), ("Max-value", (2,), 1, 0.5623627350612191)]),
    ("corr.dat", (0, 100, 200), "Timestep Number-of-time-windows Index TimeDelta Ncount c_ke*c_ke c_ke*c_er c_er*c_er",
     [("TimeDelta", (3, 5), (0, 4), 40), ("c_ke*c_ke", (3, 5), (1, 0), 1.27478e6)]),
    ("ave_spatial.profile", range(500, 2500, 500), "Timestep Number-of-bins Bin Coord Ncount vz density/number",
     [("vz", (4, 6), (3, 0), -1.00888)]))
for name, steps, columns, values, *told in FILES:
    path = os.path.join(DATA, "tables", name)
    table = read(path, *told, dt=2e-5)
    assert table.columns == [*table] == columns.split(" ") and table.steps.tolist() == [*steps], (name, table)
    assert table.steps.dtype == numpy.int64, name
    assert table.times.tolist() == [float(f"{2 * step}e-5") for step in steps], (name, table.times)
    for column, shape, place, value in values:
        assert table[column].shape == shape and table[column][place] == value and not table[column].flags.writeable, (name, column)
    with open(path, "rb") as stream:
        whole = stream.read()
    packed = written(gzip.compress(whole), "packed"), written(bz2.compress(whole), "packed.b"), written(lzma.compress(whole), "packed.x")
    for file in packed:
        assert all(numpy.array_equal(read(file, *told)[column], table[column]) for column in table)
    # wherever a file ends, its timesteps are the first ones of the whole file
    largest = 0
    for size in range(0, len(whole), 13):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                part = vg.read_table(written(whole[:size]))
        except vg.Error as error:
            assert largest == 0 and "made.txt" in str(error), (name, size, error)
            continue
        assert largest <= len(part) <= len(table), (name, size)
        largest = len(part)
        for column in part:
            assert numpy.array_equal(part[column], table[column][:largest, ...]), (name, size, column)
    assert len(table) - 1 <= largest, name

sys.modules["pandas"] = types.SimpleNamespace(DataFrame=dict)
rows = read(os.path.join(DATA, "tables", "melt.rdf")).to_pandas()
assert rows["TimeStep"].tolist() == [50] * 6 + [100] * 6 and rows["Row"].tolist() == [1, 2, 3, 4, 5, 6] * 2

averages = read(os.path.join(DATA, "log", "lammps.ave"))
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    log = vg.read_log(os.path.join(DATA, "log", "lammps.txt"))
near = [(averages[f"c_thermo_{name}"][0], log[column][log.steps == averages.steps[0]][0])
        for name, column in (("temp", "Temp"), ("press", "Press")) if f"c_thermo_{name}" in averages and averages.steps[0] in log.steps]
assert near and all(abs(a - b) < 1e-6 * abs(b) for a, b in near), near

HEAD = "# a title\n# TimeStep Number-of-rows\n# Row v\n"
MADE = (  # text, timesteps, a column and its values, warnings
    ("# a title\n# TimeStep v v\n10 1 2\n20 3 4\n10 5 nan\n# a title\n# TimeStep v v\n30 -inf 6\n", [10, 20, 30], "v", [5, 3, -numpy.inf]),
    ("# a title\n# TimeStep v v\n10 1 2\n20 3 4\n", [10, 20], "v#2", [2, 4]),
    ("step t\n10 1\nstep t\n20 2\n", [10, 20], "t", [1, 2]),
    (HEAD + "10 2\n1 5\n2 6\n20 1\n1 7\n", [10, 20], "v", [[5, 6], [7, numpy.nan]]),
    ("10 2\n1 5 1\n2 6 1\n20 0\n", [10, 20], "Step", [10, 20]),
    (HEAD + "---\nkeywords: ['c_a', ]\ndata:\n  100:\n  - [1.5, ]\n  - [2, ]\n  200:\n  - [3, ]\n  - [4, ]\n",
     [100, 200], "c_a", [[1.5, 2], [3, 4]]),
    (HEAD + "10 1\n1 5\n20 2\n1 7\n", [10], "v", [[5]], "made.txt:6: the last timestep ends early"),
    (HEAD + "10 0\n20 0\n", [10, 20], "Number-of-rows", [0, 0]),
    ("# t\n# Step v\n10 1\n20 2", [10], "v", [1], "made.txt:4: the last line ends early"))
for text, steps, column, values, *told in MADE:
    table = read(written(text), *told)
    assert table.steps.tolist() == steps and numpy.array_equal(table[column], values, equal_nan=True), (text, table[column])

BAD = (  # text, message
    ("", "expected a table, got an empty file"),
    ("a\0b\n", "expected the text of a table, got a binary file"),
    ("# Step v\n", "expected rows of numbers below the names of their columns, got none in 1 lines"),
    ("# Step v\n1 2\n3 x\n", ":3: column 2: expected a number, got 'x'"),
    ("# Step v\n1 2\n3 1_0\n", ":3: column 2: expected a number, got '1_0'"),
    ("# Step v\n1 2\n5 6 7\n", ":3: expected a row of 2 numbers, got 3"),
    ("# Step v\n1 2\n3 4\n5 6 7\n", ":4: expected a row of 2 numbers, got 3"),
    ("# Step v\n1 2\n# Step w\n3 4\n", ":3: expected rows, or the first lines again, got '# Step w'"),
    ("# Step v\n1.5 2\n", "column 'Step': expected timesteps, got 1.5"),
    ("# Step v\nnan 2\n", "column 'Step': expected timesteps, got nan"),
    (HEAD + "10 1\n1 5\n20 1 1\n", ":6: expected a timestep and its number of rows, 2 numbers, got 20 1 1"),
    (HEAD + "10 nan\n1 5\n", ":4: expected a timestep and its number of rows, 2 numbers, got 10 nan"),
    (HEAD + "10 2\n1 5\n", "expected a timestep with all of its rows, got none"))
for text, message in BAD:
    try:
        vg.read_table(written(text))
    except vg.Error as error:
        assert str(error).startswith(os.path.abspath("made.txt")) and message in str(error), (text, error)
    else:
        raise AssertionError(message)
for call, kind in ((lambda: vg.read_table("none"), FileNotFoundError), (lambda: table["w"], KeyError),
                   (lambda: vg.read_table(os.path.join(DATA, "tables", "words.txt")), vg.Error),
                   (lambda: vg.read_table("made.txt", dt=0), vg.ArgumentError)):
    try:
        call()
    except kind:
        continue
    raise AssertionError(kind)
