# SPDX-License-Identifier: BSD-3-Clause
"""Averages with contacts: chosen arrays, widths of kernels, what is said of contacts, averages over time."""
import re

import numpy
from contact_averages import (ALL, CENTRE, GAUSSIAN, HEAVISIDE, IMAGE, INSIDE, LUCY, OVERLAP, POINTS, PROFILE, SUPPORT,
                              Averages, Run, change, kernel, tables_of)
from contact_sums import local_of
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

import plain_contacts as plain
import vtkgranular as vg

COUNTS, SIZE = (6, 6, 9), 6 * 6 * 9
DEFAULT = ["v_avg", "volumefraction", "radius", "pressure", "sigma", "tau"]


def fails(averages, pattern, **properties):
    output = averages.output(**properties)
    assert averages.filter.GetErrorMessage() and re.search(pattern, averages.filter.GetErrorMessage())
    assert len(averages.said) == 1 and re.search(pattern, averages.said[0]), averages.said
    assert output.GetNumberOfElements(0) + output.GetNumberOfElements(1) == 0, pattern


def warns(averages, patterns, **properties):
    found = tables_of(averages.output(**properties))
    assert len(averages.said) == len(patterns), averages.said
    for text, pattern in zip(averages.said, patterns):
        assert re.search(pattern, text), (pattern, text)
    return found


# ---- arrays that are off are absent, and the others are as with all of them -------------------------------------------

bed = Averages("periodic_bed", CellCounts=COUNTS)
everything = bed.update()
assert list(everything) == ALL
selection = vg.vtkGranularEulerAverage().GetArraySelection()
assert [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())] == ALL
assert [name for name in ALL if selection.ArrayIsEnabled(name)] == DEFAULT
for on in ([name] for name in ALL):
    bed.choose(on)
    found = bed.update()
    assert list(found) == on and found[on[0]].tobytes() == everything[on[0]].tobytes(), on
for on in (DEFAULT, ["tau", "density"], ALL[::2], []):
    bed.choose(on)
    found = bed.update()
    assert list(found) == [name for name in ALL if name in on]
    assert all(found[name].tobytes() == everything[name].tobytes() for name in on)
assert bed.output(OutputType=POINTS).GetNumberOfVerts() == SIZE  # without any array
bed.choose(ALL)
change(bed.filter, OutputType=IMAGE)

# lines as they are written, some of them through the box: particles tell the shortest way
written = Averages("periodic_bed", CellCounts=COUNTS)
change(written.lines, PeriodicLines=2)
found = written.update()
assert all(found[name].tobytes() == everything[name].tobytes() for name in ALL)

# without contacts there is nothing of them, whatever is chosen
plainly = Averages("periodic_bed", lines=False, walls=False, CellCounts=COUNTS).update()
assert list(plainly) == [name for name in ALL[:9] if name not in ("sigma", "tau")]
# with the walls alone, or the pairs alone, there is their part
alone = [Averages("periodic_bed", lines=lines, walls=not lines, CellCounts=COUNTS).update() for lines in (True, False)]
together = alone[0]["sigma_contact"] + alone[1]["sigma_contact"]
assert abs(together - everything["sigma_contact"]).max() < 1e-15 * abs(together).max() and alone[1]["sigma_contact"].any()

# ---- kernels, by numpy --------------------------------------------------------------------------------------------------

run = Run("periodic_bed", 70000)
lo, counts = run.particles.origin, numpy.array(COUNTS)
spacing = run.size / counts


def density_by_kernel(kind, width, bounded):
    """Each particle against all cells of the lattice that it may reach."""
    mass = numpy.zeros(counts[::-1])
    for x, m in zip(run.particles.x, run.particles.mass):
        squares, numbers = [], []
        for axis in range(3):
            inside = axis == 2 and bounded
            number = numpy.arange(0 if inside else -counts[axis], (1 if inside else 2) * counts[axis])
            squares.append((lo[axis] + (number + 0.5) * spacing[axis] - x[axis])**2)
            numbers.append(number)
        weights = kernel(kind, width, squares[2][:, None, None] + squares[1][:, None] + squares[0])
        weights *= m / weights.sum()
        z = (numbers[2] >= 0) & (numbers[2] < counts[2])
        numpy.add.at(mass, numpy.ix_(numbers[2][z], numbers[1] % counts[1], numbers[0] % counts[0]), weights[z])
    return mass.reshape(-1, 1) / spacing.prod()


for kind in (GAUSSIAN, LUCY, HEAVISIDE):
    for bounds in (0, INSIDE):
        found = bed.update(Weights=kind, KernelWidth=0.008, KernelBounds=bounds)["density"]
        expected = density_by_kernel(kind, 0.008, bounds == INSIDE)
        assert abs(found - expected).max() < 1e-12 * expected.max(), (kind, bounds)
# 0, the default, is the largest diameter; with Centre and Overlap the width does not matter
assert vg.vtkGranularEulerAverage().GetKernelWidth() == 0
for kind in (GAUSSIAN, LUCY, HEAVISIDE):
    widths = [bed.update(Weights=kind, KernelWidth=width) for width in (0, 2 * run.particles.radius.max(), 0.0059)]
    assert all(widths[0][name].tobytes() == widths[1][name].tobytes() for name in ALL)
    assert widths[0]["density"].tobytes() != widths[2]["density"].tobytes()
for kind in (CENTRE, OVERLAP):
    same = [bed.update(Weights=kind, KernelWidth=width)["density"] for width in (0, 0.01, float("nan"))]
    assert same[0].tobytes() == same[1].tobytes() == same[2].tobytes()
for width in (-0.001, float("nan"), float("inf"), 1e-300):
    fails(bed, "expected a KernelWidth from 1e-60 to 1e60, got ", Weights=GAUSSIAN, KernelWidth=width)
fails(bed, "expected a kernel that is not much wider than the cells, got a width of 0.5", KernelWidth=0.5, CellCounts=(300, 300, 300))
fails(bed, "expected an array 'size' of radii, got none", KernelWidth=0, CellCounts=COUNTS, RadiusArray="size")
found = warns(bed, ["no array 'size' of radii"], KernelWidth=0.005)
assert not found["volumefraction"].any() and found["density"].any()
bed.update(RadiusArray="radius", KernelWidth=0)
# a sharp kernel at walls is in the box as well: all that is inside stays inside
assert SUPPORT[LUCY] == 2

# ---- profiles -----------------------------------------------------------------------------------------------------------

profile = Averages("periodic_bed", OutputType=PROFILE, CellCounts=(1000000, 77, 9), Weights=CENTRE)
assert len(profile.update()["position"]) == 9  # cells along the other axes do not matter
assert len(profile.update(CellsBy=1, CellSize=(1e-9, 1, 0.01))["position"]) == 9
assert len(profile.update(CellsBy=2, CellSizeRelative=3)["position"]) == 5
assert len(profile.update(CellsBy=0, ProfileAxis=1)["position"]) == 77
assert profile.filter.GetOutputDataObject(0).GetFieldData().GetArray("timestep").GetValue(0) == 70000
layers = vg.vtkGranularProfile()
layers.SetController(None)
for port in range(3):
    layers.SetInputConnection(port, profile.filter.GetInputConnection(port, 0))
layers.SetWeights(CENTRE)
for setting, value, count in (("Layers", 20000, 20000), ("Layers", 77, 77), ("Thickness", 0.01, 9), ("Thickness", 0, 77), ("Layers", 9, 9)):
    getattr(layers, f"Set{setting}")(value)
    layers.UpdateTimeStep(70000)
    assert layers.GetOutputDataObject(0).GetNumberOfRows() == count
expected, found = profile.update(ProfileAxis=2), tables_of(layers.GetOutputDataObject(0))
assert all(found[name].tobytes() == expected[name].tobytes() for name in expected if name in found) and set(found) >= {"position", *DEFAULT}
fields = profile.output(ProfileAxis=2)
assert not fields.GetFieldData().HasArray("Columns")
# from one type of output to another
for kind, name in ((IMAGE, "vtkImageData"), (PROFILE, "vtkTable"), (POINTS, "vtkPolyData"), (PROFILE, "vtkTable")):
    assert profile.output(OutputType=kind, CellCounts=COUNTS).IsA(name) and profile.said == []

# ---- what cannot be, and what is missing --------------------------------------------------------------------------------

both = Averages("periodic_bed", CellCounts=COUNTS, StressArray="c_s")
fails(both, "expected a StressArray or contacts .Lines, Walls., got both: contacts would count twice")
both.update(StressArray=None)


def changed(port, change_arrays):
    """An input as data, changed."""
    made = vtkPolyData()
    made.DeepCopy(port.GetProducer().GetOutputDataObject(port.GetIndex()))
    change_arrays(made)
    return made


def with_lines(change_arrays, change_walls=None):
    """Averages of changed contacts."""
    averages = Averages("periodic_bed", CellCounts=COUNTS)
    for port, reader, how in ((1, averages.lines, change_arrays), (2, averages.walls, change_walls)):
        reader.Update()
        if how:
            averages.filter.SetInputDataObject(port, changed(reader.GetOutputPort(), how))
    return averages


def without(name):
    return lambda data: data.GetCellData().RemoveArray(name)


found = warns(with_lines(without("force"), without("force")), ["neither an array 'force' nor 'force_normal': stress and pressure lack"])
assert not {"sigma_contact", "tau_contact", "sigma", "tau"} - {"sigma", "tau"} & set(found)
assert found["coordination"].tobytes() == everything["coordination"].tobytes()
assert found["pressure"].tobytes() == plainly["pressure"].tobytes()
fails(with_lines(without("force")), "expected forces of all contacts, with particles and with walls, got those of one kind alone")
fails(with_lines(without("id2")), "'id2'")
# nobody asks for forces
quiet = with_lines(without("force"))
quiet.choose(["coordination"])
assert quiet.update()["coordination"].tobytes() == everything["coordination"].tobytes()


def set_value(name, row, value):
    def how(data):
        array = data.GetCellData().GetArray(name)
        for k in range(array.GetNumberOfComponents()):
            array.SetComponent(row, k, value)
    return how


warns(with_lines(set_value("force", 5, float("nan"))), ["1 contacts are left out: a number of theirs is no number"])
found = warns(with_lines(set_value("id1", 5, 12345)), ["1 contacts name a particle that is not there: .* as far as it is known"])
for name in ALL:  # the line has the digits of another file than the particle
    assert abs(found[name] - everything[name]).max() < 1e-12 * abs(everything[name]).max(), name
# contacts of another timestep, and contacts that no array needs
late = with_lines(lambda data: data.GetFieldData().GetArray("timestep").SetValue(0, 7))
warns(late, ["the particles are of timestep 70000, the lines of 7"])
late.choose(["volumefraction"])
assert late.update()["volumefraction"].tobytes() == everything["volumefraction"].tobytes()
# no contacts at all
empty = with_lines(lambda data: data.Initialize(), lambda data: data.Initialize())
found = empty.update()
assert list(found) == ALL and not found["sigma_contact"].any() and not found["coordination"].any()
# nobody asks for stresses, and nothing touches yet
empty.choose(["coordination"])
assert list(empty.update()) == ["coordination"] and not empty.update()["coordination"].any()

# rows of a table, without lines: ends are at the particles, and walls cannot be without a place
tables = Averages("periodic_bed", walls=False, CellCounts=COUNTS)
lines_only = tables.update()
tables.filter.SetLinesConnection(tables.lines.GetOutputPort(1))
found = tables.update()
for name in ("sigma_contact", "tau_contact"):
    assert abs(found[name] - lines_only[name]).max() < 1e-10 * abs(found[name]).max(), name
without_one = []
for name, value, said in (("force", float("nan"), "1 contacts are left out"),
                          ("id1", 12345, "1 contacts name a particle that is not there, and have no line: they are left out")):
    rows = vtkTable()
    rows.DeepCopy(tables.lines.GetOutputDataObject(1))
    rows.GetColumnByName(name).SetTuple(5, [value] * rows.GetColumnByName(name).GetNumberOfComponents())
    tables.filter.SetInputDataObject(1, rows)
    without_one.append(warns(tables, [said]))
assert all(without_one[0][name].tobytes() == without_one[1][name].tobytes() for name in ALL)
tables.filter.SetLinesConnection(tables.lines.GetOutputPort(1))
# contacts go through periodic faces, though nothing has images
near = tables.update(Periodic=1)
assert abs(near["sigma_contact"]).max() < 3 * abs(found["sigma_contact"]).max()
inner = (numpy.arange(SIZE) // (COUNTS[0] * COUNTS[1]) > 0) & (numpy.arange(SIZE) % COUNTS[0] % (COUNTS[0] - 1) > 0) & (
    numpy.arange(SIZE) // COUNTS[0] % COUNTS[1] % (COUNTS[1] - 1) > 0)
assert abs(near["sigma_contact"] - found["sigma_contact"])[inner].max() < 1e-10 * abs(found["sigma_contact"]).max()
tables.filter.SetPeriodic(0)
tables.filter.SetLinesConnection(None)
walls = local_of("periodic_bed_walls")  # whom a port does not keep alive
tables.filter.SetWallsConnection(walls.GetOutputPort(1))
fails(tables, "expected lines or an array 'contact_point' of contacts with walls, got neither")

# ---- over time ------------------------------------------------------------------------------------------------------------

assert plain.steps("moving") == [3000, 3020]
for weights in range(5):
    moving = Averages("moving", CellCounts=COUNTS, Weights=weights, KernelBounds=INSIDE)
    frames = [moving.update(step) for step in (3000, 3020)]
    found = moving.update(TimeAverage=True)
    assert list(found) == ALL
    for name in ("sigma_contact", "tau_contact", "density", "momentum", "volumefraction"):
        mean = (frames[0][name] + frames[1][name]) / 2
        assert abs(found[name] - mean).max() < 1e-14 * abs(mean).max(), (weights, name)
    assert abs(found["sigma_kinetic"] + found["sigma_contact"] - found["sigma"]).max() < 1e-15 * abs(found["sigma"]).max()
    assert not moving.filter.GetOutputDataObject(0).GetFieldData().HasArray("timestep")
whole = Averages("moving", CellCounts=(1, 1, 1), Weights=CENTRE, TimeAverage=True).update()
runs = [Run("moving", step) for step in (3000, 3020)]
ends, all_particles = sum(run.counted.sum() for run in runs), sum(len(run.particles.ids) for run in runs)
assert abs(whole["coordination"][0, 0] - ends / all_particles) < 1e-15 * ends
normals = numpy.concatenate([plain.products(run.normals, run.normals) for run in runs]).mean(axis=0)
assert abs(whole["fabric"][0] - normals).max() < 1e-14
table = Averages("moving", CellCounts=COUNTS, OutputType=PROFILE, TimeAverage=True, Weights=GAUSSIAN).update()
assert len(table["position"]) == 9 and table["sigma_contact"].any()

print("all arrays")
