# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one rank alone: an error that names it, the old file as it was, and no rank that waits."""
import os

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
cells = GranularEulerReader(FileNames=[os.path.join(data, "euler_1000.vtk")])
faulty = ProgrammableFilter(Input=cells, CopyArrays=1, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output.VTKObject.DeepCopy(inputs[0].VTKObject)
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    output.VTKObject.GetPointData().RemoveArray("pressure")
""")
with open("old.euler", "w") as file:
    file.write("the old file")
before = sorted(os.listdir("."))
for proxy, name in ((faulty, "old.euler"), (cells, "gone/old.euler"), (cells, "old%.euler")):
    try:
        granular.save(proxy, name)
    except RuntimeError as error:
        assert str(error) == f"{name} could not be written: see the messages above", error
    else:
        raise AssertionError("nothing was raised")
    with open("old.euler") as file:
        assert file.read() == "the old file"
    assert sorted(os.listdir(".")) == before, os.listdir(".")
granular.save(cells, "new.euler")
os.remove("new.euler")
print("alive")
