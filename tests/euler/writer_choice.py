# SPDX-License-Identifier: BSD-3-Clause
"""Which writer granular.save and SaveData take for Euler cells, and what is refused."""
import os
import shutil

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
shutil.rmtree("choice", ignore_errors=True)
os.mkdir("choice")
os.chdir("choice")


def content(path):
    with open(path, "rb") as file:
        return file.read()


cells = GranularEulerReader(FileNames=[os.path.join(data, f"euler_{step}.vtk") for step in (1000, 2000)])
original = content(os.path.join(data, "euler_1000.vtk"))
granular.save(cells, "fresh.euler")
SaveData("saved.euler", cells)
granular.save(OutputPort(cells, 0), "port.euler")
granular.save(cells, "named.vtk", writer="GranularEulerWriter")
for name in ("fresh.euler", "saved.euler", "port.euler", "named.vtk"):
    assert content(name) == original, name
granular.save(cells, "later.euler", time=2000)
assert content("later.euler") == content(os.path.join(data, "euler_2000.vtk"))
granular.save(cells, "cells.dump")
assert content("cells.dump").startswith(b"ITEM: TIMESTEP")
cells.Output = "ImageData"
SaveData("paraview.vti", cells)  # ParaView's own writers keep their names

partial = PassArrays(Input=GranularEulerReader(FileNames=[os.path.join(data, "euler_1000.vtk")]),
                     PointDataArrays=["v_avg", "volumefraction", "radius"])
for proxy, name, properties in ((cells, "all.euler", {"WriteTimeSteps": 1}), (partial, "partial.euler", {}),
                                (cells, "of_%.euler", {}), (cells, "gone/a.euler", {}),
                                (Sphere(), "sphere.euler", {})):
    try:
        granular.save(proxy, name, **properties)
    except RuntimeError:
        assert not os.path.exists(name)
    else:
        raise AssertionError(f"{name} was written")
for arguments, error in (({"Style": "Atom"}, AttributeError), ({"Dialect": "LAMMPS"}, ValueError)):
    try:
        granular.save(cells, "never.euler", **arguments)
    except error:
        pass
    else:
        raise AssertionError(f"{arguments} was taken")
assert not os.path.exists("never.euler")
print("chosen")
