# SPDX-License-Identifier: BSD-3-Clause
"""The theorem of the virial on real beds: the stresses of all grains together are the moments of the forces from outside."""
import numpy
from contact_sums import Sums

import plain_contacts as plain

crossing = 0
for name, rows in (("bed", False), ("periodic_bed", False), ("moving", False), ("tilted", True), ("tilted_granular", True)):
    for step in plain.steps(name):
        particles, contacts = plain.Particles(name, step), plain.Contacts(name + "_contacts", step)
        # what contacts push a particle with is, as the simulation has it, all of its force but the weight
        weight = numpy.outer(particles.mass, plain.GRAVITY) if not rows else 0
        expected = -plain.products(particles.x, particles.f - weight).sum(axis=0)
        if not rows:
            walls = plain.Contacts(name + "_walls", step)
            expected = expected + plain.products(walls.ends[:, 0], walls.force).sum(axis=0)
        # a contact across a face pushes at both sides of the box
        across = plain.branches(particles, contacts)[1]
        crossing += (across != 0).any(axis=1).sum()
        expected = expected + plain.products(across, contacts.force).sum(axis=0)
        for arm in (0, 1):
            found = Sums(name, walls=not rows, rows=rows, LeverArm=arm).update(step)["contact_stress"].sum(axis=0)
            error = abs(found - expected).max() / abs(expected).max()
            assert error < 2e-13, (name, step, arm, error)
assert crossing > 300

# at rest the pressure of the log, in which nothing moves, is that of the contacts between particles
for name in ("bed", "periodic_bed"):
    last = plain.last_row(name)
    assert last["Step"] == 70000
    pressure = numpy.array([last[f"p[{i}]"] for i in range(1, 7)])
    found = Sums(name, walls=False).update()["contact_stress"].sum(axis=0)
    assert abs(-found / last["Volume"] - pressure).max() < 1e-11 * abs(pressure).max()
print("balanced")
