# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the files are those that one process writes."""
import gzip
import os

import granular
import numpy
import plain_dump
from paraview.simple import *
from vtkmodules.vtkParallelCore import vtkMultiProcessController

ranks = vtkMultiProcessController.GetGlobalController()
symmetric = servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode()
# without --sym this is the only process that runs the script, and knows of the others by ParaView alone
count, rank = ranks.GetNumberOfProcesses(), ranks.GetLocalProcessId()


def good(name):
    return os.path.join(os.environ["GRANULAR_DATA"], "good", name)


def content(path):
    if symmetric:
        ranks.Barrier()
    with open(path, "rb") as file:
        read = file.read()
    if symmetric:
        ranks.Barrier()
    return read


def alone(source, end, **properties):
    """What a process writes that knows of no other."""
    reader = granular.vtkGranularDumpReader()
    reader.SetController(None)
    reader.AddFileName(source)
    writer = granular.vtkGranularDumpWriter()
    writer.SetController(None)
    writer.SetInputConnection(reader.GetOutputPort())
    writer.SetFileName(f"alone_{rank}{end}")
    writer.WriteTimeStepsOn()
    for name, value in properties.items():
        getattr(writer, f"Set{name}")(value)
    assert writer.Write() == 1
    with open(writer.GetFileName(), "rb") as file:
        return file.read()


# ---- the programs' own bytes -----------------------------------------------------------------------

reader = GranularDumpReader(FileNames=[good("grains.dump")])
whole = content(good("grains.dump"))
for mode in ("Gather", "MPI-IO"):
    SaveData("a.dump", reader, WriteTimeSteps=1, Dialect="LIGGGHTS", ParallelMode=mode)
    assert content("a.dump") == whole, mode
    granular.save(reader, "dump.grains", WriteTimeSteps=1, Dialect="LIGGGHTS", ParallelMode=mode)
    assert content("dump.grains") == whole, mode
    image = GranularDumpReader(FileNames=[good("ortho_image.bin")])
    SaveData("a.bin", image, WriteTimeSteps=1, Style="Atom", Scaled=0, Image=1, ParallelMode=mode)
    assert content("a.bin") == content(good("ortho_image.bin")), mode
for step, frame in zip((0, 1000, 2000), whole.split(b"ITEM: TIMESTEP")[1:]):
    granular.save(reader, "step_*.dump.gz", WriteTimeSteps=1, Dialect="LIGGGHTS")
    assert gzip.decompress(content(f"step_{step}.dump.gz")) == b"ITEM: TIMESTEP" + frame

# ---- those of one process ---------------------------------------------------------------------------

for end in (".dump", ".dump.gz", ".dump.zst", ".bin"):
    for sort in (0, 1):
        expected = alone(good("grains.dump"), end, SortById=sort)
        for mode in ("Gather", "MPI-IO"):
            SaveData("a" + end, reader, WriteTimeSteps=1, SortById=sort, ParallelMode=mode)
            assert content("a" + end) == expected, (end, sort, mode)

# ---- one file a process -------------------------------------------------------------------------------

granular.save(reader, "piece_*.%.dump", WriteTimeSteps=1, Dialect="LIGGGHTS")
content("piece_0.0.dump")
names = [f"piece_{step}.{i}.dump" for step in (1000, 2000) for i in range(8)
         if os.path.exists(f"piece_{step}.{i}.dump")]
pieces = [plain_dump.read(name)[0] for name in names]
assert len(names) % 2 == 0 and (not symmetric or len(names) == 2 * count)
for step, frame in zip((1000, 2000), plain_dump.read(good("grains.dump"))[1:]):
    assert [word for piece in pieces if piece.timestep == step for word in piece.columns["id"]] == \
        frame.columns["id"]
again = GranularDumpReader(FileNames=[os.path.abspath(name) for name in names])
assert list(again.TimestepValues) == [1000, 2000], again.TimestepValues
again.UpdatePipeline(2000)
SaveData("union.dump", again, Dialect="LIGGGHTS")
assert content("union.dump") == b"ITEM: TIMESTEP" + whole.split(b"ITEM: TIMESTEP")[3]

# ---- a rank without rows ------------------------------------------------------------------------------

marked = ProgrammableFilter(Input=reader, CopyArrays=1, Script="""
import numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController
number = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
output.PointData.append(numpy.full(output.GetNumberOfPoints(), number), "process")
""")
marked.UpdatePipeline(2000)
SaveData("a.dump", marked, SortById=1)
content("a.dump")
marks, = plain_dump.read("a.dump")
processes = marks.numbers("process")
assert marks.rows == 1200 and len(set(processes)) == (len(names) // 2), set(processes)
for first in (True, False) if len(set(processes)) > 1 else ():
    left_out = processes.min() if first else processes.max()
    rest = Threshold(Input=marked, Scalars=["POINTS", "process"])
    rest.ThresholdMethod = "Above Upper Threshold" if first else "Below Lower Threshold"
    rest.UpperThreshold, rest.LowerThreshold = float(left_out) + 0.5, float(left_out) - 0.5
    for mode in ("Gather", "MPI-IO"):
        SaveData("b.dump", rest, ParallelMode=mode)
        content("b.dump")
        frame, = plain_dump.read("b.dump")
        assert frame.timestep == 2000 and list(frame.columns) == list(marks.columns)
        assert set(frame.numbers("process")) == set(processes) - {left_out}
        assert sorted(frame.numbers("id")) == sorted(marks.numbers("id")[processes != left_out])
print("written")
