# SPDX-License-Identifier: BSD-3-Clause
"""Files of LIGGGHTS and LAMMPS, held against plain parsing: every number, and how lines across faces are drawn."""
import glob
import gzip
import os

import numpy
import paraview.simple  # noqa: F401 - connects, which _find_reader needs
import plain_local
from paraview.vtk.util.numpy_support import vtk_to_numpy
from said import said_by

import vtkgranular as vg
from vtkgranular._reader import _find_reader

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")
FORCE = ["x1", "y1", "z1", "x2", "y2", "z2", "id1", "id2", "periodic", "forcex", "forcey", "forcez"]


class Read:
    """The outputs at a time, and all that was said."""

    def __init__(self, names, time=None, **properties):
        reader = vg.vtkGranularLocalReader()
        reader.SetController(None)
        self.said = said_by(reader)
        for name in [names] if isinstance(names, str) else names:
            reader.AddFileName(os.path.abspath(name))
        for key, value in properties.items():
            getattr(reader, f"Set{key}")(value)
        reader.GetCellDataArraySelection().EnableArray("position1")
        reader.GetCellDataArraySelection().EnableArray("position2")
        reader.UpdateInformation()
        reader.Update() if time is None else reader.UpdateTimeStep(time)
        self.reader, self.lines, self.rows = reader, reader.GetOutput(), reader.GetRows()

    def column(self, name):
        return vtk_to_numpy(self.rows.GetColumnByName(name))

    def cells(self, name):
        return vtk_to_numpy(self.lines.GetCellData().GetArray(name))

    def ends(self):
        points = self.lines.GetPoints().GetData() if self.lines.GetNumberOfPoints() else None
        return vtk_to_numpy(points).reshape(-1, 2, 3) if points else numpy.zeros((0, 2, 3))


def good(name):
    return os.path.join(data, name)


# ---- contacts of a real run --------------------------------------------------------------------------------

frames = plain_local.read(good("contacts.dump"))
assert [frame.timestep for frame in frames] == [0, 1000, 2000, 3000, 4000]
crossing = 0
for frame in frames:
    rows = numpy.array(frame.rows, dtype=float).reshape(-1, 12)
    origin, vectors = frame.box()
    edges = numpy.diag(vectors) * [flag == "pp" for flag in frame.boundary.split()]
    first, second = rows[:, :3], rows[:, 3:6]
    apart = second - first
    nearest = apart - edges * numpy.round(numpy.divide(apart, edges, out=numpy.zeros_like(apart), where=edges > 0))
    lengths = numpy.sqrt((nearest ** 2).sum(axis=1))
    crossed = (nearest != apart).sum(axis=1)
    assert ((crossed > 0) == (rows[:, 8] == 1)).all()  # the program says so, too
    crossing += (crossed > 0).sum()

    image = Read(good("contacts.dump"), frame.timestep)
    assert image.said == [], image.said
    for output in (image.column, image.cells):
        for name, expected in (("position1", first), ("position2", second), ("id1", rows[:, 6]), ("id2", rows[:, 7]),
                               ("periodic", rows[:, 8]), ("force", rows[:, 9:])):
            found = output(name)
            assert found.shape == expected.shape and (found == expected).all(), name
    assert image.column("id1").dtype == numpy.int64 and image.column("periodic").dtype == numpy.int32
    assert numpy.allclose(image.cells("length"), lengths, rtol=1e-14, atol=0)
    assert (image.ends()[:, 0] == first).all()
    assert numpy.allclose(image.ends()[:, 1], first + nearest, rtol=0, atol=1e-16)

    written = Read(good("contacts.dump"), frame.timestep, PeriodicLines=2)
    assert (written.ends()[:, 0] == first).all() and (written.ends()[:, 1] == second).all()
    assert numpy.allclose(written.cells("length"), numpy.sqrt((apart ** 2).sum(axis=1)), rtol=1e-14, atol=0)

    split = Read(good("contacts.dump"), frame.timestep, PeriodicLines=1)
    row = split.cells("row")
    assert (numpy.bincount(row, minlength=len(rows)) == 1 + crossed).all()
    assert (split.cells("force") == rows[row, 9:]).all() and (split.cells("id2") == rows[row, 7]).all()
    parts = numpy.sqrt((numpy.diff(split.ends(), axis=1)[:, 0] ** 2).sum(axis=1))
    assert numpy.allclose(numpy.bincount(row, parts, len(rows)), lengths, rtol=1e-12, atol=0)
    assert numpy.allclose(split.cells("length"), lengths[row], rtol=1e-14, atol=0)
    assert ((split.ends() >= origin) & (split.ends() <= origin + numpy.diag(vectors)))[..., :2].all()
    assert split.rows.GetNumberOfRows() == len(rows)

    shift = numpy.array([0.01, -0.02, 0.03])
    moved = Read(good("contacts.dump"), frame.timestep, PointOrigin=shift)
    assert numpy.allclose(moved.ends() + shift, image.ends(), rtol=0, atol=1e-16)
    assert (moved.cells("length") == image.cells("length")).all()
    if len(rows):
        assert (moved.column("position1") == first).all()  # as the file has it
assert crossing > 3, crossing

# ---- packed ------------------------------------------------------------------------------------------------

with open(good("contacts.dump"), "rb") as file:
    content = file.read()
with gzip.open("contacts.dump.gz", "wb") as file:
    file.write(content)
packed = Read("contacts.dump.gz", 4000)
assert (packed.cells("force") == image.cells("force")).all() and (packed.ends() == image.ends()).all()

# ---- bonds of a real run, which have no places -----------------------------------------------------------

NAMES = ["btype", "id1", "id2", "dist", "engpot", "forcex", "forcey", "forcez"]
for frame in plain_local.read(good("chain_bonds.dump")):
    bonds = Read(good("chain_bonds.dump"), frame.timestep)
    rows = numpy.array(frame.rows, dtype=float)
    assert frame.label == "BONDS" and bonds.lines.GetNumberOfCells() == 0
    assert bonds.lines.GetFieldData().GetArray("timestep").GetValue(0) == frame.timestep
    for k, name in enumerate(NAMES[:5]):
        assert (bonds.column(name) == rows[:, k]).all(), name
    assert (bonds.column("force") == rows[:, 5:]).all()
    said = [text.split("): ")[1] for text in bonds.said]
    assert len(said) == 1 and "BondTypeIdsForce" in said[0] and "set Preset to it" in said[0], said

# ---- other columns, other labels --------------------------------------------------------------------------

frame = plain_local.read(good("all.dump"))[0]
rows = numpy.array(frame.rows, dtype=float)
for words in ("pos vel id force torque delta", "delta torque force id vel pos"):
    contacts = Read(good("all.dump"), ColumnMap=words)
    assert contacts.said == [], contacts.said
    for name, columns in (("position1", slice(0, 3)), ("position2", slice(3, 6)), ("v1", slice(6, 9)),
                          ("v2", slice(9, 12)), ("force", slice(15, 18)), ("torque", slice(18, 21)), ("delta", 21)):
        assert (contacts.column(name) == rows[:, columns]).all(), name
contacts = Read(good("all.dump"))
assert len(contacts.said) == 1 and "no preset has as many" in contacts.said[0] and "name the particles in ColumnMap" in contacts.said[0]
assert (contacts.column("c_fa") == rows).all()
broken = Read(good("broken.txt"), ColumnMap="time id1 id2")  # rows alone, of which the names say whose they are
assert _find_reader([good("broken.txt")], "time id1 id2") == "GranularLocalReader"
assert len(broken.said) == 1 and "no header" in broken.said[0] and broken.column("id2").tolist() == [5471, 1931, 1815, 1816]
label = Read(good("label.dump"), ColumnMap="id1=2 id2=3")
assert label.said == [] and label.rows.GetNumberOfRows() == 32
assert (label.column("index") == numpy.arange(1, 33)).all()
assert (label.column("id1") == rows[:, 12]).all() and (label.column("id2") == rows[:, 13]).all()

# ---- one file a process, of which only the first has headers --------------------------------------------

files = sorted(glob.glob(good("pieces_*.dump")))
assert len(files) == 12
for step in (0, 1500, 3000):
    rows = plain_local.read(good(f"pieces_{step}.0.dump"))[0].rows
    for process in (1, 2, 3):
        rows = rows + plain_local.read_rows(good(f"pieces_{step}.{process}.dump"))
    rows = numpy.array(rows, dtype=float).reshape(-1, 12)
    pieces = Read(files[::-1], step)
    assert [text for text in pieces.said if "taken for the preset ContactsForce" not in text] == []
    assert pieces.lines.GetNumberOfCells() == len(rows)
    assert (pieces.column("id1") == rows[:, 6]).all() and (pieces.column("force") == rows[:, 9:]).all()
    assert (pieces.ends()[:, 0] == rows[:, :3]).all()
assert len(rows) == 32
print("every number")
