# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks read a part of the rows each, and all of them together the whole, in its order."""
import glob
import os

import all_ranks
import numpy
import plain_local
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")
contacts = os.path.join(data, "contacts.dump")


def array(lines, name):
    return vtk_to_numpy(lines.GetCellData().GetArray(name))


for periodic in ("MinimumImage", "Split", "AsWritten"):
    reader = GranularLocalReader(FileNames=[contacts], Preset="ContactsForce", PeriodicLines=periodic)
    for frame in plain_local.read(contacts)[:0:-1]:
        lines = all_ranks.whole(reader, frame.timestep)
        rows = numpy.array(frame.rows, dtype=float)
        row = array(lines, "row") if periodic == "Split" else numpy.arange(len(rows))
        assert lines.GetNumberOfCells() == len(row), (lines.GetNumberOfCells(), len(row))
        assert (numpy.unique(row) == numpy.arange(len(rows))).all() and (numpy.diff(row) >= 0).all()
        assert (array(lines, "id1") == rows[row, 6]).all() and (array(lines, "id2") == rows[row, 7]).all()
        assert (array(lines, "force") == rows[row, 9:]).all()
        starts = vtk_to_numpy(lines.GetPoints().GetData()).reshape(-1, 2, 3)[:, 0]
        assert (starts[numpy.unique(row, return_index=True)[1]] == rows[:, :3]).all()
    Delete(reader)

# files of one process each, only the first of which has a header
reader = GranularLocalReader(FileNames=sorted(glob.glob(os.path.join(data, "pieces_*.dump"))), Preset="ContactsForce")
rows = plain_local.read(os.path.join(data, "pieces_3000.0.dump"))[0].rows
for process in (1, 2, 3):
    rows = rows + plain_local.read_rows(os.path.join(data, f"pieces_3000.{process}.dump"))
lines = all_ranks.whole(reader, 3000)
assert (array(lines, "id2") == numpy.array(rows, dtype=float)[:, 7]).all()
Delete(reader)

# more ranks than rows
for count in (0, 1, 2):
    name = os.path.abspath(f"few_{count}_{all_ranks.ranks.GetLocalProcessId() if all_ranks.symmetric else 0}.dump")
    with open(name, "w") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n{count}\nITEM: ENTRIES x1 y1 z1 x2 y2 z2 id1 id2\n" +
                   "1 1 1 2 2 2 7 8\n" * count)
    all_ranks.ranks.Barrier() if all_ranks.symmetric else None
    reader = GranularLocalReader(FileNames=[os.path.abspath(f"few_{count}_0.dump")])
    lines = all_ranks.whole(reader)
    assert lines.GetNumberOfCells() == count
    if count:
        assert (array(lines, "id2") == 8).all()
    Delete(reader)
print("all there")
