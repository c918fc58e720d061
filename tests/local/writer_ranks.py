# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the files are those that one process writes."""
import gzip
import os

import all_ranks
import granular
import plain_local
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "local")
rank = all_ranks.ranks.GetLocalProcessId()


def content(path):
    if all_ranks.symmetric:
        all_ranks.ranks.Barrier()
    with open(path, "rb") as file:
        read = file.read()
    if all_ranks.symmetric:
        all_ranks.ranks.Barrier()
    return read


def alone(source, preset, port, way, **properties):
    """What a process writes that knows of no other."""
    reader, writer = granular.vtkGranularLocalReader(), granular.vtkGranularLocalWriter()
    reader.SetController(None)
    writer.SetController(None)
    reader.AddFileName(os.path.join(data, source))
    reader.SetPeriodicLines(way)
    reader.SetPreset(preset)
    writer.SetInputConnection(reader.GetOutputPort(port))
    writer.SetFileName(f"alone_{rank}.bonds")
    writer.WriteTimeStepsOn()
    for name, value in properties.items():
        getattr(writer, f"Set{name}")(value)
    assert writer.Write() == 1
    with open(writer.GetFileName(), "rb") as file:
        return file.read()


# ---- real files, as lines, split and not, and as tables ----------------------------------------------------

CONTACTS, BONDS = (granular.vtkGranularLocalReader.CONTACTS_FORCE, granular.vtkGranularLocalReader.BOND_TYPE_IDS_FORCE)
for source, preset, port, way in (("contacts.dump", CONTACTS, 0, 0), ("contacts.dump", CONTACTS, 0, 1),
                                  ("contacts.dump", CONTACTS, 0, 2), ("chain_bonds.dump", BONDS, 1, 0)):
    expected = alone(source, preset, port, way, Label="BONDS")
    assert expected.count(b"ITEM: NUMBER OF BONDS") > 2
    reader = GranularLocalReader(FileNames=[os.path.join(data, source)], Preset=preset)
    reader.PeriodicLines = ["MinimumImage", "Split", "AsWritten"][way]
    for mode in ("Gather", "MPI-IO"):
        granular.save(OutputPort(reader, port), "real.bonds", Label="BONDS", WriteTimeSteps=1, ParallelMode=mode, Threads=2)
        assert content("real.bonds") == expected, (source, port, way, mode)
        SaveData("data.bonds", OutputPort(reader, port), Label="BONDS", WriteTimeSteps=1, ParallelMode=mode)
        assert content("data.bonds") == expected, (source, port, way, mode)
    granular.save(OutputPort(reader, port), "real.bonds.gz", writer="GranularLocalWriter", Label="BONDS", WriteTimeSteps=1)
    assert gzip.decompress(content("real.bonds.gz")) == expected
    Delete(reader)

# ---- lines of joins: each bond once, wherever it is, in any order --------------------------------------------

grains = GranularDumpReader(FileNames=[os.path.join(data, "chain.dump")])
bonds = GranularLocalReader(FileNames=[os.path.join(data, "chain_bonds.dump")], Preset=BONDS)
names = ["id1", "id2", "elongation", "x1", "y1", "z1", "x2", "y2", "z2"]
for way in ("MinimumImage", "Split"):
    joined = GranularLocalJoin(Input=grains, Lines=OutputPort(bonds, 1), PeriodicLines=way, EquilibriumLength=1)
    granular.save(joined, "joined.bonds", Columns=names, time=1000)
    content("joined.bonds")
    frame, = plain_local.read("joined.bonds")
    assert frame.timestep == 1000 and frame.names == names
    expected = plain_local.read(os.path.join(data, "chain_bonds.dump"))[2]
    assert sorted(row[:2] for row in frame.rows) == sorted(row[1:3] for row in expected.rows)
    Delete(joined)

# ---- ranks without rows, that know nothing -------------------------------------------------------------------

contacts = GranularLocalReader(FileNames=[os.path.join(data, "contacts.dump")], Preset=CONTACTS)
processes = all_ranks.ranks.GetNumberOfProcesses()
for left_out in range(processes if processes > 1 else 0):
    holes = ProgrammableFilter(Input=contacts, Script=f"""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == {left_out}:
    output.VTKObject.Initialize()
else:
    output.VTKObject.ShallowCopy(inputs[0].VTKObject)
""")
    holes.UpdatePipeline(2000)
    granular.save(holes, "holes.bonds")
    content("holes.bonds")
    frame, = plain_local.read("holes.bonds")
    whole = plain_local.read(os.path.join(data, "contacts.dump"))[2]
    assert frame.timestep == 2000 and frame.bounds == whole.bounds and frame.boundary == whole.boundary
    ids = [row[6:8] for row in frame.rows]
    every = [row[6:8] for row in whole.rows]
    assert 0 < len(ids) < len(every) and [row for row in every if row in ids] == ids
    Delete(holes)

# ---- one file a process ----------------------------------------------------------------------------------------

granular.save(contacts, "piece_*.%.bonds", WriteTimeSteps=1, Dialect="LIGGGHTS")
content("piece_2000.0.bonds")
pieces = [plain_local.read(f"piece_2000.{i}.bonds")[0] for i in range(processes)]
expected = plain_local.read(os.path.join(data, "contacts.dump"))[2]
assert [row[6:] for piece in pieces for row in piece.rows] == [row[6:] for row in expected.rows]
print("written")
