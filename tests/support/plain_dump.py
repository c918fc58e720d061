# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on dumps, written with the simplest means and sharing no code."""
import gzip
import struct

import numpy


class Frame:
    """One frame: timestep, bounds (3 x 2 or 3 x 3 with tilts), column name -> list of words."""

    def __init__(self):
        self.timestep = None
        self.time = None
        self.bounds = []
        self.columns = {}
        self.rows = 0

    def numbers(self, name):
        return numpy.array([float(word) for word in self.columns[name]], dtype=float)

    def stack(self, names):
        return numpy.column_stack([self.numbers(name) for name in names])

    def box(self):
        """origin, 3 x 3 matrix whose rows are the box vectors"""
        bounds = numpy.array(self.bounds)
        lo, hi = bounds[:, 0].copy(), bounds[:, 1].copy()
        xy, xz, yz = bounds[:, 2] if bounds.shape[1] == 3 else (0.0, 0.0, 0.0)
        lo[0] -= min(0.0, xy, xz, xy + xz)
        hi[0] -= max(0.0, xy, xz, xy + xz)
        lo[1] -= min(0.0, yz)
        hi[1] -= max(0.0, yz)
        length = hi - lo
        return lo, numpy.array([[length[0], 0, 0], [xy, length[1], 0], [xz, yz, length[2]]])


def read_binary(path, names):
    """Little-endian files of LIGGGHTS (names: of the columns) and LAMMPS, in boxes of bounds and tilts."""
    with open(path, "rb") as file:
        data, at = file.read(), 0

    def take(form):
        nonlocal at
        values = struct.unpack_from("<" + form, data, at)
        at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    frames = []
    while at < len(data):
        frame = Frame()
        frame.timestep, magic = take("q"), None
        if frame.timestep < 0:
            magic = take(f"{-frame.timestep}s")
            assert magic in (b"DUMPATOM", b"DUMPCUSTOM") and take("2i") == (1, 2)
            frame.timestep = take("q")
        frame.rows, tilted = take("qi")
        take("6i")
        bounds = numpy.reshape(take("6d"), (3, 2))
        frame.bounds = numpy.column_stack((bounds, take("3d"))) if tilted else bounds
        width = take("i")
        if magic:
            take(f"{take('i')}s")
            frame.time = take("d") if take("b") else None
            names = take(f"{take('i')}s").decode()
        chunks = [numpy.frombuffer(data, "<f8", count, (at := at + 8 * count) - 8 * count)
                  for count in (take("i") for _ in range(take("i")))]
        rows = numpy.concatenate(chunks).reshape(frame.rows, width)
        frame.columns = {name: rows[:, i] for i, name in enumerate(names.split())}
        frames.append(frame)
    return frames


def read(path):
    frames, time = [], None
    with (gzip.open if path.endswith(".gz") else open)(path, "rt") as file:
        lines = iter(file.read().splitlines())
    for line in lines:
        if line.startswith("ITEM: TIMESTEP"):
            frames.append(Frame())
            frames[-1].timestep = int(next(lines))
            frames[-1].time, time = time, None
        elif line.startswith("ITEM: TIME"):
            time = float(next(lines))
        elif line.startswith("ITEM: NUMBER OF ATOMS"):
            frames[-1].rows = int(next(lines))
        elif line.startswith("ITEM: BOX BOUNDS"):
            frames[-1].bounds = [[float(word) for word in next(lines).split()] for _ in range(3)]
        elif line.startswith("ITEM: ATOMS"):
            names = line.split()[2:]
            rows = [next(lines).split() for _ in range(frames[-1].rows)]
            frames[-1].columns = {name: [row[i] for row in rows] for i, name in enumerate(names)}
    return frames
