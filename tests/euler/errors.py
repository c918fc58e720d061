# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be read is an error on all ranks, the output is empty, none waits, and ParaView lives on."""
import os

import all_ranks
import plain_euler
import granular
from paraview.simple import *

first = all_ranks.ranks.GetLocalProcessId() == 0
cells = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2)))
good = plain_euler.text(cells)
cells["centres"][5] = [7, 7, 7]
other = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (3, 2, 2)))
texts = {"word_1.vtk": good.replace("LOOKUP_TABLE default\n", "LOOKUP_TABLE default\nx", 1),
         "no_grid_1.vtk": plain_euler.text(cells), "later_1.vtk": good, "later_2.vtk": plain_euler.text(other),
         "small_1.vtk": plain_euler.text(plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (1, 1, 2))))}
for name, text in texts.items():
    with open(name, "w") as file:
        file.write(text)


def cells_of(reader, time=None):
    reader.UpdatePipeline(*([] if time is None else [time]))
    return reader.GetDataInformation().GetNumberOfCells()


reader = GranularEulerReader(FileNames=[os.path.abspath("gone.vtk")])
assert cells_of(reader) == 0
for output, expected in (("Points", 0), ("ImageData", 0)):
    reader = GranularEulerReader(FileNames=[os.path.abspath("word_1.vtk")], Output=output)
    assert cells_of(reader) == expected, output
reader = GranularEulerReader(FileNames=[os.path.abspath("no_grid_1.vtk")], Output="ImageData")
assert cells_of(reader) == 0
reader.Output = "Points"
assert cells_of(reader) == 8
reader = GranularEulerReader(FileNames=[os.path.abspath(f"later_{i}.vtk") for i in (1, 2)], Output="ImageData")
assert cells_of(reader, 1) == 8
assert cells_of(reader, 2) == 0
assert cells_of(reader, 1) == 8
reader.Output = "Points"
assert cells_of(reader, 2) == 12
# after an error another grid, that is smaller
granular.set_properties(reader, Output="ImageData")
assert cells_of(reader, 2) == 0
reader.FileNames = [os.path.abspath("small_1.vtk")]
assert cells_of(reader) == 2
print("alive")
