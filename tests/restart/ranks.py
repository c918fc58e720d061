# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks read a part of the particles and bonds each, and all of them together the whole, in its order."""
import os

import all_ranks
import numpy
import plain_restart
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "restart")
records = plain_restart.Restart(os.path.join(data, "fibres.restart")).records
ids = [plain_restart.whole(record[4]) for record in records]
pairs = sorted((number, partner) for number, record in zip(ids, records)
               for _, partner, _ in plain_restart.bonds(record, 17) if number < partner)


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


for name in ("fibres.restart", "parts.base.restart"):
    for periodic in ("MinimumImage", "Split", "AsWritten"):
        reader = GranularRestartReader(FileNames=[os.path.join(data, name)], PeriodicLines=periodic)
        particles = all_ranks.whole(reader)
        assert (array(particles.GetPointData(), "id") == ids).all()
        assert (array(particles.GetPointData(), "radius") == 0.001).all()
        lines = all_ranks.whole(OutputPort(reader, 1))
        cells = lines.GetCellData()
        first = numpy.arange(lines.GetNumberOfCells())
        if periodic == "Split":
            first = array(cells, "part") == 0
            assert (array(cells, "row")[first] == range(27)).all() and lines.GetNumberOfCells() == 28
        found = list(zip(array(cells, "id1")[first], array(cells, "id2")[first]))
        assert sorted(found) == pairs
        order = {number: row for row, number in enumerate(ids)}
        assert [order[pair[0]] for pair in found] == sorted(order[pair[0]] for pair in found)
        assert numpy.allclose(array(cells, "equilibrium_length"), 0.002)
        Delete(reader)
print("all there")
