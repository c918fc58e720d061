# SPDX-License-Identifier: BSD-3-Clause
"""Averages in cells: what more frames bring, for particles that move and for particles at rest, and what files of cells keep.

The particles are equal spheres at random, which may overlap: the expected volume fraction and velocity are known exactly."""
import math

import numpy

import granular
from scene import Rounds, array_of, main, open_dump

CELLS = 8        # along each axis
PARTICLES = 20_000
FRACTION = 0.3
SHEAR = 2.0      # vx = SHEAR * z, and fluctuations
RADIUS = (3 * FRACTION / (4 * math.pi * PARTICLES)) ** (1 / 3)


def write_run(study, name, frames, moves):
    random = numpy.random.default_rng(11)
    path = study.folder / f"{name}.dump"
    points = random.uniform(0, 1, (PARTICLES, 3))
    with open(path, "w", encoding="ascii") as out:
        for frame in range(frames):
            if moves:
                points = random.uniform(0, 1, (PARTICLES, 3))
            v = random.standard_normal((PARTICLES, 3)) * 0.5
            v[:, 0] += SHEAR * points[:, 2]
            out.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{PARTICLES}\nITEM: BOX BOUNDS pp pp pp\n"
                      "0 1\n0 1\n0 1\nITEM: ATOMS id type x y z vx vy vz radius mass \n")
            numpy.savetxt(out, numpy.column_stack((numpy.arange(1, PARTICLES + 1), numpy.ones(PARTICLES), points, v,
                                                   numpy.full((PARTICLES, 2), (RADIUS, 1)))),
                          fmt="%d %d" + 6 * " %.9g" + " %.17g %g")
    return path


def cells_of(reader, weights, **properties):
    average = granular.vtkGranularEulerAverage()
    average.SetInputConnection(reader.GetOutputPort())
    average.SetThreads(1)
    average.SetCellCounts(CELLS, CELLS, CELLS)
    average.SetWeights(weights)
    for name, value in properties.items():
        getattr(average, "Set" + name)(value)
    return average


def frames_study(study):
    most = study.pick(32, 4)
    for motion, moves in (("moving", True), ("at rest", False)):
        path = write_run(study, motion.replace(" ", "_"), most, moves)
        frames = [2 ** k for k in range(int(math.log2(most)) + 1)]
        for weights, which in (("Centre", 0), ("Overlap", 1)):
            times, filters = Rounds(), {}
            for count in frames:
                part = study.folder / f"first_{count}.dump"
                text = path.read_text(encoding="ascii").split("ITEM: TIMESTEP")[1:count + 1]
                part.write_text("".join("ITEM: TIMESTEP" + frame for frame in text), encoding="ascii")
                reader = open_dump(part)
                average = cells_of(reader, which, TimeAverage=True)
                average.Update()
                data = average.GetOutput()
                z = (numpy.arange(CELLS ** 3) // CELLS ** 2 + 0.5) / CELLS
                phi, v = array_of_cells(data, "volumefraction"), array_of_cells(data, "v_avg")
                case = f"{motion}, {weights}, {count} frames"
                study.tell(case, "volume fraction, rms error", math.sqrt(((phi - FRACTION) ** 2).mean()), "1")
                study.tell(case, "velocity, rms error", math.sqrt(((v[:, 0] - SHEAR * z) ** 2).mean()), "of shear")
                filters[case] = average
                times.add(case, lambda reader=reader, average=average: (reader.Modified(), average.Update()))
            times.run(study.pick(3, 1))
            for case in filters:
                study.tell(case, "time", 1e9 * times.time(case) / PARTICLES, "ns/particle")
                study.tell(case, "time against 1 frame", times.ratio(case, next(iter(filters))), "1")


def array_of_cells(data, name):
    for holder in (data.GetCellData(), data.GetPointData()):
        array = holder.GetArray(name)
        if array:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            return vtk_to_numpy(array)
    raise SystemExit(f"no array {name}: {[data.GetCellData().GetArrayName(i) for i in range(data.GetCellData().GetNumberOfArrays())]}")


def files_study(study):
    """Files of cells: six decimals, as LIGGGHTS writes them, against all digits."""
    path = write_run(study, "one", 1, True)
    average = cells_of(open_dump(path), 1)
    average.Update()
    truth = average.GetOutput()
    for name, dialect in (("six decimals", 0), ("Wide", 1)):
        writer = granular.vtkGranularEulerWriter()
        writer.SetInputConnection(average.GetOutputPort())
        out = study.folder / f"cells_{dialect}.euler"
        writer.SetFileName(str(out))
        writer.SetDialect(dialect)
        study.check(writer.Write(), name)
        reader = granular.vtkGranularEulerReader()
        reader.AddFileName(str(out))
        reader.Update()
        for array in ("volumefraction", "v_avg", "radius", "stress"):
            try:
                found, true = (array_of_cells(data, array) for data in (reader.GetOutput(), truth))
            except SystemExit:
                continue
            scale = numpy.sqrt((true ** 2).mean())
            study.tell(name, f"{array}, largest error", numpy.abs(found - true).max() / scale, "rms")
        study.tell(name, "size", out.stat().st_size / CELLS ** 3, "B/cell")


def study_of(study):
    frames_study(study)
    files_study(study)


main(study_of)
