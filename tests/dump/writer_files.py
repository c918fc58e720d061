# SPDX-License-Identifier: BSD-3-Clause
"""What was read is written again: the same bytes in the same form, under any name; and what an error leaves."""
import gzip
import os

import plain_dump
import vtkgranular as vg
import writing
from paraview.simple import *
from writing import check_nothing_left, check_properties, check_refused, enter_empty_folder, good

enter_empty_folder()
PARTICLES = "id type x y z ix iy iz vx vy vz radius"  # of grains.bin
LIGGGHTS = {"Dialect": "LIGGGHTS"}


def content(path):
    """The bytes of the text, compressed or not."""
    read = writing.content(path)
    return gzip.decompress(read) if path.endswith(".gz") else read


def steps(path):
    return [frame.timestep for frame in plain_dump.read(path)]


def open_all(*names, **properties):
    """With all columns, those of coordinates, too: their last digits are the file's own."""
    reader = GranularDumpReader(FileNames=[good(name) for name in names], **properties)
    reader.PointArrayStatus = list(reader.GetProperty("PointArrayStatus").Available)
    return reader


def save_and_compare(name, out, **form):
    reader = open_all(name)
    vg.save(reader, out, WriteTimeSteps=1, **form)
    assert content(out) == content(good(name)), (name, out, form)
    Delete(reader)


# ---- the same bytes with the same form -----------------------------------------------------------

names = ["grains.dump", "grains_label.dump"] + [f"grains_{step}.dump" for step in (0, 1000, 2000)] + \
    [f"pieces_{step}.{piece}.dump" for step in (0, 1000, 2000) for piece in range(4)]
for name in names:
    save_and_compare(name, "a.dump", **LIGGGHTS)
ATOM = (("plain", {"Scaled": 0}), ("scaled", {}), ("image", {"Scaled": 0, "Image": 1}),
        ("scaled_image", {"Image": 1}))
for box in ("ortho", "tri"):
    for form, properties in ATOM:
        save_and_compare(f"{box}_{form}.dump", "a.lammpstrj", Style="Atom", **properties)
    save_and_compare(f"{box}_scaled.bin", "a.bin", Style="Atom")
    save_and_compare(f"{box}_image.bin", "a.lammpsbin", Style="Atom", Scaled=0, Image=1)
    save_and_compare(f"{box}_custom.bin", "a.bin")
    for step in ("000000", "000050", "000100"):
        save_and_compare(f"{box}_{step}.dump.gz", "a.dump.gz", Style="Atom")
save_and_compare("chain.dump", "a.dump")

# 17 digits, ITEM: UNITS and ITEM: TIME; the coordinate columns are the file's own, as they were loaded, too
for box in ("ortho", "tri"):
    save_and_compare(f"{box}_unwrapped.dump", "a.dump", WriteUnits=1, WriteTime=1, NumberFormat="%.17g")

# LIGGGHTS writes a chunk a process, this one as few as can be: the rows are the same
reader = open_all("grains.bin", ColumnNames=PARTICLES)
vg.save(reader, "a.bin", WriteTimeSteps=1, **LIGGGHTS)
for mine, other in zip(plain_dump.read_binary("a.bin", PARTICLES),
                       plain_dump.read_binary(good("grains.bin"), PARTICLES), strict=True):
    assert (mine.timestep, mine.bounds.tolist()) == (other.timestep, other.bounds.tolist())
    assert all((mine.columns[name] == other.columns[name]).all() for name in PARTICLES.split())

# ---- what is asked for ---------------------------------------------------------------------------

reader = open_all("grains_1000.dump")
vg.save(reader, "a.dump", Columns="radius id image")
frame, other = plain_dump.read("a.dump")[0], plain_dump.read(good("grains_1000.dump"))[0]
assert list(frame.columns) == ["radius", "id", "ix", "iy", "iz"]
assert all(frame.columns[name] == other.columns[name] for name in frame.columns)
vg.save(reader, "a.dump", Columns="id x", NumberFormat="%.5g")
vg.save(reader, "b.dump", Columns="id x", NumberFormat="shortest")
vg.save(reader, "c.dump", Columns="id x", NumberFormat="%.17g")
shortest, exact = plain_dump.read("b.dump")[0], plain_dump.read("c.dump")[0]
assert (shortest.numbers("x") == exact.numbers("x")).all()
assert sum(map(len, shortest.columns["x"])) < sum(map(len, exact.columns["x"]))
assert plain_dump.read("a.dump")[0].columns["x"] == ["%.5g" % x for x in exact.numbers("x")]

# ---- names -----------------------------------------------------------------------------------------

particles = open_all("grains.dump")
whole = content(good("grains.dump"))
frames = [b"ITEM: TIMESTEP" + part for part in whole.split(b"ITEM: TIMESTEP")[1:]]
for name in ("a.dump", "a.lammpstrj", "a.dump.gz", "a.lammpstrj.gz"):
    SaveData(name, particles, WriteTimeSteps=1, **LIGGGHTS)
    assert content(name) == whole, name
SaveData("a.dump.zst", particles, WriteTimeSteps=1, **LIGGGHTS)
again = GranularDumpReader(FileNames=[os.path.abspath("a.dump.zst")])
again.PointArrayStatus = list(again.GetProperty("PointArrayStatus").Available)
vg.save(again, "again.dump", WriteTimeSteps=1, **LIGGGHTS)
assert content("again.dump") == whole
for name in ("dump.1000", "x.liggghts", "no_ending", "with blank.dump"):
    vg.save(particles, name, writer="GranularDumpWriter", WriteTimeSteps=1, **LIGGGHTS)
    assert content(name) == whole, name

vg.save(particles, "step_*.dump", WriteTimeSteps=1, **LIGGGHTS)
assert [content(f"step_{step}.dump") for step in (0, 1000, 2000)] == frames
vg.save(particles, "process_%.dump", WriteTimeSteps=1, **LIGGGHTS)
assert content("process_0.dump") == whole
vg.save(particles, "both_*.%.dump.gz", WriteTimeSteps=1, **LIGGGHTS)
assert [content(f"both_{step}.0.dump.gz") for step in (0, 1000, 2000)] == frames

# ---- the time that is shown ------------------------------------------------------------------------

fresh = OpenDataFile(good("grains.dump"))
SaveData("a.dump", fresh)
assert steps("a.dump") == [0]
SaveData("a.dump", fresh, WriteTimeSteps=1)
assert steps("a.dump") == [0, 1000, 2000]
SaveData("a.dump", fresh)
assert steps("a.dump") == [0]
fresh.UpdatePipeline(1000)
some = Threshold(Input=fresh, Scalars=["POINTS", "id"], LowerThreshold=1, UpperThreshold=600)
for source in (fresh, some):
    SaveData("a.dump", source)
    assert steps("a.dump") == [1000]
    SaveData("a.dump", source, WriteTimeSteps=1)
    assert steps("a.dump") == [0, 1000, 2000]
    SaveData("a.dump", source)
    assert steps("a.dump") == [1000]
    vg.save(source, "step_*.dump")
    assert steps("step_1000.dump") == [1000]

# ---- properties ------------------------------------------------------------------------------------

writer = check_properties(
    "GranularDumpWriter", particles, Style="Custom", Dialect="Automatic", Columns="", Scaled=1, Image=0,
    NumberFormat="Automatic",
    SortById=0, WriteTimeSteps=0, WriteUnits=0, WriteTime=0, BoxOrigin=[0] * 3, BoxVectors=[0] * 9,
    Boundary="", ParallelMode="Gather", Threads=0)
for name, words in (("Style", ("Atom", "Custom")), ("Dialect", ("LIGGGHTS", "LAMMPS", "Automatic")),
                    ("ParallelMode", ("Gather", "MPI-IO"))):
    for word in words:
        setattr(writer, name, word)
        assert getattr(writer, name) == word
    try:
        setattr(writer, name, "Sideways")
    except ValueError:
        pass
    else:
        raise AssertionError(f"{name} took a word that it does not know")
check_refused(particles, "never.dump", AttributeError, Colour=1)
check_refused(particles, "never.dump", ValueError, Dialect="Latin")
check_nothing_left()
