# SPDX-License-Identifier: BSD-3-Clause
"""What one rank alone cannot read, and what none can: one error, empty outputs, none waits, and ParaView lives on."""
import os

import all_ranks
from paraview.simple import *

good = os.path.join(os.environ["GRANULAR_DATA"], "good", "data_file", "full.data")
head = "a title\n\n200 atoms\n0 10 xlo xhi\n\nAtoms # atomic\n\n"
rows = [f"{i} 1 0.5 0.5 0.5\n" for i in range(1, 201)]
speeds = [f"{i} 1 2 3\n" for i in range(200, 0, -1)]


def text(rows, speeds):
    return head + "".join(rows) + "Velocities\n\n" + "".join(speeds)


texts = {"short.data": text(rows[:-1], speeds),
         "word.data": text(rows[:187] + [rows[187].replace(" 1 0.5", " 1 0.O")] + rows[188:], speeds),
         "missing.data": text(rows, ["201 1 2 3\n"] + speeds[1:]),
         "twice.data": text(rows, ["1 1 2 3\n"] + speeds[1:])}
if all_ranks.ranks.GetLocalProcessId() == 0:
    for name, content in texts.items():
        with open(name, "w") as file:
            file.write(content)
all_ranks.ranks.Barrier() if all_ranks.symmetric else None


def expect(reader, *counts):
    reader.UpdatePipeline()
    for port, count in enumerate(counts):
        information = OutputPort(reader, port).GetDataInformation()
        found = information.GetNumberOfCells() if port else information.GetNumberOfPoints()
        assert found == count or (all_ranks.symmetric and count > 0), (port, found, count)


for name in ("gone.data", *texts):
    reader = GranularDataFileReader(FileNames=[os.path.abspath(name)])
    expect(reader, 0, 0, 0)
    reader.FileNames = [good]
    expect(reader, 40, 3, 1)
    Delete(reader)
print("alive")
