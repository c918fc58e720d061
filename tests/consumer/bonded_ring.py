# SPDX-License-Identifier: BSD-3-Clause
"""Takes the program of samples/bonded_ring and the words that start processes: all particles and bonds are
right at the end, and were handed over as often as they crossed slabs."""
import re
import subprocess
import sys
from fractions import Fraction

program, *mpirun = sys.argv[1:]
PARTICLES, LENGTH = 200, 16


def crossings(ranks):
    """How often particles that fly straight on enter another slab."""
    count = 0
    for number in range(PARTICLES):
        fibre, place = divmod(number, 25)
        begin = Fraction(place, 2)
        end = begin + Fraction(1500, 64) * (1 + Fraction(fibre, 8))
        count += end * ranks // LENGTH - begin * ranks // LENGTH
    return count if ranks > 1 else 0


for ranks in 1, 2, 3:
    done = subprocess.run([*mpirun, str(ranks), program], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    found = re.search(r"(\d+) processes, (\d+) of (\d+) particles right, handed over (\d+) times",
                      done.stdout)
    assert found, done.stdout + done.stderr
    print(found.group())
    assert [int(word) for word in found.groups()] == [ranks, PARTICLES, PARTICLES, crossings(ranks)]
