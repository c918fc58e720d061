# SPDX-License-Identifier: BSD-3-Clause
"""Takes a program of samples/bonded_chain: what it prints follows from the formats, and from the histories of the bonds by hand."""
import os
import subprocess
import sys

(program,) = sys.argv[1:]
if not os.path.exists(program):
    sys.exit(print("skipped: no Fortran compiler"))


def line_of(name, tags):
    """A rank with its particles, each bonded to those beside it in the chain of six."""
    ends = [(tag, partner) for tag in tags for partner in (tag - 1, tag + 1) if 1 <= partner <= 6]
    history = sum(0.1 * tag + 0.2 * partner for tag, partner in ends)
    return [f"{name}: {' '.join(map(str, tags))}", f"  {len(ends)} bonds, history {history:4.1f}"]


HISTORY = 3
RIGHT = [4, 5, 6, 3]
expected = [
    "border: 13 doubles", "comm: 9 doubles", "copy of particle 3 at 1.75", "force on particle 3: -8.0",
    f"exchange: {22 + 2 * (2 + HISTORY)} doubles",
    *line_of("left", [1, 2]), *line_of("right", RIGHT),
    f"restart: {4 * 14 + 7 * (2 + HISTORY)} doubles", *line_of("restarted", RIGHT),
    f"memory: {10000 * (160 + 2 * (12 + 8 * HISTORY))} bytes"]
done = subprocess.run([program], capture_output=True, text=True, timeout=60)
assert done.returncode == 0, done.stdout + done.stderr
assert done.stdout.splitlines() == expected, done.stdout
print(done.stdout)
