# SPDX-License-Identifier: BSD-3-Clause
"""Other programs on the same files, and conversions: the time of each, and how far the numbers of programs are from those in the file."""
import importlib.util
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOInfovis import vtkDelimitedTextReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter

import vtkgranular as vg
from scene import LATTICE, Packing, Rounds, array_of, main, open_dump, points_of, read_again, scientific, table

OURS = "vtk-granular, 1 thread"
PLACE = 1e3  # of the box


def read_ours(path):
    data = read_again(open_dump(path))
    return numpy.column_stack((points_of(data), array_of(data, "v"), array_of(data, "f")))


def read_arrays(path):
    frame = vg.open(path).read(threads=1)
    return numpy.column_stack((frame["points"], frame["v"], frame["f"]))


def read_loadtxt(path):
    return numpy.loadtxt(path, skiprows=9, usecols=range(2, 11))


def read_pandas(path):
    import pandas
    return pandas.read_csv(path, sep=" ", skiprows=9, header=None, usecols=range(2, 11)).to_numpy()


def read_ase(path):
    from ase.io import read
    return read(path, format="lammps-dump-text", units="metal").positions  # its units of length, so that none are changed


def read_mdanalysis(path):
    import MDAnalysis
    atoms = MDAnalysis.Universe(path, format="LAMMPSDUMP", topology_format="LAMMPSDUMP").atoms
    return atoms.positions + PLACE  # it moves the corner of the box to the origin


def read_vtk(path):
    reader = vtkDelimitedTextReader()
    with open(path, encoding="ascii") as stream:
        reader.SetInputString("".join(stream.readlines()[9:]))
    reader.ReadFromInputStringOn()
    reader.SetFieldDelimiterCharacters(" ")
    reader.DetectNumericColumnsOn()
    reader.MergeConsecutiveDelimitersOn()
    reader.Update()
    columns = reader.GetOutput()
    return numpy.column_stack([vtk_to_numpy(columns.GetColumn(k)) for k in range(2, 11)])


# name: (function, module that must be there)
READERS = {
    OURS: (read_ours, None),
    "vg.open, 1 thread": (read_arrays, None),
    "numpy.loadtxt": (read_loadtxt, None),
    "pandas.read_csv": (read_pandas, "pandas"),
    "VTK, vtkDelimitedTextReader": (read_vtk, None),
    "ASE, lammps-dump-text": (read_ase, "ase"),
    "MDAnalysis, LAMMPSDUMP": (read_mdanalysis, "MDAnalysis"),
}


def conversions(study):
    """Ten frames; a conversion reads the next frame while it writes one."""
    packing = Packing(layers=study.pick(6, 1), lattice=study.pick(LATTICE, 8))
    arrays = {"id": numpy.arange(1, packing.rows + 1), "type": numpy.ones(packing.rows, int), "points": packing.points, "v": packing.v,
              "f": packing.f, "radius": packing.radius}
    path = str(study.folder / "series.dump")
    with vg.Writer(path, numbers="%g") as writer:
        for step in range(10):
            writer.write(arrays, box=vg.Box((0, 0, 0), (1, 1, 1), boundary="pp pp pp"), step=step)
    run, frames, times = vg.open(path), [frame.read() for frame in vg.open(path)], Rounds(10 * packing.rows, time.perf_counter)
    ways = {"text of six columns": (".dump", {"columns": "id type x y z radius"}), "Zstandard": (".dump.zst", {})}
    times.add("read", lambda: [run[i].read() for i in range(10)])
    for name, (ending, how) in ways.items():
        out = str(study.folder / f"out{ending}")
        times.add(f"write {name}", lambda out=out, how=how: vg.write(out, frames, **how))
        times.add(f"convert to {name}", lambda out=out, how=how: vg.write(out, run, **how))
    times.run(study.pick(3, 1))
    return table(["case", "time ns/particle", "against reading and writing"], [
        [f"`{case}`", f"{times.ns(case):.0f}", f"{times.ns(case) / (times.ns('read') + times.ns(case.replace('convert to', 'write'))):.2f}"
         if case.startswith("convert") else None] for case in times.contenders])


def legacy_files(study):
    """What `dump custom/vtk` of LIGGGHTS holds, by the reader of VTK and by ours."""
    packing = Packing(layers=study.pick(2, 1), lattice=study.pick(63, 8))
    data, times = read_again(open_dump(str(packing.write(study.folder / "legacy.dump", "%g")))), Rounds(packing.rows)
    for form, binary in (("text", 0), ("binary", 1)):
        path = str(study.folder / f"{form}_1.vtk")
        writer = vtkPolyDataWriter()
        writer.SetFileName(path)
        writer.SetFileType(1 + binary)
        writer.SetInputData(data)
        writer.Write()
        values = {}
        for name, reader in (("vtkPolyDataReader", vtkPolyDataReader()), ("GranularVTKParticleReader", vg.vtkGranularVTKParticleReader())):
            if name.startswith("Granular"):
                reader.AddFileName(path)
                reader.SetThreads(1)
            else:
                reader.SetFileName(path)
            values[name] = lambda reader=reader: points_of(read_again(reader))
            times.add(f"{form}, {name}", values[name])
        study.check(numpy.array_equal(*(read() for read in values.values())), form)
    times.run(study.pick(5, 1))
    return table(["case", "time ns/particle", "VTK's reader against ours"], [
        [f"`{case}`", f"{times.ns(case):.0f}", f"{times.ratio(case, case.replace('vtkPolyData', 'GranularVTKParticle')):.1f}"]
        for case in times.contenders])


def study_of(study):
    packing = Packing(PLACE, layers=1, lattice=study.pick(63, 8))
    truth = numpy.column_stack((packing.points, packing.v, packing.f))
    installed = {name: read for name, (read, module) in READERS.items() if not module or importlib.util.find_spec(module)}
    times, errors = Rounds(packing.rows), {}
    for text in ("%g", "%.17g"):
        path = str(packing.write(study.folder / f"{text[1:]}.dump", text))
        told = numpy.array([[float(text % value) for value in row] for row in truth.tolist()])
        for name, read in installed.items():
            values = read(path)
            true = told[:, :values.shape[1]]
            used = ~numpy.isnan(values).any(0)
            wrong = numpy.abs(values[:, used] - true[:, used])
            errors[name, text] = ((wrong > 0).mean(), (wrong / numpy.spacing(numpy.abs(true[:, used]))).max())
            times.add((name, text), lambda read=read, path=path: read(path))
        for name in list(READERS)[:2]:
            study.check(errors[name, text] == (0, 0), name)
    times.run(study.pick(3, 1))
    rows = [[f"`{name}; {text}`", f"{times.ns((name, text)):.0f}", f"{times.ratio((name, text), (OURS, text)):.1f}", f"{wrong:.0%}",
             scientific(worst)] for (name, text), (wrong, worst) in errors.items()]
    absent = [name for name in READERS if name not in installed]
    study.block("others", "15,876 particles at 1e3 lengths from the origin. Errors are distances from what the words in the file say. ASE and "
                "MDAnalysis keep positions only; MDAnalysis moves the box to the origin, which is undone here. Opening the file is part of the "
                "time." + (f" Not installed: {', '.join(absent)}." if absent else ""),
                table(["program; text", "read ns/particle", "against ours", "wrong values", "largest error [ulp]"], rows))
    study.block("legacy", "31,752 particles in legacy VTK files with the arrays of a dump of 12 columns; one thread, processor time, open "
                "readers that read again.", legacy_files(study))
    study.block("conversions", "Ten frames of 95,256 particles with 12 columns of %g; time on the wall, all cores, files in the page cache. A "
                "conversion reads the next frame while it writes one.", conversions(study))


main(study_of)
