# SPDX-License-Identifier: BSD-3-Clause
"""What opening, reading and writing take as frames grow: powers of the number of particles, fitted, and what they say of sizes that
were not measured."""
import math
import statistics

import granular
import numpy
from scene import Packing, Rounds, main, open_dump, read_again
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

RANKS, PARTICLES = 64, 1e9
T_95 = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 6: 2.45}  # Student's t by degrees of freedom, both sides


def fit(sizes, seconds):
    """Returns the exponent b of seconds = a sizes^b by least squares of logarithms, half of its 95 % interval, and a function that
    predicts seconds and the factor up to which that is uncertain for one more measurement (95 %)."""
    x, y = numpy.log(sizes), numpy.log(seconds)
    count, mean = len(x), x.mean()
    spread = ((x - mean) ** 2).sum()
    b = ((x - mean) * (y - y.mean())).sum() / spread
    rest = y - y.mean() - b * (x - mean)
    s, t = math.sqrt((rest ** 2).sum() / (count - 2)), T_95[count - 2]

    def predict(size):
        away = math.log(size) - mean
        return math.exp(y.mean() + b * away), math.exp(t * s * math.sqrt(1 + 1 / count + away ** 2 / spread))
    return b, t * s / math.sqrt(spread), predict


def bytes_of(data):
    """Of the arrays that a reader has made."""
    sets = [data.GetPoints().GetData(), data.GetVerts().GetConnectivityArray(), data.GetVerts().GetOffsetsArray()]
    sets += [data.GetPointData().GetArray(i) for i in range(data.GetPointData().GetNumberOfArrays())]
    return sum(vtk_to_numpy(each).nbytes for each in sets)


def data_of(packing):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(packing.points, deep=True))
    data = vtkPolyData()
    data.SetPoints(points)
    arrays = {"id": numpy.arange(1, packing.rows + 1), "type": numpy.ones(packing.rows, numpy.int32), "v": packing.v,
              "f": packing.f, "radius": packing.radius}
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def write(data, path):
    """A dump custom, or a binary one if the name says so."""
    writer = granular.vtkGranularDumpWriter()
    writer.SetInputData(data)
    writer.SetThreads(1)
    writer.SetNumberFormat("%g")
    writer.SetFileName(str(path))
    if not writer.Write():
        raise SystemExit(f"{path} could not be written")


def ways_of(study, layers):
    """Files of one size: the number of particles, and what is done with each kind."""
    packing = Packing(layers=layers, lattice=study.pick(63, 8))
    data = data_of(packing)
    files = {"text": study.folder / f"{packing.rows}.dump", "binary": study.folder / f"{packing.rows}.bin"}
    rounds = Rounds()
    for name, path in files.items():
        write(data, path)
        reader = open_dump(path)
        again = read_again(reader)
        study.check(again.GetNumberOfPoints() == packing.rows, f"{path} has other particles")
        rounds.add((name, "open"), lambda path=path: open_dump(path))
        rounds.add((name, "read"), lambda reader=reader: read_again(reader))
        rounds.add((name, "write"), lambda path=path: write(again, path.with_stem("again")))
    rounds.run(study.pick(5, 1))
    size = {name: path.stat().st_size / packing.rows for name, path in files.items()}
    for path in study.folder.iterdir():
        path.unlink()
    return packing.rows, size, bytes_of(again) / packing.rows, {key: rounds.time(key) for key in rounds.samples}


def tell_fit(study, case, sizes, seconds, particles):
    """particles: of the size for which the time is predicted."""
    b, uncertain, predict = fit(sizes, seconds)
    study.tell(case, "smallest", 1e9 * seconds[0] / sizes[0], "ns/particle")
    study.tell(case, "largest", 1e9 * seconds[-1] / sizes[-1], "ns/particle")
    study.tell(case, "exponent", b, "1")
    study.tell(case, "exponent, uncertain", uncertain, "1")
    at, factor = predict(particles)
    study.tell(case, "predicted", at, "s")
    study.tell(case, "predicted, uncertain", factor, "1")


def study_of(study):
    found = [ways_of(study, layers) for layers in study.pick((20, 40, 80, 120, 160), (1, 2, 4))]
    sizes = [rows for rows, *_ in found]
    for name in ("text", "binary"):
        for verb in ("open", "read", "write"):
            seconds = [times[name, verb] for *_, times in found]
            if (name, verb) == ("binary", "open"):  # looks at headers alone
                study.tell("binary, open", "a frame", statistics.median(seconds), "s")
                study.tell("binary, open", "largest against smallest frame", seconds[-1] / seconds[0], "1")
                continue
            tell_fit(study, f"{name}, {verb}", sizes, seconds, PARTICLES if verb == "open" else PARTICLES / RANKS)
        study.tell(f"{name}, size", "size", found[-1][1][name], "B/particle")
    study.tell("memory", "arrays", found[-1][2], "B/particle")


main(study_of)
