# SPDX-License-Identifier: BSD-3-Clause
"""Tilted boxes of LAMMPS, whose rows name particles by id alone: stresses, coordination and forces as the program has them,
and the pressure of its log."""
import numpy
import vtkgranular as vg
from contact_sums import Sums

import plain_contacts as plain

# step of the last line of the log, which has c_p and c_sum
LAST = {"tilted": 140000, "tilted_granular": 90000}
for name, step in LAST.items():
    all_particles, contacts = plain.Particles(name, step), plain.Contacts(name + "_contacts", step)
    largest = abs(contacts.force).max()
    last = plain.last_row(name)
    assert last["Step"] == step
    volume = last["Volume"]
    pressure, total = (numpy.array([last[f"{what}[{i}]"] for i in range(1, 7)]) for what in ("c_p", "c_sum"))
    assert abs(abs(numpy.linalg.det(all_particles.vectors)) / volume - 1) < 1e-14

    sums = Sums(name, walls=False, rows=True, LeverArm=1)
    found = sums.update()
    assert (found["id"] == all_particles.ids).all()
    assert abs(found["contact_stress"] - all_particles.stress).max() < 1e-13 * abs(all_particles.stress).max()
    assert (found["coordination"] == all_particles.coordination).all()
    assert sums.field("mean_coordination") == 2 * contacts.count / len(all_particles.ids)
    # the force is in two parts, which the filter adds; nothing else pushes
    assert abs(found["contact_force"] - all_particles.f).max() < 1e-12 * largest
    # what each pair has: branch times force
    for arm in (0, 1):
        sums.filter.SetLeverArm(arm)
        added = sums.update()["contact_stress"].sum(axis=0)
        assert abs(added - total).max() < 1e-13 * abs(total).max()
        assert abs(-added / volume - pressure).max() < 1e-13 * abs(pressure).max(), abs(-added / volume - pressure).max()
    # arms by the radii are others than half the branch: of two sizes the larger has more
    assert abs(sums.update()["contact_stress"] - all_particles.stress).max() < 1e-13 * abs(all_particles.stress).max()
    sums.filter.SetLeverArm(0)
    by_radii = sums.update()["contact_stress"]
    branch, _ = plain.branches(all_particles, contacts)
    radius = [all_particles.radius[all_particles.rows(ids)] for ids in contacts.ids]
    whole = plain.products(branch, contacts.force)
    expected = plain.add_up(all_particles, contacts, *(whole * (each / sum(radius))[:, None] for each in radius))
    assert abs(by_radii - expected).max() < 1e-13 * abs(expected).max()
    assert abs(by_radii - all_particles.stress).max() > 1e-3 * abs(expected).max()
    # the branches are as long as the program says
    assert abs(numpy.sqrt((branch ** 2).sum(axis=1)) - contacts.named["dist"][:, 0]).max() < 1e-16

    # no torques are given: those of forces at these arms
    torques = plain.add_up(all_particles, contacts, *(numpy.cross(branch, contacts.force) * (each / sum(radius))[:, None] for each in radius))
    assert abs(sums.update()["contact_torque"] - torques).max() < 1e-13 * abs(torques).max()

    # the rows have no lines, and so nothing has mobilised friction
    assert sums.filter.GetLinesOutput().GetNumberOfCells() == 0
    # lines that the join draws between the particles are the same contacts
    join = vg.vtkGranularLocalJoin()
    join.SetController(None)
    join.SetInputConnection(0, sums.particles.GetOutputPort())
    join.SetInputConnection(1, sums.contacts.GetOutputPort(1))
    for periodic in (0, 1):  # MinimumImage, Split
        join.SetPeriodicLines(periodic)
        drawn = Sums(name, walls=False, LeverArm=0)
        drawn.filter.SetLinesConnection(join.GetOutputPort())
        lines = drawn.update()
        assert (lines["contact_force"] == found["contact_force"]).all() and (lines["coordination"] == all_particles.coordination).all()
        assert abs(lines["contact_stress"] - by_radii).max() < 1e-13 * abs(by_radii).max()
        cells = drawn.of_lines()
        assert len(numpy.unique(cells["row"] if periodic else numpy.arange(contacts.count))) == contacts.count
        row = cells["row"] if periodic else slice(None)
        across, along = (numpy.sqrt((part ** 2).sum(axis=1)) for part in (contacts.tangential, contacts.normal))
        assert numpy.allclose(cells["mobilised_friction"], (across / along)[row], rtol=1e-12, atol=0)
print("as LAMMPS has them")
