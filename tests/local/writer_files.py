# SPDX-License-Identifier: BSD-3-Clause
"""The files of real runs, read and written again: the same rows to the byte, under names that say what they are."""
import gzip
import os

import numpy
import plain_local
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from writing import check_nothing_left, check_properties, content, enter_empty_folder, good

enter_empty_folder()

FORCES = "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez"
BONDS = "btype id1 id2 dist engpot forcex forcey forcez"


def renamed(path, label, names):
    """The bytes of a file with these names of its columns."""
    lines = content(path).split(b"\n")
    head = f"ITEM: {label} ".encode()
    return b"\n".join(head + names.encode() + b" " if line.startswith(head) else line for line in lines)


# ---- contacts as lines: their ends where the file has them -------------------------------------------------

contacts = GranularLocalReader(FileNames=[good("local/contacts.dump")], Preset="ContactsForce",
                               PeriodicLines="AsWritten")
original = renamed(good("local/contacts.dump"), "ENTRIES", FORCES)
liggghts = {"Dialect": "LIGGGHTS", "WriteTimeSteps": 1}
vg.save(contacts, "as_named.bonds", Columns=FORCES, **liggghts)
assert content("as_named.bonds") == original
vg.save(contacts, "by_itself.bonds", **liggghts)
assert content("by_itself.bonds") == original
vg.save(contacts, "arrays.bonds", Columns=["position1", "position2", "id1", "id2", "periodic", "force"], **liggghts)
assert content("arrays.bonds") == original
SaveData("data.bonds", contacts, **liggghts)
assert content("data.bonds") == original
vg.save(contacts, "packed.bonds.gz", writer="GranularLocalWriter", **liggghts)
assert gzip.decompress(content("packed.bonds.gz")) == original
vg.save(contacts, "step_*.bonds", **liggghts)
frames = [b"ITEM: TIMESTEP" + frame for frame in original.split(b"ITEM: TIMESTEP")[1:]]
steps = [int(time) for time in contacts.TimestepValues]
assert len(frames) == len(steps) > 2
for step, frame in zip(steps, frames):
    assert content(f"step_{step}.bonds") == frame
vg.save(contacts, "one.bonds", time=2000, Dialect="LIGGGHTS")
assert content("one.bonds") == frames[steps.index(2000)]

# split at the faces, and far from the origin: the ends are those of the file, within what was lost on the way
plain = plain_local.read(good("local/contacts.dump"))
crossing = max(frame.column(8).sum() for frame in plain)
assert crossing > 0
contacts.PeriodicLines = "Split"
vg.save(contacts, "split.bonds", **liggghts)
assert content("split.bonds") == original
contacts.PointOrigin = [1, 2, 3]
vg.save(contacts, "moved.bonds", **liggghts)
assert len(plain_local.read("moved.bonds")) == len(plain)
for frame, expected in zip(plain_local.read("moved.bonds"), plain):
    assert len(frame.rows) == len(expected.rows)
    for place in range(12):
        assert numpy.allclose(frame.column(place), expected.column(place), rtol=2e-6, atol=1e-8), place
contacts.PointOrigin = [0, 0, 0]

# the nearest image moves second ends, but not those that the file gave
contacts.PeriodicLines = "MinimumImage"
vg.save(contacts, "nearest.bonds", **liggghts)
moved = 0
for frame, expected in zip(plain_local.read("nearest.bonds"), plain):
    assert (frame.stack(["id1", "id2"]) == expected.stack([6, 7])).all() and frame.names == FORCES.split()
    moved += (frame.stack(["x2", "y2"]) != expected.stack([3, 4])).any(axis=1).sum()
assert moved == sum(frame.column(8).sum() for frame in plain)
contacts.CellArrayStatus = ["id1", "id2", "periodic", "force", "position1", "position2"]
vg.save(contacts, "given.bonds", **liggghts)
assert content("given.bonds") == original

# the rows as a table
contacts.CellArrayStatus = ["id1", "id2", "force"]
vg.save(OutputPort(contacts, 1), "rows.bonds", time=2000, Columns="id1 id2 force")
table = plain_local.read("rows.bonds")[0]
assert table.names == "id1 id2 forcex forcey forcez".split() and len(table.rows) == 35
assert table.rows == [row[6:8] + row[9:] for row in plain[steps.index(2000)].rows]

# ---- bonds of LAMMPS as a table -------------------------------------------------------------------------------

path = good("local/chain_bonds.dump")
bonds = GranularLocalReader(FileNames=[path], Preset="BondTypeIdsForce")
original = renamed(path, "BONDS", BONDS)
for columns in (BONDS, ""):
    vg.save(OutputPort(bonds, 1), "chain.bonds", Columns=columns, WriteTimeSteps=1)
    assert content("chain.bonds") == original
SaveData("data.bonds", OutputPort(bonds, 1), WriteTimeSteps=1)
assert content("data.bonds") == original
vg.save(OutputPort(bonds, 1), "chain.bonds", Label="ENTRIES", WriteTimeSteps=1)
assert content("chain.bonds") == original.replace(b"BONDS", b"ENTRIES")

# as lines between the particles, with what these give to them; and read again
all_particles = GranularDumpReader(FileNames=[good("local/chain.dump")])
for way in ("MinimumImage", "Split"):
    joined = GranularLocalJoin(Input=all_particles, Lines=OutputPort(bonds, 1), PeriodicLines=way, Averages="v",
                               EquilibriumLength=1.05)
    vg.save(joined, "joined.bonds", NumberFormat="shortest", WriteTimeSteps=1)
    written = plain_local.read("joined.bonds")
    assert [frame.timestep for frame in written] == [0, 500, 1000]
    expected = BONDS + " elongation strain v_mean[1] v_mean[2] v_mean[3] x1 y1 z1 x2 y2 z2"
    again = GranularLocalReader(FileNames=[os.path.abspath("joined.bonds")], PeriodicLines=way)
    for frame, of_file in zip(written, plain_local.read(path)):
        assert frame.label == "BONDS" and frame.names == expected.split(), frame.names
        assert [row[:8] for row in frame.rows] == of_file.rows
        joined.UpdatePipeline(frame.timestep)
        again.UpdatePipeline(frame.timestep)
        made, read = (proxy.GetClientSideObject().GetOutputDataObject(0) for proxy in (joined, again))
        assert read.GetNumberOfLines() == made.GetNumberOfLines() >= 96
        for name in ("id1", "id2", "btype", "dist", "engpot", "force", "elongation", "strain"):
            values = [vtk_to_numpy(output.GetCellData().GetArray(name)) for output in (made, read)]
            assert (values[0] == values[1]).all(), name
        ends = [vtk_to_numpy(output.GetPoints().GetData()) for output in (made, read)]
        assert abs(ends[0] - ends[1]).max() < 1e-13
    Delete(again)
    Delete(joined)

# ---- bonds of a packing, and properties -----------------------------------------------------------------------

packing = GranularPackingSource(Arrangement="Chain", NumberOfGrains=15, Radii="One", Radius=0.002, Spacing=1.5, Speed=0,
                                BondFactor=1, Boundary="f f f")
vg.save(OutputPort(packing, "Bonds"), "packing.bonds", NumberFormat="shortest")
written, = plain_local.read("packing.bonds")
assert written.names == "id1 id2 btype equilibrium_length x1 y1 z1 x2 y2 z2".split() and len(written.rows) == 14
length = numpy.sqrt(((written.stack(["x2", "y2", "z2"]) - written.stack(["x1", "y1", "z1"])) ** 2).sum(axis=1))
assert numpy.allclose(length, written.column("equilibrium_length"), rtol=1e-12)

check_properties("GranularLocalWriter", contacts, Dialect="Automatic", Label="Automatic", Columns="", NumberFormat="Automatic",
                 WriteTimeSteps=0, ParallelMode="Gather", Threads=0)
check_nothing_left()
print("written")
