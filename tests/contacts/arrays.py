# SPDX-License-Identifier: BSD-3-Clause
"""Which arrays there are: those that are on, where contacts tell them; the particles come through as they are."""
import numpy
import vtkgranular as vg
from contact_sums import NAMES, Sums, arrays_of
from vtkmodules.util.numpy_support import vtk_to_numpy

import plain_contacts as plain

OF_PARTICLES = NAMES[:-1]
OF_FORCES = ["contact_force", "contact_torque", "contact_stress", "principal_stress", "von_mises"]


def made_by(sums):
    """What of the filter's arrays is there, and the values."""
    found = sums.update()
    return {name: found[name] for name in OF_PARTICLES if name in found}


# ---- defaults ----------------------------------------------------------------------------------------------------------

sums = Sums("bed", on=NAMES)
all_ = made_by(sums)
assert list(all_) == OF_PARTICLES
selection = vg.vtkGranularContactSums().GetArraySelection()
assert [selection.GetArrayName(i) for i in range(selection.GetNumberOfArrays())] == NAMES
assert [name for name in NAMES if selection.ArrayIsEnabled(name)] == NAMES[:5]
types = {"coordination": numpy.int32, "coordination_without_rattlers": numpy.int32, "rattler": numpy.uint8}
shapes = {"contact_force": (250, 3), "contact_torque": (250, 3), "fabric": (250, 6), "contact_stress": (250, 6),
          "principal_stress": (250, 3)}
for name, values in all_.items():
    assert values.dtype == types.get(name, numpy.float64) and values.shape == shapes.get(name, (250,)), name
data = sums.filter.GetOutput().GetPointData()
for name in ("fabric", "contact_stress"):
    array = data.GetArray(name)
    assert [array.GetComponentName(i) for i in range(6)] == ["XX", "YY", "ZZ", "XY", "XZ", "YZ"]

# ---- the particles as they are -----------------------------------------------------------------------------------------

source = sums.particles.GetOutput()
output = sums.filter.GetOutput()
given = arrays_of(source.GetPointData())
for name, values in given.items():
    assert (arrays_of(data)[name] == values).all(), name
assert not set(given) & set(NAMES)  # and the input has got nothing
assert (vtk_to_numpy(output.GetPoints().GetData()) == vtk_to_numpy(source.GetPoints().GetData())).all()
assert output.GetNumberOfVerts() == source.GetNumberOfVerts() == 250
fields = [source.GetFieldData().GetArrayName(i) for i in range(source.GetFieldData().GetNumberOfArrays())]
assert fields and all(output.GetFieldData().HasArray(name) for name in fields)
assert not source.GetFieldData().HasArray("mean_coordination")
given = arrays_of(sums.contacts.GetOutput().GetCellData())
for name, values in given.items():
    assert (sums.of_lines()[name] == values).all(), name
assert set(sums.of_lines()) - set(given) == {"mobilised_friction"}

# ---- each by itself, and all but each ----------------------------------------------------------------------------------

for name in NAMES:
    for on in ([name], [each for each in NAMES if each != name], []):
        sums.choose(on)
        found = made_by(sums)
        assert list(found) == [each for each in OF_PARTICLES if each in on], (on, list(found))
        assert all((found[each] == all_[each]).all() for each in found)
        lines = sums.filter.GetLinesOutput()
        assert lines.GetNumberOfCells() == (plain.Contacts("bed_contacts", 70000).count if NAMES[-1] in on else 0)
        rattlers = "rattler" in on or "coordination_without_rattlers" in on
        assert sums.filter.GetOutput().GetFieldData().HasArray("mean_coordination_without_rattlers") == rattlers
        assert sums.field("mean_coordination") == all_["coordination"].sum() / 250

# ---- arrays that contacts do not tell ----------------------------------------------------------------------------------


def without(*words):
    """The bed's column maps, in which some words are columns of other names."""
    maps = {}
    for name in ("bed_contacts", "bed_walls"):
        names = []
        for word in plain.COLUMNS[name].split():
            count = plain._WIDTHS.get(word, 1)
            known = {"pos": [end + number for number in "12" for end in "xyz"], "id": ["id1", "id2", "periodic"],
                     "wall_id": ["mesh", "triangle", "id2"]}
            own = known.get(word, [word.lower() + (axis if count == 3 else "") for axis in "xyz"[:count]])
            own = [each.replace("contactpoint", "contact_point") for each in own]
            names += [f"other_{len(names) + i}" for i in range(count)] if word in words else own
        maps[name] = " ".join(names)
    return maps


def bed_without(*words, **how):
    made = Sums("bed", **how)
    maps = without(*words)
    made.contacts.SetColumnMap(maps["bed_contacts"])
    made.walls.SetColumnMap(maps["bed_walls"])
    return made


assert all((values == all_[name]).all() for name, values in made_by(bed_without()).items())
# the whole force, or its two parts: equal but for rounding
parts = made_by(bed_without("force"))
assert list(parts) == OF_PARTICLES
assert abs(parts["contact_force"] - all_["contact_force"]).max() < 1e-15  # N, of 15 digits
# no forces at all: contacts without forces give their number and their directions
sums = bed_without("force", "force_normal", "force_tangential")
sums.filter.Update()
assert len(sums.said) == 1 and "neither an array 'force' nor 'force_normal': what needs forces is not made" in sums.said[0]
sums.said.clear()
found = made_by(sums)
assert list(found) == [name for name in OF_PARTICLES if name not in OF_FORCES]
assert all((found[name] == all_[name]).all() for name in found)
assert sums.filter.GetLinesOutput().GetNumberOfCells() == 0
# normal forces alone are taken for the force
normal = bed_without("force", "force_tangential", "torque")
normal.choose([name for name in NAMES if name != "mobilised_friction"])
normal = made_by(normal)
all_particles, contacts, walls = (kind("bed" + what, 70000) for kind, what in (
    (plain.Particles, ""), (plain.Contacts, "_contacts"), (plain.Contacts, "_walls")))
expected = sum(plain.add_up(all_particles, each, each.named["force_normal"], each.named["force_normal"] * sign)
               for each, sign in ((contacts, -1), (walls, 1)))
assert abs(normal["contact_force"] - expected).max() < 1e-16
# torques, contact points and overlaps that are not there change what depends on them, and nothing else
for words, changed in ((["torque"], {"contact_torque"}), (["delta"], set()),
                       (["contactPoint"], {"contact_stress", "principal_stress", "von_mises"}),
                       (["torque", "contactPoint"], {"contact_torque", "contact_stress", "principal_stress", "von_mises"})):
    found = made_by(bed_without(*words))
    assert list(found) == OF_PARTICLES
    assert {name for name in found if (found[name] != all_[name]).any()} == changed, words

# ---- readers that leave out or shift -----------------------------------------------------------------------------------

shifted = Sums("bed")
for reader in (shifted.particles, shifted.contacts, shifted.walls):
    reader.SetPointOrigin(0.25, -3, 1)
found = made_by(shifted)
for name in ("coordination", "contact_force", "rattler", "coordination_without_rattlers"):
    assert (found[name] == all_[name]).all(), name
# points lose digits, as they are farther from the origin now
for name in ("contact_stress", "contact_torque", "fabric", "principal_stress", "von_mises"):
    assert abs(found[name] - all_[name]).max() < 1e-9 * abs(all_[name]).max() + 1e-15, name
# one of them alone: nothing is misplaced
for reader in (shifted.particles, shifted.contacts):
    reader.SetPointOrigin(0, 0, 0)
found = made_by(shifted)
assert (found["contact_force"] == all_["contact_force"]).all()
assert abs(found["contact_stress"] - all_["contact_stress"]).max() < 1e-9 * abs(all_["contact_stress"]).max()
print("those that are on")
