# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one rank alone: an error that names it, the old file as it was, and no rank that waits."""
import os

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")
contacts = GranularLocalReader(FileNames=[os.path.join(data, "contacts.dump")])
contacts.UpdatePipeline(2000)
faulty = ProgrammableFilter(Input=contacts, CopyArrays=1, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output.VTKObject.DeepCopy(inputs[0].VTKObject)
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    output.VTKObject.GetCellData().RemoveArray("force")
""")
faulty.UpdatePipeline(2000)
bent = ProgrammableFilter(Input=contacts, CopyArrays=1, Script="""
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output.VTKObject.DeepCopy(inputs[0].VTKObject)
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1:
    cells = vtkCellArray()
    for i in range(output.VTKObject.GetNumberOfLines()):
        cells.InsertNextCell(3, [0, 1, 2])
    output.VTKObject.SetLines(cells)
""")
bent.UpdatePipeline(2000)
with open("old.bonds", "w") as file:
    file.write("the old file")
before = sorted(os.listdir("."))
for mode in ("Gather", "MPI-IO"):
    for proxy, name in ((faulty, "old.bonds"), (bent, "old.bonds"), (contacts, "gone/old.bonds")):
        try:
            granular.save(proxy, name, ParallelMode=mode)
        except RuntimeError as error:
            assert str(error) == f"{name} could not be written: see the messages above", error
        else:
            raise AssertionError("nothing was raised")
        with open("old.bonds") as file:
            assert file.read() == "the old file"
        assert sorted(os.listdir(".")) == before, os.listdir(".")
    granular.save(contacts, "new.bonds", ParallelMode=mode)
    os.remove("new.bonds")
print("alive")
