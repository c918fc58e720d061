# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks find the same to the bit, wherever particles and contacts are; an error is one of all ranks."""
import sys

import numpy
from contact_sums import NAMES, Sums
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import all_ranks
import plain_contacts as plain

POINTS = ["id"] + NAMES[:-1]


def content(output, points=True):
    """All that is told of each particle, or of each line, in the order of the ids."""
    names = POINTS if points else ["id1", "id2", "mobilised_friction"]
    attributes = output.GetPointData() if points else output.GetCellData()
    arrays = [vtk_to_numpy(attributes.GetArray(name)) for name in names]
    places = vtk_to_numpy(output.GetPoints().GetData()).reshape(len(arrays[0]), -1)
    table = numpy.hstack([array.reshape(len(array), -1).astype(float) for array in arrays] + [places])
    return table[numpy.lexsort((table[:, 1], table[:, 0]))]


def fields_of(output):
    return [output.GetFieldData().GetArray(name).GetValue(0) for name in ("mean_coordination", "mean_coordination_without_rattlers")]


def alone(name, step, **how):
    """The same by the classes, in this process without the others."""
    sums = Sums(name, **how)
    sums.update(step)
    return sums.filter


def proxies(name, walls=True, rows=False):
    all_particles = GranularDumpReader(FileNames=[plain.path(name)])
    contacts = GranularLocalReader(FileNames=[plain.path(name + "_contacts")], ColumnMap=plain.COLUMNS[name + "_contacts"])
    ports = {"Lines": OutputPort(contacts, 1 if rows else 0)}
    if walls:
        ports["Walls"] = GranularLocalReader(FileNames=[plain.path(name + "_walls")], ColumnMap=plain.COLUMNS[name + "_walls"])
    return all_particles, ports


# particles or lines of each rank, dealt to others: DEAL is the rank of each of all of them
DEALT = """
def deal(given, output):
    import numpy
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkExtractCells
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    append, parts = vtkAppendPolyData(), []
    for source in range(ranks):
        part = vtkPolyData()
        if source == rank:
            part.DeepCopy(given)
        if ranks > 1:
            controller.Broadcast(part, source)
        parts.append(part)
        append.AddInputData(part)
    append.Update()
    whole = append.GetOutput()
    cells, extract = vtkIdList(), vtkExtractCells()
    for i in range(whole.GetNumberOfCells()):
        if (DEAL) == rank:
            cells.InsertNextId(i)
    extract.SetInputData(whole)
    extract.SetCellList(cells)
    extract.Update()
    output.ShallowCopy(extract.GetOutput())
    output.GetFieldData().PassData(given.GetFieldData())
deal(self.GetInputDataObject(0, 0), self.GetOutputDataObject(0))
"""


def dealt(source, deal):
    return ProgrammableFilter(Input=source, OutputDataSetType="vtkUnstructuredGrid", Script=DEALT.replace("DEAL", deal))


for name, steps in (("bed", [70000]), ("periodic_bed", [70000]), ("moving", [3020, 3000])):
    all_particles, ports = proxies(name)
    sums = GranularContactSums(Input=all_particles, Arrays=NAMES, RattlerContacts=4, **ports)
    for step in steps:
        expected = alone(name, step, RattlerContacts=4)
        whole = all_ranks.whole(sums, step)
        assert content(whole).tobytes() == content(expected.GetOutput()).tobytes(), (name, step)
        assert fields_of(whole) == fields_of(expected.GetOutput())
        lines = all_ranks.whole(OutputPort(sums, 1), step)
        assert content(lines, False).tobytes() == content(expected.GetLinesOutput(), False).tobytes(), (name, step)
for name in ("tilted", "tilted_granular"):
    all_particles, ports = proxies(name, False, True)
    sums = GranularContactSums(Input=all_particles, Arrays=NAMES[:-1], **ports)
    expected = content(alone(name, None, walls=False, rows=True).GetOutput())
    assert content(all_ranks.whole(sums)).tobytes() == expected.tobytes(), name

# elsewhere than the readers leave them; ranks without particles, without contacts, or without either
all_particles, ports = proxies("periodic_bed")
expected = alone("periodic_bed", 70000)
for particle_deal, line_deal in (("i * 7919 // 3 % ranks", "i % ranks"), ("0", "ranks - 1"), ("ranks - 1", "0"), ("0", "0"),
                              ("i % ranks", "0")):
    moved = {port: dealt(source, line_deal) for port, source in ports.items()}
    sums = GranularContactSums(Input=dealt(all_particles, particle_deal), Arrays=NAMES, **moved)
    whole = all_ranks.whole(sums)
    assert content(whole).tobytes() == content(expected.GetOutput()).tobytes(), (particle_deal, line_deal)
    assert fields_of(whole) == fields_of(expected.GetOutput())
    lines = all_ranks.whole(OutputPort(sums, 1))
    assert content(lines, False).tobytes() == content(expected.GetLinesOutput(), False).tobytes(), (particle_deal, line_deal)

# ---- errors on one rank, or on all: the output is empty, none waits, and the next update is good ---------------------------


def count(proxy):
    proxy.UpdatePipeline()
    return proxy.GetDataInformation().GetNumberOfPoints()


CHANGED = """
def change(given, output):
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    output.ShallowCopy(given)
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    if rank == ranks - 1:
        CHANGE
change(self.GetInputDataObject(0, 0), self.GetOutputDataObject(0))
"""


def changed(source, change):
    return ProgrammableFilter(Input=source, Script=CHANGED.replace("CHANGE", change))


without = [({"Input": changed(all_particles, 'output.GetPointData().RemoveArray("id")')}, None),
           ({"Lines": changed(ports["Lines"], 'output.GetCellData().RemoveArray("id2")')}, None),
           ({"Input": changed(all_particles, 'output.GetPointData().RemoveArray("radius")')}, "von_mises"),
           ({"Walls": changed(ports["Walls"], 'output.GetCellData().RemoveArray("force")')}, None)]
for other, array in without:
    sums = GranularContactSums(**{"Input": all_particles, **ports, **other}, Arrays=[array] if array else ["contact_force"])
    assert count(sums) == 0, other
    for port, source in {"Input": all_particles, **ports}.items():
        setattr(sums, port, source)
    if not all_ranks.symmetric:
        assert count(sums) == 250, other
    assert content(all_ranks.whole(GranularContactSums(Input=all_particles, Arrays=NAMES, **ports))).tobytes() == content(
        expected.GetOutput()).tobytes()
sums = GranularContactSums(Input=all_particles, MinimumForce=-1, **ports)
assert count(sums) == 0
sums.MinimumForce = 0
count(sums)

# warnings are told once, with the numbers of all ranks
fewer = dealt(all_particles, "i % ranks if i % 10 else -1")
assert all_ranks.whole(GranularContactSums(Input=fewer, **ports)).GetNumberOfPoints() == 225
print("all there", file=sys.stderr)  # behind what was said
