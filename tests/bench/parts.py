# SPDX-License-Identifier: BSD-3-Clause
"""The parts for developers: what the code costs against the best that is known for it, with targets."""
import re

from tables import (Column, Part, Target, cases_by_metrics, columns, contenders_by_metrics, growth_table, note, scientific, span)


# ---- plots ---------------------------------------------------------------------------------------
def plot_decode(pyplot, figures):
    sets = [name for name in ("from_chars", "portable", "AVX2", "AVX-512")
            if any(f"{name}:GB/s" in told for told in figures.cases.values())]
    cases = [case for case, told in figures.cases.items() if "from_chars:GB/s" in told]
    figure, axes = pyplot.subplots(figsize=(9, 1 + 0.6 * len(cases)), layout="constrained")
    height = 0.8 / len(sets)
    for i, name in enumerate(sets):
        axes.barh([row + i * height for row in range(len(cases))],
                  [figures.get(case, f"{name}:GB/s") for case in cases], height, label=name)
    axes.set_yticks([row + 0.4 - height / 2 for row in range(len(cases))], cases)
    axes.invert_yaxis()
    axes.set_xlabel("text decoded [GB/s]")
    axes.legend()
    return figure


def plot_read(pyplot, figures):
    told = figures.cases["more and more rows"]
    points = sorted((10 ** int(match.group(1)), value) for match, value in
                    ((re.fullmatch(r"10\^(\d+) rows:ns/row", metric), value)
                     for metric, value in told.items()) if match)
    figure, axes = pyplot.subplots(figsize=(6, 3.5), layout="constrained")
    axes.plot(*zip(*points), "o-")
    axes.set_xscale("log")
    axes.set_ylim(0, 1.2 * max(time for _, time in points))
    axes.set_xlabel("rows of 12 columns")
    axes.set_ylabel("time to read [ns/row]")
    return figure


def plot_euler(pyplot, figures):
    cases = figures.all(r"^cells of")
    sizes = [float(case.split()[2]) for case in cases]
    ways = (("Centre", "C1", "o", "-"), ("Overlap", "C0", "s", "-"),
            ("without short cuts", "C2", "^", ":"))
    figure, (time, error, both) = pyplot.subplots(1, 3, figsize=(13, 4.6), layout="constrained")
    for name, *style in ways:
        look = dict(zip(("color", "marker", "linestyle"), style))
        label = name if name != "without short cuts" else "Overlap without short cuts"
        times = [figures.get(case, f"{name}:ns/particle") for case in cases]
        largest, rms = ([figures.get(case, f"{name}, error, {what}:1") for case in cases]
                        for what in ("largest", "rms"))
        time.plot(sizes, times, **look, label=label)
        if name == "without short cuts":  # its errors are those of Overlap
            continue
        error.plot(sizes, largest, **look, label=f"{name}, largest")
        error.plot(sizes, rms, **{**look, "linestyle": "--"}, label=f"{name}, rms",
                   markerfacecolor="none")
        both.plot(times, rms, **look, label=name)
        beside = ((12, -4), (12, -4)) if name == "Centre" else ((0, 7), (0, -14))
        for i, (case, x, y) in enumerate(zip(cases, times, rms)):
            if case.split()[2] in ("50", "20", "0.2"):
                continue
            both.annotate(case.split()[2], (x, y), textcoords="offset points", xytext=beside[i % 2],
                          ha="center", fontsize=8)
    for axes in (time, error, both):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.grid(color="0.9")
        axes.legend(fontsize=8)
    for axes in (time, error):
        axes.set_xlabel("cell size / radius")
    both.margins(0.1)
    time.set_ylabel("time [ns/particle]")
    error.set_ylabel("error of the volume fraction")
    both.set_xlabel("time [ns/particle]")
    both.set_ylabel("error of the volume fraction, rms")
    both.set_title("numbers: cell size / radius", fontsize=9)
    return figure


# ---- cells, for users and developers ----------------------------------------------------------------
CELL_TABLES = [
    cases_by_metrics(r"^cells of",
                     *columns(".0f", "particles:1"),
                     *columns(".2f", "cells touched:1"),
                     *columns(".0f", "Centre:ns/particle", "Overlap:ns/particle", "without short cuts:ns/particle"),
                     Column("against Overlap", "without short cuts, time against Overlap:1", ".2f"),
                     Column("Overlap against Centre", "Overlap, time against Centre:1", ".2f"),
                     *columns(".0%", "spread:1")),
    cases_by_metrics(r"^cells of",
                     Column("Centre, largest error", "Centre, error, largest:1", ".1e"),
                     Column("rms", "Centre, error, rms:1", ".1e"),
                     Column("Overlap, largest error", "Overlap, error, largest:1", ".1e"),
                     Column("rms", "Overlap, error, rms:1", ".1e"),
                     Column("without short cuts, largest error", "without short cuts, error, largest:1", ".1e"),
                     Column("rms", "without short cuts, error, rms:1", ".1e"),
                     *columns(".0f", "exact cells:1"))]


def euler_words(figures):
    def ratio(case):
        return figures.get(case, "Overlap, time against Centre:1")
    large = [case for case in figures.all(r"^cells of") if float(case.split()[2]) >= 4]
    small = [case for case in figures.all(r"^cells of") if float(case.split()[2]) < 4]
    errors = [f"{scientific(figures.get(f'cells of {size} radii', 'Centre, error, rms:1'))} in cells of {size} radii" for size in (4, 20)]
    plain = [figures.get(case, "time against plain:1") for case in figures.all(r"^plain")]
    return [f"Centre: rms error of the volume fraction {' and '.join(errors)}. Overlap against Centre: {span([ratio(case) for case in large])} "
            f"times the time in cells of 4 radii and more, {span([ratio(case) for case in small])} times in smaller ones. Centre takes "
            f"{span(plain)} times as long as a plain loop of `+=` that trusts a computed index: that is the price of sums that do not "
            "depend on order, and of exact faces.", ""]


EULER = Part("euler", "Cells: averages of particles",
     """Spheres of equal radius at random in a cube, inside its walls. They would fill it by half if they did not overlap. Up to
     955,000 particles; fewer in the smallest cells. With cells of s radii there are 8.4 / s^3 cells for each particle, and
     the time of a particle includes these. Errors are against sums of volumes with 113 bits, in cells at random (exact
     cells). Cells touched: by a particle, on average. Without short cuts: each volume by the general formula. One thread.""",
     [*CELL_TABLES,
      note("""plain is a loop of += on doubles that trusts a computed index: count, mass, momentum, radius, volume and, in a second pass,
           the six stresses. In order: the particles of a cell follow one another. More particles in more cells: 7.5 particles in each,
           edges of 4 radii; in the same cells: 1000 of them, edges of 20 radii. Two threads: time on the wall; cores: processor time of 2
           threads by their time on the wall, which is how many the machine let them have: near 1 there is nothing to gain. processor
           time: that of 2 threads against 1."""),
      cases_by_metrics(r"^plain",
                       *columns(".1f", "plain:ns/particle", "Centre:ns/particle"),
                       Column("Centre against plain", "time against plain:1", ".2f"),
                       *columns(".0%", "spread:1")),
      cases_by_metrics(r"^more",
                       *(Column(f"{name} 10^{power} ns/particle", f"{name}, 10^{power}:ns/particle", ".0f")
                              for name in ("Centre", "Overlap") for power in (4, 5, 6, 7)),
                       *columns(".2f", "Centre, slowest against fastest:1"),
                       Column("Overlap", "Overlap, slowest against fastest:1", ".2f")),
      cases_by_metrics(r"^two threads",
                       *(Column(heading.format(name), f"{name}, {metric}", form)
                         for name in ("Centre", "Overlap") for heading, metric, form in (
                             ("{} ns/particle", "1 thread:ns/particle", ".0f"),
                             ("speed of 2 threads", "speed of 2 threads:1", ".2f"),
                             ("spread", "spread:1", ".0%"),
                             ("cores", "cores that 2 threads had:1", ".2f"),
                             ("processor time", "processor time of 2 threads:1", ".2f"))))],
     [Target(r"^plain", "time against plain:1", "<=", 3),
      Target(r"^cells of 20 ", "Overlap, time against Centre:1", "<=", 3),
      Target(r"^cells of 4 ", "Overlap, time against Centre:1", "<=", 10),
      Target(r"^more", "Centre, slowest against fastest:1", "<=", 1.5),
      Target(r"^more", "Overlap, slowest against fastest:1", "<=", 1.5),
      Target(r"^two threads", "Centre, speed of 2 threads:1", ">=", 1.5, cores=2),
      Target(r"^two threads", "Overlap, speed of 2 threads:1", ">=", 1.5, cores=2)],
     plot_euler, wants_cores=2, words=euler_words, page_tables=CELL_TABLES)


def plot_kernels(pyplot, figures):
    cases = figures.all(r"^width")
    widths = [float(case.split()[2]) for case in cases]
    figure, (noise, time, both) = pyplot.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    for i, name in enumerate(("Gaussian", "Lucy", "Heaviside", "Overlap")):
        look = {"color": f"C{i}", "marker": "os^D"[i], "label": name}
        noises = [figures.get(case, f"{name}, noise:1") for case in cases]
        noise.plot(widths, noises, **look)
        time.plot(widths, [figures.get(case, f"{name}:ns/particle") for case in cases], **look)
        blur = figures.get("blur of a step", f"{name}, blur:widths")
        both.plot([blur * width for width in widths], noises, **look)
    for axes in (noise, time, both):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.grid(color="0.9")
        axes.legend(fontsize=8)
    for axes in (noise, time):
        axes.set_xlabel("width of the kernel / radius")
    noise.set_ylabel("noise of the volume fraction, rms / mean")
    time.set_ylabel("time [ns/particle]")
    both.set_xlabel("blur of a step, 10 to 90 % / radius")
    both.set_ylabel("noise of the volume fraction, rms / mean")
    return figure


KERNEL_NAMES = ("Gaussian", "Lucy", "Heaviside", "Overlap")

KERNELS = Part("kernels", "Smooth fields: kernels",
     """Spheres of equal radius at random in a cube that they would fill by half if they did not overlap, so that the exact field is
     uniform: noise is the root mean square of the volume fraction's deviations over its mean. Fields on a grid as fine as the width;
     Overlap in cells that are as large as the sphere of Heaviside. blur: the way from 10 to 90 % of a step of the density, which is
     proportional to the width. A Gaussian has the least noise for its blur; boxes are the fastest. Times include exact sums. One
     thread.""",
     [cases_by_metrics(r"^width", *columns(".0f", "particles:1"),
                       *(Column(f"{name} noise", f"{name}, noise:1", ".3f") for name in KERNEL_NAMES)),
      cases_by_metrics(r"^width", *(Column(f"{name} ns/particle", f"{name}:ns/particle", ".0f") for name in KERNEL_NAMES),
                       Column("Heaviside against Overlap", "Heaviside, time against Overlap:1", ".2f"), *columns(".0%", "spread:1")),
      cases_by_metrics(r"^blur", *(Column(f"{name} [widths]", f"{name}, blur:widths", ".2f") for name in KERNEL_NAMES),
                       *(Column(f"{name} exact", f"{name}, blur, exact:widths", ".2f") for name in KERNEL_NAMES)),
      cases_by_metrics(r"^lines", *columns(".0f", "mean over a line:ns", "value at a point:ns"))],
     (), plot_kernels)


CONTACTS = Part("contacts", "Sums of contacts on particles",
     """10^7 contacts among 1.6 x 10^6 particles: ids of both ends, positions, contact points, forces, torques in memory. plain: one
     loop that finds both ends by the same table of ids and adds doubles to arrays of the particles, in the order of the rows; its
     sums are right up to rounding. Ours are correctly rounded. in order: neighbours, one contact after the other, as a dump of one
     process has them. shuffled: no row is near the one before it, and memory is what both wait for. all: coordination, force,
     torque, fabric and stress. force, coordination: ours still looks at all numbers of a row, to leave out rows with nan; plain trusts
     them. Two threads: plain has one. Time on the processor; with two threads, on the wall.""",
     [cases_by_metrics(r"^(?!two)", *columns(".1f", "plain:ns/contact", "ours:ns/contact"),
                       Column("against plain", "time against plain:1", ".2f"), *columns(".0%", "spread:1")),
      cases_by_metrics(r"^two", *columns(".1f", "plain:ns/contact", "ours:ns/contact"),
                       Column("against plain", "time against plain:1", ".2f"),
                       *columns(".2f", "speed of 2 threads:1"), *columns(".0%", "spread:1"))],
     [Target(r"^all|shuffled$", "time against plain:1", "<=", 3)], wants_cores=2)


BONDS = Part("bonds", "Bonded particles in messages",
     """granular_bonds.h: rows one after the other are packed, and unpacked into new rows, whose fields that are not sent become 0;
     memcpy copies as many doubles. exchange: two bonds of twelve history values a particle. One thread, time on the processor.""",
     [cases_by_metrics(r"", *columns(".1f", "memcpy:ns/particle", "pack:ns/particle"),
                       Column("against memcpy", "pack against memcpy:1", ".1f"), *columns(".1f", "unpack:ns/particle"),
                       Column("against memcpy", "unpack against memcpy:1", ".1f"))])


# ---- the parts -----------------------------------------------------------------------------------
PARTS = (
    Part("decode", "Decode: text to columns in memory",
         """GB of text a second (10^9 bytes), one thread, into memory that was touched before.
         from_chars is a plain one-pass loop (skip blanks, std::from_chars, next) that does not even
         look for the ends of lines. ratio is its time by ours for the best instruction set. Every
         value of every contender was found equal to strtod's, bit for bit. The targets for all
         forms are those of %g.""",
         [cases_by_metrics(r"^(8|12) columns",
                           *columns(".2f", "from_chars:GB/s", "portable:GB/s", "AVX2:GB/s", "AVX-512:GB/s",
                                    "portable ratio:1", "AVX2 ratio:1", "ratio:1"),
                           Column("spread", "ratio spread:1", ".0%")),
          cases_by_metrics(r"three of 12",
                           Column("time against all 12", "time against all:1", ".2f"),
                           Column("spread", "time against all spread:1", ".0%"))],
         [Target(r"columns", "ratio:1", ">=", 2),
          Target(r"^first three", "time against all:1", "<=", 0.6)],
         plot_decode),
    Part("write", "Write: a frame to a file",
         """ns a row `id type c ix iy iz` of dump atom, 10^6 rows into a file in memory (/dev/shm), time on
         the wall: text with %g, against a loop of fprintf; binary, against one write() of all bytes. All
         write the same bytes. With xs ys zs our rows are scaled on the way; the others are given what
         comes out. speed against other is their time by ours with one thread.""",
         [cases_by_metrics(r"",
                           *columns(".1f", "other:ns/row", "1 thread:ns/row", "2 threads:ns/row"),
                           *columns(".2f", "speed against other:1", "speed of 2 threads:1"),
                           *columns(".0%", "spread:1"))],
         [Target(r"^text", "speed against other:1", ">=", 5),
          Target(r"^binary", "speed against other:1", ">=", 0.7),
          Target(r"", "speed of 2 threads:1", ">=", 1.4, cores=2)], wants_cores=2),
    Part("read", "Read: a file to arrays, the whole way",
         """read_dump of a file in the page cache, double points and all arrays, against decode_rows
         of the same text in memory into memory that was touched before. Arrays are new memory each
         time, as they are for a user: the page faults are those of memory that the process did not
         have yet (small arrays come back from an earlier read). Peak memory is VmHWM of a process
         of its own.""",
         [cases_by_metrics(r"^(8|12) columns$",
                           *columns(".1f", "decode alone:ns/row", "read:ns/row"),
                           Column("ratio", "time against decode alone:1", ".2f")),
          growth_table,
          cases_by_metrics(r"^memory",
                           *columns(".1f", "arrays:MiB", "peak:MiB", "above the arrays:MiB"))],
         [Target(r"^more", "slowest against fastest:1", "<=", 1.5),
          Target(r"^memory", "above the arrays:MiB", "<=", 32)],
         plot_read),
    Part("ranks", "Ranks: one frame, read by several processes together",
         """read_dump by the ranks of MPI, each its part of a text of 10^6 rows and 12 columns, with one
         thread and the memory of a frame before; time on the wall from one barrier to the next. Sorted by
         id, the rows that each rank reads go to those that they belong to.""",
         [contenders_by_metrics(
              *columns(".1f", ":ns/row"),
              *columns(".2f", ", speed against 1 rank:1"),
              *columns(".0%", ", spread:1"))],
         [Target(r"order", "2 ranks, speed against 1 rank:1", ">=", 1.6, cores=2)], needs="MPI", wants_cores=2),
)
