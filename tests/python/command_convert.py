# SPDX-License-Identifier: BSD-3-Clause
"""granular convert: between the forms of dumps, to numpy, tables and VTK, whole or in part; the old file until all is there."""
import csv
import json
import os
import resource
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

import numpy

import plain_dump
from command import GOOD, SAMPLES, content, granular

SOURCE = os.path.join(SAMPLES, "grains.dump")
frames = plain_dump.read(SOURCE)


def only_files(*names):
    assert sorted(os.listdir()) == sorted(names), os.listdir()


def clean():
    for name in os.listdir():
        os.remove(name)


clean()
assert json.loads(granular("convert", "--json", SOURCE, "a.csv", "--frames", "1:")[0]) == {"given": [SOURCE], "out": "a.csv", "frames": 4}
assert list(json.loads(granular("convert", "--json", SOURCE, "none/a.csv", status=1)[0])) == ["error"]
clean()
# from text to every form and back: the bytes of the first file, from any number of threads
for form in ("a.dump", "a.dump.gz", "a.dump.zst"):
    granular("convert", SOURCE, form)
    granular("convert", form, "back.dump")
    assert content("back.dump") == content(SOURCE), form
    granular("convert", SOURCE, "threads_" + form, "--threads", "1")
    assert content("threads_" + form) == content(form), form
granular("convert", SOURCE, "a.lammpsbin")
for mine, text in zip(plain_dump.read_binary("a.lammpsbin", None), frames):
    assert mine.timestep == text.timestep and all(numpy.array_equal(mine.columns[name], text.numbers(name)) for name in text.columns)
granular("convert", "a.lammpsbin", "text.dump", "--dialect", "LIGGGHTS")
for mine, text in zip(plain_dump.read("text.dump"), frames):
    assert all(numpy.array_equal(mine.numbers(name), text.numbers(name)) for name in text.columns)

# one file to many and back; pieces to one; parts: columns, stride, region, every n-th frame
clean()
granular("convert", SOURCE, "step_*.dump")
only_files(*(f"step_{frame.timestep}.dump" for frame in frames))
granular("convert", "step_*.dump", "one.dump")
assert content("one.dump") == content(SOURCE)
granular("convert", os.path.join(SAMPLES, "pieces", "pieces_*.%.dump"), "whole.dump", "--sort", "--columns", "id x y z")
for mine, text in zip(plain_dump.read("whole.dump"), frames):
    order = numpy.argsort(text.numbers("id"))
    assert numpy.array_equal(mine.stack(["id", "x", "y", "z"]), text.stack(["id", "x", "y", "z"])[order])
granular("convert", SOURCE, "part.dump", "--frames", "::2", "--stride", "7", "--region", "0 - - 0.02 0 0.05", "--columns", "id,x,y,z,radius")
for mine, text in zip(plain_dump.read("part.dump"), frames[::2]):
    rows = text.stack(["id", "x", "y", "z", "radius"])
    if not len(rows):
        continue
    keep = (rows[:, 0] % 7 == 0) & (rows[:, 1] >= 0) & (rows[:, 2] <= 0.02) & (rows[:, 3] >= 0) & (rows[:, 3] <= 0.05)
    assert list(mine.columns) == ["id", "x", "y", "z", "radius"] and numpy.array_equal(mine.stack(mine.columns), rows[keep])
granular("convert", SOURCE, "atom.dump", "--style", "atom", "--dialect", "LAMMPS", "--numbers", "%.3g")
assert list(plain_dump.read("atom.dump")[-1].columns) == ["id", "type", "xs", "ys", "zs"]

# another kind of data keeps its bytes
granular("convert", os.path.join(GOOD, "euler_1000.vtk"), "cells.euler")
assert content("cells.euler") == content(os.path.join(GOOD, "euler_1000.vtk"))

# numpy and tables
clean()
granular("convert", SOURCE, "frame_*.npz", "--dt", "2e-5")
only_files(*(f"frame_{frame.timestep}.npz" for frame in frames))
arrays, text = numpy.load("frame_4000.npz"), frames[-1]
assert arrays["step"] == 4000 and arrays["time"] == 0.08 and arrays["box_vectors"].shape == (3, 3)
assert numpy.array_equal(arrays["points"], text.stack("xyz")) and numpy.array_equal(arrays["v"], text.stack(["vx", "vy", "vz"]))
granular("convert", SOURCE, "last.csv", "--frames", "-1", "--columns", "id x v radius")
with open("last.csv", encoding="ascii", newline="") as stream:
    header, *rows = csv.reader(stream)
assert header == ["id", "x", "vx", "vy", "vz", "radius"]
assert numpy.array_equal(numpy.array(rows, dtype=float), text.stack(header))

# VTK, where it is
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    assert "needs VTK" in granular("convert", SOURCE, "last.vtp", "--frames", "-1", status=1)[1]
else:
    for ending, kind in ((".vtp", vtkXMLPolyDataReader), (".vtu", vtkXMLUnstructuredGridReader)):
        granular("convert", SOURCE, "last" + ending, "--frames", "-1")
        xml.etree.ElementTree.parse("last" + ending)  # appended data are no XML, which some versions of libexpat refuse
        reader = kind()
        reader.SetFileName("last" + ending)
        reader.Update()
        data = reader.GetOutput()
        assert numpy.array_equal(vtk_to_numpy(data.GetPoints().GetData()), text.stack("xyz"))
        assert numpy.array_equal(vtk_to_numpy(data.GetPointData().GetArray("v")), text.stack(["vx", "vy", "vz"]))
        assert data.GetNumberOfCells() == len(text.numbers("id"))

# a pattern that the shell resolved, without OUT; --frames with a number below 0
clean()
granular("convert", SOURCE, "step_*.dump", "--frames", "-2:")
only_files("step_3000.dump", "step_4000.dump")
kept = content("step_4000.dump")
granular("convert", "step_3000.dump", "step_4000.dump", "step_4000.dump", status=2)
assert content("step_4000.dump") == kept

# a file of the run, under another name, does not become a table: its frames would be lost
clean()
granular("convert", SOURCE, "run.dump")
for ending in ("csv", "npz", "vtu"):
    os.symlink("run.dump", f"link_4000.{ending}")
    said = granular("convert", "run.dump", f"link_*.{ending}", "--frames", "-2:", status=2)[1]
    assert f"link_4000.{ending}: expected another file to write, got one that is read" in said, said
assert content("run.dump") == content(SOURCE)
only_files("link_4000.csv", "link_4000.npz", "link_4000.vtu", "run.dump")

# what cannot be, and the old file
clean()
with open("old.dump", "w") as stream:
    stream.write("old")
with open("old.csv", "w") as stream:
    stream.write("old")
for arguments, status, words in (
        (("old.npz",), 2, "expected * for the timestep"), (("old.csv", "--columns", "velocity", "--frames", "-1"), 1, "radius"),
        (("old.dump", "--columns", "id velocity"), 1, "velocity"), (("old.dump", "--region", "0 1"), 2, "six bounds"),
        (("old.dump", "--frames", "7"), 2, "from -5 to 4"), (("old.dump", "--frames", "a:b"), 2, "A:B:N"),
        (("old.dump", "--coordinates", "scaled"), 2, "xs"), (("old.dump", "--dialect", "VASP"), 1, "LIGGGHTS"),
        (("nowhere/new.dump",), 1, "nowhere")):
    assert words in granular("convert", SOURCE, *arguments, status=status)[1], arguments
with open("cut.dump", "wb") as stream:
    stream.write(content(SOURCE)[:400000].replace(b" 0.0025 ", b" 0.0025x ", 1))
granular("convert", "cut.dump", "old.dump", status=1)
assert content("old.dump") == content("old.csv") == b"old"

# a disk that is full, a standard error that is closed or that nobody reads, and names that begin with a dash
for out in ("old.dump", "old.csv", "last.npz"):
    said = granular("convert", SOURCE, out, "--frames", "-1", status=1, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (50000, 50000)))[1]
    assert said.count("\n") == 1 and out in said and "File too large" in said, said
assert content("old.dump") == content("old.csv") == b"old" and not os.path.exists("last.npz")
with open("odd.dump", "wb") as stream:
    stream.write(content(SOURCE)[:-5])
for number, end in enumerate(("2>&-", ">&- 2>&-", "2>&1 | true")):
    command = f"{sys.executable} {os.environ['GRANULAR_COMMAND']} convert -- odd.dump -out_{number}.dump {end}"
    status = subprocess.run(["bash", "-o", "pipefail", "-c", command]).returncode
    assert status == 0, (command, status)
    assert len(plain_dump.read(f"-out_{number}.dump")) == 4
    os.remove(f"-out_{number}.dump")
os.remove("odd.dump")

# Ctrl-C in the middle of a large one
with open("large.dump", "wb") as out:
    body = content(SOURCE)
    body = body[body.index(b"ITEM: TIMESTEP\n4000") + len(b"ITEM: TIMESTEP\n4000"):]
    for step in range(1000):
        out.write(b"ITEM: TIMESTEP\n%d" % step + body)
with subprocess.Popen([sys.executable, os.environ["GRANULAR_COMMAND"], "convert", "large.dump", "old.dump", "--numbers", "shortest"],
                      stderr=subprocess.PIPE, text=True) as running:
    there = {"cut.dump", "large.dump", "old.csv", "old.dump"}
    while running.poll() is None and sum(os.path.getsize(name) for name in set(os.listdir()) - there) < 1 << 20:
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    said = running.communicate(timeout=60)[1]
assert running.returncode == 130 and "interrupted" in said and "Traceback" not in said, (running.returncode, said)
only_files("cut.dump", "large.dump", "old.csv", "old.dump")
granular("convert", SOURCE, "unusual.csv", "--frames", "-1", "--columns", "id x")
os.remove("unusual.csv")
assert content("old.dump") == b"old"
clean()
print("convert")
