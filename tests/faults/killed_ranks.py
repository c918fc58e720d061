# SPDX-License-Identifier: BSD-3-Clause
"""One rank of three is killed while they write a file together: the old or the new file is whole, and the next write of the name leaves
nothing of them. Arguments: the number of kills, mpirun, and pvbatch or the program of killed_ranks.cpp; GRANULAR_SEED begins the random
numbers."""
import json
import os
import random
import shutil
import subprocess
import sys
import time

RANKS = 3
MODES = ("Gather", "MPI-IO")
NAMES = ("a.dump", "a.bin", "a.dump.gz")


def write(name, mode, durable, rank, delay):
    """What each rank of pvbatch does: rank `rank` is killed `delay` seconds after it begins to write; -1: none."""
    import granular
    from paraview.simple import GranularDumpReader
    from vtkmodules.vtkParallelCore import vtkMultiProcessController

    ranks = vtkMultiProcessController.GetGlobalController()
    own = ranks.GetLocalProcessId()
    reader = GranularDumpReader(FileNames=["source.dump"])
    reader.UpdatePipeline()
    with open(f"rank_{own}", "w") as file:
        file.write(str(os.getpid()))
    ranks.Barrier()
    killer = None
    if own == rank:
        killer = subprocess.Popen(["sh", "-c", f"sleep {delay}; kill -9 {os.getpid()}"])
    begin = time.monotonic()
    granular.save(reader, name, ParallelMode=mode, Durable=durable)
    took = time.monotonic() - begin
    if killer is not None:
        killer.wait()
    if own == 0:
        with open("took", "w") as file:
            json.dump(took, file)


def run(mpirun, program, *arguments):
    """Returns the exit status of the ranks, all of which have ended, and what they said. Without mpirun it is one rank."""
    start = [mpirun, "-n", str(RANKS)] if mpirun else []
    script = ["--dr", "--sym", os.path.abspath(__file__), "write"] if "pvbatch" in os.path.basename(program) else []
    done = subprocess.run([*start, program, *script, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    for rank in range(RANKS if mpirun else 1):
        with open(f"rank_{rank}") as file:
            pid = int(file.read())
        while os.path.exists(f"/proc/{pid}/exe"):
            time.sleep(0.01)
    return done.returncode, done.stdout


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
    seed = int(os.environ.get("GRANULAR_SEED", "1"))
    chosen = random.Random(seed)
    shutil.rmtree("killed", ignore_errors=True)
    os.mkdir("killed")
    os.chdir("killed")
    if "pvbatch" in os.path.basename(program):
        make_source()
    expected, took = {}, {}
    killed = new = left = 0
    for number in range(kills):
        name, mode = NAMES[number // len(MODES) % len(NAMES)], MODES[number % len(MODES)]
        if (name, mode) not in expected:
            status, said = run(mpirun, program, name, mode, "On", -1, 0)
            assert status == 0, said
            with open("took") as file:
                took[name, mode] = json.load(file)
            expected[name, mode] = content(name)
        with open(name, "wb") as file:
            file.write(b"old" * 100_000)
        rank, delay = chosen.randrange(RANKS), chosen.uniform(0, 1.1 * took[name, mode])
        status, said = run(mpirun, program, name, mode, chosen.choice(["On", "Off"]), rank, f"{delay:.6f}")
        killed += status != 0
        now = content(name)
        new += now == expected[name, mode]
        assert now in (b"old" * 100_000, expected[name, mode]), (seed, name, mode, rank, delay, len(now), said)
        left += bool(hidden())
        status, said = run(None, program, name, mode, "Off", -1, 0)
        assert status == 0, said
        assert not hidden(), (seed, name, mode, rank, delay, hidden())
    assert killed >= kills // 2, (killed, kills)
    print(f"{killed} of {kills} killed while they wrote, {left} left a file, {new} had written the new one")


if sys.argv[1] == "write":
    write(sys.argv[2], sys.argv[3], sys.argv[4], int(sys.argv[5]), float(sys.argv[6]))
else:
    main(int(sys.argv[1]), sys.argv[2], sys.argv[3])
