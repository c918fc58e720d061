# SPDX-License-Identifier: BSD-3-Clause
"""One rank of three is killed at a call of the system while they write a file together: the old or the new file is whole, and the next
write of the name leaves nothing of them. Arguments: the number of kills, mpirun, and the program of killed_ranks.cpp; GRANULAR_SEED
begins the random numbers."""
import os
import random
import shutil
import subprocess
import sys
import time

import vtkgranular as vg

RANKS = 3
NAMES = ("a.dump", "a.bin", "a.dump.gz")
OLD = b"old" * 100_000


def run(mpirun, program, *arguments):
    """Returns the exit status of the ranks, all of which have ended, and what they said."""
    at_once = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}  # Open MPI ends the others; else it waits for a second
    done = subprocess.run([mpirun, "-n", str(RANKS), program, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env={**os.environ, **at_once})
    for rank in range(RANKS):
        pid = int(content(f"rank_{rank}"))
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


def content(name):
    with open(name, "rb") as file:
        return file.read()


def hidden():
    return [name for name in os.listdir(".") if name.startswith(".granular-")]


def main(kills, mpirun, program):
    seed = int(os.environ.get("GRANULAR_SEED", "1"))
    chosen = random.Random(seed)
    shutil.rmtree("killed", ignore_errors=True)
    os.mkdir("killed")
    os.chdir("killed")
    ways = [(name, mode, chosen.choice(("On", "Off"))) for name in NAMES for mode in ("Gather", "MPI-IO")]
    status, said = run(mpirun, program, *(word for name, mode, durable in ways for word in (f"{mode}_{name}", mode, durable, -1, 0)))
    assert status == 0, said
    calls = [content(f"most_{rank}").split() for rank in range(RANKS)]
    frame = vg.open("Gather_a.dump")[0]
    left = new = 0
    for kill in range(kills):
        name, mode, durable = way = ways[kill % len(ways)]
        expected = content(f"{mode}_{name}")
        with open(name, "wb") as file:
            file.write(OLD)
        rank, most = chosen.choice([(rank, int(own[kill % len(ways)])) for rank, own in enumerate(calls) if int(own[kill % len(ways)]) > 0])
        call = chosen.randint(1, most)
        status, said = run(mpirun, program, *way, rank, call)
        now, what = content(name), (seed, way, rank, call, said)
        assert status != 0, what
        assert now in (OLD, expected), (len(now), *what)
        new += now == expected
        left += bool(hidden())
        vg.write(name, frame)
        assert not hidden(), (hidden(), *what)
    print(f"killed at {kills} calls, {left} left a file, {new} had written the new one")


main(int(sys.argv[1]), sys.argv[2], sys.argv[3])
