# SPDX-License-Identifier: BSD-3-Clause
"""Particles through time: paths of some, and mean square displacements of all, against decoding the same frames.

The particles walk at random in a periodic box, and their rows are in the order of cells of the box, as simulations have them: it
changes a little from frame to frame. Ids have no order in space."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import vtkgranular as vg
from scene import Rounds, main, open_dump, table

SELECTED = 1000
STEP = 2e-3  # rms along each axis from frame to frame, in box lengths
CELLS = 40   # along each axis


class Walk:
    """The unwrapped places at all frames, in the order of ids."""

    def __init__(self, particles, frames):
        random = numpy.random.default_rng(11)
        self.ids = random.permutation(particles) + 1
        places = [random.random((particles, 3))]
        for _ in range(frames - 1):
            places.append(places[-1] + STEP * random.standard_normal((particles, 3)))
        self.places, self.random = places, random

    def write(self, path):
        with vg.Writer(str(path), numbers="%g") as writer:
            for step, places in enumerate(self.places):
                images = numpy.floor(places)
                cells = ((places - images) * CELLS).astype(int) @ (1, CELLS, CELLS * CELLS)
                rows = numpy.argsort(cells, kind="stable")
                noise = self.random.standard_normal((len(rows), 6))
                writer.write({"id": self.ids[rows], "type": numpy.ones(len(rows), int), "points": (places - images)[rows],
                              "image": images[rows].astype(int), "v": noise[:, :3], "f": noise[:, 3:], "radius": abs(noise[:, 0])},
                             box=vg.Box((0, 0, 0), (1, 1, 1), boundary="pp pp pp"), step=step)
        return path


def times_of(reader):
    return reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS())


def open_run(path, *arrays):
    """A reader that knows the frames, and has shown the last one: points and these arrays, or all columns."""
    reader = open_dump(path)
    if arrays:
        reader.GetPointDataArraySelection().DisableAllArrays()
        for name in arrays:
            reader.GetPointDataArraySelection().EnableArray(name)
    reader.UpdateTimeStep(times_of(reader)[-1])
    return reader


def step_through(reader):
    for moment in times_of(reader):
        reader.UpdateTimeStep(moment)
    return reader.GetOutput()


def update(made):
    made.Update()
    return made.GetOutput()


def filter_on(reader, kind, **properties):
    made = kind()
    made.SetInputConnection(reader.GetOutputPort())
    for name, value in properties.items():
        getattr(made, "Set" + name)(value)
    return made


def paths(path):
    return filter_on(open_run(path, "id"), vg.vtkGranularTrajectories, Threads=1, NumberOfSamples=SELECTED)


def squares(path):
    return filter_on(open_run(path, "id"), vg.vtkGranularHistory, Threads=1, OutputType=vg.vtkGranularHistory.STATISTICS,
                     MeanSquareDisplacement=True)


def check_results(study, walk, path):
    """The paths end where the walk does, and the squares are those of the walk, to the digits of the text."""
    lines = update(paths(path))
    ids = vtk_to_numpy(lines.GetCellData().GetArray("id"))
    study.check(len(ids) == SELECTED, "number of paths")
    cells, points = lines.GetLines(), vtk_to_numpy(lines.GetPoints().GetData())
    ends = points[vtk_to_numpy(cells.GetOffsetsArray())[1:] - 1]
    rows = numpy.argsort(walk.ids)[ids - 1]
    moved = walk.places[-1] - walk.places[0]
    starts = points[vtk_to_numpy(cells.GetOffsetsArray())[:-1]]
    study.check(abs(ends - starts - moved[rows]).max() < 3e-6, "paths")
    msd = vtk_to_numpy(update(squares(path)).GetColumnByName("msd"))[-1]
    study.check(abs(msd / (moved ** 2).sum(1).mean() - 1) < 1e-4, "mean square displacement")


def study_of(study):
    particles, frames = study.pick(250_000, 5000), study.pick(12, 3)
    walk = Walk(particles, frames)
    path = walk.write(study.folder / "walk.dump")
    check_results(study, walk, path)
    times = Rounds(particles * frames)
    times.add("all columns", step_through, lambda: (open_run(path),))
    times.add("ids and positions", step_through, lambda: (open_run(path, "id"),))
    times.add("paths of 1000", update, lambda: (paths(path),))
    times.add("mean square displacement of all", update, lambda: (squares(path),))
    times.run(study.pick(5, 1))
    study.block("paths", "250,000 particles walk at random in a periodic box: 12 frames of 15 columns of %g, with image counts; rows in the order "
                "of places. The run is open. all columns, ids and positions: all frames are read, one after the other. Paths: of 1000 "
                "particles, a random sample. One thread, processor time.",
                table(["case", "time ns/particle and frame", "against all columns"], [
                    [f"`{case}`", f"{times.ns(case):.0f}", f"{times.ratio(case, 'all columns'):.2f}"] for case in times.contenders]))


main(study_of)
