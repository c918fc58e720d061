# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks read a part of the particles and bonds each, and all of them together the whole, in its order."""
import os

import all_ranks
import numpy
import plain_data
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good")


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


for style, name in (("bond", "local/chain.data"), ("full", "data_file/full.data"), ("sphere", "data_file/sphere.data"),
                    ("ellipsoid", "shapes/superellipsoids.data")):
    path = os.path.join(data, name)
    plain = plain_data.Data(path)
    atoms, velocities, shapes = plain.rows("Atoms"), plain.rows("Velocities"), plain.rows("Ellipsoids")
    bonds = numpy.array(plain.sections.get("Bonds", []), dtype=int).reshape(-1, 4)
    for ordered in (0, 1):
        for periodic in ("MinimumImage", "Split", "AsWritten"):
            reader = GranularDataFileReader(FileNames=[path], AtomStyle=style, SortById=ordered, PeriodicLines=periodic)
            particles = all_ranks.whole(reader)
            points = particles.GetPointData()
            ids = list(sorted(atoms) if ordered else atoms)
            assert (array(points, "id") == ids).all()
            if velocities:
                assert (array(points, "v") == [velocities[number][:3] for number in ids]).all()
            if style == "sphere":
                assert (array(points, "omega") == [velocities[number][3:] for number in ids]).all()
            if shapes:
                found = numpy.concatenate([array(points, part) for part in ("shape", "quat", "blockiness")], axis=1)
                assert (found == [shapes[number] for number in ids]).all()
            lines = all_ranks.whole(OutputPort(reader, 1))
            cells = lines.GetCellData()
            first = numpy.arange(lines.GetNumberOfCells())
            if periodic == "Split" and len(bonds):
                first = array(cells, "part") == 0
                assert (array(cells, "row")[first] == range(len(bonds))).all()
                assert lines.GetNumberOfCells() >= len(bonds)
            if len(bonds):
                assert (array(cells, "bond_id")[first] == bonds[:, 0]).all()
                assert (array(cells, "id2")[first] == bonds[:, 3]).all()
                place = dict(zip(array(points, "id"), vtk_to_numpy(particles.GetPoints().GetData())))
                ends = vtk_to_numpy(lines.GetPoints().GetData()).reshape(-1, 2, 3)[first]
                assert (ends[:, 0] == [place[number] for number in bonds[:, 2]]).all()
            box = all_ranks.whole(OutputPort(reader, 2), kind="vtkUnstructuredGrid")
            assert box.GetNumberOfCells() == 1
            Delete(reader)
    some = all_ranks.whole(GranularDataFileReader(FileNames=[path], AtomStyle=style, Stride=4))
    assert (array(some.GetPointData(), "id") == [number for number in atoms if number % 4 == 0]).all()
print("all there")
