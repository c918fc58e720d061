# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program of the guide on some ranks: the dump that it writes holds what the program says."""
import subprocess
import sys

subprocess.run(sys.argv[1:], check=True)
with open("grains.dump") as file:
    frames = file.read().split("ITEM: TIMESTEP\n")[1:]
assert [int(frame.split()[0]) for frame in frames] == [0, 50, 100], frames
for number, frame in enumerate(frames):
    header, *rows = frame.split("ITEM: ATOMS ")[1].splitlines()
    assert header.split() == "id type x y z vx vy vz radius".split(), header
    rows = [[float(word) for word in row.split()] for row in rows]
    assert rows == [[1, 1, 1 + 0.25 * number, 1, 3, 0, 0, 0.1, 0.5], [2, 2, 4, 1, 6, 0, 0, -0.1, 0.25],
                    [3, 1, 1 + 0.25 * number, 2, 3, 0, 0, 0.1, 0.5], [4, 2, 4, 2, 6, 0, 0, -0.1, 0.25]], rows
