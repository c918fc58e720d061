# SPDX-License-Identifier: BSD-3-Clause
"""Threads: the same bits, and the time on the wall."""
import os
import time
import zlib

import granular
from scene import Packing, Rounds, array_of, main, open_dump, points_of, read_again
from vtkmodules.util.numpy_support import vtk_to_numpy


def bits(*arrays):
    return [zlib.crc32(array) for array in arrays]


def study_of(study):
    packing = Packing(layers=study.pick(21, 1), lattice=study.pick(63, 8))
    path = packing.write(study.folder / "one.dump", "%g")
    cores = len(os.sched_getaffinity(0))
    counts = sorted({1, 2, min(cores, 4), cores})
    reader = open_dump(path)
    data = read_again(reader)
    found, works = {}, {}
    for count in counts:
        mine = open_dump(path, Threads=count)
        average = granular.vtkGranularEulerAverage()
        average.SetInputData(data)
        average.SetCellCounts(20, 20, 20)
        average.SetWeights(average.OVERLAP)
        average.SetThreads(count)
        writer = granular.vtkGranularDumpWriter()
        writer.SetInputData(data)
        writer.SetThreads(count)
        out = study.folder / f"{count}.dump"
        writer.SetFileName(str(out))

        def average_again(average=average):
            average.Modified()
            average.Update()
            return average.GetOutput()

        frame, cells = read_again(mine), average_again()
        writer.Write()
        works.update({("read", count): lambda mine=mine: read_again(mine), ("average", count): average_again,
                      ("write", count): writer.Write})
        arrays = cells.GetCellData() if cells.GetCellData().GetNumberOfArrays() else cells.GetPointData()
        found["read", count] = bits(points_of(frame), array_of(frame, "v"), array_of(frame, "f"), array_of(frame, "id"))
        found["average", count] = bits(*(vtk_to_numpy(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())))
        found["write", count] = bits(out.read_bytes())
    for verb in ("read", "average", "write"):
        times = Rounds(time.perf_counter)
        for count in counts:
            study.check(found[verb, count] == found[verb, 1], f"{verb}: {count} threads give other bits than one")
            times.add(count, works[verb, count])
        times.run(study.pick(7, 1))
        for count in counts:
            case = f"{verb}, {count} thread{'s' if count > 1 else ''}"
            study.tell(case, "time", 1e9 * times.time(count) / packing.rows, "ns/particle")
            study.tell(case, "speed against 1 thread", 1 / times.ratio(count, 1), "1")


main(study_of)
