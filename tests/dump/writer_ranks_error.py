# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one rank alone: an error that names it, the old file as it was, and no rank that waits."""
import os

import granular
from paraview.simple import *

reader = GranularDumpReader(FileNames=[os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")])
faulty = ProgrammableFilter(Input=reader, CopyArrays=1, Script="""
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1:
    short = vtkDoubleArray()
    short.SetName("radius")
    short.InsertNextValue(1)
    output.VTKObject.GetPointData().AddArray(short)
""")
with open("old.dump", "w") as file:
    file.write("the old file")
before = sorted(os.listdir("."))
for mode in ("Gather", "MPI-IO"):
    for folder in ("", "gone/"):
        try:
            granular.save(reader if folder else faulty, folder + "old.dump", WriteTimeSteps=1, ParallelMode=mode)
        except RuntimeError as error:
            assert str(error) == f"{folder}old.dump could not be written: see the messages above", error
        else:
            raise AssertionError("nothing was raised")
        with open("old.dump") as file:
            assert file.read() == "the old file"
        assert sorted(os.listdir(".")) == before, os.listdir(".")
    granular.save(reader, "new.dump", WriteTimeSteps=1, ParallelMode=mode)
    os.remove("new.dump")
print("alive")
