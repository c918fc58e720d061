# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one rank alone: an error that names it, the old file as it was, and no rank that waits."""
import os

import granular
from paraview.simple import *

divided = GranularDecompositionSource(Bounds=[0, 1, 0, 1, 0, 1], ProcessorGrid=[3, 3, 3])
faulty = ProgrammableFilter(Input=divided, CopyArrays=1, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output.VTKObject.DeepCopy(inputs[0].VTKObject)
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    points = output.VTKObject.GetPoints()
    points.SetPoint(0, 5, 5, 5)
""")
with open("old.vtk", "w") as file:
    file.write("the old file")
before = sorted(os.listdir("."))
for proxy, name in ((faulty, "old.vtk"), (divided, "gone/old.vtk"), (divided, "old.dump")):
    try:
        granular.save(proxy, name, writer="GranularDecompositionWriter")
    except RuntimeError as error:
        assert str(error) == f"{name} could not be written: see the messages above", error
    else:
        raise AssertionError("nothing was raised")
    with open("old.vtk") as file:
        assert file.read() == "the old file"
    assert sorted(os.listdir(".")) == before, os.listdir(".")
granular.save(divided, "new.vtk", writer="GranularDecompositionWriter")
os.remove("new.vtk")
print("alive")
