# SPDX-License-Identifier: BSD-3-Clause
"""A dump that grows while the reader looks at it: UpdatePipeline looks twice, and each rank gets its part all the same."""
import os

from paraview.simple import *

ROWS = 300


def frame(step):
    return (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{ROWS}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
            + "".join(f"{i} 0.{i} 0.5 0.25\n" for i in range(1, ROWS + 1)))


def append(text):
    with open("growing.dump", "a", encoding="ascii") as out:
        out.write(text)


def grow(reader, _):
    """Completes the file when the first look has seen it."""
    global waiting
    if reader.GetProgress() == 1:
        append(waiting)
        waiting = ""


waiting = ""
with open("growing.dump", "w", encoding="ascii"):
    pass
reader = GranularDumpReader(FileNames=[os.path.abspath("growing.dump")], RefreshOnUpdate=1)
calculator = Calculator(Input=reader, Function="id")
reader.GetClientSideObject().AddObserver("ProgressEvent", grow)
for step, source in enumerate((reader, reader, calculator, calculator, reader)):
    text = frame(step)
    append(text[:4000])
    waiting = text[4000:]
    source.UpdatePipeline(step)
    assert waiting == "", step
    assert source.GetDataInformation().GetNumberOfPoints() == ROWS, (step, source.GetDataInformation().GetNumberOfPoints())
    reader.UpdatePipelineInformation()
    assert list(reader.TimestepValues) == list(range(step + 1)), reader.TimestepValues
    assert source.GetDataInformation().GetNumberOfPoints() == ROWS
print("each has its part")
