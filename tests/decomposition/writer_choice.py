# SPDX-License-Identifier: BSD-3-Clause
"""Which writer granular.save and SaveData take, and what several time steps without a `*` in the name come to."""
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


grains = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")], TimestepSize=2e-5)
domains = GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2])
divided = GranularDecompositionReader(FileNames=[os.path.join(data, "decomposition/all.vtk")])
voxels = b"DATASET UNSTRUCTURED_GRID"
fresh = GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2])  # nobody has looked at it yet
granular.save(fresh, "fresh.vtk")
assert voxels in content("fresh.vtk")
granular.save(OutputPort(domains, 0), "port.vtk", time=1000 * 2e-5)
granular.save(domains, "other.vtk", time=1000 * 2e-5)
assert content("port.vtk") == content("other.vtk")
granular.save(divided, "no_counts.decomposition")
assert voxels in content("no_counts.decomposition")
grains.UpdatePipeline(1000 * 2e-5)
granular.save(divided, "divided.vtk", Dialect="PUBLIC")
assert content("divided.vtk") == content(os.path.join(data, "decomposition/all.vtk"))[:248]
for proxy, name in ((domains, "domains.dump"), (domains, "domains")):
    granular.save(proxy, name)
    assert content(name).startswith(b"ITEM: TIMESTEP"), name
try:
    granular.save(grains, "grains.vtk")  # dumps have no such name
except RuntimeError:
    assert not os.path.exists("grains.vtk")
else:
    raise AssertionError("grains became voxels")
granular.save(domains, "domains.vtk", writer="GranularDumpWriter")
assert content("domains.vtk").startswith(b"ITEM: TIMESTEP")
SaveData("run.decomposition", domains)
assert voxels in content("run.decomposition")
SaveData("paraview.vtu", domains)  # ParaView's own writers keep their names
assert b"appended" in content("paraview.vtu")

for arguments, error in (({"writer": "GranularSomethingWriter"}, AttributeError), ({"Style": "Atom"}, AttributeError),
                         ({"Dialect": "LAMMPS"}, ValueError)):
    try:
        granular.save(domains, "never.vtk", **arguments)
    except error:
        pass
    else:
        raise AssertionError(f"{arguments} was taken")
assert not os.path.exists("never.vtk")

try:
    granular.save(domains, "all.vtk", WriteTimeSteps=1)
except RuntimeError:
    assert not os.path.exists("all.vtk")
else:
    raise AssertionError("several steps went into one file")

for properties in ({"Binary": 1}, {"Dialect": "PUBLIC"}):
    try:
        granular.save(domains, "never.vtu", **properties)
    except RuntimeError:
        pass
    else:
        raise AssertionError(f"{properties} was taken")
assert not os.path.exists("never.vtu")
print("chosen")
