# SPDX-License-Identifier: BSD-3-Clause
"""Damaged copies of good files through the VTK readers, all in one process, through the same readers one after the other, as by a user
who opens many files. Each copy must end within 10 s of processors, in memory of at most 20 times its files and 256 MiB, with valid
outputs, or empty ones and an error that names the file. Arguments: how many copies of each file (default 4), the seed. A copy depends
on the seed and its number alone. After a crash or a hang, the file `last` says which copy it was."""
import ctypes
import gzip
import os
import random
import signal
import struct
import sys
import time

import vtkgranular as vg
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArraySelection
from vtkmodules.vtkCommonDataModel import vtkDataObject

from said import said_by

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
MIB = 1 << 20
KINDS = ("Dump", "Local", "DataFile", "Euler", "Decomposition", "Restart")
WORDS = [b"nan", b"-1", b"1e308", b"-inf", b"0.5", b"word", b" ", b"9223372036854775807", b"4294967296", b"\nITEM: TIMESTEP\n", b"ITEM: ",
         b" c_a[1] c_a[2] ", b"id ", b"position1 ", b"x1 y1 z1 x2 y2 z2 ", b"Bonds\n\n", b"", *(bytes([byte]) for byte in b"0-+.exyz[]#\n\t\r\""),
         *(struct.pack("<Q", number)[:size] for size in (4, 8) for number in (
             0, 1, 5, 8, 0x7fffffff, 0x80000000, 0xffffffff, 2**63 - 1, 2**64 - 1, 0x7ff0000000000000, 0x7ff8000000000000))]
PROPERTIES = {  # of the readers that have them
    "Threads": [0, 1, 2, 3],
    "RepeatedSteps": [0, 1, 2],
    "TimestepSize": [1e-5, 1e-5, 1e-5, 1e300],
    "ColumnNames": ["", "", "id type x y z", "id type x y z ix iy iz vx vy vz radius element", "id type xs ys zs ix iy iz", "a b c d e"],
    "PointPrecision": [0, 1],
    "Vertices": [0, 1, 2],
    "PointOrigin": [(0, 0, 0), (0, 0, 0), (1e3, 0, 0)],
    "RegionOfInterest": [(1, -1) * 3, (1, -1) * 3, (0, 0.05, 1, -1, 1, -1)],
    "AtomStyle": ["", "", "sphere", "full", "ellipsoid", "hybrid sphere bond"],
    "Boundary": ["", "p p p", "f f f"],
    "Coordinates": [0, 1, 2],
    "SortById": [0, 1],
    "Stride": [1, 1, 3],
    "PeriodicLines": [0, 1, 2],
    "Preset": [0, 0, 0, *range(13)],
    "OutputType": [0, 1],
    "CheckOverlap": [0, 1, 2],
    "CheckGaps": [0, 1, 2],
    "HistoryLayout": [0, 0, *range(6)],
}


def content(path):
    with open(path, "rb") as file:
        return file.read()


def damaged(good, other, chance):
    """One to three places changed, cut out, cut off or filled with a word or with a part of this file or another: most often among the
    first, where headers are."""
    data = bytearray(good)
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(min(len(data), chance.choice((512, len(data), len(data)))) or 1)
        part = chance.choice((other, data))
        begin = chance.randrange(len(part) or 1)
        new = chance.choice((bytes([chance.randrange(256)]), chance.choice(WORDS), chance.choice(WORDS), part[begin:begin + chance.randrange(400)]))
        data[at:at + chance.choice((0, len(new), chance.randrange(40), chance.choice((0, len(data)))))] = new
    return bytes(data)


def copy_of(good, plain, other, chance):
    """A damaged copy; of a compressed file often of what it holds, so that something is left to read."""
    if good == plain or chance.randrange(3) == 0:
        return damaged(good, other, chance)
    return gzip.compress(damaged(plain, other, chance), 1)


def status(name):
    """A number of this process in bytes."""
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith(name + ":"))


def leaves(output):
    """An output, or the data sets that it is composed of."""
    if not output.IsA("vtkCompositeDataSet"):
        return [output]
    each = output.NewIterator()
    found = []
    while not each.IsDoneWithTraversal():
        found.append(each.GetCurrentDataObject())
        each.GoToNextItem()
    return found


def size_of(output):
    return sum(output.GetNumberOfElements(kind) for kind in range(vtkDataObject.NUMBER_OF_ATTRIBUTE_TYPES))


def values_of(array):
    """Every byte is read: a memory checker sees those that are not there."""
    if array.IsA("vtkStringArray"):
        return [array.GetValue(i) for i in range(array.GetNumberOfValues())]
    return bytes(vtk_to_numpy(array))


def check_valid(output):
    """Filters may trust it: each array has a name, and a value for each point, cell or row; cells have points that are there."""
    for kind in range(vtkDataObject.NUMBER_OF_ATTRIBUTE_TYPES):
        arrays = output.GetAttributesAsFieldData(kind)
        for i in range(arrays.GetNumberOfArrays() if arrays else 0):
            array = arrays.GetAbstractArray(i)
            assert array and array.GetName(), "an array without a name"
            assert kind == vtkDataObject.FIELD or array.GetNumberOfTuples() == output.GetNumberOfElements(kind), array.GetName()
            values_of(array)
    if output.IsA("vtkPointSet") and output.GetPoints():
        values_of(output.GetPoints().GetData())
    for name in ("GetVerts", "GetLines", "GetPolys", "GetStrips") if output.IsA("vtkPolyData") else ("GetCells",):
        cells = getattr(output, name, lambda: None)()
        has_points = cells and hasattr(cells, "GetConnectivityArray") and cells.GetNumberOfCells()  # not those of grids
        points = vtk_to_numpy(cells.GetConnectivityArray()) if has_points else []
        assert not len(points) or (points.min() >= 0 and points.max() < output.GetNumberOfPoints()), "a cell of points that are not there"


class Reader:
    """A reader that lives as long as the process."""

    def __init__(self, kind):
        self.get = getattr(vg, f"vtkGranular{kind}Reader")()
        self.said = said_by(self.get)

    def set_any(self, chance):
        """Sets the properties that it has at random."""
        for name, values in PROPERTIES.items():
            if hasattr(self.get, "Set" + name):
                value = chance.choice(values)
                getattr(self.get, "Set" + name)(*value if isinstance(value, tuple) else (value,))
        for name in ("GetPointDataArraySelection", "GetCellDataArraySelection"):
            arrays = getattr(self.get, name, vtkDataArraySelection)()
            for i in range(arrays.GetNumberOfArrays()):
                arrays.SetArraySetting(arrays.GetArrayName(i), chance.randrange(3) > 0)

    def check(self, update, folder):
        """One update: valid outputs, or an error and empty ones. Returns whether there are outputs."""
        self.said.clear()
        update()
        failed, message = self.get.GetErrorCode() != 0, self.get.GetErrorMessage() or ""
        assert failed == bool(message), f"an error without a message, or a message without an error: {message}"
        assert not failed or folder in message, f"an error that names no file: {message}"
        assert failed or not any("ERROR: " in text for text in self.said), f"an error was told, but nothing failed: {self.said}"
        for port in range(self.get.GetNumberOfOutputPorts()):
            for output in leaves(self.get.GetOutputDataObject(port)):
                assert not failed or size_of(output) == 0, "an error, and yet an output"
                check_valid(output)
        return not failed

    def use(self, paths, chance):
        """As by a user: opens, looks at some times and pieces, changes properties. Returns how many updates gave data, and all."""
        folder = os.path.dirname(paths[0])
        self.get.ClearFileNames()
        for path in paths:
            self.get.AddFileName(path)
        self.get.Refresh()  # the names are those of the copy before
        self.set_any(chance)
        read = self.check(self.get.UpdateInformation, folder)
        self.set_any(chance)  # now the arrays are known
        for _ in range(2):
            information, times = self.get.GetOutputInformation(0), self.get.GetExecutive().TIME_STEPS()
            moment = chance.choice(information.Get(times)) if information.Has(times) and information.Length(times) else 0
            pieces = chance.choice((1, 1, 3))
            piece = chance.randrange(pieces)
            read += self.check(lambda: self.get.UpdateTimeStep(moment, piece, pieces), folder)  # noqa: B023
        return read, 3


def try_copy(readers, files, number, chance):
    """Writes a copy, or two, of which the second may be the file as it was, and reads them. Returns as Reader.use."""
    name, good, plain, able = files[number]
    paths, size = [], 0
    for piece in range(chance.choice((1, 1, 1, 2))):
        copy = good if piece and chance.randrange(2) else copy_of(good, plain, chance.choice(files)[1], chance)
        paths.append(os.path.abspath(f"a.{piece}{os.path.splitext(name)[1]}"))
        with open(paths[-1], "wb") as file:
            file.write(copy)
        size += max(len(copy), len(plain))
    start, before = time.process_time(), status("VmSize")
    signal.alarm(100)  # s, on a machine that does much else
    for reader in readers:
        reader.get.CanReadFile(paths[0])
    counts = readers[chance.choice(able)].use(paths, chance)
    if chance.randrange(8) == 0:
        readers[chance.randrange(len(readers))].use(paths, chance)
    took, memory = time.process_time() - start, status("VmPeak") - before
    assert took < 10, f"{took} s of processors"
    assert memory <= 20 * size + 256 * MIB, f"{memory / MIB} MiB of memory for {size} bytes"
    return counts


def main(copies=4, seed=1):
    ctypes.CDLL(None).mallopt(-8, 1)  # one arena: those of threads reserve addresses
    readers = [Reader(kind) for kind in KINDS]
    files = []
    for folder, _, names in sorted(os.walk(GOOD)):
        for name in sorted(names):
            path = os.path.join(folder, name)
            able = [i for i, reader in enumerate(readers) if reader.get.CanReadFile(path)]
            if able and os.path.getsize(path) > 0:
                good = content(path)
                files.append((os.path.relpath(path, GOOD), good, gzip.decompress(good) if name.endswith(".gz") else good, able))
    read = updates = 0
    for copy in range(copies):
        for number, (name, *_) in enumerate(files):
            what = f"seed {seed} copy {copy} of {name}"
            with open("last", "w") as file:
                file.write(what)
            try:
                counts = try_copy(readers, files, number, random.Random(what))
            except AssertionError as error:
                raise AssertionError(f"{what}: {error}") from None
            read, updates = read + counts[0], updates + counts[1]
    print(f"{len(files)} files, {copies} copies of each: {read} of {updates} updates gave data")
    assert 0 < read < updates, (read, updates)


main(*map(int, sys.argv[1:3]))
