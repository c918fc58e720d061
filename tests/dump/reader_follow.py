# SPDX-License-Identifier: BSD-3-Clause
"""Follow a run that is being written, as scripts and the time controls of ParaView do.

What ParaView 5.11 does, and what is tested here:
- UpdatePipelineInformation() always asks the reader, and brings its times to TimestepValues and to
  the time keeper. UpdateAnimationUsingDataTimeSteps() of the scene does that as well.
- UpdatePipeline(time) always asks the reader; TimestepValues stays as it was.
- UpdatePipeline() without a time, and Render(), do not ask a reader that is up to date: nothing can be
  found there, whatever RefreshOnUpdate is.
- The scene goes to no time beyond those that it knows.
"""
import os

from paraview.simple import *


def frame(step, rows):
    """So many grains."""
    return (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{rows}\nITEM: BOX BOUNDS pp pp ff\n"
            "0 1\n0 1\n0 1\nITEM: ATOMS id type x y z radius\n" +
            "".join(f"{i} 1 0.{i} 0.5 0.25 0.05\n" for i in range(1, rows + 1)))


class Run:
    """A file that grows by a frame at a time."""

    def __init__(self, name):
        self.path = os.path.abspath(name)
        self.steps = []
        if os.path.exists(self.path):
            os.remove(self.path)
        self.write()

    def write(self):
        step = 10 * len(self.steps)
        with open(self.path, "a") as file:
            file.write(frame(step, len(self.steps) + 1))
        self.steps.append(step)

    def last(self):
        return self.steps[-1]

    def rows(self):
        return len(self.steps)


def points(source):
    return source.GetDataInformation().GetNumberOfPoints()


# ---- without RefreshOnUpdate, Reload Files does it ---------------------------------------------

run = Run("off.dump")
reader = OpenDataFile(run.path)
assert reader.RefreshOnUpdate == 0
reader.UpdatePipeline()
run.write()
for update in (reader.UpdatePipelineInformation, lambda: reader.UpdatePipeline(10)):
    update()
    assert list(reader.TimestepValues) == [0] and points(reader) == 1
reader.PointArrayStatus = ["id"]
ReloadFiles(reader)
assert list(reader.TimestepValues) == [0, 10], reader.TimestepValues
reader.UpdatePipeline(10)
assert points(reader) == 2
assert list(reader.PointArrayStatus) == list(reader.PointData.keys()) == ["id"], reader.PointData.keys()
Delete(reader)

# ---- with it, whatever asks the reader finds what there is -------------------------------------

run = Run("text.dump")
reader = OpenDataFile(run.path)
reader.RefreshOnUpdate = 1
calculator = Calculator(Input=reader, Function="2*radius")
reader.UpdatePipeline()
assert points(reader) == 1
for round in range(3):
    run.write()
    reader.UpdatePipelineInformation()
    assert list(reader.TimestepValues) == run.steps, reader.TimestepValues
    assert list(GetTimeKeeper().TimestepValues) == run.steps
    reader.UpdatePipeline(run.last())
    assert points(reader) == run.rows(), points(reader)
    # a time beyond the end shows the last frame there is, then as now
    for again in range(2):
        run.write()
        reader.UpdatePipeline(1e6)
        assert points(reader) == run.rows(), points(reader)
    # through a filter
    run.write()
    calculator.UpdatePipeline(run.last())
    assert points(calculator) == run.rows(), points(calculator)
    calculator.UpdatePipelineInformation()
    reader.UpdatePipelineInformation()
    assert list(reader.TimestepValues) == run.steps
    # what is fetched is what is there
    assert servermanager.Fetch(calculator).GetNumberOfPoints() == run.rows()
Delete(calculator)
Delete(reader)

# ---- a run that starts over --------------------------------------------------------------------

run = Run("over.dump")
reader = OpenDataFile(run.path)
reader.RefreshOnUpdate = 1
reader.PointArrayStatus = ["id"]
reader.UpdatePipeline()
with open(run.path, "w") as file:
    file.write(frame(0, 4) + frame(5, 5) + frame(9, 6))
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == [0, 5, 9], reader.TimestepValues
reader.UpdatePipeline(5)
assert points(reader) == 5
assert list(reader.PointData.keys()) == ["id"], reader.PointData.keys()
Delete(reader)

# ---- in a view, with its time controls ---------------------------------------------------------

ResetSession()
run = Run("animated.dump")
run.write()
reader = OpenDataFile(run.path)
reader.RefreshOnUpdate = 1
view = GetActiveViewOrCreate("RenderView")
shown = Show(reader, view)
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()


def seen():
    Render(view)
    return shown.GetRepresentedDataInformation().GetNumberOfPoints()


assert seen() == 1
scene.GoToLast()
assert seen() == 2
for update in (scene.UpdateAnimationUsingDataTimeSteps, reader.UpdatePipelineInformation,
               lambda: ReloadFiles(reader)):
    run.write()
    update()
    assert list(GetTimeKeeper().TimestepValues) == run.steps
    scene.GoToLast()
    assert view.ViewTime == run.last() and seen() == run.rows(), (view.ViewTime, seen())
    scene.GoToFirst()
    assert seen() == 1
    scene.GoToNext()
    assert seen() == 2
# while it plays, frames that come do no harm
scene.GoToFirst()
run.write()
scene.Play()
assert seen() == run.rows() - 1
scene.UpdateAnimationUsingDataTimeSteps()
scene.Play()
assert seen() == run.rows()
# a view may be at any time
run.write()
view.ViewTime = run.last()
assert seen() == run.rows()
