# SPDX-License-Identifier: BSD-3-Clause
"""Beds of LIGGGHTS: stresses, coordination, forces and torques of contacts as the program itself has them."""
import numpy
from contact_sums import Sums

import plain_contacts as plain

BEDS = [(name, step) for name in ("bed", "periodic_bed", "moving") for step in plain.steps(name)]
assert BEDS == [("bed", 70000), ("periodic_bed", 70000), ("moving", 3000), ("moving", 3020)]


def error(found, expected):
    """Of the largest."""
    assert found.shape == expected.shape
    return abs(found - expected).max() / abs(expected).max()


half, pairs, all_, walls = ({name: Sums(name, **how) for name in ("bed", "periodic_bed", "moving")} for how in (
    {"walls": False, "LeverArm": 1}, {"walls": False}, {}, {"lines": False}))
for name, step in BEDS:
    particles = plain.Particles(name, step)
    count = len(particles.ids)

    # compute stress/atom, its part of pairs, takes half the branch; compute contact/atom counts no walls
    found = half[name].update(step)
    assert (found["id"] == particles.ids).all()
    assert error(found["contact_stress"], particles.stress) < 1e-13
    assert (found["coordination"] == particles.coordination).all() and found["coordination"].dtype == numpy.int32
    assert half[name].field("mean_coordination") == particles.coordination.sum() / count
    # the contact point is elsewhere, but for spheres of one size
    of_points = pairs[name].update(step)
    assert 1e-3 < error(of_points["contact_stress"], particles.stress) < 0.2
    assert (of_points["coordination"] == particles.coordination).all()
    assert error(of_points["contact_stress"].sum(axis=0), particles.stress.sum(axis=0)) < 1e-13

    # all forces of a particle are those of its contacts, and its weight
    found = all_[name].update(step)
    with_weight = found["contact_force"] + numpy.outer(particles.mass, plain.GRAVITY)
    assert abs(with_weight - particles.f).max() < 5e-15, abs(with_weight - particles.f).max()
    assert abs(found["contact_force"]).max() > 1e-3
    rows = plain.Contacts(name + "_walls", step)
    touched = numpy.bincount(particles.rows(rows.ids[1]), minlength=count)
    assert touched.sum() == rows.count > 0
    assert (found["coordination"] == particles.coordination + touched).all()

    # walls alone: the forces that fix wall/gran stores
    found = walls[name].update(step)
    assert (found["coordination"] == touched).all()
    if name != "moving":
        stored = particles.frame.stack([f"f_force_walls[{i}]" for i in (1, 2, 3)])
        assert abs(found["contact_force"] - stored).max() < 1e-17 and abs(stored).max() > 1e-3

# at rest no torque is left, if the program tells that of each contact
found = all_["bed"].update()
largest = abs(plain.Contacts("bed_contacts", 70000).named["torque"]).max()
assert abs(found["contact_torque"]).max() < 5e-11 < 1e-5 * largest
some = pairs["bed"].update()
assert abs(some["contact_torque"]).max() > 1e-8  # the walls' part
# without these it is that of the force at the contact point, which is not quite where the program has it
particles, contacts = plain.Particles("periodic_bed", 70000), plain.Contacts("periodic_bed_contacts", 70000)
found = all_["periodic_bed"].update()
arms = plain.nearest(contacts.named["contactPoint"] - contacts.ends[:, 0], particles.vectors, contacts.periodic)[0]
assert abs(found["contact_torque"]).max() < 0.02 * abs(numpy.cross(arms, contacts.force)).max()

# each torque by numpy
for name, step in BEDS:
    particles, contacts, rows = plain.Particles(name, step), plain.Contacts(name + "_contacts", step), plain.Contacts(name + "_walls", step)
    found = all_[name].update(step)["contact_torque"]
    branch = plain.branches(particles, contacts)[0]
    if name == "bed":
        first, of_walls = contacts.named["torque"], rows.named["torque"]
        second = numpy.cross(branch, contacts.force) - first
    else:
        first_arm = branch * (particles.radius[particles.rows(contacts.ids[0])] / sum(
            particles.radius[particles.rows(ids)] for ids in contacts.ids))[:, None]
        second_arm = first_arm - branch
        if "contactPoint" in contacts.named:
            first_arm, second_arm = (plain.nearest(contacts.named["contactPoint"] - particles.x[particles.rows(ids)], particles.vectors,
                                                   contacts.periodic)[0] for ids in contacts.ids)
        first, second = numpy.cross(first_arm, contacts.force), numpy.cross(second_arm, -contacts.force)
        of_walls = numpy.cross(rows.ends[:, 0] - rows.ends[:, 1], rows.force)
    expected = plain.add_up(particles, contacts, first, second) + plain.add_up(particles, rows, None, of_walls)
    assert abs(found - expected).max() < 1e-14 * max(abs(first).max(), abs(of_walls).max()), name

# dumped within a run: some particles have left the box, and their contacts have not. The lines are in the box, and those of
# the rows are between the images that are nearest to each other
lines, rows = (Sums("moving_step", walls=False, rows=rows).update(3020) for rows in (False, True))
particles = plain.Particles("moving_step", 3020)
outside = (particles.x < particles.origin).any(axis=1) | (particles.x > particles.origin + numpy.diag(particles.vectors)).any(axis=1)
assert outside.sum() == 4
for name in ("coordination", "contact_force", "rattler", "coordination_without_rattlers"):
    assert (lines[name] == rows[name]).all(), name
for name in ("contact_stress", "contact_torque", "fabric"):
    assert error(rows[name], lines[name]) < 1e-13, name
print("as LIGGGHTS has them")
