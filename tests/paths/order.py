# SPDX-License-Identifier: BSD-3-Clause
"""Frames out of order, and a restarted run that repeats some steps: paths and tables are those of the run in order."""
import gzip
import os

import plain_paths
import vtkgranular as vg
from vtkmodules.util.numpy_support import vtk_to_numpy

WALK = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths", "walk.dump.gz")
text = gzip.open(WALK, "rt").read()
frames = ["ITEM: TIME\n" + part for part in text.split("ITEM: TIME\n")[1:]]  # of a frame the first line
assert len(frames) == 31


def write(name, parts):
    with open(name, "w") as file:
        file.write("".join(parts))
    return os.path.abspath(name)


def made_of(kind, paths, **properties):
    reader, made = vg.vtkGranularDumpReader(), getattr(vg, f"vtkGranular{kind}")()
    for path in paths:
        reader.AddFileName(path)
    made.SetInputConnection(reader.GetOutputPort())
    for name, value in properties.items():
        getattr(made, f"Set{name}")(value)
    made.Update()
    assert not made.GetErrorMessage(), made.GetErrorMessage()
    return made.GetOutput()


def columns_of(table):
    rows = table.GetRowData()
    return {rows.GetArrayName(i): vtk_to_numpy(rows.GetArray(i)).tobytes() for i in range(rows.GetNumberOfArrays())}


lines = plain_paths.lines_of(made_of("Trajectories", [WALK], Arrays="v"))
table = columns_of(made_of("History", [WALK], OutputType=1, Arrays="v", MeanSquareDisplacement=True))
for number, paths in enumerate((
        [write("backwards.dump", frames[::-1])],
        [write("mixed.dump", frames[1::2] + frames[::2])],
        [write("second.dump", frames[15:]), write("first.dump", frames[:15])],
        # the restart begins before the end of the run, which was killed
        [write("run.dump", frames[:20]), write("restarted.dump", frames[14:])],
        [write("appended.dump", frames[:20] + frames[14:])])):
    found = plain_paths.lines_of(made_of("Trajectories", paths, Arrays="v"))
    assert plain_paths.same(dict(sorted(found.items())), dict(sorted(lines.items()))), number
    assert columns_of(made_of("History", paths, OutputType=1, Arrays="v", MeanSquareDisplacement=True)) == table, number
print("in order")
