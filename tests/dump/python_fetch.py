# SPDX-License-Identifier: BSD-3-Clause
"""vg.fetch: the numbers of the files as numpy arrays, on one rank and on several."""
import os

import numpy
import plain_dump
import vtkgranular as vg
from paraview.simple import *

good = os.path.join(os.environ["GRANULAR_DATA"], "good")
samples = os.path.join(good, "..", "..", "..", "samples", "data")

path = os.path.join(good, "grains.dump")
reader = vg.reader(path)
for frame in plain_dump.read(path):
    data = vg.fetch(reader, time=frame.timestep)
    if frame.rows == 0:
        assert data["points"].shape == (0, 3), data["points"].shape
        continue
    order = numpy.argsort(data["id"])
    expected = numpy.argsort(frame.numbers("id"))
    for axis, name in enumerate("xyz"):
        assert (data["points"][order, axis] == frame.numbers(name)[expected]).all(), name
        assert (data["v"][order, axis] == frame.numbers("v" + name)[expected]).all(), name
    assert (data["radius"][order] == frame.numbers("radius")[expected]).all()
    assert data["id"].dtype == numpy.int64 and data["type"].dtype == numpy.int32
    assert data["timestep"] == frame.timestep and int(data["timestep"]) == frame.timestep
    assert list(data["Columns"][:5]) == ["id", "type", "x", "y", "z"]
    assert data["BoxBounds"].shape == (6,) and str(data["Coordinates"]) == "Absolute"

# the arrays stay when the pipeline goes on, and are not to be written to
last = vg.fetch(reader)
copy = last["points"].copy()
vg.update(reader, reader.TimestepValues[1])
assert (last["points"] == copy).all()
try:
    last["points"][0, 0] = 1
    raise AssertionError("the memory of the pipeline could be changed")
except ValueError:
    pass

# outputs by number, name and port
for port in (1, "Box"):
    assert vg.fetch(reader, port=port)["points"].shape == (8, 3), port
assert vg.fetch(OutputPort(reader, 1))["points"].shape == (8, 3)
for port in (2, "Bonds"):
    try:
        vg.fetch(reader, port=port)
        raise AssertionError(port)
    except ValueError as error:
        assert "Particles, Box" in str(error), error

# lines and tables, words, cells
contacts = vg.reader(os.path.join(samples, "bonds", "settled_contacts.dump.gz"), Preset="ContactsForce")
lines, rows = vg.fetch(contacts), vg.fetch(contacts, port="Rows")
assert len(lines["points"]) == 2 * len(lines["id1"]) > 1000
assert (lines["id1"] == rows["id1"]).all() and lines["force"].shape == (len(lines["id1"]), 3)
plain = os.path.join(good, "plain.dump")
last = plain_dump.read(plain)[-1]
words = vg.fetch(vg.reader(plain), time=last.timestep)["element"]
assert list(words) == last.columns["element"] and len(words) > 0
average = GranularEulerAverage(Input=reader, CellCounts=[3, 4, 5])
cells = vg.fetch(average, time=2000)
assert tuple(cells["dimensions"]) == (4, 5, 6) and cells["volumefraction"].shape == (60,)
assert numpy.allclose(cells["origin"] + cells["spacing"] * (cells["dimensions"] - 1), [0.05, 0.05, 0.15])
average.Output = "Points"  # the same cells as points at their centres, in an order that ranks do not change
centres = vg.fetch(average, time=2000)
places = numpy.rint((centres["points"] - cells["origin"]) / cells["spacing"] - 0.5).astype(int)
whole = cells["volumefraction"].reshape(5, 4, 3)
assert len(places) > 20 and whole.max() > 0.1
for (x, y, z), value in zip(places, centres["volumefraction"]):
    assert whole[z, y, x] == value

# without a time: the last update's or, for what was never updated, the animation's, for all inputs alike
beads = vg.reader(os.path.join(samples, "bonds", "chain.dump"))
bonds = vg.reader(os.path.join(samples, "bonds", "chain_bonds.dump"), Preset="BondTypeIdsForce")
lines = GranularLocalJoin(Input=beads, Lines=OutputPort(bonds, 1))
times = list(beads.TimestepValues)
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = times[-1]
vg.update(bonds, times[0])
assert vg.fetch(bonds, port="Rows")["timestep"] == times[0]
assert vg.fetch(lines)["timestep"] == times[-1]
vg.update(lines, times[1])
assert vg.fetch(lines)["timestep"] == times[1]
scene.AnimationTime = times[0]
assert vg.fetch(lines)["timestep"] == times[1]
vg.save(GranularLocalJoin(Input=beads, Lines=OutputPort(bonds, 1)), "joined.bonds")
with open("joined.bonds") as file:
    assert int(file.read().split()[2]) == times[0]
print("fetched")
