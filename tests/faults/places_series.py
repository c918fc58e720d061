# SPDX-License-Identifier: BSD-3-Clause
"""A series of many more files than a process may have open, without a home, on any number of ranks.

GRANULAR_PLACES: the number of files."""
import os
import resource
import shutil

import all_ranks
import granular
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkParallelCore import vtkCommunicator

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
KINDS = {"Local": "local/contacts.dump", "Restart": "restart/style_sphere.restart", "DataFile": "data_file/granular.data",
         "Euler": "euler_1000.vtk", "Decomposition": "decomposition_1000.vtk"}
COUNT = int(os.environ.get("GRANULAR_PLACES", "300"))
rank, ranks = all_ranks.ranks.GetLocalProcessId(), all_ranks.ranks.GetNumberOfProcesses()
for variable in ("HOME", "TMPDIR"):
    os.environ.pop(variable, None)
if rank == 0:
    shutil.rmtree("series", ignore_errors=True)
    os.mkdir("series")
    for i in range(COUNT):
        with open(f"series/s_{i}.dump", "w") as file:
            file.write(f"ITEM: TIMESTEP\n{i}\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
                       + "".join(f"{3 * i + j} 0.5 0.5 0.5\n" for j in range(3)))
        for kind, source in KINDS.items():
            os.symlink(os.path.join(GOOD, source), f"series/{kind}_{i}{os.path.splitext(source)[1]}")
all_ranks.wait()


def reader(kind, names, **properties):
    made = getattr(granular, f"vtkGranular{kind}Reader")()
    made.AddObserver("WarningEvent", lambda *_: None)
    for name in names:
        made.AddFileName(name)
    for name, value in properties.items():
        getattr(made, f"Set{name}")(value)
    return made


def rows(made, time):
    made.UpdateTimeStep(time, rank, ranks, 0)
    assert made.GetErrorCode() == 0, made.GetErrorMessage()
    data = made.GetOutputDataObject(0)
    return [data.GetNumberOfElements(kind) for kind in range(7)]


def total(count):
    """The sum over all ranks."""
    own, all_of_them = vtkIntArray(), vtkIntArray()
    own.InsertNextValue(count)
    all_ranks.ranks.AllReduce(own, all_of_them, vtkCommunicator.SUM_OP)
    return all_of_them.GetValue(0)


alone = {kind: rows(reader(kind, [os.path.join(GOOD, source)]), 0) for kind, source in KINDS.items()}
resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64))
names = granular.files("series/s_*.dump")
assert len(names) == COUNT
made = reader("Dump", names, Threads=4)
for step in [*range(0, COUNT, 10), COUNT - 1, COUNT - 2]:
    count = rows(made, step)[0]
    ids = made.GetOutputDataObject(0).GetPointData().GetArray("id")
    assert count == ids.GetNumberOfTuples() and all(ids.GetValue(i) // 3 == step for i in range(count))
    assert total(count) == 3
all_ranks.wait()
for kind, source in KINDS.items():
    made = reader(kind, granular.files(f"series/{kind}_*{os.path.splitext(source)[1]}"), RepeatedSteps=2)
    assert rows(made, 0) == alone[kind], kind
all_ranks.wait()
if rank == 0:
    shutil.rmtree("series")
print("the series was read")
