# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks join the same to the bit, wherever particles and bonds are, each the lines of its bonds."""
import os
import sys

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

from vtkmodules.vtkCommonDataModel import vtkTable

import all_ranks
import vtkgranular as vg

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
dump = os.path.join(data, "local", "chain.dump")

# The bonds of the last frame and one with nobody: PART of them on each rank; KNOWN: those without know the columns.
# What a script of ParaView defines it leaves here: a function, and nothing else.
BONDS = f"""
def fill(table):
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    text = open({os.path.join(data, "local", "chain_bonds.dump")!r}).read().splitlines()[-96:]
    bonds = numpy.array([line.split()[:3] + [1 + i / 128] for i, line in enumerate(text)] + [[1, 7, 1000, 1]], float)
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    bonds = bonds[PART]
    for name, values in zip(["btype", "id1", "id2", "equilibrium_length"] if len(bonds) or KNOWN else [], bonds.T):
        array = numpy_to_vtk(values.copy(), deep=1)
        array.SetName(name)
        table.AddColumn(array)
fill(self.GetOutputDataObject(0))
"""


def script(part=":", known=True):
    return BONDS.replace("PART", part).replace("KNOWN", str(known))


NUMBERS = ["btype", "id1", "id2", "length", "elongation", "strain", "v_mean", "type_mean", "v_difference"]


def content(output):
    """All that is told of each line, in the order of the ids."""
    cells = output.GetCellData()
    arrays = [vtk_to_numpy(cells.GetArray(name)).reshape(output.GetNumberOfCells(), -1) for name in NUMBERS]
    arrays.append(vtk_to_numpy(output.GetPoints().GetData()).reshape(-1, 6))
    table = numpy.hstack([array.astype(float) for array in arrays])
    return table[numpy.lexsort((table[:, 2], table[:, 1]))]


def alone(periodic):
    """The same by the classes, in this process without the others."""
    reader, join, rows = vg.vtkGranularDumpReader(), vg.vtkGranularLocalJoin(), vtkTable()
    reader.SetController(None)
    reader.AddFileName(dump)
    exec(script().replace("self.GetOutputDataObject(0)", "made"), {"made": rows})
    join.SetController(None)
    join.SetInputConnection(0, reader.GetOutputPort())
    join.SetInputDataObject(1, rows)
    join.SetPeriodicLines(periodic)
    join.SetAverages("v type")
    join.SetDifferences("*")
    join.UpdateTimeStep(1000)
    return join.GetOutput()


all_particles = GranularDumpReader(FileNames=[dump])
for periodic in (0, 1, 2):
    expected = content(alone(periodic))
    assert len(expected) == 96 if periodic != 1 else len(expected) > 96
    for own, known in (("rank::ranks", True), ("slice(0, 97 if rank == 0 else 0)", False),
                       ("slice(0, 97 if rank == ranks - 1 else 0)", True)):
        rows = ProgrammableSource(OutputDataSetType="vtkTable", Script=script(own, known))
        lines = GranularLocalJoin(Input=all_particles, Lines=rows, PeriodicLines=periodic, Averages="v type", Differences="*")
        output = all_ranks.whole(lines, 1000)
        found = content(output)
        assert found.tobytes() == expected.tobytes(), (periodic, own, abs(found - expected).max())
        if periodic == 1:  # the parts of a line have its number, which no other has
            ids = vtk_to_numpy(output.GetCellData().GetArray("id1"))
            row = vtk_to_numpy(output.GetCellData().GetArray("row"))
            assert len(numpy.unique(row)) == 96 and row.max() < 97
            assert not [i for i in numpy.unique(row) if len(set(ids[row == i])) > 1]
        Delete(lines)
        Delete(rows)

# split lines, whose parts are dealt to other ranks: each counts once
expected = content(alone(0)).tobytes()
rows = ProgrammableSource(OutputDataSetType="vtkTable", Script=script("slice(0, 97 if rank == 0 else 0)"))
DEAL = """
def deal(given, output):
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkExtractCells
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    lines = vtkPolyData()
    if rank == 0:
        lines.ShallowCopy(given)
    if ranks > 1:
        controller.Broadcast(lines, 0)
    cells, extract = vtkIdList(), vtkExtractCells()
    for cell in range(rank, lines.GetNumberOfCells(), ranks):
        cells.InsertNextId(cell)
    extract.SetInputData(lines)
    extract.SetCellList(cells)
    extract.Update()
    output.ShallowCopy(extract.GetOutput())
deal(self.GetInput(), self.GetOutput())
"""
parted = GranularLocalJoin(Input=all_particles, Lines=rows, PeriodicLines="Split")
assert all_ranks.whole(parted, 1000).GetNumberOfCells() > 96
dealt = ProgrammableFilter(Input=parted, OutputDataSetType="vtkUnstructuredGrid", Script=DEAL)
lines = GranularLocalJoin(Input=all_particles, Lines=dealt, Averages="v type", Differences="*")
assert content(all_ranks.whole(lines, 1000)).tobytes() == expected

# particles that have lost their field data: the box is that of the lines, of which most ranks have neither
LOSE = """
from vtkmodules.vtkCommonDataModel import vtkFieldData
self.GetOutput().ShallowCopy(self.GetInput())
if ALL or not self.GetInput().GetNumberOfCells():
    self.GetOutput().SetFieldData(vtkFieldData())
"""
lost = ProgrammableFilter(Input=all_particles, Script=LOSE.replace("ALL", "True"))
joined = GranularLocalJoin(Input=all_particles, Lines=rows)
some = ProgrammableFilter(Input=joined, Script=LOSE.replace("ALL", "False"))
lines = GranularLocalJoin(Input=lost, Lines=some, Averages="v type", Differences="*")
assert content(all_ranks.whole(lines, 1000)).tobytes() == expected

# names with blanks
doubled = Calculator(Input=all_particles, Function="2*type", ResultArrayName="type, doubled")
lines = GranularLocalJoin(Input=doubled, Lines=rows, Averages="*")
cells = all_ranks.whole(lines, 1000).GetCellData()
twice, once = (vtk_to_numpy(cells.GetArray(name + "_mean")) for name in ("type, doubled", "type"))
assert len(once) == 96 and (twice == 2 * once).all()

# without ids on one rank: an error of all, and none waits
without = ProgrammableSource(OutputDataSetType="vtkTable", Script=script().replace(
    '"id2"', '"id2" if rank < ranks - 1 else "other"'))
lines = GranularLocalJoin(Input=all_particles, Lines=without)
lines.UpdatePipeline(1000)
assert lines.GetDataInformation().GetNumberOfCells() == 0
print("all there", file=sys.stderr)  # behind what was said
