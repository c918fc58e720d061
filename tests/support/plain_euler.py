# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on the files of dump euler/vtk, written with the simplest means and sharing no code."""
import numpy

ARRAYS = {"v_avg": 3, "volumefraction": 1, "radius": 1, "pressure": 1}
STRESSES = {"sigma": 3, "tau": 3}


def read(path):
    """The values of a file of LIGGGHTS by name, and its centres as `centres`."""
    with open(path) as file:
        lines = file.read().splitlines()
    found, at, count = {}, 0, 0
    while at < len(lines):
        words = lines[at].split()
        at += 1
        if words[:1] == ["POINTS"]:
            count, name, size = int(words[1]), "centres", 3
        elif words[:1] == ["VECTORS"]:
            name, size = words[1], 3
        elif words[:1] == ["SCALARS"]:
            name, size = words[1], 1
            at += 1  # LOOKUP_TABLE
        else:
            continue
        rows = [[float(word) for word in line.split()] for line in lines[at:at + count]]
        found[name] = numpy.array(rows, dtype=float).reshape(count, size)
        at += count
    return found


def text(values, number=lambda value: "%f" % value):
    """The file that LIGGGHTS, or where there are stresses PFM, writes of such values, by Python's printf."""
    count = len(values["centres"])

    def rows(name):
        return "".join(" ".join(number(value) for value in row) + "\n" for row in values[name])

    out = "# vtk DataFile Version 2.0\nLIGGGHTS mesh/VTK export\nASCII\nDATASET POLYDATA\n"
    out += f"POINTS {count} float\n{rows('centres')}VERTICES {count} {2 * count}\n"
    out += "".join(f"1 {i}\n" for i in range(count)) + f"POINT_DATA {count}\n"
    for name, size in {**ARRAYS, **STRESSES}.items():
        if name in values:
            kind = "SCALARS {} float 1\nLOOKUP_TABLE default\n" if size == 1 else "VECTORS {} float\n"
            out += kind.format(name) + rows(name)
    return out


def grid(lo, hi, counts):
    """The centres of a regular grid's cells, x fastest."""
    axes = [lo[a] + (numpy.arange(counts[a]) + 0.5) * ((hi[a] - lo[a]) / counts[a]) for a in range(3)]
    z, y, x = numpy.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return numpy.column_stack([x.ravel(), y.ravel(), z.ravel()])


def grids(faces, counts):
    """The centres of the grids of processes that planes divide a box among: along each axis the planes, and the cells
    between two of them."""
    found = []
    for k, j, i in numpy.ndindex(*(len(along) for along in reversed(counts))):
        lo = [faces[axis][at] for axis, at in enumerate((i, j, k))]
        hi = [faces[axis][at + 1] for axis, at in enumerate((i, j, k))]
        found.append(grid(lo, hi, [counts[axis][at] for axis, at in enumerate((i, j, k))]))
    return found


def cells(centres, stresses=False, seed=1):
    """Values for cells at these centres, that are not the same twice."""
    random = numpy.random.default_rng(seed)
    sizes = {**ARRAYS, **(STRESSES if stresses else {})}
    return {"centres": centres, **{name: random.uniform(-9, 9, (len(centres), size)) for name, size in sizes.items()}}
