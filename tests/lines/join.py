# SPDX-License-Identifier: BSD-3-Clause
"""The bonds of a real run, between the particles of its dump: as long as the program that wrote them says."""
import os
import re

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_TYPE_INT64
from vtkmodules.vtkCommonDataModel import vtkTable

import plain_dump
import plain_local

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
NAMES = ["btype", "id1", "id2", "dist", "energy", "fx", "fy", "fz"]


def table_of(rows, step):
    table = vtkTable()
    for name, values in zip(NAMES, rows.T):
        array = numpy_to_vtk(values.astype(int) if name.startswith("id") else values, deep=1)
        array.SetName(name)
        table.AddColumn(array)
    timestep = numpy_to_vtk(numpy.array([step]), deep=1, array_type=VTK_TYPE_INT64)
    timestep.SetName("timestep")
    table.GetFieldData().AddArray(timestep)
    return table


bonds = {frame.timestep: frame.stack(range(8)) for frame in
         plain_local.read(os.path.join(data, "local", "chain_bonds.dump"))}
assert list(bonds) == [0, 500, 1000] and all(len(rows) == 96 for rows in bonds.values())
particles = {frame.timestep: frame for frame in plain_dump.read(os.path.join(data, "local", "chain.dump"))}
all_particles = GranularDumpReader(FileNames=[os.path.join(data, "local", "chain.dump")])
rows = TrivialProducer()
crossed = 0
for step, table in bonds.items():
    rows.GetClientSideObject().SetOutput(table_of(table, step))
    # what they are: by id, the second end brought as near to the first as the box allows
    frame = particles[step]
    ids = frame.numbers("id").astype(int)
    places = dict(zip(ids, frame.stack("xyz")))
    speeds = dict(zip(ids, frame.stack(["vx", "vy", "vz"])))
    edges = numpy.diff(numpy.array(frame.bounds)).T[0]
    first, second = (numpy.array([places[int(i)] for i in table[:, k]]) for k in (1, 2))
    vectors = second - first
    crossed += (abs(vectors) > edges / 2).any(axis=1).sum()
    vectors -= edges * numpy.round(vectors / edges)
    for coordinates in ("Absolute", "Unwrapped", "Scaled"):
        all_particles.Coordinates = coordinates
        lines = GranularLocalJoin(Input=all_particles, Lines=rows, Averages="v", Differences="*", EquilibriumLength=1.05)
        lines.UpdatePipeline(step)
        output = lines.GetClientSideObject().GetOutput()
        cells = {name: vtk_to_numpy(output.GetCellData().GetArray(name)) for name in
                 ("id1", "id2", "dist", "length", "elongation", "strain", "v_mean", "v_difference", "mol_difference")}
        assert output.GetNumberOfLines() == output.GetNumberOfCells() == 96
        assert (cells["id1"] == table[:, 1]).all() and (cells["id2"] == table[:, 2]).all()
        # both files have six digits
        assert abs(cells["length"] - cells["dist"]).max() < 3e-4, abs(cells["length"] - cells["dist"]).max()
        assert numpy.allclose(cells["length"], numpy.sqrt((vectors ** 2).sum(axis=1)), rtol=0, atol=1e-13)
        assert (cells["elongation"] == cells["length"] - 1.05).all()
        assert (cells["strain"] == cells["elongation"] / 1.05).all()
        assert not cells["mol_difference"].any()  # bonds are within molecules
        ends = [numpy.array([speeds[int(i)] for i in table[:, k]]) for k in (1, 2)]
        assert (cells["v_mean"] == (ends[0] + ends[1]) / 2).all()
        assert (cells["v_difference"] == ends[1] - ends[0]).all()
        points = vtk_to_numpy(output.GetPoints().GetData()).reshape(-1, 2, 3)
        scale = edges if coordinates == "Scaled" else 1
        assert numpy.allclose((points[:, 1] - points[:, 0]) * scale, vectors, rtol=0, atol=1e-13)
        # they begin where the particles are shown
        shown = all_particles.GetClientSideObject().GetOutput()
        where = dict(zip(vtk_to_numpy(shown.GetPointData().GetArray("id")), vtk_to_numpy(shown.GetPoints().GetData())))
        starts = numpy.array([where[int(i)] for i in table[:, 1]])
        assert numpy.allclose(points[:, 0], starts, rtol=0, atol=1e-13)
        assert output.GetFieldData().GetAbstractArray("Coordinates").GetValue(0) == coordinates
        Delete(lines)
assert crossed > 3, crossed

# split: the parts of a line are as long as the line, and in the box
all_particles.Coordinates = "Absolute"
lines = GranularLocalJoin(Input=all_particles, Lines=rows, PeriodicLines="Split")
lines.UpdatePipeline(1000)
output = lines.GetClientSideObject().GetOutput()
row = vtk_to_numpy(output.GetCellData().GetArray("row"))
assert len(row) > 96 and (numpy.unique(row) == numpy.arange(96)).all()
points = vtk_to_numpy(output.GetPoints().GetData()).reshape(-1, 2, 3)
parts = numpy.bincount(row, numpy.sqrt(((points[:, 1] - points[:, 0]) ** 2).sum(axis=1)))
assert abs(parts - numpy.sqrt((vectors ** 2).sum(axis=1))).max() < 1e-13
low, high = numpy.array(particles[1000].bounds).T
outside = ((points < low) | (points > high)).any(axis=(1, 2))
ends_outside = ((first < low) | (first > high) | (second < low) | (second > high)).any(axis=1)
assert not (outside & ~ends_outside[row]).any()

# the same by the reader: the ids of its table are those of the particles
read = GranularLocalReader(FileNames=[os.path.join(data, "local", "chain_bonds.dump")], Preset="BondTypeIdsForce")
lines = GranularLocalJoin(Input=all_particles, Lines=OutputPort(read, 1))
for step, table in bonds.items():
    lines.UpdatePipeline(step)
    output = lines.GetClientSideObject().GetOutput()
    for place, name in enumerate(("btype", "id1", "id2", "dist")):
        assert (vtk_to_numpy(output.GetCellData().GetArray(name)) == table[:, place]).all(), name
    assert output.GetFieldData().GetArray("timestep").GetValue(0) == step
    assert abs(vtk_to_numpy(output.GetCellData().GetArray("length")) - table[:, 3]).max() < 3e-4

# one clock: of two files one has ITEM: TIME, so the same timesteps have other times; a column `length` is that of the file
def timed(name, has_time):
    with open(os.path.join(data, "local", name)) as file:
        text = file.read()
    with open(name, "w") as file:
        file.write(re.sub(r"ITEM: TIMESTEP\n(\d+)", lambda match: f"ITEM: TIME\n{int(match[1]) * 0.005}\n{match[0]}", text)
                   if has_time else text)
    return os.path.abspath(name)


for with_time in ("chain.dump", "chain_bonds.dump"):
    beads = GranularDumpReader(FileNames=[timed("chain.dump", with_time == "chain.dump")])
    read = GranularLocalReader(FileNames=[timed("chain_bonds.dump", with_time != "chain.dump")],
                               ColumnMap="btype id1 id2 length engpot forcex forcey forcez")
    lines = GranularLocalJoin(Input=beads, Lines=OutputPort(read, 1))
    assert list(beads.TimestepValues) != list(read.TimestepValues)
    for time, (step, table) in zip(beads.TimestepValues, bonds.items()):
        lines.UpdatePipeline(time)
        output = lines.GetClientSideObject().GetOutput()
        assert output.GetFieldData().GetArray("timestep").GetValue(0) == step
        cells = {name: vtk_to_numpy(output.GetCellData().GetArray(name)) for name in ("id1", "length", "length_2")}
        assert (cells["id1"] == table[:, 1]).all() and (cells["length"] == table[:, 3]).all(), (with_time, step)
        assert abs(cells["length_2"] - table[:, 3]).max() < 3e-4, (with_time, step)
        read.UpdatePipeline(time)  # which the filter leaves as it was
        assert list(read.TimestepValues)[1:] == ([500, 1000] if with_time == "chain.dump" else [2.5, 5])

# contacts of LIGGGHTS, which have their places, too: there the particles are, whether the reader split the lines or not
all_particles = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")])
contacts = GranularLocalReader(FileNames=[os.path.join(data, "local", "contacts.dump")], Preset="ContactsForce")
joined = GranularLocalJoin(Input=all_particles, Lines=contacts)
counts = []
for step in (0, 1000, 2000):
    found = []
    for periodic in ("MinimumImage", "Split"):
        contacts.PeriodicLines = periodic
        joined.UpdatePipeline(step)
        output = joined.GetClientSideObject().GetOutput()
        if output.GetNumberOfCells():
            found.append([vtk_to_numpy(output.GetCellData().GetArray(name)).copy() for name in ("id1", "id2", "length")]
                         + [vtk_to_numpy(output.GetPoints().GetData()).copy()])
    if periodic == "Split" and found:
        contacts.PeriodicLines = "MinimumImage"
        contacts.UpdatePipeline(step)
        own = vtk_to_numpy(contacts.GetClientSideObject().GetOutput().GetPoints().GetData())
        assert abs(found[0][3] - own).max() < 1e-6, abs(found[0][3] - own).max()  # six digits of both
        assert all((one == other).all() for one, other in zip(*found)), step
    counts.append(len(found[0][0]) if found else 0)
assert counts[0] == 0 and counts == [len(frame.rows) for frame in
                                     plain_local.read(os.path.join(data, "local", "contacts.dump"))[:3]], counts
print("as long as they are")
