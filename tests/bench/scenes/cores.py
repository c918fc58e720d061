# SPDX-License-Identifier: BSD-3-Clause
"""Threads: the same bits, and the time on the wall."""
import os
import time
import zlib

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import vtkgranular as vg
from scene import Packing, Rounds, main, open_dump, read_again, table


NEIGHBOURS = 3  # contacts are as many as particles, times this


def contacts_of(particles):
    """Lines from each particle to the next ones in the file, each with a force along x."""
    lines, cells = vtkPolyData(), vtkCellArray()
    rows = numpy.arange(particles.GetNumberOfPoints())
    ends = numpy.concatenate([numpy.stack((rows, numpy.roll(rows, -k)), 1) for k in range(1, NEIGHBOURS + 1)])
    cells.SetData(2, numpy_to_vtk(ends.ravel(), deep=True, array_type=16))  # vtkTypeInt64Array
    lines.SetPoints(particles.GetPoints())
    lines.SetLines(cells)
    for name, values in (("id1", ends[:, 0] + 1), ("id2", ends[:, 1] + 1), ("force", numpy.eye(3)[[0] * len(ends)])):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        lines.GetCellData().AddArray(array)
    return lines


def bits(data):
    """A checksum of the points and arrays."""
    attributes = [data.GetPointData(), data.GetCellData()]
    arrays = [each.GetArray(i) for each in attributes for i in range(each.GetNumberOfArrays()) if each.GetArray(i)]
    return [zlib.crc32(vtk_to_numpy(array)) for array in arrays]


def again(made):
    made.Modified()
    made.Update()
    return made.GetOutput()


def works(study, path, packing, threads):
    """verb: work that returns a checksum of its result."""
    reader = open_dump(path, Threads=threads)
    data = read_again(open_dump(path))
    average = vg.vtkGranularEulerAverage()
    average.SetInputData(data)
    average.SetCellCounts(20, 20, 20)
    average.SetWeights(average.OVERLAP)
    sums = vg.vtkGranularContactSums()
    sums.SetInputData(data)
    sums.SetInputDataObject(1, contacts_of(data))
    writer = vg.vtkGranularDumpWriter()
    writer.SetInputData(data)
    out = study.folder / f"{threads}.dump"
    writer.SetFileName(str(out))
    for each in (average, sums, writer):
        each.SetThreads(threads)
    return {"read": (lambda: read_again(reader), lambda: bits(reader.GetOutput())),
            "average over cells": (lambda: again(average), lambda: bits(average.GetOutput())),
            "sum contacts": (lambda: again(sums), lambda: bits(sums.GetOutput())),
            "write": (writer.Write, lambda: zlib.crc32(out.read_bytes()))}


def study_of(study):
    packing = Packing(layers=study.pick(21, 1), lattice=study.pick(63, 8))
    path = packing.write(study.folder / "one.dump", "%g")
    counts = sorted({1, 2, len(os.sched_getaffinity(0))})
    ways, rows = {count: works(study, path, packing, count) for count in counts}, []
    for verb in ways[1]:
        times, found = Rounds(packing.rows * (NEIGHBOURS if "contacts" in verb else 1), time.perf_counter), {}
        for count in counts:
            work, result = ways[count][verb]
            work()
            found[count] = result()
            study.check(found[count] and found[count] == found[1], f"{verb}: {count} threads give other bits than one")
            times.add(count, work)
        times.run(study.pick(7, 1))
        rows += [[f"`{verb}, {count} thread{'s' if count > 1 else ''}`", f"{times.ns(count):.0f}", f"{1 / times.ratio(count, 1):.2f}"]
                 for count in counts]
    study.block("cores", "333,396 particles: a text of %g read, 20 x 20 x 20 Overlap cells averaged, 10^6 contacts summed on particles (per "
                "contact), a text of shortest numbers written. Time on the wall. All thread counts give the same bits, or this fails.",
                table(["case", "time ns/particle", "speed against 1 thread"], rows))


main(study_of)
