# SPDX-License-Identifier: BSD-3-Clause
"""Data files of LAMMPS and LIGGGHTS: every number of the class's outputs against plain parsing."""
import gzip
import os

import numpy
import plain_data
from paraview.vtk.util.numpy_support import vtk_to_numpy
from said import said_by

import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
COLUMNS = {"sphere": ["type", "diameter", "density"], "ellipsoid": ["type", "ellipsoidflag", "density"],
           "full": ["mol", "type", "q"], "bond": ["mol", "type"], "granular": ["type", "diameter", "density"]}
SPINS = {"sphere": "omega", "granular": "omega", "ellipsoid": "angmom"}


class Read:
    """The outputs, and all that was said."""

    def __init__(self, name, **properties):
        reader = vg.vtkGranularDataFileReader()
        reader.SetController(None)
        self.said = said_by(reader)
        reader.AddFileName(os.path.abspath(name))
        for key, value in properties.items():
            getattr(reader, f"Set{key}")(*value) if isinstance(value, tuple) else getattr(reader, f"Set{key}")(value)
        reader.Update()
        self.reader, self.particles, self.lines = reader, reader.GetOutput(), reader.GetBonds()
        self.box = reader.GetOutputDataObject(2)

    def points(self, name=None):
        return vtk_to_numpy(self.particles.GetPointData().GetArray(name) if name else
                            self.particles.GetPoints().GetData())

    def cells(self, name):
        return vtk_to_numpy(self.lines.GetCellData().GetArray(name))


for style, name in (("sphere", "data_file/sphere.data"), ("ellipsoid", "data_file/ellipsoid.data"),
                    ("full", "data_file/full.data"), ("granular", "data_file/granular.data"),
                    ("bond", "local/chain.data")):
    path = os.path.join(data, name)
    plain = plain_data.Data(path)
    atoms, velocities = plain.rows("Atoms"), plain.rows("Velocities")
    silent = style in ("granular", "bond")  # these do not say their style
    read = Read(path, **({"AtomStyle": style} if silent else {}))
    assert read.said == [], read.said
    assert (read.points("id") == list(atoms)).all() and read.points("id").dtype == numpy.int64
    rows = numpy.array(list(atoms.values()))
    columns = COLUMNS[style]
    for k, column in enumerate(columns):
        assert (read.points(column) == rows[:, k]).all(), (name, column)
    k = len(columns)
    assert (read.points() == rows[:, k:k + 3]).all() and read.points().dtype == float
    assert (read.points("image") == rows[:, k + 3:]).all() and read.points("image").dtype == numpy.int32
    if "diameter" in columns:
        assert (read.points("radius") == rows[:, columns.index("diameter")] / 2).all()
    if velocities:
        moving = numpy.array([velocities[number] for number in atoms])
        assert (read.points("v") == moving[:, :3]).all()
        if style in SPINS:
            assert (read.points(SPINS[style]) == moving[:, 3:]).all()
    assert read.particles.GetNumberOfVerts() == len(atoms)
    # bonds, each from particle to particle
    bonds = numpy.array([row for row in plain.sections.get("Bonds", [])], dtype=int).reshape(-1, 4)
    assert read.lines.GetNumberOfCells() == len(bonds)
    for k, column in enumerate(("bond_id", "btype", "id1", "id2")):
        assert (read.cells(column) == bonds[:, k]).all(), (name, column)
    if len(bonds):
        place = dict(zip(read.points("id"), read.points()))
        ends = vtk_to_numpy(read.lines.GetPoints().GetData()).reshape(-1, 2, 3)
        assert (ends[:, 0] == [place[number] for number in bonds[:, 2]]).all()
        assert numpy.allclose(numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), read.cells("length"), rtol=1e-14)
        whole = Read(path, PeriodicLines=2, **({"AtomStyle": style} if silent else {}))
        ends = vtk_to_numpy(whole.lines.GetPoints().GetData()).reshape(-1, 2, 3)
        assert (ends[:, 1] == [place[number] for number in bonds[:, 3]]).all()
        assert (read.cells("length") <= whole.cells("length")).all()
    # the box
    low, high = numpy.array([[float(word) for word in words[:2]] for words in plain.header if words[-1][1:] == "hi"]).T
    tilts = [list(map(float, words[:3])) for words in plain.header if words[3:] == ["xy", "xz", "yz"]]
    corners = vtk_to_numpy(read.box.GetPoints().GetData())
    xy, xz, yz = tilts[0] if tilts else (0, 0, 0)
    assert read.box.GetNumberOfCells() == 1 and (corners[0] == low).all()
    assert numpy.allclose(corners[6], high + [xy + xz, yz, 0], rtol=0, atol=1e-15), corners
    assert vtk_to_numpy(read.particles.GetFieldData().GetArray("BoxVectors")).ravel()[3] == xy

# ---- the same as of dumps --------------------------------------------------------------------------------

path = os.path.join(data, "data_file", "sphere.data")
read = Read(path)
again = Read(path, SortById=True, PointOrigin=(100.0, -5.0, 0.25))
order = numpy.argsort(read.points("id"))
assert (again.points("id") == read.points("id")[order]).all() and (again.points("v") == read.points("v")[order]).all()
assert (again.points() == read.points()[order] - [100, -5, 0.25]).all()
some = Read(path, Stride=3, RegionOfInterest=(1.0, -1.0, 0.0, 1.5, 1.0, -1.0))
y = read.points()[:, 1]
kept = (read.points("id") % 3 == 0) & (y >= 0) & (y <= 1.5)
assert 0 < kept.sum() < 14 and (some.points("omega") == read.points("omega")[kept]).all()
assert some.particles.GetFieldData().GetAbstractArray("ParticlesLeftOut")
scaled = Read(path, Coordinates=2)
assert (abs(scaled.points()) < 2).all() and scaled.box.GetBounds() == (0, 1, 0, 1, 0, 1)
moved = Read(path, Coordinates=1).points() - read.points()
number = list(read.points("id")).index(3)  # of image 1 -2 0
assert numpy.allclose(moved[number], [4 - 2 * 0.5, -2 * 3, 0], rtol=0, atol=1e-14), moved[number]
assert (numpy.delete(moved, number, axis=0) == 0).all()
reader = vg.vtkGranularDataFileReader()
reader.AddFileName(path)
reader.UpdateInformation()
selection = reader.GetPointDataArraySelection()
assert [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())] == [
    "id", "type", "diameter", "density", "x", "y", "z", "image", "v", "omega", "radius"]
selection.DisableAllArrays()
selection.EnableArray("omega")
reader.Update()
points = reader.GetOutput().GetPointData()
assert points.GetNumberOfArrays() == 1 and (vtk_to_numpy(points.GetArray("omega")) == read.points("omega")).all()

labels = Read(os.path.join(data, "data_file", "labels.data"))
names = [output.GetFieldData().GetAbstractArray("TypeNames") for output in (labels.particles, labels.lines)]
assert [[array.GetValue(i) for i in range(array.GetNumberOfValues())] for array in names] == [["sand", "steel"], ["glue"]]

# ---- written as a dump and read again ---------------------------------------------------------------------

writer = vg.vtkGranularDumpWriter()
writer.SetController(None)
writer.SetInputData(read.particles)
writer.SetFileName(os.path.abspath("sphere.dump"))
writer.SetNumberFormat("%.17g")
writer.Write()
dump = vg.vtkGranularDumpReader()
dump.SetController(None)
dump.AddFileName(os.path.abspath("sphere.dump"))
dump.Update()
for name in ("id", "type", "diameter", "radius", "v", "omega", "image"):
    assert (vtk_to_numpy(dump.GetOutput().GetPointData().GetArray(name)) == read.points(name)).all(), name

# ---- many in one series, compressed ones, and one that is not complete ---------------------------------------

with open(path) as file:
    text = file.read()
for step in 1000, 2000:
    with gzip.open(f"series_{step}.data.gz", "wt") as packed:
        packed.write(text.replace("timestep = 3000", f"timestep = {step}"))
with open("cut.data", "w") as file:
    file.write(text[:len(text) // 2])
reader = vg.vtkGranularDataFileReader()
reader.SetController(None)
said = said_by(reader)
for name in ("series_2000.data.gz", path, "series_1000.data.gz", "cut.data"):
    reader.AddFileName(os.path.abspath(name))
reader.UpdateTimeStep(2000)
key = vg.vtkGranularDataFileReader.GetExecutive(reader).TIME_STEPS()
assert reader.GetOutputInformation(0).Get(key) == (1000, 2000, 3000)
assert (vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("v")) == read.points("v")).all()
assert len(said) == 1 and "in the section Atoms, got 37" in said[0] and "left out" in said[0], said
assert "AtomStyle" in str(reader) and "RegionOfInterest" in str(reader)
for name in ("grains.dump", "local/contacts.dump", "restart/fibres.restart"):
    assert not vg.vtkGranularDataFileReader.CanReadFile(os.path.join(data, name))
print("read")
