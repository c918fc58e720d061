# SPDX-License-Identifier: BSD-3-Clause
"""Takes the program of samples/parallel_dump and the words that start processes: what three of them
write is what one writes, and what exact arithmetic says."""
import os
import subprocess
import sys
from fractions import Fraction

try:
    import plain_dump
except ImportError as error:  # numpy, which nothing else of the core alone needs
    sys.exit(print(f"skipped: {error}"))

program, *mpirun = sys.argv[1:]
COLUMNS = "id type xs ys zs ix iy iz"
LOW, LENGTH = -1, 5


def run(name, ranks, *how):
    done = subprocess.run([*mpirun, str(ranks), program, name, *how], capture_output=True, text=True,
                          timeout=60)
    return done.returncode, done.stdout + done.stderr


def hashed(n):
    return Fraction(n * 2654435761 % 2**20, 2**20)


def atom(number, step):
    """id, type, three scaled coordinates and three image counts of an atom that flies straight on."""
    scaled, image = [], []
    for axis in range(3):
        speed = 4 * hashed(23 * number + 7 * axis) - 2
        flown = hashed(17 * number + 5 * axis) + speed * Fraction(step, 128) / LENGTH
        image.append(flown // 1)
        scaled.append(float(flown % 1))  # the exact number, rounded once
    return [number, 1 if number % 5 else 2, *scaled, *image]


for name, read in (("grains.dump", plain_dump.read),
                   ("grains.bin", lambda name: plain_dump.read_binary(name, COLUMNS)),
                   ("grains.dump.gz", plain_dump.read)):
    written = {}
    for ranks, *how in ((1,), (3, "gather"), (3, "mpi-io"), (2, "mpi-io")):
        code, said = run(name, ranks, *how)
        assert code == 0, said  # MPI may have something to say of the machine
        with open(name, "rb") as file:
            written[file.read()] = ranks, how
        frames = read(name)
        os.remove(name)
    assert len(written) == 1, f"{name} depends on the number of processes"
    assert [frame.timestep for frame in frames] == [0, 100, 200, 300, 400]
    crossed = 0
    for frame in frames:
        assert frame.rows == 500 and list(frame.columns) == COLUMNS.split()
        assert [list(axis[:2]) for axis in frame.bounds] == [[LOW, LOW + LENGTH]] * 3
        rows = frame.stack(COLUMNS.split()).tolist()
        assert rows == [atom(number, frame.timestep) for number in range(1, 501)], frame.timestep
        crossed += sum(any(row[5:]) for row in rows)
    assert crossed > 500, "the atoms stay in the box"
    print(name, len(next(iter(written))), "bytes")

# An error of the first process ends all of them, with its text and nothing left behind.
os.makedirs("folder.dump", exist_ok=True)
before = sorted(os.listdir("."))
for how in "gather", "mpi-io":
    code, said = run("folder.dump", 3, how)
    assert code == 1 and "folder.dump: " in said, (code, said)
    assert sorted(os.listdir(".")) == before
