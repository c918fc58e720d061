# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be averaged is an error on all ranks, the output is empty, none waits, and ParaView lives on."""
import os

import all_ranks
import vtkgranular as vg
from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkParallelCore import vtkCommunicator

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
particles = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")])


def cells_of(proxy, time=2000):
    """Of all ranks together."""
    proxy.UpdatePipeline(time)
    cells = proxy.GetDataInformation().GetNumberOfCells()
    if not all_ranks.symmetric:
        return cells
    own, total = vtkIntArray(), vtkIntArray()
    own.InsertNextValue(cells)
    all_ranks.ranks.AllReduce(own, total, vtkCommunicator.SUM_OP)
    return total.GetValue(0)


average = GranularEulerAverage(Input=particles)
assert cells_of(average) == 1000
average.RadiusArray = "no_radius"
assert cells_of(average) == 0
average.RadiusArray = "radius"
assert cells_of(average) == 1000
vg.set_properties(average, CellsBy="CellSize", CellSize=[0.02, 0.02, 0.02])
assert cells_of(average) == 5 * 5 * 7
average.Bounds = [0, 0.05, 0, 0.05, 0, 0.15]
assert cells_of(average) == 2 * 2 * 7
average.Bounds = [-0.05, 0.05, -0.05, 0.05, 0, 0.15]
average.CellSize = [0, 0.02, 0.02]
assert cells_of(average) == 0
average.CellSize = [1e-9, 1e-9, 1e-9]
assert cells_of(average) == 0
average.CellsBy = "CellSizeRelative"
assert cells_of(average) == 112
average.Output = "Points"
assert cells_of(average) == 112
vg.set_properties(average, CellsBy="CellCounts", CellCounts=[30000, 30000, 1000])  # more than there is memory for
assert cells_of(average) == 0
average.Output = "ImageData"
assert cells_of(average) == 0
for counts, radius in (([6, 6, 6], "radius"), ([6, 6, 6], "no_radius"), ([12, 4, 9], "radius"), ([5, 4, 3], "radius")):
    vg.set_properties(average, CellCounts=counts, RadiusArray=radius)  # each rank has its own cells, whatever was before
    expected = counts[0] * counts[1] * counts[2] if radius == "radius" else 0
    assert cells_of(average) == expected, counts

# on the last rank alone
faulty = ProgrammableFilter(Input=particles, CopyArrays=1, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output.VTKObject.ShallowCopy(inputs[0].VTKObject)
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == controller.GetNumberOfProcesses() - 1:
    output.VTKObject.GetPointData().RemoveArray("radius")
""")
for kind in ("ImageData", "Points"):
    broken = GranularEulerAverage(Input=faulty, Output=kind)
    assert cells_of(broken) == 0, kind
    broken.Input = particles
    assert cells_of(broken) == 1000, kind

# a word in the last frame: no average over time, and each frame once
with open(os.path.join(data, "grains.dump")) as file:
    text = file.read()
at = text.rindex("ITEM: TIMESTEP")
name = f"word_{all_ranks.ranks.GetLocalProcessId() if all_ranks.symmetric else 0}.dump"
with open(name, "w") as file:
    file.write(text[:at] + text[at:].replace(" 0.0025 ", " 0.0025x ", 1))
over_time = GranularEulerAverage(Input=GranularDumpReader(FileNames=[os.path.abspath("word_0.dump")]), TimeAverage=1)
assert cells_of(over_time) == 0
over_time.TimeAverage = 0
assert cells_of(over_time, 1000) == 1000
print("alive")
