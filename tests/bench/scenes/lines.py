# SPDX-License-Identifier: BSD-3-Clause
"""Lines between particles in tilted periodic boxes, as written and by the minimum image; and counts of particles on faces."""
from decimal import Decimal, getcontext
from fractions import Fraction

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

import granular
from scene import main, open_dump, tell_error

getcontext().prec = 50
TILTS = {"flat": (0, 0, 0), "tilted by 1/2": (0.5, 0, 0), "tilted by 1/2 along all": (0.5, 0.5, 0.5),
         "tilted by 2": (2, 0, 0), "tilted by -1.5, 0.75, 1.25": (-1.5, 0.75, 1.25)}


def exact_nearest(difference, edges, reach):
    """The least square of a length over images, in integers of 2^-40; the search is wide enough for these tilts."""
    counts = numpy.array(numpy.meshgrid(*3 * [range(-reach, reach + 1)], indexing="ij")).reshape(3, -1).T
    images = counts.astype(object).dot(edges)
    moved = images + difference
    return min((moved ** 2).sum(1))


def lines_study(study):
    random = numpy.random.default_rng(5)
    rows = study.pick(1000, 100)
    unit = 2 ** 40
    for name, tilts in TILTS.items():
        xy, xz, yz = tilts
        edges = numpy.array([[unit, 0, 0], [int(xy * unit), unit, 0], [int(xz * unit), int(yz * unit), unit]], dtype=object)
        # Places are whole numbers of 2^-40: each coordinate and each difference is exact in a double.
        ends = random.integers(0, unit, (2 * rows, 3)).astype(object)
        near = random.integers(-unit // 20, unit // 20, (rows, 3)).astype(object)
        ends[1::2] = ends[0::2] + near
        wrapped = []
        for end in ends:  # into the tilted box, along z, y, x
            for axis in (2, 1, 0):
                end = end - (end[axis] // unit) * edges[axis]
            wrapped.append(end)
        places = [[value / unit for value in end] for end in wrapped]
        path = study.folder / "ends.dump"
        bounds = [(min(0, xy, xz, xy + xz), 1 + max(0, xy, xz, xy + xz), xy), (min(0, yz), 1 + max(0, yz), xz), (0, 1, yz)]
        text = "".join(" ".join(repr(float(x)) for x in line) + "\n" for line in bounds)
        path.write_text(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(places)}\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
                        f"{text}ITEM: ATOMS id type x y z \n" +
                        "".join(f"{i} 1 {x!r} {y!r} {z!r} \n" for i, (x, y, z) in enumerate(places, 1)), encoding="ascii")
        bonds = vtkTable()
        for column, first in (("id1", 1), ("id2", 2)):
            array = numpy_to_vtk(numpy.arange(first, 2 * rows + 1, 2), deep=True)
            array.SetName(column)
            bonds.AddColumn(array)
        true = [exact_nearest(wrapped[2 * k + 1] - wrapped[2 * k], edges, 4) for k in range(rows)]
        lengths = [float((Decimal(int(square)).sqrt()) / unit) for square in true]
        reader = open_dump(path)
        for way, setting in (("minimum image", 0), ("as written", 2)):
            join = granular.vtkGranularLocalJoin()
            join.SetInputConnection(0, reader.GetOutputPort())
            join.SetInputData(1, bonds)
            join.SetPeriodicLines(setting)
            join.Update()
            found = vtk_to_numpy(join.GetOutput().GetCellData().GetArray("length"))
            study.check(len(found) == rows, name)
            ulps = [float(abs(Decimal(float(a)) - Decimal(int(square)).sqrt() / unit)) / float(numpy.spacing(b))
                    for a, square, b in zip(found, true, lengths)]
            case = f"{name}; {way}"
            tell_error(study, case, "length", ulps, 1, "ulp")
            study.tell(case, "wrong image", float((numpy.abs(found - lengths) > 1e-9).mean()), "1")
            study.tell(case, "longest against true", float((found / lengths).max()), "1")
            if setting == 0:
                study.check(max(ulps) <= 2, f"{case}: {max(ulps)} ulp")


def counts_study(study):
    """Particles on the faces of grids, and one step of a double beside: the counts against comparisons with the faces, and what
    the usual formula, the integer part of (x - lo) / (hi - lo) * n, makes of them."""
    random = numpy.random.default_rng(6)
    grids = study.pick(200, 20)
    misplaced, wrong, placed, ulps = 0, 0, 0, 0.0
    for _ in range(grids):
        n = int(random.integers(2, 40))
        lo = float(random.uniform(-10, 10))
        hi = lo + float(random.uniform(0.1, 10))
        source = granular.vtkGranularDecompositionSource()
        source.SetBounds(lo, hi, 0, 1, 0, 1)
        source.SetProcessorGrid(n, 1, 1)
        source.Update()
        corners = vtk_to_numpy(source.GetOutput().GetPoints().GetData())[:, 0]
        faces = numpy.unique(corners)
        study.check(len(faces) == n + 1, "faces of a grid")
        inner = faces[1:-1]
        x = numpy.concatenate((inner, numpy.nextafter(inner, -numpy.inf), numpy.nextafter(inner, numpy.inf)))
        points = numpy.column_stack((x, numpy.full((len(x), 2), 0.5)))
        data = vtkPolyData()
        data.SetPoints(vtkPoints())
        data.GetPoints().SetData(numpy_to_vtk(points, deep=True))
        count = granular.vtkGranularDecomposition()
        count.SetInputData(data)
        count.SetBounds(lo, hi, 0, 1, 0, 1)
        count.SetProcessorGrid(n, 1, 1)
        count.Update()
        output = count.GetOutput()
        owners = numpy.searchsorted(faces, x, side="right") - 1  # by comparison
        true = numpy.bincount(owners, minlength=n)
        misplaced += int(abs(vtk_to_numpy(output.GetCellData().GetArray("nlocal")) - true).sum())
        formula = ((x - lo) / (hi - lo) * n).astype(int).clip(0, n - 1)
        wrong += int((formula != owners).sum())
        placed += len(x)
        imbalance = Fraction(int(true.max()) * n, len(x))
        found = output.GetFieldData().GetArray("imbalance").GetValue(0)
        ulps = max(ulps, float(abs(Fraction(found) - imbalance) / Fraction(float(numpy.spacing(found)))))
    study.tell("on faces", "particles", placed, "1")
    study.check(misplaced == 0, "counts on faces")
    study.tell("on faces", "wrong subdomain", misplaced, "1")
    study.tell("on faces", "wrong subdomain by the formula", wrong / placed, "1")
    study.tell("on faces", "imbalance, largest error", ulps, "ulp")


def study_of(study):
    lines_study(study)
    counts_study(study)


main(study_of)
