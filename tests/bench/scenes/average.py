# SPDX-License-Identifier: BSD-3-Clause
"""Averages in cells: what more frames bring, for particles that move and for particles at rest, and what files of cells keep.

The particles are equal spheres at random that do not overlap, in a periodic box: no place is special, so the expected volume
fraction and velocity of each cell are known exactly."""
import math
import re

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import granular
from scene import Rounds, main, open_dump, points_of

CELLS = (4, 8, 16)  # along each axis
FRAMES = (1, 2, 4, 8, 16, 32)
PARTICLES = 20_000
FRACTION = 0.3
SPEED = 1.0       # vx = SPEED * sin(2 pi z), and fluctuations of half of it
RADIUS = (3 * FRACTION / (4 * math.pi * PARTICLES)) ** (1 / 3)


def packing(seed):
    source = granular.vtkGranularPackingSource()
    source.SetNumberOfGrains(PARTICLES)
    source.SetBoxLengths(1, 1, 1)
    source.SetBoundary("pp pp pp")
    source.SetRadius(RADIUS)
    source.SetSeed(seed)
    source.Update()
    return points_of(source.GetOutput())


def write_run(study, name, frames, moves):
    random = numpy.random.default_rng(11)
    path = study.folder / f"{name}.dump"
    points = packing(1)
    study.check(len(points) == PARTICLES, "packing")
    with open(path, "w", encoding="ascii") as out:
        for frame in range(frames):
            if moves and frame:
                points = packing(1 + frame)
            v = random.standard_normal((PARTICLES, 3)) * 0.5 * SPEED
            v[:, 0] += SPEED * numpy.sin(2 * math.pi * points[:, 2])
            out.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{PARTICLES}\nITEM: BOX BOUNDS pp pp pp\n"
                      "0 1\n0 1\n0 1\nITEM: ATOMS id type x y z vx vy vz radius mass \n")
            numpy.savetxt(out, numpy.column_stack((numpy.arange(1, PARTICLES + 1), numpy.ones(PARTICLES), points, v,
                                                   numpy.full((PARTICLES, 2), (RADIUS, 1)))),
                          fmt="%d %d" + 6 * " %.9g" + " %.17g %g")
    return path


def cells_of(reader, weights, cells, **properties):
    average = granular.vtkGranularEulerAverage()
    average.SetInputConnection(reader.GetOutputPort())
    average.SetThreads(1)
    average.SetCellCounts(cells, cells, cells)
    average.SetWeights(weights)
    for name, value in properties.items():
        getattr(average, "Set" + name)(value)
    return average


def cell_array(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name))


def tell_errors(study, case, data, cells):
    """Against the expected values: the volume fraction, and the mean of vx over each cell."""
    lower = numpy.arange(cells ** 3) // cells ** 2 / cells
    wave = [numpy.cos(2 * math.pi * z) for z in (lower, lower + 1 / cells)]
    v = cell_array(data, "v_avg")[:, 0]
    study.tell(case, "volume fraction, rms error", math.sqrt(((cell_array(data, "volumefraction") - FRACTION) ** 2).mean()), "1")
    expected = SPEED * (wave[0] - wave[1]) * cells / (2 * math.pi)
    study.tell(case, "velocity, rms error", math.sqrt(((v - expected) ** 2).mean()) / SPEED, "of the speed")


def first_frames(study, path, count):
    part = study.folder / f"first_{count}.dump"
    frames = path.read_text(encoding="ascii").split("ITEM: TIMESTEP")[1:count + 1]
    part.write_text("".join("ITEM: TIMESTEP" + frame for frame in frames), encoding="ascii")
    return part


def frames_study(study):
    all_cells = study.pick(CELLS, CELLS[:2])
    for motion, moves, frames in (("moving", True, FRAMES), ("at rest", False, FRAMES[::2])):
        frames = study.pick(frames, frames[:2])
        path = write_run(study, motion.replace(" ", "_"), frames[-1], moves)
        times = Rounds()
        for count in frames:
            reader = open_dump(first_frames(study, path, count))
            for cells in all_cells:
                for weights, which in (("Centre", 0), ("Overlap", 1)):
                    average = cells_of(reader, which, cells, TimeAverage=True)
                    average.Update()
                    case = f"{motion}, {weights}, {cells}^3 cells, {count} frames"
                    tell_errors(study, case, average.GetOutput(), cells)
                    study.tell(case, "cell size", 1 / cells / RADIUS, "radius")
                    study.tell(case, "frames", count, "1")
                    times.add(case, lambda reader=reader, average=average: (reader.Modified(), average.Update()))
        times.run(study.pick(2, 1))
        for case in times.contenders:
            study.tell(case, "time", 1e9 * times.time(case) / PARTICLES, "ns/particle")
            one = re.sub(r"\d+ frames$", "1 frames", case)
            study.tell(case, "time against 1 frame", times.ratio(case, one), "1")


def files_study(study):
    """Files of cells: six decimals, as LIGGGHTS writes them, against all digits."""
    path = write_run(study, "one", 1, True)
    cells = CELLS[1]
    average = cells_of(open_dump(path), 1, cells)
    average.Update()
    for name, dialect in (("six decimals", granular.vtkGranularEulerWriter.LIGGGHTS), ("Wide", granular.vtkGranularEulerWriter.WIDE)):
        writer = granular.vtkGranularEulerWriter()
        writer.SetInputConnection(average.GetOutputPort())
        out = study.folder / f"cells_{dialect}.euler"
        writer.SetFileName(str(out))
        writer.SetDialect(dialect)
        study.check(writer.Write(), name)
        reader = granular.vtkGranularEulerReader()
        reader.AddFileName(str(out))
        reader.SetOutputType(reader.IMAGE_DATA)
        reader.Update()
        for array in ("volumefraction", "v_avg", "radius", "pressure"):
            found, true = (cell_array(data, array) for data in (reader.GetOutputDataObject(0), average.GetOutput()))
            study.tell(name, f"{array}, largest error", numpy.abs(found - true).max() / numpy.sqrt((true ** 2).mean()), "rms")
        study.tell(name, "size", out.stat().st_size / cells ** 3, "B/cell")


def study_of(study):
    frames_study(study)
    files_study(study)


main(study_of)
