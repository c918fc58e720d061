# SPDX-License-Identifier: BSD-3-Clause
"""Subdomains as voxels: made, written, read and filled with counts; reading against VTK's reader, counts against numpy."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader, vtkUnstructuredGridWriter

import vtkgranular as vg
from scene import Packing, Rounds, main, open_dump, points_of, table

COUNT = "count particles"


def source_of(cells):
    source = vg.vtkGranularDecompositionSource()
    source.SetProcessorGrid(cells, cells, cells)
    source.SetThreads(1)
    source.Update()
    return source


def again(algorithm):
    algorithm.Modified()
    algorithm.Update()
    return algorithm.GetOutput()


def writer_of(kind, data, path):
    writer = kind()
    writer.SetInputData(data)
    writer.SetFileName(path)
    return writer


def counts_of(points, cuts):
    """The counts of a grid with the same cuts along all axes."""
    cells = len(cuts) - 1
    x, y, z = numpy.clip(numpy.searchsorted(cuts, points.T, "right") - 1, 0, cells - 1)
    return numpy.bincount((x * cells + y) * cells + z, minlength=cells ** 3)


def study_of(study):
    cells = study.pick(40, 8)
    source = source_of(cells)
    voxels, path, theirs = source.GetOutput(), str(study.folder / "voxels.vtk"), str(study.folder / "theirs.vtk")
    ours = vg.vtkGranularDecompositionReader()
    ours.AddFileName(path)
    ours.SetThreads(1)
    vtk = vtkUnstructuredGridReader()
    vtk.SetFileName(path)
    writers = {"write": writer_of(vg.vtkGranularDecompositionWriter, voxels, path),
               "write, VTK": writer_of(vtkUnstructuredGridWriter, voxels, theirs)}
    for writer in writers.values():
        writer.Write()
    study.check((points_of(again(ours)) == points_of(voxels)).all(), "corners of voxels")
    times = Rounds(cells ** 3)
    for name, algorithm in (("make", source), ("read", ours), ("read, VTK", vtk)):
        times.add(name, again, lambda algorithm=algorithm: (algorithm,))
    for name, writer in writers.items():
        times.add(name, lambda writer=writer: (writer.Modified(), writer.Write()))
    times.run(study.pick(9, 1))

    packing = Packing(layers=study.pick(16, 1), lattice=study.pick(63, 8))
    particles = open_dump(packing.write(study.folder / "particles.dump"))
    count = vg.vtkGranularDecomposition()
    count.SetInputConnection(particles.GetOutputPort())
    count.SetProcessorGrid(cells, cells, cells)
    count.SetThreads(1)
    nlocal = vtk_to_numpy(again(count).GetCellData().GetArray("nlocal"))
    cuts = numpy.unique(points_of(voxels)[:, 0])
    study.check((nlocal == counts_of(packing.points, cuts)).all(), COUNT)
    counting = Rounds(packing.rows)
    counting.add(COUNT, again, lambda: (count,))
    counting.add("count, numpy", counts_of, lambda: (packing.points, cuts))
    counting.run(study.pick(9, 1))
    study.block("voxels", f"{cells ** 3:,} subdomains, legacy VTK text with all digits. Counts: {packing.rows:,} particles in as many subdomains, "
                "which are made as well; numpy.searchsorted and bincount. Corners read back bit by bit, and counts are those of numpy, or this "
                "fails. One thread, processor time.",
                table(["case", "time ns", "of a", "against"], [
                    [f"`{name}`", f"{times.ns(name):.0f}", "subdomain",
                     f"{times.ratio(name, name + ', VTK'):.2f} of VTK's" if name + ", VTK" in times.samples else None] for name in ("make", "write", "read")] +
                    [[f"`{COUNT}`", f"{counting.ns(COUNT):.0f}", "particle", f"{counting.ratio(COUNT, 'count, numpy'):.2f} of numpy"]]))


main(study_of)
