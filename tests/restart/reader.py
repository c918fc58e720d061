# SPDX-License-Identifier: BSD-3-Clause
"""Restart files of LIGGGHTS and Flexible_Fibers: every number against plain parsing, and against dumps of the same steps."""
import os

import numpy
import plain_restart
from paraview.vtk.util.numpy_support import vtk_to_numpy
from said import said_by

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "restart")
shared = os.path.join(os.environ["GRANULAR_DATA"], "..", "..", "..", "shared", "data")
BONDS = 17  # where the block of bond/gran begins behind that of granular
HISTORY = ("force_normal", "force_tangential", "torque_normal", "torque_tangential")


class Read:
    """The outputs, and all that was said."""

    def __init__(self, *names, time=None, **properties):
        reader = vg.vtkGranularRestartReader()
        reader.SetController(None)
        self.said = said_by(reader)
        for name in names:
            reader.AddFileName(os.path.abspath(name))
        for key, value in properties.items():
            getattr(reader, f"Set{key}")(*value) if isinstance(value, tuple) else getattr(reader, f"Set{key}")(value)
        reader.Update() if time is None else reader.UpdateTimeStep(time)
        self.reader, self.particles, self.lines = reader, reader.GetOutput(), reader.GetBonds()

    def points(self, name=None):
        return vtk_to_numpy(self.particles.GetPointData().GetArray(name) if name else
                            self.particles.GetPoints().GetData())

    def cells(self, name):
        return vtk_to_numpy(self.lines.GetCellData().GetArray(name))

    def ends(self):
        return vtk_to_numpy(self.lines.GetPoints().GetData()).reshape(-1, 2, 3)

    def names(self, data):
        return [data.GetAbstractArray(i).GetName() for i in range(data.GetNumberOfArrays())]


def good(name):
    return os.path.join(data, name)


def rows_of(name):
    with open(good(name)) as file:
        return numpy.array([[float(word) for word in line.split()] for line in file.readlines()[9:]])


def check_particles(read, records):
    """What all records of granular hold, bit for bit, in their order."""
    values = numpy.array([record[:BONDS] for record in records])
    assert (read.points() == values[:, 1:4]).all() and read.points().dtype == float
    for name, slot in (("v", 8), ("radius", 11), ("mass", 12), ("density", 13), ("omega", 14)):
        array = read.points(name)
        expected = values[:, slot:slot + 3] if array.ndim == 2 else values[:, slot]
        assert (array == expected).all(), name
    for name, slot in (("id", 4), ("type", 5), ("mask", 6)):
        assert (read.points(name) == [plain_restart.whole(number) for number in values[:, slot]]).all(), name
    assert (read.points("image") == [plain_restart.image(number) for number in values[:, 7]]).all()
    assert read.points("id").dtype == numpy.int64 and read.points("type").dtype == numpy.int32
    assert read.particles.GetPointData().GetPedigreeIds().GetName() == "id"
    assert read.particles.GetNumberOfVerts() == len(records)


def bonds_of(records):
    """{(lower id, higher id): (type, history of the lower one)}"""
    return {(plain_restart.whole(record[4]), partner): (kind, history)
            for record in records for kind, partner, history in plain_restart.bonds(record, BONDS)
            if plain_restart.whole(record[4]) < partner}


def check_bonds(read, records, arrays):
    """Each once, with the history of the lower id, in arrays of these names."""
    expected = bonds_of(records)
    found = list(zip(read.cells("id1"), read.cells("id2")))
    assert sorted(found) == sorted(expected) and len(expected) > 0
    assert (read.cells("btype") == [expected[pair][0] for pair in found]).all()
    history = numpy.array([expected[pair][1] for pair in found])
    values = numpy.hstack([read.cells(name).reshape(len(found), -1) for name in arrays])
    assert values.shape == history.shape, (values.shape, history.shape)
    assert (values[:, :12] == history[:, :12]).all() and (values[:, 12:] == abs(history[:, 12:])).all()
    assert read.cells("id1").dtype == numpy.int64 and read.cells("btype").dtype == numpy.int32


# ---- 31 particles in fibres, on three processes -------------------------------------------------------------

read = Read(good("fibres.restart"))
records = plain_restart.Restart(good("fibres.restart")).records
assert len(records) == 31
check_particles(read, records)
check_bonds(read, records, (*HISTORY, "equilibrium_length", "damage"))
dump = {int(row[0]): row for row in rows_of("fibres.dump")}  # 17 digits
rows = numpy.array([dump[number] for number in read.points("id")])
for name, column in (("type", 1), ("image", 5), ("v", 8), ("omega", 11), ("radius", 14), ("mass", 15), ("density", 16)):
    array = read.points(name)
    assert (array == (rows[:, column:column + 3] if array.ndim == 2 else rows[:, column])).all(), name
assert (read.points() == rows[:, 2:5]).all()

# what the program says of the bonds at the same step, with six digits: forces on the first particle
local = {(int(row[6]), int(row[7])): row for row in rows_of("fibres.bond")}
pairs = list(zip(read.cells("id1"), read.cells("id2")))
assert sorted(pairs) == sorted(local) and len(pairs) == 27
rows = numpy.array([local[pair] for pair in pairs])
assert (read.cells("btype") == rows[:, 8]).all()
assert numpy.allclose(read.cells("force_normal") + read.cells("force_tangential"), rows[:, 9:12], rtol=6e-6, atol=0)
assert numpy.allclose(read.cells("torque_normal") + read.cells("torque_tangential"), rows[:, 12:15], rtol=6e-6, atol=0)
assert (abs(read.cells("torque_tangential")) > 0).any() and (read.cells("damage") == 1).all()

# lines: from particle to particle, short also where the ring closes through the periodic face
places = dict(zip(read.points("id"), read.points()))
ends = read.ends()
assert (ends[:, 0] == [places[pair[0]] for pair in pairs]).all()
crossing = pairs.index((25, 31))
shift = ends[:, 1] - [places[pair[1]] for pair in pairs]
assert (numpy.delete(shift, crossing, axis=0) == 0).all()
assert numpy.allclose(abs(shift[crossing]), [0, 0.014, 0], rtol=0, atol=1e-15), shift[crossing]
assert numpy.allclose(read.cells("length"), 0.002, rtol=0.02, atol=0)
whole = Read(good("fibres.restart"), PeriodicLines=2)
assert (whole.ends()[:, 1] == [places[pair[1]] for pair in pairs]).all() and whole.cells("length").max() > 0.011
split = Read(good("fibres.restart"), PeriodicLines=1)
assert split.lines.GetNumberOfCells() == 28 and (numpy.unique(split.cells("row")) == range(27)).all()
assert (split.cells("part") == (split.cells("row") == numpy.roll(split.cells("row"), 1))).all()

# what is known of the whole
field = read.particles.GetFieldData()
assert vtk_to_numpy(field.GetArray("timestep"))[0] == 10000
assert vtk_to_numpy(field.GetArray("BoxBounds")).ravel().tolist() == [-0.002, 0.022, -0.006, 0.008, -0.012, 0.012]
assert field.GetAbstractArray("Boundary").GetValue(0) == "ff pp ff"
assert field.GetAbstractArray("units").GetValue(0) == "si"
groups = field.GetAbstractArray("Groups")
assert [groups.GetValue(i) for i in range(groups.GetNumberOfValues())] == ["all", "clamped", "ring"]
clamped = read.points("mask") >> 1 & 1
assert (read.points()[clamped == 1, 0] < 0.0015).all() and clamped.sum() == 4
box = read.reader.GetOutputDataObject(2)
assert box.GetNumberOfCells() == 1 and box.GetBounds() == (-0.002, 0.022, -0.006, 0.008, -0.012, 0.012)

# ---- one file a process, of which the first has none -----------------------------------------------------

parts = Read(good("parts.base.restart"))
check_particles(parts, records)
check_bonds(parts, records, (*HISTORY, "equilibrium_length", "damage"))
everything = Read(*(good(f"parts.{part}.restart") for part in ("0", "1", "2", "base")))
assert (everything.points() == parts.points()).all()
assert read.said == parts.said == everything.said == [], (read.said, everything.said)

# ---- names of the history, what is read, where points are ------------------------------------------------

numbered = Read(good("fibres.restart"), HistoryLayout=1)
check_bonds(numbered, records, [f"history{i}" for i in range(1, 15)])
other = Read(good("fibres.restart"), HistoryLayout=2)  # has 12
check_bonds(other, records, [f"history{i}" for i in range(1, 15)])
names = read.names(read.particles.GetPointData())
assert sorted(names) == sorted(["id", "type", "mask", "image", "v", "radius", "mass", "density", "omega", "mol"]), names
reader = read.reader
for array in names:
    reader.GetPointDataArraySelection().DisableArray(array)
reader.GetCellDataArraySelection().DisableAllArrays()
reader.GetCellDataArraySelection().EnableArray("damage")
reader.Update()
assert read.names(reader.GetOutput().GetPointData()) == [] and reader.GetOutput().GetNumberOfPoints() == 31
assert sorted(read.names(reader.GetBonds().GetCellData())) == ["damage", "length"]
assert (vtk_to_numpy(reader.GetBonds().GetPoints().GetData()) == ends.reshape(-1, 3)).all()
moved = Read(good("fibres.restart"), PointOrigin=(0.5, 0.25, -2.0))
assert (moved.points() == read.points() - [0.5, 0.25, -2]).all()
assert numpy.allclose(moved.ends(), ends - [0.5, 0.25, -2], rtol=0, atol=1e-15)
assert vtk_to_numpy(moved.lines.GetFieldData().GetArray("PointOrigin")).ravel().tolist() == [0.5, 0.25, -2]

# ---- pieces ----------------------------------------------------------------------------------------------

for pieces in (2, 3, 5, 40):
    points, cells = [], []
    for piece in range(pieces):
        reader = vg.vtkGranularRestartReader()
        reader.SetController(None)
        reader.AddFileName(good("fibres.restart"))
        reader.UpdatePiece(piece, pieces, 0)
        points.append(vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("id")))
        data_of = reader.GetBonds().GetCellData()
        own = numpy.stack([vtk_to_numpy(data_of.GetArray(name)) for name in ("id1", "id2")], axis=1)
        assert set(own[:, 0]) <= set(points[-1])
        cells.append(own)
        assert reader.GetOutputDataObject(2).GetNumberOfCells() == (piece == 0)
    assert numpy.concatenate(points).tolist() == list(places)
    assert numpy.concatenate(cells).tolist() == [list(pair) for pair in pairs]

# ---- particles without bonds, and bonds with twelve values, of other programs -------------------------------

if os.path.isdir(shared):
    all_particles = Read(os.path.join(shared, "liggghts", "grains.restart"))
    records = plain_restart.Restart(os.path.join(shared, "liggghts", "grains.restart")).records
    assert len(records) == 1200
    check_particles(all_particles, records)
    assert all_particles.lines.GetNumberOfCells() == 0 and all_particles.said == [], all_particles.said
    walls = numpy.array([record[18:21] for record in records])  # fix property/atom: its length and three values
    assert (all_particles.points("f_history_zwalls") == walls).all() and (walls != 0).any()
    beam = Read(os.path.join(shared, "reference", "beam.restart"))
    records = plain_restart.Restart(os.path.join(shared, "reference", "beam.restart")).records
    check_particles(beam, records)
    check_bonds(beam, records, HISTORY)
    assert beam.lines.GetNumberOfCells() == 10 and vtk_to_numpy(
        beam.particles.GetFieldData().GetArray("timestep"))[0] == 100004
print("every number")
