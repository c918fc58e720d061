# SPDX-License-Identifier: BSD-3-Clause
"""What one rank alone cannot read: one error, which names the rank; all go on with the next file."""
import os

from paraview.simple import *

rows = [f"{i:04d} 0.5 0.5 0.5\n" for i in range(1, 1001)]
rows[900] = "0901 0.5 zero 0.5\n"
with open("broken.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1000\nITEM: BOX BOUNDS pp pp pp\n"
               "0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n" + "".join(rows))
for sort in (0, 1):
    reader = GranularDumpReader(FileNames=[os.path.abspath("broken.dump")], SortById=sort)
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 0
    reader.FileNames = [os.path.abspath("gone.dump")]
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 0
    reader.FileNames = [os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")]
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 1200
    Delete(reader)
print("alive")
