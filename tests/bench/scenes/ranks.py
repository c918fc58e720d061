# SPDX-License-Identifier: BSD-3-Clause
"""One frame read by the ranks of pvbatch together, one thread each: time on the wall from one barrier to the next.

This script starts pvbatch on one rank and on two by turns; inside, all ranks run it."""
import os
import statistics
import subprocess
import sys
import time

HOW = {"in the file's order": False, "sorted by id": True}
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none"}


def inside(path, rounds):
    """Rank 0 prints the rows of all ranks and the seconds of each way."""
    import vtkgranular as vg
    from vtkmodules.vtkCommonCore import vtkIdTypeArray
    from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

    ranks = vtkMultiProcessController.GetGlobalController()
    for how, sort in HOW.items():
        reader, seconds = vg.vtkGranularDumpReader(), []
        reader.AddFileName(path)
        reader.SetThreads(1)
        reader.SetSortById(sort)
        for _ in range(rounds + 1):  # the first one takes new memory
            reader.Modified()
            ranks.Barrier()
            start = time.perf_counter()
            reader.UpdatePiece(ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses(), 0)
            ranks.Barrier()
            seconds.append(time.perf_counter() - start)
        mine, rows = vtkIdTypeArray(), vtkIdTypeArray()
        mine.InsertNextValue(reader.GetOutput().GetNumberOfPoints())
        rows.SetNumberOfValues(1)
        ranks.Reduce(mine, rows, vtkCommunicator.SUM_OP, 0)
        if ranks.GetLocalProcessId() == 0:
            print(f"TOLD {how}|{rows.GetValue(0)}|{statistics.median(seconds[1:])}", flush=True)


def told_by(count, path, rounds):
    """way: (rows of all ranks, seconds from one barrier to the next)."""
    done = subprocess.run(["mpiexec", "-n", str(count), "pvbatch", "--sym", __file__, "--inside", path, str(rounds)],
                          stdout=subprocess.PIPE, text=True, check=True, env={**os.environ, **MPI})
    told = (line[5:].split("|") for line in done.stdout.splitlines() if line.startswith("TOLD "))
    return {how: (int(rows), float(seconds)) for how, rows, seconds in told}


def study_of(study):
    from scene import LATTICE, Packing, table

    packing = Packing(layers=study.pick(LATTICE, 1), lattice=study.pick(LATTICE, 8))
    path = str(packing.write(study.folder / "frame.dump", "%g"))
    seconds = {(how, count): [] for how in HOW for count in (1, 2)}
    for _ in range(study.pick(3, 1)):
        for count in (1, 2):
            for how, (rows, each) in told_by(count, path, study.pick(7, 1)).items():
                study.check(rows == packing.rows, f"{how}: {rows} rows on {count} ranks")
                seconds[how, count].append(each)
    study.block("ranks", "A text of 10^6 particles and 12 columns of %g, read by the ranks of `pvbatch`, each its part, with one thread and the "
                "memory of a frame before; time on the wall from one barrier to the next. Sorted by id, the rows that each rank reads go to "
                "the rank they belong to.",
                table(["case", "time ns/particle", "speed against 1 rank"], [
                    [f"`{how}, {count} rank{'s' if count > 1 else ''}`", f"{1e9 * statistics.median(each) / packing.rows:.0f}",
                     f"{statistics.median(one / mine for one, mine in zip(seconds[how, 1], each)):.2f}"]
                    for (how, count), each in seconds.items()]))


if "--inside" in sys.argv:
    inside(sys.argv[-2], int(sys.argv[-1]))
else:
    from scene import main

    main(study_of)
