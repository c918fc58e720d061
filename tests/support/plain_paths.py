# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on paths, from the frames of plain_dump: dictionaries, and no more."""
import itertools

import numpy


def places(frame):
    """x y z of each particle in the box, whatever columns the file has."""
    if not frame.rows:
        return numpy.zeros((0, 3))
    origin, vectors = frame.box()
    if "x" in frame.columns:
        return frame.stack("xyz")
    return origin + frame.stack(["xs", "ys", "zs"]) @ vectors


def images(frame):
    return frame.stack(["ix", "iy", "iz"]).astype(int) if "ix" in frame.columns else None


def nearest(step, vectors):
    """The counts of vectors that make a step shortest; few will do."""
    counts = numpy.array(list(itertools.product((-2, -1, 0, 1, 2), repeat=3)))
    return counts[((step + counts @ vectors) ** 2).sum(axis=1).argmin()]


class Path:
    """One particle: numbers of its frames, unwrapped places, and its rows in those frames."""

    def __init__(self):
        self.frames, self.places, self.rows = [], [], []
        self._first = self._counts = self._shown = None

    def add(self, number, row, shown, image, vectors):
        if image is not None:
            place = shown + image @ vectors
            if not self.frames:
                self._first = place - shown
            place = place - self._first
        else:
            if not self.frames:
                self._counts = numpy.zeros(3, dtype=int)
            else:
                self._counts = self._counts + nearest(shown - self._shown, vectors)
            place = shown + self._counts @ vectors
        self._shown = shown
        self.frames.append(number)
        self.rows.append(row)
        self.places.append(place)

    def stretches(self):
        """Lists of indices without gaps in the frames."""
        begins = [i for i, f in enumerate(self.frames) if i == 0 or self.frames[i - 1] != f - 1]
        return [list(range(begin, end)) for begin, end in zip(begins, begins[1:] + [len(self.frames)])]


def paths(frames, ids=None, use_images=True, unwrapped=False):
    """Of each id its Path, in the order of ids. Boxes stay as they are where image counts are missing."""
    found = {}
    for number, frame in enumerate(frames):
        if not frame.rows:
            continue
        vectors = frame.box()[1]
        shown = frame.stack(["xu", "yu", "zu"]) if unwrapped else places(frame)
        image = images(frame) if use_images and not unwrapped else None
        for row, number_of in enumerate(frame.columns["id"]):
            particle = int(number_of)
            if ids is None or particle in ids:
                path = found.setdefault(particle, Path())
                if unwrapped:
                    path.add(number, row, shown[row], numpy.zeros(3), vectors)
                else:
                    path.add(number, row, shown[row], None if image is None else image[row], vectors)
    return dict(sorted(found.items()))


def lines_of(output):
    """Of each id in a vtkPolyData a list of lines, each a dictionary of its point and cell arrays."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    found = {}
    if not output.GetNumberOfCells():
        return found
    arrays = {"points": vtk_to_numpy(output.GetPoints().GetData())}
    for i in range(output.GetPointData().GetNumberOfArrays()):
        array = output.GetPointData().GetArray(i)
        arrays[array.GetName()] = vtk_to_numpy(array)
    ids, lengths = (vtk_to_numpy(output.GetCellData().GetArray(name)) for name in ("id", "length"))
    cells = [rows for each in (output.GetVerts(), output.GetLines()) if each.GetNumberOfCells()
             for rows in numpy.split(vtk_to_numpy(each.GetConnectivityArray()), vtk_to_numpy(each.GetOffsetsArray())[1:-1])]
    assert len(cells) == output.GetNumberOfCells()
    for cell, rows in enumerate(cells):
        line = {name: array[rows] for name, array in arrays.items()}
        line["length"] = lengths[cell]
        found.setdefault(int(ids[cell]), []).append(line)
    for lines in found.values():
        lines.sort(key=lambda line: (line["time"][0], line["time"][-1]))
    return found


def same(one, other):
    """Whether two results of lines_of are the same, bit for bit."""
    return list(one) == list(other) and all(
        len(one[i]) == len(other[i]) and all(
            a.keys() == b.keys() and all(
                numpy.asarray(a[name]).dtype == numpy.asarray(b[name]).dtype
                and numpy.asarray(a[name]).tobytes() == numpy.asarray(b[name]).tobytes() for name in a)
            for a, b in zip(one[i], other[i])) for i in one)
