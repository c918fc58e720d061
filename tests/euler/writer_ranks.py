# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the files are those that one process writes: points in the order of the ranks, cells of a grid
in that of LIGGGHTS."""
import os

import all_ranks
import granular
import numpy
import plain_euler
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
rank = all_ranks.ranks.GetLocalProcessId()
steps = (1000, 2000, 3000, 4000)


def content(path):
    if all_ranks.symmetric:
        all_ranks.ranks.Barrier()
    with open(path, "rb") as file:
        read = file.read()
    if all_ranks.symmetric:
        all_ranks.ranks.Barrier()
    return read


def write(name, values):
    """A file for all ranks, written by the first."""
    if rank == 0:
        with open(name, "w") as file:
            file.write(plain_euler.text(values))
    if all_ranks.symmetric:
        all_ranks.ranks.Barrier()
    return os.path.abspath(name)


# the real files, from points and from the parts of an image
series = GranularEulerReader(FileNames=[os.path.join(data, f"euler_{step}.vtk") for step in steps])
for output in ("Points", "ImageData"):
    series.Output = output
    granular.save(series, "real_*.euler", WriteTimeSteps=1)
    for step in steps:
        assert content(f"real_{step}.euler") == content(os.path.join(data, f"euler_{step}.vtk")), (output, step)
parallel = GranularEulerReader(FileNames=[os.path.join(data, "euler/parallel_2000.vtk")])
for output in ("Points", "ImageData"):
    parallel.Output = output
    granular.save(parallel, "parallel.euler")
    assert content("parallel.euler") == content(os.path.join(data, "euler/parallel_2000.vtk")), output

# grids of every shape, which are cut along other axes
for i, counts in enumerate(((2, 2, 5), (7, 2, 2), (2, 9, 3), (8, 6, 4), (16, 2, 2))):
    values = plain_euler.cells(plain_euler.grid((0, 0, 0), counts, counts), seed=i)
    name = write(f"shape_{i}_10.vtk", values)
    reader = GranularEulerReader(FileNames=[name], Output="ImageData")
    granular.save(reader, "shape.euler")
    assert content("shape.euler") == content(name), counts
    # with ghost cells, which are others'
    ghosts = GhostCells(Input=reader) if "GhostCells" in globals() else GhostCellsGenerator(Input=reader)
    granular.save(ghosts, "ghosts.euler")
    assert content("ghosts.euler") == content(name), counts
    Delete(ghosts)
    Delete(reader)

# an image of ParaView's own, whose extent begins below 0
wavelet = PointDatatoCellData(Input=Wavelet(WholeExtent=[-4, 5, -3, 3, -2, 6]), PassPointData=0)
arrays = Calculator(Input=wavelet, AttributeType="Cell Data", ResultArrayName="v_avg", Function="RTData*iHat+jHat")
for name, function in (("volumefraction", "RTData/300"), ("radius", "1"), ("pressure", "RTData")):
    arrays = Calculator(Input=arrays, AttributeType="Cell Data", ResultArrayName=name, Function=function)
granular.save(arrays, "wavelet.euler")
found = plain_euler.read("wavelet.euler") if content("wavelet.euler") else None
assert (found["centres"] == plain_euler.grid((-4, -3, -2), (5, 3, 6), (9, 6, 8))).all()
assert numpy.allclose(found["v_avg"][:, :1], found["pressure"], rtol=0, atol=1e-6) and found["pressure"].min() > 30
assert numpy.allclose(found["volumefraction"] * 300, found["pressure"], rtol=0, atol=3e-4)

# some ranks have nothing, not even arrays or field data: the others know the timestep
series.Output = "Points"
holes = ProgrammableFilter(Input=series, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == 0 and controller.GetNumberOfProcesses() > 1:
    output.VTKObject.Initialize()
else:
    output.VTKObject.ShallowCopy(inputs[0].VTKObject)
""")
holes.UpdatePipeline(2000)
granular.save(holes, "holes_*.euler")
size = all_ranks.ranks.GetNumberOfProcesses()
content("holes_2000.euler")
found = plain_euler.read("holes_2000.euler")
whole = plain_euler.read(os.path.join(data, "euler_2000.vtk"))
left = 0 if size == 1 else 112 // size
assert abs(len(found["centres"]) - (112 - left)) <= 1
assert (found["pressure"] == whole["pressure"][-len(found["pressure"]):]).all()
print("written")
