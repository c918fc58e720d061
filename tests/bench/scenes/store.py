# SPDX-License-Identifier: BSD-3-Clause
"""Storing a scene: bytes a particle, time to write and read, and what is lost, for boxes near to and far from the origin."""
import ctypes
import gzip
import os
import shutil

import numpy
from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import granular
from scene import (COLUMNS, SMALLEST, Packing, Rounds, array_of, lengths, main, open_dump, points_of, read_again, tell_error)

SCALED = "id type xs ys zs " + " ".join(COLUMNS[5:])
PLACES = {"0": 0.0, "1e3": 1000.123456789, "1e6": 1000123.456789}  # far boxes have no round bounds
BASELINE = "custom %g"

# name: properties of the writer, ending. Without NumberFormat: six digits are not asked for.
KINDS = {
    "custom %g": ({"NumberFormat": "%g"}, ".dump"),
    "custom %.9g": ({"NumberFormat": "%.9g"}, ".dump"),
    "custom %.12g": ({"NumberFormat": "%.12g"}, ".dump"),
    "custom %.17g": ({"NumberFormat": "%.17g"}, ".dump"),
    "custom shortest": ({"NumberFormat": "shortest"}, ".dump"),
    "scaled %g": ({"NumberFormat": "%g", "Columns": SCALED}, ".dump"),
    "scaled %.9g": ({"NumberFormat": "%.9g", "Columns": SCALED}, ".dump"),
    "binary, LIGGGHTS": ({"Dialect": 0}, ".bin"),
    "binary, LAMMPS": ({"Dialect": 1}, ".bin"),
}
PACKERS = {"": "", ", gzip": ".gz", ", zstd": ".zst"}


def dump_writer(data, path, **properties):
    writer = granular.vtkGranularDumpWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    for name, value in {"Dialect": 1, "Columns": " ".join(COLUMNS), "Threads": 1, **properties}.items():
        getattr(writer, "Set" + name)(value)
    return writer


def zstd(content, level):
    """By the system's library: Python has none."""
    library = ctypes.CDLL("libzstd.so.1")
    library.ZSTD_compressBound.restype = library.ZSTD_compress.restype = ctypes.c_size_t
    room = library.ZSTD_compressBound(ctypes.c_size_t(len(content)))
    out = ctypes.create_string_buffer(room)
    size = library.ZSTD_compress(out, ctypes.c_size_t(room), content, ctypes.c_size_t(len(content)), level)
    return out.raw[:size]


class PackedBinary:
    """A binary dump that is compressed afterwards, as by the program gzip or zstd: no code writes such files."""

    def __init__(self, writer, path):
        self.writer, self.path = writer, path

    def Write(self):
        plain, ending = os.path.splitext(self.path)
        self.writer.SetFileName(plain)
        done = self.writer.Write()
        with open(plain, "rb") as stream:
            content = stream.read()
        os.remove(plain)
        with open(self.path, "wb") as out:
            out.write(gzip.compress(content, 6, mtime=0) if ending == ".gz" else zstd(content, 3))
        return done


def vtk_ways():
    """name: (make a writer, make a reader, ending) of VTK's own formats."""
    def legacy(data, path):
        writer = vtkPolyDataWriter()
        writer.SetFileTypeToASCII()
        writer.SetInputData(data)
        writer.SetFileName(path)
        return writer

    def xml(compress):
        def make(data, path):
            writer = vtkXMLPolyDataWriter()
            writer.SetDataModeToBinary() if compress else writer.SetDataModeToAppended()
            writer.EncodeAppendedDataOff()
            if not compress:
                writer.SetCompressorTypeToNone()
            writer.SetInputData(data)
            writer.SetFileName(path)
            return writer
        return make

    ways = {"VTK legacy, text": (legacy, vtkPolyDataReader, ".vtk"),
            "VTP, raw": (xml(False), vtkXMLPolyDataReader, ".vtp"),
            "VTP, zlib": (xml(True), vtkXMLPolyDataReader, ".vtp")}
    try:
        from vtkmodules.vtkIOHDF import vtkHDFReader, vtkHDFWriter
    except ImportError:
        return ways
    def hdf(data, path):
        writer = vtkHDFWriter()
        writer.SetInputData(data)
        writer.SetFileName(path)
        return writer
    return {**ways, "VTKHDF": (hdf, vtkHDFReader, ".vtkhdf")}


class Way:
    """One way to store one scene: its file is written by write(), its data are what read() gives."""

    def __init__(self, name, make_writer, open_reader, path):
        self.name, self.make_writer, self.open_reader, self.path = name, make_writer, open_reader, path
        self.is_dump = open_reader is None

    def prepare(self):
        return (self.make_writer(),)

    @staticmethod
    def write(writer):
        if not writer.Write():
            raise SystemExit("a file could not be written")

    def reader(self):
        if self.is_dump:
            names = ()
            if self.path.endswith(".bin") or ".bin." in self.path:
                names = (("ColumnNames", " ".join(COLUMNS)),)
            return open_dump(self.path, **dict(names))
        reader = self.open_reader()
        reader.SetFileName(self.path)
        return reader


def ways_of(study, data, place):
    for kind, (properties, ending) in KINDS.items():
        for packer, more in PACKERS.items():
            path = str(study.folder / f"{kind}{packer}{place}".replace(" ", "_").replace("%", "")) + ending + more
            packed = ending == ".bin" and more
            yield Way(kind + packer, lambda p=path, q=properties, packed=packed:
                      PackedBinary(dump_writer(data, p, **q), p) if packed else dump_writer(data, p, **q), None, path)
    for kind, (make, reader, ending) in vtk_ways().items():
        path = str(study.folder / f"{kind}{place}".replace(" ", "_")) + ending
        yield Way(kind, lambda p=path, m=make: m(data, p), reader, path)


def tell_errors(study, way, place, packing, data):
    points, case = points_of(data), f"{way.name}; box at {place}"
    tell_error(study, case, "position", points - packing.points, SMALLEST, "radius")
    tell_error(study, case, "velocity", array_of(data, "v") - packing.v, numpy.sqrt((lengths(packing.v) ** 2).mean()), "rms")
    tell_error(study, case, "force", lengths(array_of(data, "f") - packing.f) / lengths(packing.f), 1, "1")
    tell_error(study, case, "strain", packing.strain_of(points) - packing.strain, 1, "1")
    exact = any(name in way.name for name in ("17g", "shortest", "binary", "VTP, raw", "VTP, zlib", "VTKHDF"))
    if exact:
        study.check((points == packing.points).all() and (array_of(data, "f") == packing.f).all(), case)


def print_box_as_liggghts(path, packing):
    """LIGGGHTS prints the bounds with six digits."""
    with open(path, encoding="ascii") as stream:
        text = stream.read()
    head, mark, rest = text.partition("ITEM: BOX BOUNDS pp pp pp\n")
    rows = rest.split("\n", 3)[3]
    with open(path, "w", encoding="ascii") as out:
        out.write(head + mark + 3 * ("%g %g\n" % (packing.lo, packing.hi)) + rows)


def far_box_of_liggghts(study):
    """The example of the page, in the bytes of LIGGGHTS: particles of radius 1 mm in a box of 0.19 m, 1 km away along all axes."""
    lo, length, radius = 1000.1249, 0.1902, 1e-3
    scaled = numpy.random.default_rng(1).random((study.pick(100_000, 1000), 3))
    points = lo + length * scaled
    head = (f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(points)}\nITEM: BOX BOUNDS ff ff ff\n"
            + 3 * ("%g %g\n" % (lo, lo + length)) + "ITEM: ATOMS id type ")
    for columns, values, form in (("xs ys zs", scaled, "%g"), ("x y z", points, "%g"), ("x y z", points, "%.9g"), ("x y z", points, "%.12g")):
        path = study.folder / "far.dump"
        with open(path, "w", encoding="ascii") as out:
            out.write(head + f"{columns} \n")
            numpy.savetxt(out, numpy.column_stack((numpy.arange(1, len(points) + 1), values)), f"%d 1 {form} {form} {form} ")
        found = points_of(read_again(open_dump(path)))
        case = f"far box of LIGGGHTS, {columns} of {form}"
        tell_error(study, f"{case}; box at 1e3", "position", found - points, radius, "radius")
        tell_error(study, f"{case}; box at 1e3", "coordinate", (found - points).ravel(), radius, "radius")


def study_of(study):
    far_box_of_liggghts(study)
    for place, lo in PLACES.items():
        timed = place == "1e3"
        packing = Packing(lo, layers=study.pick(4 if timed else 1, 1), lattice=study.pick(63, 8))
        true = open_dump(packing.write(study.folder / f"true_{place}.dump"))
        true.Update()
        data = true.GetOutput()
        study.check((points_of(data) == packing.points).all(), "reading %.17g")
        writing, reading, readers = Rounds(), Rounds(), {}
        for way in ways_of(study, data, place):
            way.write(*way.prepare())
            reader = way.reader()
            try:
                found = read_again(reader)
                told = found.GetNumberOfPoints() == packing.rows
            except AttributeError:
                told = False
            if not told and not way.is_dump:
                continue  # some versions of libexpat refuse what VTK has written raw
            study.check(told, way.name)
            readers[way.name] = (way, reader)
            tell_errors(study, way, place, packing, found)
            study.tell(f"{way.name}; box at {place}", "size", os.path.getsize(way.path) / packing.rows, "B/particle")
            if way.name in ("scaled %g", "scaled %.9g") and place != "1e6":  # there, both bounds would be the same
                liggghts = Way(f"{way.name}, box of LIGGGHTS", way.make_writer, None, way.path.replace(".dump", "_six.dump"))
                shutil.copy(way.path, liggghts.path)
                print_box_as_liggghts(liggghts.path, packing)
                tell_errors(study, liggghts, place, packing, read_again(liggghts.reader()))
            writing.add(way.name, way.write, way.prepare)
            reading.add(way.name, lambda reader=reader: read_again(reader))
        rounds = study.pick(3, 1) if timed else 0
        writing.run(rounds)
        reading.run(rounds)
        for name in readers if timed else ():
            for verb, times in (("write", writing), ("read", reading)):
                study.tell(name, f"{verb}", 1e9 * times.time(name) / packing.rows, "ns/particle")
                study.tell(name, f"{verb} against {BASELINE}", times.ratio(name, BASELINE), "1")


main(study_of)
