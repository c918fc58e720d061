# SPDX-License-Identifier: BSD-3-Clause
"""Contacts in cells: real beds of LIGGGHTS and a sheared box of LAMMPS against numpy, against the sums of all contacts, and
against the weight above."""
import numpy
from contact_averages import (ALL_SPACE, CENTRE, GAUSSIAN, IMAGE, INSIDE, LUCY, OVERLAP, POINTS, PROFILE, ROWS, Averages, Run,
                              parts_by_length)
from contact_sums import Sums

import plain_contacts as plain

STEPS = {"bed": 70000, "periodic_bed": 70000, "moving": 3020, "tilted": 140000}
COUNTS = (5, 4, 7)
SIZE = 5 * 4 * 7


def error(found, expected):
    """Of the largest."""
    assert found.shape == expected.shape, (found.shape, expected.shape)
    return abs(found - expected).max() / abs(expected).max()


def stress_of(found, part="contact"):
    """xx yy zz xy xz yz of each cell."""
    end = "_" + part if part else ""
    return numpy.hstack([found["sigma" + end], found["tau" + end]])


runs = {name: Run(name, step) for name, step in STEPS.items()}
boxes = {name: (run.particles.origin, run.particles.origin + run.size) for name, run in runs.items()}
# the cells of a tilted box: as many and as large as those of a straight one of its lengths, which has the same volume
bounds = {name: {"Bounds": numpy.stack(boxes[name], axis=1).ravel().tolist()} if name in ROWS else {} for name in runs}
volumes = {name: run.size.prod() / SIZE for name, run in runs.items()}

# ---- each cell, by numpy --------------------------------------------------------------------------------------------

for name, run in runs.items():
    parts = parts_by_length(run, *boxes[name], COUNTS)
    assert abs(parts.sum(axis=1) - 1).max() < 1e-12
    averages = Averages(name, CellCounts=COUNTS, **bounds[name])
    for weights in (CENTRE, OVERLAP):
        found = averages.update(STEPS[name], Weights=weights)
        assert error(stress_of(found), parts.T @ run.virial / volumes[name]) < 1e-12
        fabric = parts.T @ plain.products(run.normals, run.normals)
        contacts = parts.sum(axis=0)[:, None]
        fabric = numpy.divide(fabric, contacts, out=numpy.zeros_like(fabric), where=contacts > 0)
        assert error(found["fabric"], fabric) < 1e-10
        if weights == CENTRE:  # then there are as many particles as centres
            inside = numpy.floor((run.wrapped() - boxes[name][0]) / run.size * COUNTS).astype(int) % COUNTS
            cells = (inside[:, 2] * COUNTS[1] + inside[:, 1]) * COUNTS[0] + inside[:, 0]
            number = numpy.bincount(cells, minlength=SIZE)
            ends = parts.T @ run.counted
            expected = numpy.divide(ends, number, out=numpy.zeros(SIZE), where=number > 0)
            assert error(found["coordination"][:, 0], expected) < 1e-12
            mass = numpy.bincount(cells, run.particles.mass, minlength=SIZE)
            assert error(found["density"][:, 0] * volumes[name], mass) < 1e-14

# ---- all cells together have what all particles and contacts have, for any weights -----------------------------------

for name, run in runs.items():
    step = STEPS[name]
    sums = Sums(name, walls=name not in ROWS, rows=name in ROWS).update(step)["contact_stress"].sum(axis=0)
    assert error(sums, run.virial.sum(axis=0)) < 1e-12
    averages = Averages(name, CellCounts=COUNTS, KernelBounds=INSIDE, **bounds[name])
    without = Averages(name, lines=False, walls=False, CellCounts=COUNTS, KernelBounds=INSIDE, **bounds[name])
    scale = abs(run.virial).sum(axis=0)
    momentum = run.particles.mass[:, None] * run.v
    # a kernel needs cells that periodic images share: tilts of whole cells
    for weights in (CENTRE, OVERLAP) if name in ROWS else range(5):
        found = averages.update(step, Weights=weights)
        total = stress_of(found).sum(axis=0) * volumes[name]
        assert (abs(total - sums) < 1e-13 * scale).all(), (name, weights, total, sums)
        assert abs(found["density"].sum() * volumes[name] / run.particles.mass.sum() - 1) < 1e-13
        assert (abs(found["momentum"].sum(axis=0) * volumes[name] - momentum.sum(axis=0))
                < 1e-13 * abs(momentum).sum(axis=0)).all()
        assert abs(found["volumefraction"].sum() * volumes[name] / (4 / 3 * numpy.pi * (run.particles.radius**3).sum()) - 1) < 1e-12
        # the parts, and what the definitions say
        kinetic = stress_of(found, "kinetic")
        assert error(kinetic + stress_of(found), stress_of(found, "")) < 1e-15
        assert error(-stress_of(found, "")[:, :3].sum(axis=1) / 3, found["pressure"][:, 0]) < 1e-15
        full = found["density"][:, 0] > 0
        assert error(found["v_avg"][full], found["momentum"][full] / found["density"][full]) < 1e-14
        temperature = -kinetic[:, :3].sum(axis=1)[full] / 3 / found["density"][full, 0]
        assert name != "moving" or error(found["granular_temperature"][full, 0], temperature) < 1e-12
        assert abs(found["fabric"][:, :3].sum(axis=1)[found["coordination"][:, 0] > 0] - 1).max() < 1e-13
        # contacts change nothing but the stress
        alone = without.update(step, Weights=weights)
        for array in ("v_avg", "volumefraction", "radius", "density", "momentum", "granular_temperature"):
            assert alone[array].tobytes() == found[array].tobytes(), array
        assert list(alone) == [array for array in found if array in alone] and "sigma" not in alone
        assert error(alone["pressure"][:, 0], -kinetic[:, :3].sum(axis=1) / 3) < 1e-14
        # in all of space less is in the cells where there are walls
        found = averages.update(step, Weights=weights, KernelBounds=ALL_SPACE)
        inside = found["density"].sum() * volumes[name] / run.particles.mass.sum()
        lost = 1 - inside  # the kernel of Heaviside is short
        if run.periodic.all():
            assert abs(lost) < 1e-13, lost
        else:
            assert 1e-3 < lost < 0.5 if weights in (GAUSSIAN, LUCY) else -1e-13 < lost < (0.5 if weights > LUCY else 1e-13), lost
        averages.update(step, KernelBounds=INSIDE)

# ---- the stress of the program's own particles, without walls, is the same in the sum ---------------------------------

for name, run in runs.items():
    pairs = Averages(name, walls=False, CellCounts=COUNTS, **bounds[name])
    array = Averages(name, lines=False, walls=False, CellCounts=COUNTS, StressArray="c_s", **bounds[name])
    for weights in (CENTRE, OVERLAP):
        by_lines, by_array = (each.update(STEPS[name], Weights=weights) for each in (pairs, array))
        a, b = stress_of(by_lines, ""), stress_of(by_array, "")
        assert 1e-3 < error(a, b) < 1  # a particle's stress is at its place, that of a line is along it
        assert error(a.sum(axis=0), b.sum(axis=0)) < 1e-12
        assert "sigma_contact" not in by_array

# ---- the weight above -----------------------------------------------------------------------------------------------

# Through each plane acts what particles with their centre above need: their weight, but for the little that they are
# accelerated. A layer has the mean of its planes.
name, run = "periodic_bed", runs["periodic_bed"]
area = run.size[0] * run.size[1]
carried = run.particles.f[:, 2] - run.particles.mass * plain.GRAVITY[2]
assert abs(run.particles.f[:, 2]).max() < 1e-6 * run.particles.mass.max() * 9.81  # at rest
LAYERS, TOP = 31, 0.031
profile = Averages(name, OutputType=PROFILE, CellCounts=(9, 9, LAYERS), Bounds=(1, -1, 1, -1, 0, TOP), Weights=OVERLAP)
output = profile.output()
assert profile.said == [] and output.IsA("vtkTable") and output.GetNumberOfRows() == LAYERS
found = profile.update()
positions = found["position"][:, 0]
assert abs(positions - (numpy.arange(LAYERS) + 0.5) * TOP / LAYERS).max() < 1e-17
above = numpy.clip((run.particles.x[:, 2] - positions[:, None]) / (TOP / LAYERS) + 0.5, 0, 1) @ carried
assert abs(found["sigma_contact"][:, 2] * area + above).max() < 1e-12 * above.max()
floor = plain.Contacts("periodic_bed_walls", 70000).force[:, 2].sum()
assert abs(-found["sigma_contact"][0, 2] * area / floor - 1) < 1e-13  # nobody's centre is in the lowest layer
assert abs(floor / (9.81 * run.particles.mass.sum()) - 1) < 1e-9
# smoothed, but the same weight
for weights in (GAUSSIAN, LUCY):
    smooth = profile.update(Weights=weights, KernelWidth=0.001)
    middle = (positions > 0.004) & (positions < 0.02)
    assert 1e-6 < abs(smooth["sigma_contact"][middle, 2] * area / -above[middle] - 1).max() < 0.05

# ---- profiles are images, summed over layers ---------------------------------------------------------------------------

for axis in range(3):
    image = Averages(name, CellCounts=COUNTS, Weights=OVERLAP).update()
    layers = Averages(name, CellCounts=COUNTS, Weights=OVERLAP, OutputType=PROFILE, ProfileAxis=axis).update()
    assert list(layers) == ["position"] + list(image)
    for array in ("density", "momentum", "volumefraction", "sigma_contact", "tau_contact"):
        cells = image[array].reshape(*COUNTS[::-1], -1)
        expected = cells.mean(axis=tuple(other for other in range(3) if other != 2 - axis))
        assert error(layers[array], expected) < 1e-13, (axis, array)
    spacing = run.size[axis] / COUNTS[axis]
    assert abs(layers["position"][:, 0] - boxes[name][0][axis] - (numpy.arange(COUNTS[axis]) + 0.5) * spacing).max() < 1e-15

# ---- points are the same cells, and threads do not matter --------------------------------------------------------------

for weights in range(5):
    averages = Averages(name, CellCounts=COUNTS, Weights=weights, Threads=1)
    expected = averages.update()
    output = averages.output(OutputType=POINTS)
    assert output.IsA("vtkPolyData") and output.GetNumberOfVerts() == SIZE
    for found in (averages.update(), averages.update(OutputType=IMAGE, Threads=3)):
        assert list(found) == list(expected)
        assert all(found[array].tobytes() == expected[array].tobytes() for array in expected)
print("as heavy as the bed")
