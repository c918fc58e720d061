# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the files are those that one process writes, with the cells in the order of the ranks."""
import os

import granular
from paraview.simple import *
from vtkmodules.vtkParallelCore import vtkMultiProcessController

ranks = vtkMultiProcessController.GetGlobalController()
symmetric = servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
rank = ranks.GetLocalProcessId()
data = os.path.join(os.environ["GRANULAR_DATA"], "good")
ENDS = (".vtk", ".vtu", ".decomposition")


def content(path):
    if symmetric:
        ranks.Barrier()
    with open(path, "rb") as file:
        read = file.read()
    if symmetric:
        ranks.Barrier()
    return read


def alone(source, end, dialect=0):
    """What a process writes that knows of no other."""
    writer = granular.vtkGranularDecompositionWriter()
    writer.SetController(None)
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(f"alone_{rank}{end}")
    writer.SetDialect(dialect)
    assert writer.Write() == 1
    with open(writer.GetFileName(), "rb") as file:
        return file.read()


def alone_source(bounds, grid):
    source = granular.vtkGranularDecompositionSource()
    source.SetController(None)
    source.SetBounds(*bounds)
    source.SetProcessorGrid(*grid)
    return source


# fewer subdomains than ranks, as many, and more
for grid in ((1, 1, 1), (1, 2, 1), (3, 5, 7)):
    bounds = (-1 / 3, 1, 0, 2, 1e9, 1e9 + 1)
    source = GranularDecompositionSource(Bounds=bounds, ProcessorGrid=grid)
    for end in ENDS:
        expected = alone(alone_source(bounds, grid), end)
        granular.save(source, "a" + end, writer="GranularDecompositionWriter")
        assert content("a" + end) == expected, (grid, end)
    granular.save(source, "public.vtk", writer="GranularDecompositionWriter", Dialect="PUBLIC")
    assert content("public.vtk") == alone(alone_source(bounds, grid), ".vtk", 1), grid

# with particles, at all times; the first ranks have no grains at step 0
grains = GranularDumpReader(FileNames=[os.path.join(data, "grains.dump")])
domains = GranularDecomposition(Input=grains, ProcessorGrid=[2, 3, 4])
for end in (".vtk", ".vtu"):
    granular.save(domains, "step_*" + end, WriteTimeSteps=1)
    reader = granular.vtkGranularDumpReader()
    reader.AddFileName(os.path.join(data, "grains.dump"))
    counts = granular.vtkGranularDecomposition()
    counts.SetProcessorGrid(2, 3, 4)
    counts.SetInputConnection(reader.GetOutputPort())
    for algorithm in (reader, counts):
        algorithm.SetController(None)
    for step in (0, 1000, 2000):
        counts.UpdateTimeStep(step)
        assert content(f"step_{step}{end}") == alone(counts, end), (step, end)

# some ranks have nothing, not even field data or arrays: the others know the timestep
holes = ProgrammableFilter(Input=domains, Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
if controller.GetLocalProcessId() == 0 and controller.GetNumberOfProcesses() > 1:
    output.VTKObject.Initialize()
else:
    output.VTKObject.ShallowCopy(inputs[0].VTKObject)
""")
holes.UpdatePipeline(2000)
granular.save(holes, "holes_*.vtk", writer="GranularDecompositionWriter")
text = content("holes_2000.vtk")
assert b"nlocal 1 " in text and text.startswith(b"# vtk DataFile Version 3.0"), text[:300]

print("written")
