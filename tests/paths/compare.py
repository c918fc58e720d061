# SPDX-License-Identifier: BSD-3-Clause
"""Two frames of real runs compared: displacements and fragments as LAMMPS itself says, bonds and particles that came and went
as a plain reading of the files says."""
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import plain_dump
import plain_local

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
DUMP = os.path.join(data, "paths", "breaking.dump")
BONDS = os.path.join(data, "paths", "breaking_bonds.dump")
frames = plain_dump.read(DUMP)
steps = [frame.timestep for frame in frames]
assert steps == [0, 400, 800, 1200]


def arrays_of(output, points=True):
    """{name: values} of an output that is up to date."""
    attributes = output.GetPointData() if points else output.GetCellData()
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)) for i in range(attributes.GetNumberOfArrays())}


def output_of(proxy, port=0):
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def unwrapped_rows(frame):
    """Positions by x + n L."""
    return frame.stack("xyz") + frame.stack(["ix", "iy", "iz"]) @ frame.box()[1]


def unwrapped(frame, ids):
    """The same in the order of the ids."""
    places = unwrapped_rows(frame)
    order = numpy.argsort(frame.numbers("id"))
    assert (frame.numbers("id")[order] == ids).all()
    return places[order]


def pairs(frame):
    """The bonds of a frame as sorted pairs."""
    columns = frame.stack(range(3)).astype(int)
    return [tuple(sorted(row[1:])) for row in columns.tolist()]


# what LAMMPS says of itself
all_particles = GranularDumpReader(FileNames=[DUMP])
local = GranularLocalReader(FileNames=[BONDS], Preset="BondTypeIds")
bonds = GranularLocalJoin(Input=all_particles, Lines=OutputPort(local, 1))
compared = GranularCompare(Input=all_particles, Lines=bonds, Differences="*")
rows = {frame.timestep: frame for frame in plain_local.read(BONDS)}
moved = 0
for step, frame in zip(steps, frames):
    compared.UpdatePipeline(step)
    output = output_of(compared)
    found = arrays_of(output)
    ids = found["id"]
    assert (ids == frame.numbers("id")).all() and not found["change"].any()
    assert output.GetNumberOfCells() == output.GetNumberOfVerts() == len(ids) == 100
    said = frame.stack([f"c_displacement[{k}]" for k in (1, 2, 3)])
    # the box is that of LAMMPS' 17 digits, so all that differs is rounding of numbers below 64
    assert abs(found["displacement"] - said).max() < 2e-14, abs(found["displacement"] - said).max()
    assert numpy.allclose(found["displacement"], unwrapped(frame, ids) - unwrapped(frames[0], ids), rtol=0, atol=3e-14)
    moved = max(moved, abs(said).max())
    assert (found["fragment"] == frame.numbers("c_fragment")).all()
    label, counts = numpy.unique(frame.numbers("c_fragment"), return_counts=True)
    sizes = dict(zip(label, counts))
    assert (found["fragment_size"] == [sizes[one] for one in frame.numbers("c_fragment")]).all()
    assert (found["fragment_mass"] == found["fragment_size"]).all()  # all masses are 1
    assert (found["mass_difference"] == 0).all()
    assert (found["image_difference"] == frame.stack(["ix", "iy", "iz"]) - frames[0].stack(["ix", "iy", "iz"])).all()

    now, before = pairs(rows[step]), pairs(rows[0])
    lines = output_of(compared, 1)
    cells = arrays_of(lines, points=False)
    ends = [tuple(sorted(pair)) for pair in zip(cells["id1"].tolist(), cells["id2"].tolist())]
    change = cells["change"]
    assert ends[:len(now)] == now and (change[:len(now)] == [0 if pair in before else 1 for pair in now]).all()
    assert ends[len(now):] == [pair for pair in before if pair not in now] and (change[len(now):] == 2).all()
    assert lines.GetNumberOfLines() == len(ends)
    lost = (change == 2).sum()
    # lost bonds are where they were: from end to end in the first frame
    points = vtk_to_numpy(lines.GetPoints().GetData()).reshape(-1, 2, 3)
    places = dict(zip(frames[0].numbers("id").astype(int), frames[0].stack("xyz")))
    for pair, (first, second) in list(zip(zip(cells["id1"], cells["id2"]), points))[len(now):]:
        assert (first == places[pair[0]]).all()
        assert abs((second - places[pair[1]]) - 30 * numpy.round((second - places[pair[1]]) / 30)).max() < 1e-14
assert moved > 14 and lost == 33 and (change == 1).sum() == 7, (moved, lost)

# the shown frame is still that of the readers
for reader, points in ((all_particles, True), (local, False)):
    assert output_of(reader).GetFieldData().GetArray("timestep").GetValue(0) == 1200

# other references
for reference, properties in (([0, 0, 400, 800], {"Reference": "Previous"}),
                              ([400] * 4, {"Reference": "Time", "ReferenceTime": 799}),
                              ([0] * 4, {"Reference": "Time", "ReferenceTime": -5}),
                              ([1200] * 4, {"Reference": "Time", "ReferenceTime": 1e9})):
    other = GranularCompare(Input=all_particles, Lines=bonds, **properties)
    for step in (1200, 400, 0, 800, 1200):
        other.UpdatePipeline(step)
        ids = arrays_of(output_of(other))["id"]
        frame, before = frames[steps.index(step)], frames[steps.index(reference[steps.index(step)])]
        found = arrays_of(output_of(other))["displacement"]
        assert numpy.allclose(found, unwrapped(frame, ids) - unwrapped(before, ids), rtol=0, atol=3e-14)
        cells = arrays_of(output_of(other, 1), points=False)
        change = cells["change"]
        ages = numpy.choose(change, [step - before.timestep, 0, numpy.nan])  # kept, new, lost
        assert numpy.array_equal(cells["age"], ages, equal_nan=True), (step, reference)
        now, then = pairs(rows[step]), pairs(rows[before.timestep])
        expected = [int(pair not in then) for pair in now] + [2 for pair in then if pair not in now]
        assert change.tolist() == expected, (step, reference)
    Delete(other)

# unwrapped points move as far as wrapped ones with images; without images the nearest image is taken
unwrapping = GranularDumpReader(FileNames=[DUMP], Coordinates="Unwrapped")
compared = GranularCompare(Input=unwrapping)
compared.UpdatePipeline(1200)
found = arrays_of(output_of(compared))
assert abs(found["displacement"] - said).max() < 2e-14 and "fragment" not in found
assert output_of(compared, 1).GetNumberOfCells() == 0
all_particles.PointArrayStatus = [name for name in all_particles.PointArrayStatus if name != "image"]
nearest = GranularCompare(Input=all_particles, Reference="Time", ReferenceTime=400)
nearest.UpdatePipeline(800)
found = arrays_of(output_of(nearest))["displacement"]
edges = numpy.diff(numpy.array(frames[2].bounds)).T[0]
vectors = frames[2].stack("xyz") - frames[1].stack("xyz")
assert numpy.allclose(found, vectors - edges * numpy.round(vectors / edges), rtol=0, atol=2e-14)
assert (abs(found) > edges / 4).any(axis=1).sum() == 12  # which is told

# particles that come: none in the first frame of this run of LIGGGHTS, more and more afterwards; the next one is the reference
file = os.path.join(data, "grains.dump")
settling = plain_dump.read(file)
all_particles = GranularDumpReader(FileNames=[file])
compared = GranularCompare(Input=all_particles, Differences="v")
for frame in settling:
    compared.UpdatePipeline(frame.timestep)
    found = arrays_of(output_of(compared))
    ids, old = frame.numbers("id"), settling[1].numbers("id").tolist()
    kept = numpy.isin(ids, old)
    assert (found["change"][:len(ids)] == ~kept).all() and (found["id"][:len(ids)] == ids).all()
    lost = len(set(old) - set(ids)) if frame.timestep > 0 else 0
    assert len(found["change"]) == len(ids) + lost and (found["change"][len(ids):] == 2).all()
    if frame.timestep > 0:
        assert kept.sum() > 1000
        before = [old.index(i) for i in ids[kept]]
        moved = unwrapped_rows(frame)[kept] - unwrapped_rows(settling[1])[before]
        assert numpy.allclose(found["displacement"][:len(ids)][kept], moved, rtol=0, atol=1e-15)
        assert numpy.isnan(found["displacement"][:len(ids)][~kept]).all()
compared.Reference = "Previous"
compared.UpdatePipeline(2000)
found = arrays_of(output_of(compared))
ids = settling[2].numbers("id")
old = {i: row for row, i in enumerate(settling[1].numbers("id"))}
change = [0 if i in old else 1 for i in ids]
assert (found["change"][:len(ids)] == change).all()
speeds = [frame.stack(["vx", "vy", "vz"]) for frame in settling]
expected = numpy.array([speeds[2][row] - speeds[1][old[i]] for row, i in enumerate(ids) if i in old])
assert (found["v_difference"][:len(ids)][found["change"][:len(ids)] == 0] == expected).all()

# the other way round all of them are lost
compared.Reference = "Time"
compared.ReferenceTime = 2000
compared.UpdatePipeline(0)
found = arrays_of(output_of(compared))
assert (found["change"] == 2).all() and (found["id"] == ids).all() and numpy.isnan(found["displacement"]).all()
assert (vtk_to_numpy(output_of(compared).GetPoints().GetData()) == settling[2].stack("xyz")).all()
assert (found["v"] == speeds[2]).all()

# contacts alone
contacts = os.path.join(data, "local", "contacts.dump")
rows = plain_local.read(contacts)
compared = GranularCompare(Input=GranularLocalReader(FileNames=[contacts], Preset="ContactsForce"), Reference="Previous")
some = 0
for before, frame in zip(rows, rows[1:]):
    compared.UpdatePipeline(frame.timestep)
    output = output_of(compared)
    cells = arrays_of(output, points=False)
    now, then = ([tuple(sorted(row)) for row in one.stack((6, 7)).astype(int).tolist()] for one in (frame, before))
    assert cells["change"].tolist() == [int(pair not in then) for pair in now] + [2 for pair in then if pair not in now]
    assert output_of(compared, 1).GetNumberOfCells() == 0
    some += (cells["change"] == 0).sum()
    lost = cells["change"] == 2
    forces = before.stack((9, 10, 11))[[pair not in now for pair in then]]
    assert (cells["force"][lost] == forces).all()
assert some > 10, some
print("as they say")
