# SPDX-License-Identifier: BSD-3-Clause
"""One rank of three is killed while they write a file together: the old or the new file is whole, and the next write of the name leaves
nothing of them. Arguments: the number of kills, mpirun, and the program of killed_ranks.cpp, whose ranks are killed at a call of the
system, or pvbatch, whose ranks are killed at a random moment; GRANULAR_SEED begins the random numbers."""
import os
import random
import shutil
import signal
import subprocess
import sys
import time

RANKS = 3
MODES = ("Gather", "MPI-IO")
NAMES = ("a.dump", "a.bin", "a.dump.gz")
DURABLE = ("On", "Off")
OLD = b"old" * 100_000


def write(*arguments):
    """What each rank of pvbatch does, for each five arguments: name, mode, durability, the rank that is killed (-1: none), and how many
    seconds after it begins to write. The seconds that it took are written to most_RANK."""
    from paraview.simple import GranularDumpReader
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    import granular

    ranks = vtkMultiProcessController.GetGlobalController()
    own = ranks.GetLocalProcessId()
    reader = GranularDumpReader(FileNames=["source.dump"])
    reader.UpdatePipeline()
    with open(f"rank_{own}", "w") as file:
        file.write(str(os.getpid()))
    with open(f"most_{own}", "w") as most:
        for name, mode, durable, rank, delay in zip(*[iter(arguments)] * 5):
            ranks.Barrier()
            begin = time.monotonic()
            if own == int(rank):
                signal.signal(signal.SIGALRM, signal.SIG_DFL)  # which ends the process, whatever it does
                signal.setitimer(signal.ITIMER_REAL, max(float(delay), 1e-6))
            granular.save(reader, name, ParallelMode=mode, Durable=durable)
            signal.setitimer(signal.ITIMER_REAL, 0)
            print(time.monotonic() - begin, file=most)


def run(mpirun, program, *arguments):
    """Returns the exit status of the ranks, all of which have ended, and what they said."""
    script = ["--dr", "--sym", os.path.abspath(__file__), "write"] if is_pvbatch(program) else []
    at_once = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}  # Open MPI ends the others; else it waits for a second
    done = subprocess.run([mpirun, "-n", str(RANKS), program, *script, *map(str, arguments)], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, env={**os.environ, **at_once})
    for rank in range(RANKS):
        with open(f"rank_{rank}") as file:
            pid = int(file.read())
        while has_files(pid):
            time.sleep(0.01)
    return done.returncode, done.stdout


def has_files(pid):
    """Returns whether a process may have open files, and locks: a zombie without threads has none."""
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX" or len(os.listdir(f"/proc/{pid}/task")) > 1
    except (FileNotFoundError, ProcessLookupError):
        return False


def is_pvbatch(program):
    return "pvbatch" in os.path.basename(program)


def write_all(mpirun, program, ways):
    """Writes a file in each way, without kills. Returns the contents, and the most calls or seconds of each rank."""
    arguments = [word for name, mode, durable in ways for word in (f"{mode}_{name}", mode, durable, -1, 0)]
    status, said = run(mpirun, program, *arguments)
    assert status == 0, said
    most = []
    for rank in range(RANKS):
        with open(f"most_{rank}") as file:
            most.append(dict(zip(ways, map(float, file))))
    return {way: content(f"{way[1]}_{way[0]}") for way in ways}, most


def content(name):
    with open(name, "rb") as file:
        return file.read()


def hidden():
    return [name for name in os.listdir(".") if name.startswith(".granular-")]


def make_source():
    import granular
    import numpy

    points = numpy.random.default_rng(1).random((100_000, 3))
    granular.write("source.dump", {"points": points, "id": numpy.arange(1, len(points) + 1), "v": points * 7.1})


def main(kills, mpirun, program):
    import granular

    seed = int(os.environ.get("GRANULAR_SEED", "1"))
    chosen = random.Random(seed)
    shutil.rmtree("killed", ignore_errors=True)
    os.mkdir("killed")
    os.chdir("killed")
    if is_pvbatch(program):
        make_source()
    ways = [(name, mode, chosen.choice(DURABLE)) for name in NAMES for mode in MODES]
    expected, most = write_all(mpirun, program, ways)
    frame = granular.open("Gather_a.dump")[0]
    tries = killed = new = left = 0
    while tries < kills or (killed == 0 and tries < 10 * kills):
        way = ways[tries % len(ways)]
        name = way[0]
        with open(name, "wb") as file:
            file.write(OLD)
        rank = chosen.choice([rank for rank in range(RANKS) if most[rank][way] > 0])
        moment = chosen.uniform(0, 1.1 * most[rank][way]) if is_pvbatch(program) else chosen.randint(1, int(most[rank][way]))
        status, said = run(mpirun, program, *way, rank, moment)
        what = (seed, way, rank, moment, said)
        tries += 1
        killed += status != 0
        assert status != 0 or is_pvbatch(program), what
        now = content(name)
        new += status != 0 and now == expected[way]
        assert now in (OLD, expected[way]), (len(now), *what)
        left += bool(hidden())
        granular.write(name, frame)
        assert not hidden(), (hidden(), *what)
    assert killed > 0
    print(f"{killed} of {tries} killed while they wrote, {left} left a file, {new} had written the new one")


if sys.argv[1] == "write":
    write(*sys.argv[2:])
else:
    main(int(sys.argv[1]), sys.argv[2], sys.argv[3])
