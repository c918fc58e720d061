# SPDX-License-Identifier: BSD-3-Clause
"""What a user reads first: ten lines of the report, and the table Decide of docs/speed_and_error.md. Both are made of figures."""
from scene_parts import error, position_error
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


# need: (way to store, the box it was measured at, properties besides, error shown, what goes wrong with the default)
DECIDE = (
    ("a picture, box near the origin", "custom %g", "0", "default of most runs; `PointPrecision=\"Single\"` halves the points",
     "position", "nothing"),
    ("a picture, box far away", "scaled %g", "1e3", "`dump atom` or `xs ys zs`; `PointPrecision=\"Single\"` only with `PointOrigin`",
     "position", "x y z of six digits: particles jump by a radius"),
    ("a picture of many particles", "binary, LAMMPS", "1e3", "`CellArrays` off but the ones shown; `Vertices=\"None\"`", "position",
     "text: five times the time"),
    ("statistics of velocities to 1e-4", "scaled %g", "1e3", "six digits suffice for velocities anywhere", "velocity", "nothing"),
    ("averages in cells", "scaled %.9g", "1e3", "`Weights=\"Overlap\"` for cells below 20 radii", "position",
     "Centre: see Cells; files of six decimals"),
    ("strain to 1e-4, box near the origin", "custom %.9g", "0", "", "strain", "%g: strain wrong by more than 1e-5 per cent of a radius"),
    ("strain to 1e-4, box far away", "scaled %.9g", "1e3", "", "strain", "%g: strain wrong by 100 %"),
    ("forces for a network", "scaled %g", "1e3", "", "force", "nothing"),
    ("to go on with a run", "binary, LAMMPS", "1e3", "or a restart file", "position", "six digits: particles overlap by 1e-4 radii"),
    ("exchange with LIGGGHTS", "custom shortest", "1e3", "`Dialect=\"LIGGGHTS\"`", "position", "nothing: Automatic keeps all digits"),
    ("exchange with other programs", "custom shortest", "1e3", "", "position", "VTK's legacy text: 11 digits"),
    ("an archive", "scaled %.9g, zstd", "1e3", "`.zst` in the name", "position", "gzip: three times the time to write"),
)


def decide_table(store):
    rows = []
    for need, way, place, besides, metric, wrong in DECIDE:
        case = f"{way}; box at {place}"
        unit = {"position": "radius", "velocity": "rms", "force": "1", "strain": "1"}[metric]
        words = {"position": "radii", "velocity": "of the rms velocity", "force": "relative", "strain": "strain"}[metric]
        rows.append([need, f"`{way}`" + (f"; {besides}" if besides else ""), f"{store.get(case, 'size:B/particle'):.0f}",
                     f"{store.get(way, 'write:ns/particle'):.0f}", f"{store.get(way, 'read:ns/particle'):.0f}",
                     f"{error(store, case, metric, unit)} {words}", wrong])
    return markdown(["need", "settings", "B/particle", "write ns", "read ns", "largest error", "what goes wrong otherwise"], rows)
