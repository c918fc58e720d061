# SPDX-License-Identifier: BSD-3-Clause
"""What a user reads first: ten lines of the report, and the table Decide of docs/speed_and_error.md. Both are made of figures."""
from scene_parts import DEFAULT, costs, error, position_error
from tables import markdown, scientific


def ns(value):
    return f"{value:.0f} ns"


def lines_of(results):
    """Ten lines at most, of the parts that were measured."""
    found = {part.name: figures for part, figures in results}
    if "store" in found:
        store = found["store"]
        for way in ("custom %g", "scaled %g", "custom shortest", "binary, LAMMPS"):
            yield (f"Storing, {way}: {store.get(way + '; box at 1e3', 'size:B/particle'):.0f} bytes a particle, written in "
                   f"{ns(store.get(way, 'write:ns/particle'))}, read in {ns(store.get(way, 'read:ns/particle'))}; largest error at 1e3 "
                   f"lengths {scientific(position_error(store, way, '1e3'))} radii")
    if "look" in found:
        look = found["look"]
        yield (f"Single points: {look.get('single', 'points:B/particle'):.0f} bytes instead of "
               f"{look.get('double', 'points:B/particle'):.0f}; error at 1e6 lengths {error(look, 'single; box at 1e6', 'position', 'radius')}"
               f" radii, with PointOrigin {error(look, 'single, PointOrigin; box at 1e6', 'position', 'radius')}")
    if "choose" in found:
        choose = found["choose"]
        yield (f"Points alone take {choose.get('columns: points', 'read against everything:1'):.0%} of the time of all columns; one "
               f"frame of 20 takes {choose.get('1 frame of 20', 'read against all:1'):.0%} of all")
    if "euler" in found:
        case = "cells of 4 radii"
        if case in found["euler"].cases:
            told = found["euler"].cases[case]
            yield (f"Cells of 4 radii: Centre {ns(told['Centre:ns/particle'])}, volume fraction wrong by "
                   f"{scientific(told['Centre, error, rms:1'])} (rms); Overlap {ns(told['Overlap:ns/particle'])}, "
                   f"{scientific(told['Overlap, error, rms:1'])}")
    if "lines" in found:
        worst = max(found["lines"].get(case, "length, largest:ulp") for case in found["lines"].all("minimum image"))
        yield f"Lengths of lines in tilted periodic boxes: within {worst:.1f} ulp"
    if "cores" in found:
        case = "read, 2 threads"
        if case in found["cores"].cases:
            yield f"Two threads read {found['cores'].get(case, 'speed against 1 thread:1'):.1f} times as fast as one, to the same bits"
    if "others" in found:
        others = found["others"]
        ratios = {case: others.get(case, "read against ours:1") for case in others.all("%.17g$")
                  if not case.startswith("vtk-granular") and others.get(case, "read against ours:1")}
        if ratios:
            best = min(ratios, key=ratios.get)
            yield f"The fastest other reader of the same text, {best.split(';')[0]}, takes {ratios[best]:.1f} times as long"


def ratio(store, index, way, other):
    """How many times the bytes (0), the time to write (1) or to read (2) of another way."""
    return costs(store, way)[index] / costs(store, other)[index]


# (need, way to store, place of the box, settings besides, error that matters, what goes wrong with the default)
DECIDE = (
    ("a picture, box near the origin", "custom %g", "0", "the default of most runs; `PointPrecision=\"Single\"` saves memory",
     "position", "nothing"),
    ("a picture, box far away", "custom %.9g", "1e3",
     "`dump_modify ID format \"%d %d %.9g ...\"`, a format for each column; `PointPrecision=\"Single\"` only with `PointOrigin`",
     "position", "particles jump by two radii"),
    ("the same by LAMMPS", "scaled %g", "1e3", "`xs ys zs`: LAMMPS prints all digits of the box, LIGGGHTS six", "position",
     "particles jump by two radii"),
    ("a picture of many particles", "binary, LAMMPS", "1e3", "`PointArrayStatus` of what is shown, `Vertices=\"None\"`", "position",
     lambda store: f"text takes {ratio(store, 2, DEFAULT, 'binary, LAMMPS'):.0f} times as long to read"),
    ("velocities to 1e-4, box anywhere", "custom %.9g", "1e3", "`%g` for `vx vy vz` is enough", "velocity",
     "velocities are right, positions are not"),
    ("averages in cells", "custom %.9g", "1e3", "`Weights=\"Overlap\"` for cells below 20 radii: see [Cells](#cells)", "position",
     "particles are in wrong cells"),
    ("strain to 1e-4, box near the origin", "custom %.9g", "0", "", "strain", "the error is as large as the strain"),
    ("strain to 1e-4, box far away", "custom %.12g", "1e3", "", "strain", "nothing is right"),
    ("forces of particles to 1e-4", "custom %.9g", "1e3", "forces of contacts: `dump local`, six digits as well", "force",
     "forces are right, positions are not"),
    ("to go on with a run", "binary, LAMMPS", "1e3", "all columns of the atom style; contacts and bonds only in a restart file",
     "position", "particles overlap"),
    ("exchange with LIGGGHTS", "custom shortest", "1e3", "`Dialect=\"LIGGGHTS\"`", "position",
     "digits are lost; `NumberFormat=\"Automatic\"` keeps them"),
    ("exchange with other programs", "custom shortest", "1e3", "", "position",
     lambda store: f"digits are lost; VTK's text is wrong by {error(store, 'VTK legacy, text; box at 1e3', 'position', 'radius')} radii"),
    ("an archive", "custom %.12g, zstd", "1e3", "`.zst` in the name", "position",
     lambda store: f"digits are lost; gzip takes {ratio(store, 1, 'custom %.12g, gzip', 'custom %.12g, zstd'):.0f} times as long to write "
     f"for {1 - ratio(store, 0, 'custom %.12g, gzip', 'custom %.12g, zstd'):.0%} fewer bytes"),
)
UNITS = {"position": ("radius", "radii"), "velocity": ("rms", "of the rms velocity"), "force": ("1", "of a force"),
         "strain": ("1", "")}


def decide_table(store):
    def told(way, place, metric):
        unit, words = UNITS[metric]
        return f"{error(store, f'{way}; box at {place}', metric, unit)} {words}".strip()
    rows = []
    for need, way, place, besides, metric, wrong in DECIDE:
        size, write, read = costs(store, way)
        own = [told(each, place, metric) if metric != "position" else "" for each in (way, DEFAULT)]
        positions = [told(each, place, "position") for each in (way, DEFAULT)]
        rows.append([need, f"`{way}`", besides, f"{size:.0f}", f"{write:.0f}", f"{read:.0f}", own[0] or positions[0], positions[0],
                     own[1] or positions[1], positions[1], wrong(store) if callable(wrong) else wrong])
    return markdown(["need", "store as", "settings besides", "B/particle", "write ns/particle", "read ns/particle",
                     "largest error of what is needed", "of positions", f"the same with the default, `{DEFAULT}`", "of positions",
                     "what goes wrong with the default"], rows)


def example(store, opening):
    """The costs of the example below the table, and its errors in the bytes of LIGGGHTS."""
    size, write, read = costs(store, "custom %.9g")
    look = f", {opening / 1000:.2f} s to find the frame when the file is opened" if opening else ""

    def far(columns, metric="position"):
        return f"{store.get(f'far box of LIGGGHTS, {columns}; box at 1e3', f'{metric}, largest:radius'):.2g}"
    return [f"Costs for 10^6 particles with the 12 columns of the table, all of nine digits, by this library and one core: {size:.0f} MB, "
            f"{write / 1000:.2f} s to write, {read / 1000:.2f} s to read{look}. Text loses half a unit of the last digit along each axis. With "
            f"`x y z` of `%g`, that is half a centimetre: {far('x y z of %g', 'coordinate')} radii along an axis, {far('x y z of %g')} radii as a "
            f"distance. With `xs ys zs` of `%g`, the bounds 1000.12 and 1000.32 lose as much: particles are wrong by up to "
            f"{far('xs ys zs of %g')} radii, and the packing is stretched by 5 %. With `x y z` of `%.9g`, the largest error is "
            f"{far('x y z of %.9g')} radii; with `%.12g`, {far('x y z of %.12g')}. The error of velocities with six digits is "
            f"{error(store, 'custom %g; box at 1e3', 'velocity', 'rms')} of their rms value.", ""]
