# SPDX-License-Identifier: BSD-3-Clause
"""The parts that a user asks for: what each choice costs, and what it loses. docs/speed_and_error.md is made of them."""
import math
import re

from parts import BONDS, CONTACTS, EULER, KERNELS
from tables import Column, Part, Target, cases_by_metrics, columns, markdown, scientific, span, verdict

PLACES = ("0", "1e3", "1e6")
SMALLEST = 0.9 / (63 * 1.05 + 1) / 2 ** 1.5  # radius of the particles of scenes/scene.py, in box lengths
EXACT = 1e-17  # where errors of 0 are drawn


def error(figures, case, metric, unit, form="largest"):
    """Largest (rms) of an error, or one of the two; empty where there is none."""
    if case not in figures.cases or figures.get(case, f"{metric}, largest:{unit}") is None:
        return ""
    largest, rms = (scientific(figures.get(case, f"{metric}, {what}:{unit}")) for what in ("largest", "rms"))
    return largest if form == "largest" or largest == rms else f"{largest} ({rms})"


# ---- storing -------------------------------------------------------------------------------------
def stored(figures):
    """Ways to store that were timed."""
    return [case for case in figures.cases if "; box at" not in case]


def position_error(figures, way, place):
    return figures.get(f"{way}; box at {place}", "position, largest:radius")


def costs(figures, way):
    return (figures.get(f"{way}; box at 1e3", "size:B/particle"), figures.get(way, "write:ns/particle"),
            figures.get(way, "read:ns/particle"))


def is_text(way):
    return way.startswith(("custom", "scaled", "VTK legacy"))


def rival(figures, way, place):
    """Returns a way of the same kind, text or binary, that is no worse in bytes, writing, reading and error of positions, and
    better in one; or None."""
    def all_of(name):
        return (*costs(figures, name), position_error(figures, name, place))
    mine = all_of(way)
    for other in stored(figures):
        if is_text(other) == is_text(way) and all(a <= b for a, b in zip(all_of(other), mine)) and all_of(other) != mine:
            return other
    return None


def rivals(figures, way):
    """One for each place of the box, or nothing."""
    found = [rival(figures, way, place) for place in PLACES]
    return found if all(found) else []


def store_table(part, figures, quick):
    head = ["way", "B/particle", "write ns/particle", "against custom %g", "read ns/particle", "against custom %g",
            *(f"position error at {place} [radii]" for place in PLACES), *(f"strain error at {place}" for place in PLACES),
            "velocity error [rms velocity]", "force error, relative", "target"]
    rows = []
    for way in stored(figures):
        size, write, read = costs(figures, way)
        case = f"{way}; box at 1e3"
        rows.append([f"_{way}_" if rivals(figures, way) else f"**{way}**", f"{size:.0f}", f"{write:.0f}",
                     f"{figures.get(way, 'write against custom %g:1'):.2f}", f"{read:.0f}",
                     f"{figures.get(way, 'read against custom %g:1'):.2f}",
                     *(error(figures, f"{way}; box at {place}", "position", "radius", "both") for place in PLACES),
                     *(error(figures, f"{way}; box at {place}", "strain", "1") for place in PLACES),
                     error(figures, case, "velocity", "rms"), error(figures, case, "force", "1"),
                     verdict(part, figures, case, "position, largest:radius", quick)])
    return markdown(head, rows)


def store_words(figures):
    plain = [way for way in stored(figures) if is_text(way) and f"{way}, zstd" in stored(figures)]

    def against(packer, index, form, other=""):
        return span([costs(figures, f"{way}, {packer}")[index] / costs(figures, way + other)[index] for way in plain], form)

    never = [f"{way} ({', '.join(sorted(set(rivals(figures, way))))})" for way in stored(figures) if rivals(figures, way)]
    binary = costs(figures, "binary, LAMMPS")
    text = [costs(figures, way) for way in plain]
    packed = costs(figures, "binary, LAMMPS, zstd")
    return [
        f"Zstandard: {against('zstd', 0, '.0%')} of the bytes of plain text, {against('zstd', 1, '.1f')} times the time to write, "
        f"{against('zstd', 2, '.1f')} times the time to read. gzip: {against('gzip', 0, '.0%')} of the bytes, "
        f"{against('gzip', 1, '.0f')} and {against('gzip', 2, '.1f')} times the time.", "",
        f"Binary against plain text: {span([binary[0] / each[0] for each in text], '.0%')} of the bytes, "
        f"{span([binary[1] / each[1] for each in text], '.0%')} of the time to write, "
        f"{span([binary[2] / each[2] for each in text], '.0%')} of the time to read, no error. Take text where people or other "
        "programs read the file.", "",
        f"Binary dumps are written plain, because no other program reads compressed ones. Compressed afterwards by zstd, they take "
        f"{packed[0] / binary[0]:.0%} of the bytes, and {packed[2] / binary[2]:.1f} times the time to read.", "",
        "Scaled coordinates need all digits of the box, as LAMMPS and this library print them. LIGGGHTS prints six. With its bounds, the "
        "largest error of `scaled %g` at 1e3 is "
        f"{error(figures, 'scaled %g, box of LIGGGHTS; box at 1e3', 'position', 'radius')} radii, and more digits of `xs ys zs` do not help "
        f"({error(figures, 'scaled %.9g, box of LIGGGHTS; box at 1e3', 'position', 'radius')} radii). At 1e6, both bounds are the same "
        "number.", "",
        "Never right, because another way of the same kind, text or binary, is as good or better in bytes, writing, reading and error "
        f"wherever the box is: {'; '.join(never) if never else 'none'}.", ""]


def front(points):
    """The points that no other one beats in both, in order."""
    best, found = math.inf, []
    for x, y, name in sorted(points):
        if y < best:
            best = y
            found.append((x, y, name))
    return found


DEFAULT = "custom %g"  # what most runs write


def scatter(axes, points, label):
    """Points and their front; those behind it are grey, and the default is red."""
    ahead = front(points)
    names = {name for _, _, name in ahead}
    for x, y, name in points:
        color = "C3" if name == DEFAULT else "C0" if name in names else "0.75"
        axes.plot(x, max(y, EXACT), "o", color=color, zorder=3 if name in (DEFAULT, *names) else 2)
        if name == DEFAULT:
            axes.annotate(name, (x, max(y, EXACT)), textcoords="offset points", xytext=(5, -11), fontsize=7, color="C3")
    axes.step([x for x, _, _ in ahead], [max(y, EXACT) for _, y, _ in ahead], where="post", color="C0", linewidth=1)
    right, told = 1.35 * max(x for x, _, _ in points), [(x, y) for x, y, name in points if name in names]
    for x, y, name in points:
        near = any(y == other and abs(x - place) < 0.2 * right for place, other in told)
        if name not in names and name in ("binary, LAMMPS", "VTP, raw", "VTK legacy, text", "custom %.17g") and not near:
            told.append((x, y))
            axes.annotate(name, (x, max(y, EXACT)), textcoords="offset points", xytext=(0, -11), fontsize=6, color="0.5", ha="center")
    for i, (x, y, name) in enumerate(ahead):
        axes.annotate(name, (x, max(y, EXACT)), textcoords="offset points", xytext=(6, 5 + 9 * (i % 2)), fontsize=7)
    axes.set_yscale("log")
    axes.set_ylim(EXACT / 30, 1e4)
    axes.axhline(1e-2, color="0.6", linewidth=0.8, linestyle=":")
    axes.grid(color="0.93")
    axes.set_xlabel(label)
    axes.set_xlim(left=0, right=right)


def plot_store(pyplot, figures):
    ways = stored(figures)
    figure, panels = pyplot.subplots(2, 3, figsize=(14, 8.5), sharey=True, layout="constrained")
    for axes, place in zip(panels[0], PLACES):
        scatter(axes, [(costs(figures, way)[0], position_error(figures, way, place), way) for way in ways], "bytes a particle")
        axes.set_title(f"box at {place} lengths from the origin")
    texts = [way for way in ways if "gzip" not in way]
    for axes, index, label in ((panels[1][0], 1, "time to write [ns/particle]"), (panels[1][1], 2, "time to read [ns/particle]")):
        scatter(axes, [(costs(figures, way)[index], position_error(figures, way, "1e3"), way) for way in texts], label)
        axes.set_title("box at 1e3; gzip left out")
    axes = panels[1][2]
    digits = [("%g", 6), ("%.9g", 9), ("%.12g", 12), ("%.17g", 17)]
    lines = [("custom", place, "o-", color, f"x y z, box at {place}") for place, color in zip(PLACES, ("C0", "C1", "C3"))]
    lines.append(("scaled", "1e6", "s--", "k", "xs ys zs, all digits of the box"))
    for form, place, style, color, label in lines:
        points = [(count, figures.get(f"{form} {text}; box at {place}", "strain, largest:1"))
                  for text, count in digits if f"{form} {text}; box at {place}" in figures.cases]
        axes.plot([x for x, _ in points], [max(y, EXACT) for _, y in points], style, color=color, label=label)
    axes.axhline(1e-4, color="0.4", linewidth=0.8)
    axes.text(9, 1.5e-4, "a strain of 1e-4", fontsize=8, color="0.4")
    axes.set_yscale("log")
    axes.set_xlabel("digits of text")
    axes.set_ylabel("largest error of strain")
    axes.yaxis.set_tick_params(labelleft=True)
    axes.set_title("strains of pairs of neighbours")
    axes.grid(color="0.93")
    axes.legend(fontsize=8)
    for row in panels:
        row[0].set_ylabel("largest error of positions [smallest radii]")
    panels[0][0].text(2, 1.4e-2, "1 % of a radius", fontsize=8, color="0.4")
    panels[0][0].text(2, 1.4 * EXACT, "exact", fontsize=8, color="0.4")
    return figure


# ---- looking -------------------------------------------------------------------------------------
LOOKS = ("double", "double, PointOrigin", "single", "single, PointOrigin")


def place_name(power):
    return f"1e{power}" if power else "0"


def look_table(part, figures, quick):
    rows = []
    for way in LOOKS:
        rows.append([f"`{way}`", f"{figures.get(way, 'points:B/particle'):.0f}", f"{figures.get(way, 'data:B/particle'):.0f}",
                     f"{figures.get(way, 'read:ns/particle'):.0f}", f"{figures.get(way, 'read against double:1'):.2f}",
                     *(error(figures, f"{way}; box at {place_name(power)}", "position", "radius", "both")
                       for power in (0, 3, 6, 12)),
                     verdict(part, figures, f"{way}; box at 1e3", "position, largest:radius", quick)])
    head = ["points", "B/particle of points", "of all arrays", "read ns/particle", "against double",
            *(f"error at {place_name(power)} [radii]" for power in (0, 3, 6, 12)), "target"]
    scaled = [[f"`{case}`", error(figures, case, "position", "ulp", "both"),
               verdict(part, figures, case, "position, largest:ulp", quick)] for case in figures.all(" crossings$")]
    return markdown(head, rows) + ["Scaled coordinates and image counts, made into positions, against fractions:", ""] + \
        markdown(["box", "error, largest (rms) [ulp]", "target"], scaled)


def plot_look(pyplot, figures):
    figure, axes = pyplot.subplots(figsize=(10, 4.6), layout="constrained")
    for way, style in zip(LOOKS, ("o-", "s--", "v-", "^--")):
        values = [figures.get(f"{way}; box at {place_name(power)}", "position, largest:radius") for power in range(13)]
        axes.plot([10.0 ** power for power in range(13)], [max(value, EXACT) for value in values], style, label=way)
    axes.plot([10.0 ** power for power in range(13)], [3 ** 0.5 * 2.0 ** -53 * 10 ** power / SMALLEST for power in range(13)], ":",
              color="0.5", label="half a step of the doubles along each axis")
    axes.axhline(1, color="0.4", linewidth=0.8)
    axes.text(1.2, 1.4, "one radius", fontsize=8, color="0.4")
    axes.text(1.2, 1.5 * EXACT, "exact", fontsize=8, color="0.4")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xticks([1, *(10.0 ** power for power in range(1, 13))], ["0", *(f"$10^{{{power}}}$" for power in range(1, 13))])
    axes.set_xlabel("distance of the box from the origin [box lengths]")
    axes.set_ylabel("largest error of positions [smallest radii]")
    axes.grid(color="0.93")
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


def plot_layer(pyplot, figures):
    """Circles of the particles of a layer, as single precision has them."""
    figure, panels = pyplot.subplots(1, 2, figsize=(10, 5.2), sharex=True, sharey=True, layout="constrained")
    told = figures.cases["layer"]
    for axes, name in zip(panels, ("single", "single, PointOrigin")):
        numbers = sorted(int(metric.split(" of ")[1].split(":")[0]) for metric in told if metric.startswith(name + ", x of "))
        for i in numbers:
            centre = [told[f"{name}, {axis} of {i}:lattice constants"] for axis in "xy"]
            axes.add_patch(pyplot.Circle(centre, 0.5 / 2 ** 0.5, facecolor="C0", edgecolor="k", alpha=0.6, linewidth=0.5))
        axes.set_xlim(-0.5, 9)
        axes.set_ylim(-0.5, 9)
        axes.set_aspect("equal")
        axes.set_title(name)
        axes.set_xticks([])
        axes.set_yticks([])
    return figure


# ---- only what the scene needs --------------------------------------------------------------------
def plot_choose(pyplot, figures):
    figure, panels = pyplot.subplots(1, 2, figsize=(12, 4.8), layout="constrained")
    groups = (("columns", "o", "C0"), ("Stride", "s", "C1"), ("RegionOfInterest", "^", "C2"), ("frame", "D", "C3"),
              ("points of", "*", "C4"))
    labels = {"frame": "frames of a run, once it is open", "points of": "points of every 10th, single, no vertices"}
    for axes, metric, label in zip(panels, ("read", "memory"), ("time", "memory")):
        axes.plot([0.005, 1], [0.005, 1], color="0.6", linewidth=1)
        axes.text(0.006, 0.0085, "in proportion", fontsize=8, color="0.5", rotation=38)
        for group, mark, color in groups:
            points = []
            for case in figures.cases:
                against = [value for name, value in figures.cases[case].items() if name.startswith(f"{metric} against")]
                if group in case and against and not case.startswith("opening"):
                    points.append((figures.get(case, "kept:1"), against[0]))
            if points:
                axes.plot(*zip(*sorted(points)), mark, color=color, label=labels.get(group, group),
                          linestyle="-" if len(points) > 1 else "", linewidth=0.8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("part that is kept")
        axes.set_ylabel(f"{label} against everything")
        axes.grid(color="0.93")
        axes.legend(fontsize=8)
    return figure


# ---- cells ---------------------------------------------------------------------------------------
AVERAGED = (("volume fraction, rms error:1", "error of the volume fraction (expected 0.3)"),
            ("velocity, rms error:of the speed", "error of the velocity / amplitude of its wave"))
MOTIONS = ("moving", "at rest")


def averaged(figures, motion, weights, cells):
    """Cases of one cell size, in the order of frames."""
    return figures.all(f"^{motion}, {weights}, {cells}\\^3 cells")


def plot_average(pyplot, figures):
    """Error against time: a line is one cell size, a point one number of frames."""
    figure, panels = pyplot.subplots(2, 2, figsize=(11, 8), sharex=True, sharey="row", layout="constrained")
    sizes = sorted({int(re.search(r"(\d+)\^3", case).group(1)) for case in figures.all(r"frames$")})
    for row, (metric, label) in zip(panels, AVERAGED):
        row[0].set_ylabel(label + ", rms")
        for axes, motion in zip(row, MOTIONS):
            for color, cells in zip(("C0", "C1", "C2"), sizes):
                for weights, style in (("Overlap", "o-"), ("Centre", "s--")):
                    cases = averaged(figures, motion, weights, cells)
                    times, errors = ([figures.get(case, name) for case in cases] for name in ("time:ns/particle", metric))
                    size = figures.get(cases[0], "cell size:radius")
                    axes.plot(times, errors, style, color=color, markersize=4, markerfacecolor=color if style == "o-" else "w",
                              label=f"cells of {size:.0f} radii, {weights}")
                    for case, *place in zip(cases, times, errors):
                        if weights == "Overlap" and cells == sizes[0]:
                            axes.annotate(f"{figures.get(case, 'frames:1'):.0f}", place, textcoords="offset points",
                                          xytext=(3, -11), fontsize=7)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.grid(color="0.93")
    for axes, motion in zip(panels[0], MOTIONS):
        axes.set_title(f"particles {motion}; numbers: frames")
    for axes in panels[1]:
        axes.set_xlabel("time of the whole average, reading included [ns/particle]")
    panels[0][1].legend(fontsize=8)
    return figure


def plot_frames(pyplot, figures):
    figure, panels = pyplot.subplots(1, 2, figsize=(11, 4), layout="constrained")
    for axes, (metric, label) in zip(panels, AVERAGED):
        for motion, color in zip(MOTIONS, ("C0", "C3")):
            for weights, style in (("Overlap", "o-"), ("Centre", "s--")):
                cases = averaged(figures, motion, weights, 8)
                axes.plot([figures.get(case, "frames:1") for case in cases], [figures.get(case, metric) for case in cases], style,
                          color=color, markerfacecolor=color if style == "o-" else "w", label=f"{motion}, {weights}")
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        axes.xaxis.set_major_formatter("{x:.0f}")
        axes.set_xlabel("frames")
        axes.set_ylabel("rms")
        axes.set_title(label, fontsize=10)
        axes.grid(color="0.93")
    panels[0].legend(fontsize=8)
    return figure


SUMS = ("+= float", "pairwise float", "+= double", "pairwise double", "compensated", "exact")
SUM_KINDS = r"^(alike|masses|cancelling)"


def sums_table(part, figures, quick):
    kinds = figures.all(SUM_KINDS)
    rows = [[f"`{name}`", *(f"{figures.get(kinds[0], name + metric):.2f}" for metric in (":ns/term", ", time against += double:1")),
             *(scientific(figures.get(kind, f"{name}, relative error, {which}:1"))
               for kind in kinds for which in ("median", "largest"))] for name in SUMS]
    return markdown(["sum", "ns/term", "against += double", *(f"{kind}, {which}" for kind in kinds
                                                              for which in ("median error", "largest"))], rows)


def whiskers(least, middle, largest):
    """For errorbar on a logarithmic axis; errors of 0 are drawn at EXACT."""
    least, middle, largest = (max(value, EXACT) for value in (least, middle, largest))
    return middle, [[middle - least], [largest - middle]]


def plot_sums(pyplot, figures):
    """Errors against time; bars reach from the least to the largest of all orders."""
    kinds = figures.all(SUM_KINDS)
    figure, panels = pyplot.subplots(1, len(kinds), figsize=(12, 4.2), sharex=True, sharey=True, layout="constrained")
    for axes, kind in zip(panels, kinds):
        for i, name in enumerate(SUMS):
            middle, bars = whiskers(*(figures.get(kind, f"{name}, relative error, {which}:1") for which in
                                      ("least", "median", "largest")))
            axes.errorbar(figures.get(kind, name + ":ns/term"), middle, yerr=bars, fmt="o", color=f"C{i}", capsize=4, label=name)
        axes.set_yscale("log")
        axes.axhline(2.0 ** -53, color="0.5", linewidth=0.8, linestyle=":")
        axes.axhline(1, color="0.5", linewidth=0.8)
        axes.set_title(kind)
        axes.set_xlabel("time [ns/term]")
        axes.grid(color="0.93")
    panels[0].set_xlim(0, 1.1 * max(figures.get(kind, name + ":ns/term") for kind in kinds for name in SUMS))
    panels[0].text(0.02, 1.4 * 2.0 ** -53, "half an ulp", fontsize=8, color="0.4")
    panels[0].text(0.02, 1.5, "nothing is right", fontsize=8, color="0.4")
    panels[0].text(0.02, 1.4 * EXACT, "exact", fontsize=8, color="0.4")
    panels[0].set_ylabel("relative error of the sum")
    panels[0].legend(fontsize=8, loc="center right")
    return figure


def plot_volumes(pyplot, figures):
    figure, (size, time) = pyplot.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    cases = figures.all("^h/r")
    edges = [float(case.split("=")[1]) for case in cases]
    for metric, style, color, label in (("promised", "-", "0.5", "bound that is promised"), ("error, largest", "o-", "C0", "largest error"),
                                        ("error, rms", "o--", "C0", "rms error")):
        size.plot(edges, [max(figures.get(case, f"{metric}:of the smaller"), EXACT) for case in cases], style, color=color, label=label,
                  markerfacecolor="w" if "rms" in metric else color)
    size.set_xlabel("edge of the cube / radius")
    size.set_ylabel("error / the smaller of sphere and cube")
    (case,) = figures.all("^one")
    told = figures.cases[case]
    for name in [metric[:-len(":ns/volume")] for metric in told if metric.endswith(":ns/volume")]:
        error = max(told[f"{name}, error, rms:of the smaller"], EXACT)
        time.plot(told[f"{name}:ns/volume"], error, "o", color="C0" if name == "exact" else "0.6")
        time.annotate(name, (told[f"{name}:ns/volume"], error), textcoords="offset points", xytext=(6, 4), fontsize=8)
    time.set_xlabel("time of one volume, edge = radius [ns]")
    time.set_ylabel("rms error / the smaller of sphere and cube")
    for axes in (size, time):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.grid(color="0.93")
    time.set_xlim(right=5 * time.get_xlim()[1])
    size.legend(fontsize=8)
    return figure


NUMBERS = ("digits times a power", "std::from_chars", "parse_double")


def numbers_table(part, figures, quick):
    words = figures.all("^words")
    rows = [[f"`{name}`", *(cell for case in words for cell in (
        f"{figures.get(case, name + ':ns/word'):.1f}", f"{figures.get(case, name + ', wrong words of 10^9:1'):.0f}"))]
        for name in NUMBERS]
    return ["Words of text into doubles:", ""] + markdown(
        ["way", *(cell for case in words for cell in (f"{case}: ns/word", "wrong of 10^9"))], rows)


def sums_words(figures):
    kinds = figures.all(SUM_KINDS)
    exact = span([figures.get(kind, "exact, time against += double:1") for kind in kinds])
    return [f"Exact sums take {exact} times as long as `+=` of doubles. Compensated sums are as good on these terms and faster, but they "
            "depend on the order of the terms, and so on the number of threads and ranks, where terms cancel further.", ""]


def numbers_words(figures):
    words = figures.all("^words")
    wrong = {case: figures.get(case, "digits times a power, wrong words of 10^9:1") / 1e9 for case in words}
    usual = [value for case, value in wrong.items() if "hardest" not in case]
    return [f"`digits times a power` misses {span(usual, '.0%')} of the usual words and {max(wrong.values()):.0%} of the hardest. "
            "The others miss none of 10^6.", ""]


def volumes_words(figures):
    (case,) = figures.all("^one")
    told = figures.cases[case]
    exact, most = VOLUMES[0], VOLUMES[-1]
    return [f"{most} take {told[most + ':ns/volume'] / told[exact + ':ns/volume']:.0f} times as long as the exact volume and are wrong by "
            f"{told[most + ', error, rms:of the smaller']:.0%} of it (rms).", ""]


def plot_numbers(pyplot, figures):
    words = figures.all("^words")
    figure, (wrong, time) = pyplot.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    for i, name in enumerate(NUMBERS):
        places = [row + 0.27 * (i - 1) for row in range(len(words))]
        values = [figures.get(case, name + ", wrong words of 10^9:1") / 1e9 for case in words]
        wrong.bar(places, values, 0.25, color=("C3", "0.7", "C0")[i], label=name)
        for place, value in zip(places, values):
            wrong.text(place, value + 0.01, f"{value:.0%}", ha="center", fontsize=8)
        time.bar(places, [figures.get(case, name + ":ns/word") for case in words], 0.25, color=("C3", "0.7", "C0")[i], label=name)
    wrong.set_ylim(0, 1)
    wrong.yaxis.set_major_formatter(lambda value, _: f"{value:.0%}")
    wrong.set_ylabel("words that become a wrong double")
    time.set_ylabel("time [ns/word]")
    for axes in (wrong, time):
        axes.set_xticks(range(len(words)), [case.removeprefix("words").lstrip(", of") for case in words])
        axes.grid(color="0.93", axis="y")
        axes.set_axisbelow(True)
    time.legend(fontsize=8)
    return figure


# ---- lines, cores, others --------------------------------------------------------------------------
def lines_table(part, figures, quick):
    rows = []
    for case in figures.all(" (image|written)$"):
        rows.append([f"`{case}`", error(figures, case, "length", "ulp", "both"), f"{figures.get(case, 'wrong image:1'):.1%}",
                     f"{figures.get(case, 'longest against true:1'):.3g}",
                     verdict(part, figures, case, "length, largest:ulp", quick)])
    told = figures.cases["on faces"]
    return markdown(["box; lines", "error of length, largest (rms) [ulp]", "lines to a wrong image", "longest against true",
                     "target"], rows) + [
        f"Counts: of {told['particles:1']:.0f} particles on and beside the faces of grids, `GranularDecomposition` puts "
        f"{told['wrong subdomain:1']:.0f} into a wrong subdomain. The usual formula `int((x - lo) / (hi - lo) * n)` does so with "
        f"{told['wrong subdomain by the formula:1']:.1%} of them. The imbalance is wrong by at most "
        f"{told['imbalance, largest error:ulp']:.2f} ulp.", ""]


def others_table(part, figures, quick):
    rows, absent = [], []
    for case in figures.cases:
        if figures.get(case, "not installed:1"):
            absent.append(case)
            continue
        wrong, ratio = figures.get(case, "wrong values:1"), figures.get(case, "read against ours:1")
        rows.append([f"`{case}`", f"{figures.get(case, 'read:ns/particle'):.0f}", "" if ratio is None else f"{ratio:.1f}",
                     "" if wrong is None else f"{wrong:.0%}",
                     "" if wrong is None else scientific(figures.get(case, "error, largest:ulp")),
                     verdict(part, figures, case, "error, largest:ulp", quick)])
    words = [f"Not installed, and so left out: {', '.join(absent)}.", ""] if absent else []
    return markdown(["program; text", "read ns/particle", "against ours", "wrong values", "largest error [ulp]", "target"],
                    rows) + words


FRAMES, RANKS, PARTICLES, BANDWIDTHS = 1000, 64, 1e9, (10, 100)  # the last in GB/s


def span_of_time(seconds):
    """In the unit in which it is a number that people read."""
    for unit, size, least in (("h", 3600, 3600), ("min", 60, 60), ("s", 1, 0.1), ("ms", 1e-3, 0)):
        if seconds >= least:
            return f"{seconds / size:.2g} {unit}"


def scale_table(part, figures, quick):
    rows = []
    for case in figures.all(r"^(text|binary), (open|read|write)$"):
        if figures.get(case, "exponent:1") is None:
            continue
        rows.append([f"`{case}`", *(f"{figures.get(case, f'{size}:ns/particle'):.0f}" for size in ("smallest", "largest")),
                     f"{figures.get(case, 'exponent:1'):.3f} +- {figures.get(case, 'exponent, uncertain:1'):.3f}",
                     span_of_time(figures.get(case, "predicted:s")),
                     f"{figures.get(case, 'predicted, uncertain:1'):.1f}"])
    return markdown(["one frame, one thread", "smallest ns/particle", "largest ns/particle", "exponent", "predicted",
                     "within a factor of"], rows)


def scale_words(figures):
    def times(case, count=1):
        if figures.get(case, "predicted:s") is None:
            return count * figures.get(case, "a frame:s"), 1
        return count * figures.get(case, "predicted:s"), figures.get(case, "predicted, uncertain:1")

    def moved(name, bandwidth, frames=1):
        return frames * PARTICLES * figures.get(f"{name}, size", "size:B/particle") / (1e9 * bandwidth)

    rows = []
    for name in ("text", "binary"):
        for what, case, frames, ranks in (("open the run in one file, by one rank", "open", FRAMES, 1),
                                          ("open the run, a file for each frame, by all ranks", "open", FRAMES, RANKS),
                                          ("one more frame, by all ranks", "read", 1, 1),
                                          ("write a frame, by all ranks", "write", 1, 1)):
            bound = case != "open" or name == "text"
            if not bound and ranks > 1:
                continue  # headers alone: one rank has them at once
            seconds, factor = times(f"{name}, {case}", frames / ranks)
            rows.append([f"{name}: {what}", f"{span_of_time(seconds / factor)} to {span_of_time(seconds * factor)}"
                         if factor > 1 else span_of_time(seconds),
                         *(span_of_time(moved(name, bandwidth, frames)) if bound else "nothing" for bandwidth in BANDWIDTHS)])
    memory = figures.get("memory", "arrays:B/particle") * PARTICLES / RANKS / 2 ** 30
    return markdown(["10^9 particles, 1000 frames, 64 ranks of one thread", "processor",
                     *(f"bytes at {bandwidth} GB/s" for bandwidth in BANDWIDTHS)], rows) + [
        f"Memory of a rank: {memory:.1f} GiB for the arrays of a frame, and twice that while a pool keeps those of the frame before.", ""]


VOLUMES = ("exact", "19 points", "136 points", "912 points", "7208 points")

SCENE = """A packing of 63,504 particles with radii from 4.7e-3 to 5.3e-3 in a box of length 1, stretched by 5 %; 12 columns: id
type x y z vx vy vz fx fy fz radius. One thread, processor time, files in the page cache. """

SCENE_PARTS = (
    Part("store", "Storing a scene",
         SCENE + """Time and bytes are those at 1e3. Write: by the writers of this library and of VTK. Read: of an open file, again. Errors:
         largest (rms). Italics: never right, see below.""",
         [store_table],
         [Target(r"shortest|%\.17g|binary", "position, largest:radius", "<=", 0)], plot_store, script=True, words=store_words),
    Part("look", "Looking at a scene",
         SCENE + """Text of 17 digits. Errors are those of point + PointOrigin, largest (rms), in smallest radii.""",
         [look_table],
         [Target(r"^double; ", "position, largest:radius", "<=", 0),
          Target(r"^single, PointOrigin; ", "position, largest:radius", "<=", 1e-5),
          Target(r"crossings", "position, largest:ulp", "<=", 0.501)], {"look": plot_look, "layer": plot_layer}, script=True),
    Part("draw", "Drawing",
         """A disturbed lattice that fills the window of 1000 x 800 pixels at zoom 1; the camera turns by two degrees a frame; time on the
         wall. Glyphs of spheres have 96 triangles; those of superquadrics have as many sides as keep the outline of a typical
         particle within a quarter of a pixel.""",
         [cases_by_metrics(r" spheres", *columns(".2f", *(f"frames at zoom {zoom}:1/s" for zoom in (1, 4, 16))),
                           *columns(".2f", *(f"against Point Gaussian at zoom {zoom}:1" for zoom in (1, 4, 16)))),
          cases_by_metrics(r" superquadrics", *columns(".2f", *(f"frames at zoom {zoom}:1/s" for zoom in (1, 4, 16))),
                           *columns(".2f", *(f"against glyphs at zoom {zoom}:1" for zoom in (1, 4, 16))),
                           *columns(".0f", *(f"sides at zoom {zoom}:1" for zoom in (1, 4, 16))))],
         [Target(r"1e6 spheres, Grains", f"against Point Gaussian at zoom {zoom}:1", ">=", 0.75) for zoom in (1, 4, 16)],
         script=True, wants_cores=2),
    Part("choose", "Only what the scene needs",
         """333,396 particles as above, text of %g; and a file of 20 frames. kept: the part of the values, or of the particles, that
         is asked for. One thread, processor time.""",
         [cases_by_metrics(r"^(?!.*(frame|opening))", *columns(".3f", "kept:1"), *columns(".0f", "read:ns/particle"),
                           *columns(".2f", "read against everything:1"), *columns(".0f", "memory:B/particle"),
                           *columns(".2f", "memory against everything:1")),
          cases_by_metrics(r"frame|opening", *columns(".2f", "kept:1"), Column("ns a particle of the run", "read:ns/particle", ".1f"),
                           *columns(".3f", "read against all:1"))],
         [Target(r"^1 frame", "read against all:1", "<=", 0.06)], plot_choose, script=True),
    EULER,
    KERNELS,
    CONTACTS,
    BONDS,
    Part("average", "Averages over frames",
         """20,000 equal spheres at random that do not overlap, in a periodic box; 5 to 312 in each cell. Moving: in each frame
         at other places. At rest: at the same places in all frames. The expected volume fraction is 0.3. The velocity is a
         wave, sin(2 pi z), and fluctuations of half its amplitude that are new in each frame. Time is that of reading and
         averaging all frames. Files of cells: what is read back against what was written.""",
         [cases_by_metrics(r"8\^3 cells, (1|16) frames$", *columns(".1f", "cell size:radius"), *columns(".0f", "time:ns/particle"),
                           Column("against 1 frame", "time against 1 frame:1", ".2f"),
                           *columns(".1e", "volume fraction, rms error:1", "velocity, rms error:of the speed")),
          cases_by_metrics(r"^(six|Wide)", *columns(".0f", "size:B/cell"),
                           *columns(".1e", "volumefraction, largest error:rms", "v_avg, largest error:rms",
                                    "radius, largest error:rms", "pressure, largest error:rms"))],
         [Target(r"^Wide", "v_avg, largest error:rms", "<=", 0)], {"average": plot_average, "frames": plot_frames}, script=True),
    Part("volumes", "Volumes of spheres in cells",
         """Unit spheres, and 2000 cubes of each edge whose faces or inside hold a point of the surface. Errors are against 113
         bits. Points: those of a regular grid in the sphere; the volume is the part of them that lies in the cube, as many
         programs count it.""",
         [cases_by_metrics(r"^one", *columns(".0f", *(f"{name}:ns/volume" for name in VOLUMES)),
                           *columns(".1e", *(f"{name}, error, rms:of the smaller" for name in VOLUMES)))],
         [], plot_volumes, words=volumes_words),
    Part("sums", "Sums and numbers",
         """10^6 terms into one sum, in 50 random orders. Alike: 0.5 to 1.5. Masses 1e12 apart: halves of 1e6 and 1e-6.
         Cancelling: pairs to and fro, and 1e-12 that remains. exact makes eight sums at once, and its time is that of one of
         them. The true sum is made of integers. Words: 10^6 decimals from -1 to 1, the hardest: those in the middle between
         two doubles, or just above. digits times a power is the loop that many programs have.""",
         [sums_table, numbers_table], [], {"sums": plot_sums, "numbers": plot_numbers},
         words=lambda figures: sums_words(figures) + numbers_words(figures)),
    Part("lines", "Lines between particles in tilted boxes",
         """1000 pairs in boxes of length 1, up to 0.09 apart, ends wrapped into the box. Coordinates are multiples of 2^-40, and
         the true length is the least over images, by integers.""",
         [lines_table], [Target(r"minimum image", "length, largest:ulp", "<=", 2)], script=True),
    Part("paths", "Particles through time",
         """250,000 particles walk at random in a periodic box: 12 frames of 15 columns of %g, with image counts; rows in the order of
         places. The run is open. all columns, ids and positions: all frames are read, one after the other. Paths: of 1000
         particles, a random sample. ParaView's filter takes every 250th particle of unwrapped positions, MDAnalysis wrapped positions.
         One thread, processor time; speed of 2 threads: time on the wall.""",
         [cases_by_metrics(r"", *columns(".0f", "time:ns/particle"), *columns(".2f", "against all columns:1", "against ids and positions:1",
                                                                            "speed of 2 threads:1"))],
         [Target(r"^paths", "against all columns:1", "<=", 0.5), Target(r"^mean", "against ids and positions:1", "<=", 1.5),
          Target(r"^paths", "speed of 2 threads:1", ">=", 1.5, cores=2), Target(r"^mean", "speed of 2 threads:1", ">=", 1.5, cores=2)],
         script=True, wants_cores=2),
    Part("cores", "Cores",
         """333,396 particles: a text of %g read, 20 x 20 x 20 Overlap cells averaged, a text of shortest numbers written. Time
         on the wall. All thread counts give the same bits, or this fails.""",
         [cases_by_metrics(r"", *columns(".0f", "time:ns/particle"), *columns(".2f", "speed against 1 thread:1"))],
         [Target(r"read, 2", "speed against 1 thread:1", ">=", 1.5, cores=2)], script=True, wants_cores=2),
    Part("scale", "Scale, on paper",
         """Frames of 317,520 to 2,540,160 particles, 12 columns, text of %g and binary of LAMMPS, files in the page cache, processor
         time of one thread. Times are fitted by powers of the number of particles; +- and the factors are 95 % intervals of the
         fit. Predicted: open, a frame of 10^9 particles; read and write, the part of one of 64 ranks, 1.6 x 10^7 particles.""",
         [scale_table], [], script=True, words=scale_words),
    Part("others", "Other programs on the same files",
         """15,876 particles at 1e3 lengths from the origin. Errors are distances from what the words in the file say. ASE and
         MDAnalysis keep positions only; MDAnalysis moves the box to the origin, which is undone here. Opening the file is
         part of the time. LAMMPS: the processor time of the whole program.""",
         [others_table], [Target(r"^vtk-granular", "error, largest:ulp", "<=", 0)], script=True),
    Part("arrays", "Arrays and conversions without a viewer",
         """10^6 particles with 12 columns of %g, and ten frames of 95,256 particles; time on the wall, all cores, files in the page
         cache. granular.open and the other programs begin with the name of the file. A conversion reads the next frame while it
         writes one.""",
         [cases_by_metrics(r"", *columns(".0f", "time:ns/particle"), *columns(".2f", "against granular.open:1"),
                           *columns(".2f", "against the C interface:1", "against reading and writing:1", "against writing:1"))],
         [Target(r"^pandas", "against granular.open:1", ">=", 20), Target(r"^ASE", "against granular.open:1", ">=", 60),
          Target(r"^array v", "against the C interface:1", "<=", 1.1),
          Target(r"^convert: six", "against reading and writing:1", "<=", 1.67),
          Target(r"^convert: Zst", "against writing:1", "<=", 1.1)], script=True, wants_cores=2),
)
