# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read: one error that says what was understood, empty outputs, no rank waits, and ParaView lives on."""
import os
import struct

import all_ranks
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good", "restart")
fibres = os.path.join(data, "fibres.restart")
with open(fibres, "rb") as file:
    whole = file.read()
record = whole.index(struct.pack("<d", 65.0))  # of a particle with two bonds
bonds = record + 8 * (17 + 12)
assert struct.unpack_from("<d", whole, bonds)[0] == 2
files = {"restart.cut": whole[:-100],
         "restart.many": whole[:bonds] + struct.pack("<d", 2e9) + whole[bonds + 8:],
         "restart.lammps": b"LammpS RestartT\0" + bytes(200),
         "restart.base.7": open(os.path.join(data, "parts.base.restart"), "rb").read()}
if all_ranks.ranks.GetLocalProcessId() == 0:
    for name, content in files.items():
        with open(name, "wb") as file:
            file.write(content)
all_ranks.ranks.Barrier() if all_ranks.symmetric else None


def expect(reader, *counts):
    reader.UpdatePipeline()
    for port, count in enumerate(counts):
        information = OutputPort(reader, port).GetDataInformation()
        found = information.GetNumberOfCells() if port else information.GetNumberOfPoints()
        assert found == count or (all_ranks.symmetric and count > 0), (port, found, count)


for name in ("restart.gone", *files):
    reader = GranularRestartReader(FileNames=[os.path.abspath(name)])
    expect(reader, 0, 0, 0)
    reader.FileNames = [fibres]
    expect(reader, 31, 27, 1)
    Delete(reader)

# of a run that was stopped while it wrote, the file before is shown
reader = GranularRestartReader(FileNames=[os.path.abspath("restart.cut"), fibres])
expect(reader, 31, 27, 1)
print("alive")
