# SPDX-License-Identifier: BSD-3-Clause
"""Averages in cells: time and error against the size of cells, the width of kernels, and the number of frames.

The particles are equal spheres at random that do not overlap, in a periodic box: no place is special, so the expected volume
fraction and velocity of each cell are known exactly."""
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

import vtkgranular as vg
from scene import Rounds, main, open_dump, read_again, points_of, scientific, table

FRACTION = 0.3
SPEED = 1.0       # vx = SPEED * sin(2 pi z), and fluctuations of half of it
WEIGHTS = {"Centre": vg.vtkGranularEulerAverage.CENTRE, "Overlap": vg.vtkGranularEulerAverage.OVERLAP}
KERNELS = {"Gaussian": vg.vtkGranularEulerAverage.GAUSSIAN, "Lucy": vg.vtkGranularEulerAverage.LUCY,
           "Heaviside": vg.vtkGranularEulerAverage.HEAVISIDE}


def radius_of(particles):
    return (3 * FRACTION / (4 * math.pi * particles)) ** (1 / 3)


def packing(particles, seed):
    source = vg.vtkGranularPackingSource()
    source.SetNumberOfGrains(particles)
    source.SetBoxLengths(1, 1, 1)
    source.SetBoundary("pp pp pp")
    source.SetRadius(radius_of(particles))
    source.SetSeed(seed)
    source.Update()
    if source.GetOutput().GetNumberOfPoints() != particles:
        raise SystemExit("the packing lacks particles")
    return points_of(source.GetOutput())


def write_run(study, name, particles, frames, moves):
    random = numpy.random.default_rng(11)
    path = study.folder / f"{name}.dump"
    points = packing(particles, 1)
    with vg.Writer(str(path), numbers="%.17g") as writer:
        for frame in range(frames):
            if moves and frame:
                points = packing(particles, 1 + frame)
            v = random.standard_normal((particles, 3)) * 0.5 * SPEED
            v[:, 0] += SPEED * numpy.sin(2 * math.pi * points[:, 2])
            writer.write({"id": numpy.arange(1, particles + 1), "type": numpy.ones(particles, int), "points": points, "v": v,
                          "radius": numpy.full(particles, radius_of(particles)), "mass": numpy.ones(particles)},
                         box=vg.Box((0, 0, 0), (1, 1, 1), boundary="pp pp pp"), step=frame)
    return path


def average_of(reader, weights, cells, **properties):
    average = vg.vtkGranularEulerAverage()
    average.SetInputConnection(reader.GetOutputPort())
    for name, value in {"Threads": 1, "CellCounts": (cells,) * 3, "Weights": weights, **properties}.items():
        getattr(average, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    return average


def again(average):
    average.Modified()
    average.Update()


def field(average, name="volumefraction"):
    data = average.GetOutput()
    return vtk_to_numpy((data.GetCellData().GetArray(name) or data.GetPointData().GetArray(name)))


def rms(values):
    return math.sqrt((numpy.asarray(values) ** 2).mean())


def timed(study, averages, particles):
    times = Rounds(particles)
    for name, average in averages.items():
        again(average)
        times.add(name, again, lambda average=average: (average,))
    times.run(study.pick(3, 1))
    return times


def cells_study(study):
    """Centre against Overlap, whose volumes are exact: tests promise 1e-12 of a particle."""
    particles = study.pick(100_000, 2000)
    reader = open_dump(write_run(study, "cells", particles, 1, True))
    read_again(reader)
    rows, radius = [], radius_of(particles)
    for cells in study.pick((112, 56, 28, 14, 7, 3), (4,)):
        averages = {name: average_of(reader, weights, cells) for name, weights in WEIGHTS.items()}
        times = timed(study, averages, particles)
        error = rms(field(averages["Centre"]) - field(averages["Overlap"])) / FRACTION
        study.check(abs(field(averages["Overlap"]).mean() / FRACTION - 1) < 1e-9, "Overlap")
        rows.append((1 / cells / radius, times.ns("Centre"), times.ns("Overlap"), times.ratio("Overlap", "Centre"), error))
    study.block("cells", f"{particles:,} equal spheres at random that do not overlap and fill {FRACTION:.0%} of a periodic box. The time of a "
                "particle includes the cells. The error is that of the volume fraction, against its mean; that of Overlap is rounding. One "
                "thread, processor time.",
                table(["cell size / radius", "Centre ns/particle", "Overlap ns/particle", "Overlap against Centre", "error of Centre, rms"],
                      [[f"{size:.2g}", f"{centre:.0f}", f"{overlap:.0f}", f"{ratio:.1f}", scientific(error)]
                       for size, centre, overlap, ratio, error in rows]))
    study.picture("cells", lambda pyplot: plot_cells(pyplot, rows))
    kernels_study(study, reader, particles)


def plot_cells(pyplot, rows):
    figure, (time, error) = pyplot.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    sizes, centre, overlap, _, errors = zip(*rows)
    time.plot(sizes, centre, "s--", label="Centre")
    time.plot(sizes, overlap, "o-", label="Overlap")
    error.plot(sizes, errors, "s--", label="Centre")
    time.set_ylabel("time [ns/particle]")
    error.set_ylabel("error of the volume fraction, rms / mean")
    for axes in (time, error):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("cell size / radius")
        axes.grid(color="0.93")
        axes.legend(fontsize=8)
    return figure


def kernels_study(study, reader, particles):
    """Noise is the deviation of a field from its mean, which the expected field does not have."""
    rows, radius = [], radius_of(particles)
    for width in study.pick((1, 2, 5, 10), (5,)):
        cells = max(1, round(1 / (width * radius)))
        averages = {name: average_of(reader, kernel, cells, KernelWidth=width * radius) for name, kernel in KERNELS.items()}
        averages["Overlap"] = average_of(reader, WEIGHTS["Overlap"], max(1, round(cells / (4 * math.pi / 3) ** (1 / 3))))
        times = timed(study, averages, particles)
        rows.append([width, *(cell for name, average in averages.items()
                              for cell in (f"{rms(field(average) / field(average).mean() - 1):.3f}", f"{times.ns(name):.0f}"))])
    study.block("kernels", "The same particles. Noise is the root mean square of the volume fraction's deviations, over its mean. The grid is as "
                "fine as the width; Overlap in cells as large as the sphere of Heaviside. One thread, processor time.",
                table(["width / radius", *(f"{name} {what}" for name in (*KERNELS, "Overlap") for what in ("noise", "ns/particle"))], rows))
    study.picture("kernels", lambda pyplot: plot_kernels(pyplot, rows))


def plot_kernels(pyplot, rows):
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    widths, *columns = numpy.array(rows, float).T
    for number, name in enumerate((*KERNELS, "Overlap")):
        for panel in (0, 1):
            axes[panel].plot(widths, columns[2 * number + panel], "o-" if name in KERNELS else "s--", label=name)
    axes[0].set_ylabel("noise of the volume fraction, rms / mean")
    axes[1].set_ylabel("time [ns/particle]")
    for each in axes:
        each.set(xscale="log", yscale="log", xlabel="width of the kernel / radius")
        each.grid(color="0.93")
        each.legend(fontsize=8)
    return figure


def errors_of(average, cells):
    """Of the volume fraction and of the mean of vx over each cell, rms, against the expected values."""
    lower = numpy.arange(cells ** 3) // cells ** 2 / cells
    wave = [numpy.cos(2 * math.pi * z) for z in (lower, lower + 1 / cells)]
    expected = SPEED * (wave[0] - wave[1]) * cells / (2 * math.pi)
    return rms(field(average) - FRACTION), rms(field(average, "v_avg")[:, 0] - expected) / SPEED


def frames_study(study):
    """More frames, for particles that move and for particles at rest; time is that of reading and averaging all frames."""
    particles, cells, counts = study.pick(20_000, 2000), 8, study.pick((1, 4, 16), (1, 2))
    found = {}
    for motion in ("moving", "at rest"):
        for count in counts:
            reader = open_dump(write_run(study, f"{motion}_{count}", particles, count, motion == "moving"))
            averages = {name: average_of(reader, weights, cells, TimeAverage=True) for name, weights in WEIGHTS.items()}
            times = Rounds(particles)
            for name, average in averages.items():
                times.add(name, lambda reader=reader, average=average: (reader.Modified(), average.Update()))
            times.run(study.pick(2, 1))
            for name, average in averages.items():
                found[motion, name, count] = (times.ns(name), *errors_of(average, cells))
    size = 1 / cells / radius_of(particles)
    study.block("frames", f"{particles:,} such spheres in 8 x 8 x 8 cells of {size:.1f} radii. Moving: in each frame at other places. At rest: at the "
                f"same places in all frames. The expected volume fraction is {FRACTION}. The velocity is a wave, sin(2 pi z), and fluctuations "
                "of half its amplitude that are new in each frame. Time is that of reading and averaging all frames.",
                table(["case", "time ns/particle", "error of the volume fraction, rms", "error of the velocity, rms [amplitude]"], [
                    [f"`{motion}, {name}, {count} frame{'s' if count > 1 else ''}`", f"{time:.0f}", scientific(fraction), scientific(velocity)]
                    for (motion, name, count), (time, fraction, velocity) in found.items()]))


def study_of(study):
    cells_study(study)
    frames_study(study)


main(study_of)
