# SPDX-License-Identifier: BSD-3-Clause
"""Storing a scene: bytes a particle, time to write and read, and what is lost, for boxes near to and far from the origin; and which
way suits which need."""
import os
import shutil

import numpy
from vtkmodules.vtkIOLegacy import vtkPolyDataReader, vtkPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import vtkgranular as vg
from scene import (COLUMNS, SMALLEST, Packing, Rounds, array_of, largest, lengths, main, open_dump, points_of, read_again, scientific,
                   table)

SCALED = "id type xs ys zs " + " ".join(COLUMNS[5:])
PLACES = {"0": 0.0, "1e3": 1000.123456789, "1e6": 1000123.456789}  # far boxes have no round bounds
DEFAULT = "custom %g"  # what most runs write
SIX = "scaled %g, box of LIGGGHTS"
EXACT = 1e-17  # where errors of 0 are drawn

# name: properties of the writer, ending, packers
KINDS = {
    DEFAULT: ({"NumberFormat": "%g"}, ".dump", True),
    "custom %.9g": ({"NumberFormat": "%.9g"}, ".dump", False),
    "custom %.12g": ({"NumberFormat": "%.12g"}, ".dump", True),
    "custom %.17g": ({"NumberFormat": "%.17g"}, ".dump", False),
    "custom shortest": ({"NumberFormat": "shortest"}, ".dump", True),
    "scaled %g": ({"NumberFormat": "%g", "Columns": SCALED}, ".dump", False),
    "scaled %.9g": ({"NumberFormat": "%.9g", "Columns": SCALED}, ".dump", False),
    "binary, LIGGGHTS": ({"Dialect": 0}, ".bin", False),
    "binary, LAMMPS": ({"Dialect": 1}, ".bin", False),
}
PACKERS = {"": "", ", gzip": ".gz", ", zstd": ".zst"}

# need, way to store, place of the box, settings besides, error that matters, what goes wrong with the default
DECIDE = (
    ("a picture, box near the origin", DEFAULT, "0", "`PointPrecision=\"Single\"` saves memory", "position",
     "the same"),
    ("a picture, box far away", "custom %.9g", "1e3",
     "`dump_modify ID format \"%d %d %.9g ...\"`; `PointPrecision=\"Single\"` only with `PointOrigin`",
     "position", "particles jump by two radii"),
    ("the same by LAMMPS", "scaled %g", "1e3", "`xs ys zs`: LAMMPS prints all digits of the box, LIGGGHTS six", "position",
     "particles jump by two radii"),
    ("a picture of many particles", "binary, LAMMPS", "1e3", "`PointArrayStatus` of what is shown, `Vertices=\"None\"`", "position",
     "text takes longer to read"),
    ("velocities to 1e-4, box anywhere", "custom %.9g", "1e3", "`%g` for `vx vy vz` is enough", "velocity",
     "velocities are right, positions are not"),
    ("averages in cells", "custom %.9g", "1e3", "`Weights=\"Overlap\"` for cells below 20 radii: see [averages](measurements/averages.md)", "position",
     "particles are in wrong cells"),
    ("strain to 1e-4, box near the origin", "custom %.9g", "0", "", "strain", "the error is as large as the strain"),
    ("strain to 1e-4, box far away", "custom %.12g", "1e3", "", "strain", "nothing is right"),
    ("forces of particles to 1e-4", "custom %.9g", "1e3", "forces of contacts: `dump local`, six digits as well", "force",
     "forces are right, positions are not"),
    ("to go on with a run", "binary, LAMMPS", "1e3", "all columns of the atom style; contacts and bonds only in a restart file",
     "position", "particles overlap"),
    ("exchange with LIGGGHTS", "custom shortest", "1e3", "`Dialect=\"LIGGGHTS\"`", "position",
     "digits are lost; `NumberFormat=\"Automatic\"` keeps them"),
    ("exchange with other programs", "custom shortest", "1e3", "", "position", "digits are lost, in VTK's text as well"),
    ("an archive", "custom %.12g, zstd", "1e3", "`.zst` in the name", "position", "digits are lost"),
)
UNITS = {"position": " radii", "velocity": " of the rms velocity", "force": " of a force", "strain": ""}


def dump_writer(data, path, **properties):
    writer = vg.vtkGranularDumpWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    for name, value in {"Dialect": 1, "Columns": " ".join(COLUMNS), "Threads": 1, **properties}.items():
        getattr(writer, "Set" + name)(value)
    return writer


def dump_reader(path):
    return open_dump(path, **({"ColumnNames": " ".join(COLUMNS)} if path.endswith(".bin") else {}))


def vtk_legacy(data, path):
    writer = vtkPolyDataWriter()
    writer.SetFileTypeToASCII()
    writer.SetInputData(data)
    writer.SetFileName(path)
    return writer


def vtk_xml(data, path):
    """Raw appended data."""
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetInputData(data)
    writer.SetFileName(path)
    return writer


def vtk_reader(kind):
    def open_file(path):
        reader = kind()
        reader.SetFileName(path)
        return reader
    return open_file


def ways():
    """name: (make a writer of data and a path, open a path, ending)."""
    for kind, (properties, ending, packed) in KINDS.items():
        for packer, more in PACKERS.items() if packed else [("", "")]:
            yield kind + packer, (lambda data, path, p=properties: dump_writer(data, path, **p), dump_reader, ending + more)
    yield "VTK legacy, text", (vtk_legacy, vtk_reader(vtkPolyDataReader), ".vtk")
    yield "VTP, raw", (vtk_xml, vtk_reader(vtkXMLPolyDataReader), ".vtp")


def errors_of(packing, data):
    points = points_of(data)
    return {"position": largest(points - packing.points) / SMALLEST, "strain": largest(packing.strain_of(points) - packing.strain),
            "velocity": largest(array_of(data, "v") - packing.v) / float(numpy.sqrt((lengths(packing.v) ** 2).mean())),
            "force": largest(lengths(array_of(data, "f") - packing.f) / lengths(packing.f))}


def print_box_as_liggghts(path, packing):
    """LIGGGHTS prints the bounds with six digits."""
    with open(path, encoding="ascii") as stream:
        text = stream.read()
    head, mark, rest = text.partition("ITEM: BOX BOUNDS pp pp pp\n")
    rows = rest.split("\n", 3)[3]
    with open(path, "w", encoding="ascii") as out:
        out.write(head + mark + 3 * ("%g %g\n" % (packing.lo, packing.hi)) + rows)


def write(writer):
    if not writer.Write():
        raise SystemExit("a file could not be written")


def measure(study, place):
    """Returns errors by way, and costs by way for the place of which the table has them: bytes, ns to write, ns to read."""
    timed = place == "1e3"
    packing = Packing(PLACES[place], layers=study.pick(4 if timed else 1, 1), lattice=study.pick(63, 8))
    true = open_dump(packing.write(study.folder / f"true_{place}.dump"))
    true.Update()
    data = true.GetOutput()
    study.check((points_of(data) == packing.points).all(), "reading %.17g")
    writing, reading, errors, sizes = Rounds(packing.rows), Rounds(packing.rows), {}, {}
    for number, (name, (make, open_file, ending)) in enumerate(ways()):
        path = str(study.folder / f"{number}_{place}{ending}")
        write(make(data, path))
        reader = open_file(path)
        found = read_again(reader)
        if name == "VTP, raw" and found.GetNumberOfPoints() == 0:
            continue  # some versions of libexpat refuse what VTK has written raw
        study.check(found.GetNumberOfPoints() == packing.rows, name)
        errors[name] = errors_of(packing, found)
        sizes[name] = os.path.getsize(path) / packing.rows
        if any(exact in name for exact in ("17g", "shortest", "binary", "raw")):
            study.check(not any(errors[name].values()), name)
        if name == "scaled %g" and place != "1e6":  # there, both bounds would be the same
            six = path.replace(".dump", "_six.dump")
            shutil.copy(path, six)
            print_box_as_liggghts(six, packing)
            errors[SIX] = errors_of(packing, read_again(dump_reader(six)))
        writing.add(name, write, lambda make=make, path=path: (make(data, path),))
        reading.add(name, lambda reader=reader: read_again(reader))
    if not timed:
        return errors, {}
    writing.run(study.pick(3, 1))
    reading.run(study.pick(3, 1))
    return errors, {name: (sizes[name], writing.ns(name), reading.ns(name)) for name in sizes}


def decide(errors, costs):
    def told(way, place, metric):
        return scientific(errors[place][way][metric]) + UNITS[metric]
    return table(["need", "store as", "setting", "B/particle", "largest error", f"else, with `{DEFAULT}`"],
                 [[need, f"`{way}`", besides, f"{costs[way][0]:.0f}", told(way, place, metric),
                   f"{told(DEFAULT, place, metric)}: {wrong}"] for need, way, place, besides, metric, wrong in DECIDE])


def far_errors():
    """name: the largest error of positions [smallest radii] at distances [smallest radii] from the origin."""
    near, distances, found = Packing(layers=1).points[::20], 10.0 ** numpy.arange(0, 11), {}
    for distance in distances * SMALLEST:
        lo = distance * 1.01234567891234  # bounds that are not round
        points = lo + near
        ways = {f"%.{digits}g".replace("%.6g", "%g"): [[float(f"%.{digits}g" % value) for value in row] for row in points.tolist()]
                for digits in (6, 9, 12)}
        ways["single precision"] = points.astype(numpy.float32)
        ways["single precision, PointOrigin"] = (points - lo).astype(numpy.float32).astype(float) + lo
        for name, told in ways.items():
            found.setdefault(name, []).append(max(largest(numpy.asarray(told, float) - points) / SMALLEST, EXACT))
        scaled = numpy.array([[float("%g" % value) for value in row] for row in (points - lo).tolist()])
        bounds = [float("%g" % bound) for bound in (lo, lo + 1)]
        found.setdefault("xs of %g, box of LAMMPS", []).append(largest(lo + scaled - points) / SMALLEST)
        found.setdefault("xs of %g, box of LIGGGHTS", []).append(largest(bounds[0] + scaled * (bounds[1] - bounds[0]) - points) / SMALLEST)
    return distances, found


def plot_far(pyplot, distances, found):
    figure, axes = pyplot.subplots(figsize=(7, 4.2), layout="constrained")
    for name, errors in found.items():
        axes.plot(distances, errors, "--" if name.startswith("xs") else ":" if name.startswith("single") else "-", label=name)
    axes.axhline(1e-2, color="0.6", linewidth=0.8, linestyle=":")
    axes.text(1.2, 1.4e-2, "1 % of a radius", fontsize=8, color="0.4")
    axes.set(xscale="log", yscale="log", xlabel="distance of the box from the origin [radii]", ylabel="largest error of positions [radii]",
             ylim=(1e-12, 1e4), xlim=(1, 1e10))
    axes.grid(color="0.93")
    axes.legend(fontsize=8, loc="lower right")
    return figure


def front(points):
    """The points that no other one beats in both, in order."""
    best, found = float("inf"), []
    for x, y, name in sorted(points):
        if y < best:
            best = y
            found.append((x, y, name))
    return found


def scatter(axes, points, label):
    """Points and their front; those behind it are grey, and the default is red."""
    ahead = front(points)
    names = {name for _, _, name in ahead}
    for x, y, name in points:
        axes.plot(x, max(y, EXACT), "o", color="C3" if name == DEFAULT else "C0" if name in names else "0.75")
        if name in names or name in (DEFAULT, "VTK legacy, text", "VTP, raw"):
            axes.annotate(name, (x, max(y, EXACT)), textcoords="offset points", xytext=(6, 5 if name in names else -11), fontsize=7)
    axes.step([x for x, _, _ in ahead], [max(y, EXACT) for _, y, _ in ahead], where="post", color="C0", linewidth=1)
    axes.set_yscale("log")
    axes.set_ylim(EXACT / 30, 1e4)
    axes.axhline(1e-2, color="0.6", linewidth=0.8, linestyle=":")
    axes.grid(color="0.93")
    axes.set_xlabel(label)
    axes.set_xlim(left=0, right=1.35 * max(x for x, _, _ in points))


def plot(pyplot, errors, costs):
    figure, panels = pyplot.subplots(1, 3, figsize=(14, 4.6), sharey=True, layout="constrained")
    for index, label in enumerate(("bytes a particle", "time to write [ns/particle]", "time to read [ns/particle]")):
        scatter(panels[index], [(cost[index], errors[way]["position"], way) for way, cost in costs.items()
                                if index == 0 or "gzip" not in way], label)
    panels[0].set_ylabel("largest error of positions [smallest radii]")
    panels[0].text(2, 1.4e-2, "1 % of a radius", fontsize=8, color="0.4")
    panels[0].text(2, 1.4 * EXACT, "exact", fontsize=8, color="0.4")
    figure.suptitle("box at 1e3 lengths from the origin", fontsize=10)
    return figure


def study_of(study):
    measured = {place: measure(study, place) for place in PLACES}
    errors = {place: each for place, (each, _) in measured.items()}
    costs = measured["1e3"][1]
    study.block("decide", decide(errors, costs))
    rows = [[f"`{way}`", *([f"{cost:.0f}" for cost in costs[way]] if way in costs else [None] * 3),
             *(scientific(errors[place][way]["position"]) if way in errors[place] else "" for place in PLACES),
             *(scientific(errors["1e3"][way][metric]) for metric in ("strain", "velocity"))] for way in errors["1e3"]]
    study.block("store", "A packing of 63,504 particles with radii from 4.7e-3 to 5.3e-3 in a box of length 1, stretched by 5 %; 12 columns: "
                "id type x y z vx vy vz fx fy fz radius. One thread, processor time, files in the page cache. Bytes, times and the errors of "
                "strains and velocities are those at 1e3 box lengths. Writers are those of this library and of VTK. An open file is read "
                "again. Errors are the largest ones.",
                table(["way", "B/particle", "write ns/particle", "read ns/particle", *(f"position error at {place} [radii]" for place in PLACES),
                       "strain error", "velocity error [rms velocity]"], rows))
    study.picture("far", lambda pyplot: plot_far(pyplot, *far_errors()))
    study.picture("store", lambda pyplot: plot(pyplot, errors["1e3"], costs))


main(study_of)
