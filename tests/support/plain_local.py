# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on files of dump local, written with the simplest means and sharing no code."""
import gzip

import numpy

import plain_dump


class Frame:
    """One frame: the label of its section, names of the columns (some may be alike), and rows of words."""

    def __init__(self):
        self.timestep = None
        self.time = None
        self.label = None
        self.boundary = ""
        self.bounds = []  # 3 x 2, or 3 x 3 with tilts; empty if the file has no box
        self.names = []
        self.rows = []

    def column(self, which):
        """Numbers, by the place of the column or by its name: of columns that are alike the first."""
        place = self.names.index(which) if isinstance(which, str) else which
        return numpy.array([float(row[place]) for row in self.rows], dtype=float)

    def stack(self, which):
        return numpy.array([self.column(each) for each in which], dtype=float).T

    def box(self):
        """origin, 3 x 3 matrix whose rows are the box vectors"""
        frame = plain_dump.Frame()
        frame.bounds = self.bounds
        return frame.box()


def _lines(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rt") as file:
        return file.read().splitlines()


def _sections(path):
    """Each line of ITEM, without that word, and the lines that follow it."""
    sections = []
    for line in _lines(path):
        if line.startswith("ITEM:"):
            sections.append((line[len("ITEM:"):].strip(), []))
        elif line.strip():
            sections[-1][1].append(line.split())
    return sections


def read(path):
    """All frames of a file: text, any label, with or without a box."""
    frames, time, count = [], None, None
    for title, lines in _sections(path):
        if title == "TIME":
            time = float(lines[0][0])
        elif title == "TIMESTEP":
            frames.append(Frame())
            frames[-1].timestep = int(lines[0][0])
            frames[-1].time, time = time, None
        elif title.startswith("NUMBER OF "):
            frames[-1].label = title[len("NUMBER OF "):]
            count = int(lines[0][0])
        elif title.startswith("BOX BOUNDS"):
            flags = [word for word in title.split()[2:] if word not in ("xy", "xz", "yz")]
            frames[-1].boundary = " ".join(flags)
            frames[-1].bounds = [[float(word) for word in line] for line in lines]
        elif frames and title.startswith(frames[-1].label):
            frames[-1].names = title[len(frames[-1].label):].split()
            frames[-1].rows = lines
            assert len(lines) == count, (path, frames[-1].timestep, len(lines), count)
    return frames


def read_rows(path):
    """Rows of words of a file without a header, as all processes but the first write with '%' in the name."""
    return [line.split() for line in _lines(path)]
