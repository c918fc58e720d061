# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program of the guide on some ranks: the dump that it writes holds what the program says."""
import subprocess
import sys

subprocess.run(sys.argv[1:], check=True)
with open("grains.dump") as file:
    frames = file.read().split("ITEM: TIMESTEP\n")[1:]
assert [int(frame.split()[0]) for frame in frames] == [0, 50, 100], frames
for number, frame in enumerate(frames):
    rows = [line.split() for line in frame.split("ITEM: ATOMS id type xs ys zs\n")[1].splitlines()]
    assert [row[:2] for row in rows] == [["1", "1"], ["2", "2"], ["3", "1"], ["4", "2"]], rows
    assert [float(word) for word in rows[2][2:]] == [(1 + 0.25 * number) / 10, 0.2, 0.3], rows
    assert [float(word) for word in rows[1][2:]] == [0.4, 0.5, 0.6], rows
