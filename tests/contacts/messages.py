# SPDX-License-Identifier: BSD-3-Clause
"""What the filter says: errors name what they mean, leave both outputs empty and the next update good; warnings count."""
import itertools

import numpy
import vtkgranular as vg
from contact_sums import NAMES, Sums
from said import said_by
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkPolyData, vtkTable, vtkUnstructuredGrid)

import plain_contacts as plain

NAN = float("nan")


def array_of(name, values):
    if isinstance(values[0] if len(values) else 0, str):
        array = vtkStringArray()
        for value in values:
            array.InsertNextValue(value)
    else:
        array = numpy_to_vtk(numpy.array(values), deep=1)
    array.SetName(name)
    return array


def data_of(points, arrays, cells=0, field=None):
    """Particles as vertices, or cells of so many points each, with arrays {name: values}."""
    made, places, all_cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(numpy.array(points, dtype=float).reshape(-1, 3), deep=1))
    made.SetPoints(places)
    size = max(cells, 1)
    for first in range(0, len(points), size):
        all_cells.InsertNextCell(size)
        for i in range(size):
            all_cells.InsertCellPoint(first + i)
    {0: made.SetVerts, 2: made.SetLines}.get(cells, made.SetPolys)(all_cells)
    for name, values in arrays.items():
        (made.GetCellData() if cells else made.GetPointData()).AddArray(array_of(name, values))
    for name, values in (field or {}).items():
        made.GetFieldData().AddArray(array_of(name, values))
    return made


def table_of(arrays):
    made = vtkTable()
    for name, values in arrays.items():
        made.AddColumn(array_of(name, values))
    return made


def all_particles(**other):
    """Three in a row, 2 apart; other arrays, or None for none of that name."""
    arrays = {"id": [1, 2, 3], "radius": [1.0, 1.0, 1.0], **other}
    return data_of([[0, 0, 0], [2, 0, 0], [4, 0, 0]], {name: values for name, values in arrays.items() if values is not None})


ROWS = {"id1": [1, 2], "id2": [2, 3], "force": [[-4.0, 1, 0], [-6, 0, 0]]}
ENDS = [[0, 0, 0], [2, 0, 0], [2, 0, 0], [4, 0, 0]]


def pairs(points=ENDS, cells=2, field=None, **other):
    arrays = {**ROWS, **other}
    return data_of(points, {name: values for name, values in arrays.items() if values is not None}, cells, field)


def walls(**other):
    arrays = {"id2": [1], "force": [[0, 0, 3.0]], **other}
    return data_of([[0, 0, -1], [0, 0, 0]], {name: values for name, values in arrays.items() if values is not None}, 2)


def made_of(particles=None, lines=None, walls=None, on=NAMES[:5], **properties):
    made = vg.vtkGranularContactSums()
    made.SetController(None)
    made.SetInputDataObject(0, particles or all_particles())
    for port, data in ((1, lines), (2, walls)):
        if data:
            made.SetInputDataObject(port, data)
    for name in NAMES:
        (made.GetArraySelection().EnableArray if name in on else made.GetArraySelection().DisableArray)(name)
    for name, value in properties.items():
        getattr(made, f"Set{name}")(value)
    made.said = said_by(made)
    return made


def works(made, *said):
    made.said.clear()
    made.Update()
    assert len(made.said) == len(said) and all(text in each for text, each in zip(said, made.said)), (made.said, said)
    assert made.GetErrorCode() == 0 and not made.GetErrorMessage() and made.GetOutput().GetNumberOfPoints()


def fails(made, text):
    made.said.clear()
    made.Modified()
    made.Update()
    assert len(made.said) == 1 and text in made.said[0], (made.said, text)
    assert made.GetErrorMessage() == text, (made.GetErrorMessage(), text)
    assert made.GetErrorCode() != 0
    for output in (made.GetOutput(), made.GetLinesOutput()):
        assert output.GetNumberOfPoints() + output.GetNumberOfCells() == 0
        assert output.GetPointData().GetNumberOfArrays() + output.GetFieldData().GetNumberOfArrays() == 0


def refused(text, good_port=0, good=None, **bad):
    """An error; the same filter works with other data on that port."""
    made = made_of(**bad)
    fails(made, text)
    if good:
        made.SetInputDataObject(good_port, good)
        works(made)


def array(made, name, lines=False):
    return vtk_to_numpy((made.GetLinesOutput().GetCellData() if lines else made.GetOutput().GetPointData()).GetArray(name))


# ---- inputs --------------------------------------------------------------------------------------------------------------

good = made_of(lines=pairs(), walls=walls(), on=NAMES)
works(good)
assert array(good, "coordination").tolist() == [2, 2, 1]
assert array(good, "contact_force").tolist() == [[-4, 1, 3], [-2, -1, 0], [6, 0, 0]]

refused("expected contacts: the input Lines, Walls, or both, got none. In the window: Edit, Change Input", 1, pairs())
works(made_of(lines=pairs()))
works(made_of(walls=walls()))
refused("expected a vtkPointSet of particles, got a vtkImageData", 0, all_particles(), particles=vtkImageData(), lines=pairs())
refused("expected a vtkPointSet of particles, got a vtkMultiBlockDataSet: the filter MergeBlocks makes one of it", 0, all_particles(),
        particles=vtkMultiBlockDataSet(), lines=pairs())
KINDS = "expected lines as cells of a vtkDataSet, or a vtkTable with a row for each, got a vtkMultiBlockDataSet: the filter MergeBlocks makes one of it"
refused(KINDS, 1, pairs(), lines=vtkMultiBlockDataSet())
refused(KINDS, 2, walls(), walls=vtkMultiBlockDataSet())
refused("expected lines as cells, got a cell of the VTK type 5 in row 0 (the first is 0)", 1, pairs(),
        lines=pairs(points=ENDS + ENDS[:2], cells=3))
vertices = all_particles()
for name, values in ROWS.items():
    vertices.GetCellData().AddArray(array_of(name, values + values[:1]))
refused("expected lines as cells, got a cell of the VTK type 1 in row 0 (the first is 0)", 1, pairs(), lines=vertices)

# ---- arrays --------------------------------------------------------------------------------------------------------------

refused("expected an array 'id' of the particles, got none", 0, all_particles(), particles=all_particles(id=None), lines=pairs())
refused("column 'id': expected a 64-bit integer as id, got 1.5 in row 0 (the first is 0)", 0, all_particles(),
        particles=all_particles(id=[1.5, 2, 3]), lines=pairs())
works(made_of(particles=all_particles(id=[1.0, 2.0, 3.0]), lines=pairs()))
refused("expected an array 'id1' of the lines, got none", 1, pairs(), lines=pairs(id1=None))
refused("expected an array 'id2' of the lines, got none", 1, pairs(), lines=pairs(id2=None))
refused("expected an array 'id2' of the lines, got none", 2, walls(), walls=walls(id2=None))
refused("expected contacts with walls as Walls, got an array 'id1' of a second particle: contacts between particles are Lines", 2,
        walls(), walls=walls(id1=[77]))
refused("expected an array 'force_tangential' or 'force' of the contacts for mobilised_friction, got 'force_normal' alone", 1, pairs(),
        lines=pairs(force=None, force_normal=ROWS["force"]), on=NAMES)
refused("expected 3 numbers a row in the array 'force' of the lines, got 1", 1, pairs(), lines=pairs(force=[1.0, 2.0]))
refused("expected 3 numbers a row in the array 'torque' of the lines, got 1", 1, pairs(), lines=pairs(torque=[1.0, 2.0]))
refused("expected 3 numbers a row in the array 'contact_point' of the lines, got 1", 1, pairs(), lines=pairs(contact_point=[1.0, 2.0]))
refused("expected 3 numbers a row in the array 'force' of the lines, got the type string", 1, pairs(), lines=pairs(force=["a", "b"]))
refused("expected one number a row in the array 'delta' of the lines, got 3", 1, pairs(), lines=pairs(delta=ROWS["force"]),
        MinimumOverlap=0.1)
works(made_of(lines=pairs(delta=ROWS["force"])))  # which nobody asks for
ONE_KIND = "expected forces of all contacts, with particles and with walls, got those of one kind alone"
refused(ONE_KIND, 2, walls(), lines=pairs(), walls=walls(force=None))
refused(ONE_KIND, 1, pairs(), lines=pairs(force=None), walls=walls())
works(made_of(lines=pairs(force=None), walls=walls(force=None)), "neither an array 'force' nor 'force_normal'")
works(made_of(lines=pairs(force=None), on=["coordination", "fabric"]))
refused("expected lines or an array 'contact_point' of contacts with walls, got neither", 2, walls(),
        walls=table_of({"id2": [1], "force": [[0, 0, 3.0]]}))
works(made_of(walls=table_of({"id2": [1], "force": [[0, 0, 3.0]], "contact_point": [[0, 0, -1.0]]})))
NO_RADII = "expected an array 'radius' of the particles, whose volume stresses are divided by, got none"
for on in (["von_mises"], ["principal_stress"]):
    refused(NO_RADII, 0, all_particles(), particles=all_particles(radius=None), lines=pairs(), on=on)
    refused(NO_RADII.replace("radius", "size"), 0, all_particles(size=[1.0, 1, 1]), lines=pairs(), on=on, RadiusArray="size")
works(made_of(particles=all_particles(radius=None), lines=pairs()))
refused("expected an array 'radius' of numbers, got texts", 0, all_particles(), particles=all_particles(radius=["a", "b", "c"]), lines=pairs())
OVERLAP = "expected an array 'delta' of the contacts, or 'radius' of the particles, for MinimumOverlap, got neither"
refused(OVERLAP, 0, all_particles(), particles=all_particles(radius=None), lines=pairs(), MinimumOverlap=1e-9)
refused(OVERLAP, 0, all_particles(), particles=all_particles(radius=None), lines=pairs(delta=[1.0, 1.0]), walls=walls(), MinimumOverlap=1e-9)
works(made_of(particles=all_particles(radius=None), lines=pairs(delta=[1.0, 1.0]), MinimumOverlap=1e-9))

refused("expected forces of the contacts for MinimumForce, got none", 1, pairs(), lines=pairs(force=None), MinimumForce=1e-9)
works(made_of(lines=pairs(force=None)), "neither an array 'force' nor 'force_normal'")

# ---- properties ----------------------------------------------------------------------------------------------------------

for name, kind, bad in (("MinimumForce", "of 0 or more", "-1 nan inf"), ("MinimumOverlap", "of 0 or more", "-1e-09 nan inf"),
                        ("FrictionCoefficient", "above 0", "0 -0.5 nan inf")):
    made = made_of(lines=pairs(), on=NAMES)
    for text in bad.split():
        getattr(made, f"Set{name}")(float(text))
        fails(made, f"expected a {name} {kind}, got {text}")
    getattr(made, f"Set{name}")(0.5)
    works(made)
made = made_of(lines=pairs())
made.SetRattlerContacts(0)
made.SetLeverArm(7)
assert [text.split("): ")[1].strip() for text in made.said] == ["RattlerContacts must be at least 1, got 0", "LeverArm must be from 0 to 1, got 7"]
assert made.GetRattlerContacts() == 2 and made.GetLeverArm() == 0

# ---- parts of lines ------------------------------------------------------------------------------------------------------

split = {"row": [0, 0, 1, 1], "part": [0, 1, 0, 1], "id1": [1, 1, 2, 2], "id2": [2, 2, 3, 3],
         "force": [[-4.0, 1, 0]] * 2 + [[-6.0, 0, 0]] * 2}
parts = [[0, 0, 0], [1, 0, 0], [9, 0, 0], [10, 0, 0], [2, 0, 0], [2.5, 0, 0], [-7, 0, 0], [-5.5, 0, 0]]
made = made_of(lines=pairs(parts, **split), on=NAMES)
works(made)
expected = made_of(lines=pairs(), on=NAMES)
works(expected)
for name in NAMES[:-1]:
    assert (array(made, name) == array(expected, name)).all(), name
assert array(made, NAMES[-1], lines=True).tolist() == [0.25, 0.25, 0, 0]
refused("expected the parts of each line one after the other, got 1 of other lines or places: with PeriodicLines MinimumImage lines "
        "are whole", 1, pairs(), lines=pairs(parts, **{**split, "part": [0, 0, 1, 1]}))

# ---- warnings ------------------------------------------------------------------------------------------------------------

MISSING = "{} of {} contacts name a particle that is not there: they count for the other one alone"
BROKEN = "{} of {} contacts are left out: a number of theirs is no number, infinite or too large"
made = made_of(lines=pairs(id2=[9, 3]), walls=walls())
works(made, MISSING.format(1, 3))
assert array(made, "contact_force").tolist() == [[-4, 1, 3], [-6, 0, 0], [6, 0, 0]]
works(made_of(lines=pairs(), walls=walls(id2=[8])), MISSING.format(1, 3))
# a particle that is not in the dump, as of a group: the other one has its contact, and no part in what needs a line
made = made_of(lines=table_of({**ROWS, "id1": [9, 9]}))
works(made, MISSING.format(2, 2) + "; 2 of these have no line, and count for coordination and force alone")
assert array(made, "coordination").tolist() == [0, 1, 1]
assert array(made, "contact_force").tolist() == [[0, 0, 0], [4, -1, 0], [6, 0, 0]]
for name in ("contact_torque", "fabric", "contact_stress"):
    assert not array(made, name).any(), name
made = made_of(lines=pairs(force=[[-4.0, 1, 0], [NAN, 0, 0]]), walls=walls())
works(made, BROKEN.format(1, 3))
assert array(made, "contact_force").tolist() == [[-4, 1, 3], [4, -1, 0], [0, 0, 0]]
made = made_of(particles=all_particles(id=[1, 2, 2]), lines=pairs(id2=[2, 2]))
works(made, "1 particles have the id of another one: contacts go to the first")
assert array(made, "coordination").tolist() == [1, 3, 0]
# several at once, each told once until something changes
made = made_of(particles=all_particles(id=[1, 2, 2]), lines=pairs(id2=[9, 2], force=[[-4.0, 1, 0], [NAN, 0, 0]]))
works(made, MISSING.format(1, 2), BROKEN.format(1, 2), "1 particles have the id")
made.said.clear()
made.UpdatePiece(1, 2, 0)
assert made.said == [], made.said
made.Modified()
made.UpdatePiece(0, 2, 0)
assert len(made.said) == 3, made.said

# lines of another time, also of a file with one time alone
for particles_of, lines_of, step, said in (("moving", "moving", 3000, []), ("moving", "moving", 3020, []),
                                        ("bed", "moving", 70000, ["the particles are of timestep 70000, the lines of 3020"]),
                                        ("moving", "bed", 3020, ["the particles are of timestep 3020, the lines of 70000"])):
    made = Sums(lines_of, walls=False, on=NAMES[:5])
    if particles_of != lines_of:
        made.particles = Sums(particles_of).particles
        made.filter.SetInputConnection(0, made.particles.GetOutputPort())
    made.filter.UpdateTimeStep(step)
    told = [each for each in made.said if "timestep" in each]
    assert len(told) == len(said) and all(text in each for text, each in zip(said, told)), made.said

# files that name particles by id alone: the second output has the rows
made = Sums("tilted", walls=False, on=NAMES[:5])
made.filter.Update()
assert len(made.said) == 1 and (
    "an input has no lines, as its file does not say where these are: take the rows, the second output of the reader") in made.said[0]
assert (vtk_to_numpy(made.filter.GetOutput().GetPointData().GetArray("coordination")) == 0).all()

# arrays that nobody makes
made = Sums("bed")
made.filter.GetArraySelection().EnableArray("stress")
made.filter.GetArraySelection().DisableArray("strain")
made.filter.Update()
assert len(made.said) == 1 and "there is no array 'stress': Arrays may name coordination, contact_force, " in made.said[0], made.said

# ---- lines as readers draw them ------------------------------------------------------------------------------------------

contacts = plain.Contacts("periodic_bed_contacts", 70000)
across = contacts.named["id"][:, 2] == 1
assert 0 < across.sum() < 250
for lever in (0, 1):  # at half the line, no contact point tells the way through a face
    all_ = [Sums("periodic_bed", local={"PeriodicLines": kind}, LeverArm=lever) for kind in (0, 1, 2)]
    first, *others = (each.update() for each in all_)
    for name, other in itertools.product(NAMES[:-1], others):
        assert (first[name] == other[name]).all(), (name, lever)
    rows, counts = numpy.unique(all_[1].of_lines()["row"], return_counts=True)
    assert (rows == numpy.arange(contacts.count)).all() and ((counts > 1) == across).all()
# without a box of the particles that of the lines tells the period
box = {"BoxOrigin": [0.0] * 3, "BoxVectors": [5.0, 0, 0, 0, 5, 0, 0, 0, 5], "Boundary": ["pp pp pp"]}
for field, length in ((None, 4), (box, -1)):
    made = made_of(lines=pairs([[0, 0, 0], [4, 0, 0]], id1=[1], id2=[3], force=[[1.0, 0, 0]], field=field))
    works(made)
    assert array(made, "contact_stress")[:, 0].sum() == length

# ---- nothing -------------------------------------------------------------------------------------------------------------

for particles in (vtkPolyData(), vtkUnstructuredGrid(), data_of([], {})):
    made = made_of(particles=particles, lines=pairs(), on=NAMES)
    made.Update()
    assert len(made.said) == 1 and MISSING.format(2, 2) in made.said[0] and made.GetErrorCode() == 0, made.said
    made = made_of(particles=particles, lines=vtkPolyData(), walls=vtkTable(), on=NAMES)
    made.Update()
    assert made.said == [] and made.GetOutput().GetFieldData().GetArray("mean_coordination").GetValue(0) == 0
for lines in (vtkPolyData(), vtkTable()):
    made = made_of(lines=lines, walls=vtkTable(), on=NAMES, RattlerContacts=1, MinimumOverlap=1)
    works(made)
    assert not array(made, "coordination").any() and (array(made, "rattler") == 1).all() and not array(made, "contact_stress").any()
print("all said")
