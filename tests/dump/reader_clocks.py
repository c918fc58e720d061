# SPDX-License-Identifier: BSD-3-Clause
"""One clock: all readers, ITEM: TIME and write_series give a timestep the same time, that of exact fractions."""
import os
import shutil
from fractions import Fraction

import vtkgranular as vg
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
STEPS = range(0, 101)
dt = 1e-5
exact = [float(step * Fraction("1e-5")) for step in STEPS]


def write(name, steps, time=None, counted="ATOMS"):
    with open(name, "w") as file:
        for step in steps:
            if time:
                file.write(f"ITEM: TIME\n{time(step)}\n")
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF {counted}\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                       f"ITEM: {counted} " + ("id x y z\n1 0.5 0.5 0.5\n" if counted == "ATOMS" else
                                              "x1 y1 z1 x2 y2 z2 id1 id2 periodic\n0 0 0 1 1 1 1 2 0\n"))
    return os.path.abspath(name)


def copies(name, good):
    """The same file for each timestep."""
    names = [os.path.abspath(f"{name}_{step}.vtk") for step in STEPS]
    for copy in names:
        shutil.copy(os.path.join(data, good), copy)
    return names


def times(files, **options):
    reader = OpenDataFile(files, **options)
    reader.UpdatePipelineInformation()
    return reader, list(reader.TimestepValues)


# a dump with the times that LAMMPS prints, beside others that know timesteps alone: one animation of 101 steps
with_time, own = times(write("time.dump", STEPS, lambda step: f"{step * dt:.16g}"))
assert own == exact, [(a, b) for a, b in zip(own, exact) if a != b]
readers = [with_time]
for files in (write("steps.dump", STEPS), write("contacts.local", STEPS, counted="ENTRIES"),
              copies("decomposition", "decomposition_1000.vtk"), copies("euler", "euler_1000.vtk")):
    reader, found = times(files, TimestepSize=dt)
    assert found == exact, (files, [(a, b) for a, b in zip(found, exact) if a != b])
    readers.append(reader)
for step in STEPS:
    with open(f"mesh_{step}.stl", "w") as file:
        file.write("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                   "endsolid a\n")
mesh = OpenDataFile(vg.write_series([f"mesh_{step}.stl" for step in STEPS], dt))
assert list(mesh.TimestepValues) == exact
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
assert list(GetTimeKeeper().TimestepValues) == exact, len(GetTimeKeeper().TimestepValues)

# what is shown at a time is the frame of that time, and what is written comes back at it
for step in (3, 6, 7, 33, 100):
    for reader in readers[:2]:
        reader.UpdatePipeline(exact[step])
        assert reader.FieldData["timestep"].GetRange() == (step, step)
vg.save(readers[1], "again.dump", WriteTimeSteps=1, Dialect="LAMMPS", WriteTime=1)
assert times(os.path.abspath("again.dump"))[1] == exact
seventh = times(write("seventh.dump", (0, 1, 5)), TimestepSize=1 / 7)[0]
vg.save(seventh, "again.dump", WriteTimeSteps=1, Dialect="LAMMPS", WriteTime=1)
assert times(os.path.abspath("again.dump"))[1] == list(seventh.TimestepValues)
assert seventh.TimestepValues[1] == 1 / 7 != float(f"{1 / 7:.16g}")  # 17 digits
