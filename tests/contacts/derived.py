# SPDX-License-Identifier: BSD-3-Clause
"""Fabric, principal stresses, rattlers and mobilised friction of real beds, held against numpy, and against the friction law
that the beds were made with."""
import numpy
from contact_sums import Sums
from vtkmodules.util.numpy_support import vtk_to_numpy

import plain_contacts as plain

BEDS = [(name, step) for name in ("bed", "periodic_bed", "moving") for step in plain.steps(name)]
TILTED = [(name, step) for name in ("tilted", "tilted_granular") for step in plain.steps(name)]


def matrices(six):
    """Symmetric matrices of xx yy zz xy xz yz."""
    whole = numpy.empty((len(six), 3, 3))
    for n, (i, j) in enumerate(plain.SIX):
        whole[:, i, j] = whole[:, j, i] = six[:, n]
    return whole


def length(vectors):
    return numpy.sqrt((vectors ** 2).sum(axis=1))


def check_stresses(found, particles):
    """Principal values and equivalent stresses: those of the stress over the volume of the sphere."""
    stress = matrices(found["contact_stress"] / (4 / 3 * numpy.pi * particles.radius ** 3)[:, None])
    values = numpy.linalg.eigvalsh(stress)[:, ::-1]
    scale = abs(values).max(axis=1)
    assert (abs(found["principal_stress"] - values) <= 2e-14 * scale[:, None]).all()
    deviator = stress - numpy.einsum("nii->n", stress)[:, None, None] / 3 * numpy.eye(3)
    expected = numpy.sqrt(1.5 * (deviator ** 2).sum(axis=(1, 2)))
    assert (abs(found["von_mises"] - expected) <= 2e-14 * scale).all()
    assert scale.max() > 100 and ((scale == 0) == (abs(found["contact_stress"]).max(axis=1) == 0)).all()


def check_fabric(found, particles, parts):
    """The mean of n_a n_b: parts are contacts and the vectors along them."""
    sums, counts = numpy.zeros((len(particles.ids), 6)), numpy.zeros((len(particles.ids), 1))
    for contacts, branch in parts:
        normal = branch / length(branch)[:, None]
        of_each = numpy.hstack([plain.products(normal, normal), numpy.ones((contacts.count, 1))])
        added = plain.add_up(particles, contacts, of_each, of_each)
        sums, counts = sums + added[:, :6], counts + added[:, 6:]
    assert (found["coordination"] == counts[:, 0]).all()
    assert abs(found["fabric"] - sums / numpy.maximum(counts, 1)).max() < 1e-14
    trace = found["fabric"][:, :3].sum(axis=1)
    assert abs(trace - (counts[:, 0] > 0)).max() < 1e-15 * 4


def bearing(particles, parts, least):
    """Coordination of what is left when those with fewer contacts are taken away, again and again; 0 for rattlers."""
    stays = numpy.ones(len(particles.ids), dtype=bool)
    while True:
        counts = numpy.zeros((len(particles.ids), 1), dtype=int)
        for contacts, _ in parts:
            ends = [particles.rows(ids) for ids in contacts.ids if ids is not None]
            both = numpy.logical_and.reduce([stays[end] for end in ends])[:, None].astype(int)
            counts += plain.add_up(particles, contacts, both, both).astype(int)
        if (stays == (stays & (counts[:, 0] >= least))).all():
            return ~stays, counts[:, 0]
        stays &= counts[:, 0] >= least


some = 0
for name, step in BEDS + TILTED:
    rows = (name, step) in TILTED
    particles, contacts = plain.Particles(name, step), plain.Contacts(name + "_contacts", step)
    parts = [(contacts, plain.branches(particles, contacts)[0])]
    sums = Sums(name, walls=not rows, rows=rows)
    found = sums.update(step)
    check_stresses(found, particles)
    if not rows:
        walls = plain.Contacts(name + "_walls", step)
        parts.append((walls, walls.ends[:, 1] - walls.ends[:, 0]))
    check_fabric(found, particles, parts)
    for least in (1, 2, 3, 4, 6, 100):
        sums.filter.SetRattlerContacts(least)
        found = sums.update(step)
        rattler, coordination = bearing(particles, parts, least)
        assert (found["rattler"] == rattler).all() and found["rattler"].dtype == numpy.uint8
        assert (found["coordination_without_rattlers"] == coordination).all()
        left = len(particles.ids) - rattler.sum()
        mean = coordination.sum() / left if left else 0
        assert abs(sums.field("mean_coordination_without_rattlers") - mean) < 1e-14
        some += 0 < left < len(particles.ids)
assert some > 15

# ---- thresholds --------------------------------------------------------------------------------------------------------

particles, contacts, walls = (kind("bed" + what, 70000) for kind, what in (
    (plain.Particles, ""), (plain.Contacts, "_contacts"), (plain.Contacts, "_walls")))
for part in (0.2, 0.5, 0.9):
    for name, values in (("MinimumForce", [length(each.force) for each in (contacts, walls)]),
                         ("MinimumOverlap", [each.named["delta"][:, 0] for each in (contacts, walls)])):
        least = numpy.quantile(values[0], part)
        sums = Sums("bed", **{name: least})
        found = sums.update()
        ones = [(each >= least).astype(int)[:, None] for each in values]
        expected = sum(plain.add_up(particles, each, one, one) for each, one in zip((contacts, walls), ones))[:, 0]
        assert (found["coordination"] == expected).all() and 0 < expected.sum() < 2 * contacts.count
        assert sums.field("mean_coordination") == expected.sum() / 250
        # forces and stresses contain all
        assert (found["contact_stress"] == Sums("bed").update()["contact_stress"]).all()
# the overlap of lines and radii is the program's delta but for digits
contacts = plain.Contacts("moving_contacts", 3000)
least = numpy.median(contacts.named["delta"])
between = (least + contacts.named["delta"][contacts.named["delta"] > least].min()) / 2
with_delta = Sums("moving", walls=False, MinimumOverlap=between).update(3000)
columns = [f"n{i}" for i in range(1, 20)]
for i, word in enumerate("x1 y1 z1 x2 y2 z2".split() + [""] * 6 + "id1 id2 periodic forcex forcey forcez".split()):
    columns[i] = word or columns[i]
without = Sums("moving", walls=False, MinimumOverlap=between)
without.contacts.SetColumnMap(" ".join(columns))
assert (without.update(3000)["coordination"] == with_delta["coordination"]).all() and with_delta["coordination"].any()

# ---- friction ----------------------------------------------------------------------------------------------------------

particles, contacts = plain.Particles("bed", 70000), plain.Contacts("bed_contacts", 70000)
sums = Sums("bed")
sums.update()
cells = sums.of_lines()
assert (cells["id1"] == contacts.ids[0]).all() and (cells["id2"] == contacts.ids[1]).all()
expected = length(contacts.named["force_tangential"]) / length(contacts.named["force_normal"])
# force - force_tangential has the digits of the file
assert numpy.allclose(cells["mobilised_friction"], expected, rtol=1e-9, atol=1e-12)
# no contact has more than coefficientFriction of its two types: 0.5, of type 2 with itself 0.3
kinds = particles.frame.numbers("type")
pair = [kinds[particles.rows(ids)] for ids in contacts.ids]
most = numpy.where((pair[0] == 2) & (pair[1] == 2), 0.3, 0.5)
assert (cells["mobilised_friction"] <= most * (1 + 1e-9)).all() and (cells["mobilised_friction"] > 0.8 * most).any()
sums.filter.SetFrictionCoefficient(0.5)
sums.update()
assert (sums.of_lines()["mobilised_friction"] == cells["mobilised_friction"] / 0.5).all()
# without the parts, by the lines' directions
for name, step in BEDS[1:]:
    particles, contacts = plain.Particles(name, step), plain.Contacts(name + "_contacts", step)
    sums = Sums(name)
    sums.update(step)
    branch = plain.branches(particles, contacts)[0]
    normal = branch / length(branch)[:, None]
    along = (contacts.force * normal).sum(axis=1)
    across = length(contacts.force - along[:, None] * normal)
    found = sums.of_lines()["mobilised_friction"]
    assert numpy.allclose(found, across / abs(along), rtol=1e-9, atol=1e-9)
    pair = [particles.frame.numbers("type")[particles.rows(ids)] for ids in contacts.ids]
    within = found <= numpy.where((pair[0] == 2) & (pair[1] == 2), 0.3, 0.5) * (1 + 1e-9)
    assert within.all() == (name == "periodic_bed")  # while particles move, this program adds damping that the law does not limit
    # the lines are those of the reader
    lines = sums.filter.GetLinesOutput()
    assert lines.GetNumberOfCells() == lines.GetNumberOfLines() == contacts.count
    ends = vtk_to_numpy(lines.GetPoints().GetData()).reshape(-1, 2, 3)
    drawn = plain.nearest(contacts.ends[:, 1] - contacts.ends[:, 0], particles.vectors, contacts.periodic)[0]
    assert (ends[:, 0] == contacts.ends[:, 0]).all() and abs(ends[:, 1] - ends[:, 0] - drawn).max() < 1e-17 * 4
print("as numpy has them")
