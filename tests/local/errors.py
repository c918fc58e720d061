# SPDX-License-Identifier: BSD-3-Clause
"""What one rank alone cannot read, and what none can: one error, empty outputs, none waits, and ParaView lives on."""
import os

import all_ranks
from paraview.simple import *

good = os.path.join(os.environ["GRANULAR_DATA"], "good", "local", "chain_bonds.dump")
HEAD = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1000\nITEM: ENTRIES "
rows = [f"0.5 0.5 0.5 0.6 0.5 0.5 {i:04d} {i + 1:04d}\n" for i in range(1000)]
bad = rows[:900] + [rows[900].replace("0.6 ", "O.6 ")] + rows[901:]
texts = {"word.dump": HEAD + "x1 y1 z1 x2 y2 z2 id1 id2\n" + "".join(bad),
         "silent.dump": HEAD + " ".join(f"c_a[{i}]" for i in range(1, 9)) + "\n" + "".join(rows),
         "short.dump": HEAD + "x1 y1 z1 x2 y2 z2 id1 id2\n" + "".join(rows[:-1]) + "0.5 0.5\n"}
if all_ranks.ranks.GetLocalProcessId() == 0:
    for name, text in texts.items():
        with open(name, "w") as file:
            file.write(text)
all_ranks.ranks.Barrier() if all_ranks.symmetric else None


def expect(reader, cells, rows):
    reader.UpdatePipeline()
    for port, count in enumerate((cells, rows)):
        information = OutputPort(reader, port).GetDataInformation()
        if not all_ranks.symmetric:
            assert (information.GetNumberOfRows() if port else information.GetNumberOfCells()) == count, (port, count)
        elif count == 0:
            assert (information.GetNumberOfRows() if port else information.GetNumberOfCells()) == 0


for name in ("gone.dump", *texts):
    reader = GranularLocalReader(FileNames=[os.path.abspath(name)])
    expect(reader, 0, 0)
    if name == "silent.dump":
        reader.ColumnMap = "x1 y1 z1 x2 y2 z2 id1 id2"
        expect(reader, 1000, 1000)
    reader.FileNames = [good]
    reader.ColumnMap = ""
    expect(reader, 0, 96)
    Delete(reader)
print("alive")
