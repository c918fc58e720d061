# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and writes report.md, report.csv and plots.

A part is a program bench_NAME, whose benchmarks are called NAME/case and tell figures called metric:unit, or a script
scenes/NAME.py that does so, and an entry of PARTS (for developers) or SCENE_PARTS (for users). A program fails where
results are wrong, and then so does this; what is slow is said, no more."""
import argparse
import csv
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from multiprocessing import Process, Value

import page
import summary
from parts import PARTS
from scene_parts import SCENE_PARTS
from tables import Figures, cores_missing, is_met

HERE = os.path.dirname(os.path.abspath(__file__))
ALL_PARTS = SCENE_PARTS + PARTS


# ---- running and writing -------------------------------------------------------------------------
def has_program(part, programs):
    if part.script:
        return any(os.path.exists(os.path.join(folder, "granular")) for folder in os.environ.get("PYTHONPATH", "").split(":"))
    return os.path.exists(os.path.join(programs, "bench_" + part.name))


def command_of(part, programs, how_much, out):
    if part.script:
        return ["/usr/bin/python3", "-B", os.path.join(HERE, "scenes", part.name + ".py"), "--out", out] + how_much
    return [os.path.join(programs, "bench_" + part.name), "--benchmark_out=" + out, "--benchmark_out_format=json"] + how_much


def run_part(part, programs, how_much, folder):
    """(figures, context) of the part's program; leaves this script where results are wrong."""
    out = os.path.join(folder, part.name + ".json")
    done = subprocess.Popen(command_of(part, programs, how_much, out), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, start_new_session=True)
    try:
        said, _ = done.communicate()
    except KeyboardInterrupt:
        os.killpg(done.pid, signal.SIGTERM)
        done.wait()
        raise
    if done.returncode != 0:
        sys.exit(said + f"\n{part.name} failed ({done.returncode}): wrong results")
    with open(out, encoding="utf-8") as stream:
        told = json.load(stream)
    figures = Figures(int(told["context"]["cores"]))
    for benchmark in told["benchmarks"]:
        case = re.sub(r"/iterations:\d+/manual_time$", "", benchmark["name"]).split("/", 1)[1]
        figures.cases[case] = {key: value for key, value in benchmark.items() if ":" in key}
    if not figures.cases:
        sys.exit(f"{part.name} has no benchmarks")
    return figures, told["context"]


def spin(until, spent):
    start = time.process_time()
    while time.monotonic() < until:
        pass
    spent.value = time.process_time() - start


def cores_given(wanted=2, seconds=0.4):
    """Returns how many of so many cores the machine gives just now: the processor time of as many busy processes by their
    time on the wall."""
    spent = [Value("d", 0.0) for _ in range(wanted)]
    start = time.monotonic()
    busy = [Process(target=spin, args=(start + seconds, each)) for each in spent]
    for each in busy:
        each.start()
    for each in busy:
        each.join()
    return sum(each.value for each in spent) / (time.monotonic() - start)


def run_parts(parts, programs, how_much, folder, tell):
    """Yields (part, figures, context), and tells how far it has come; ends early on Ctrl-C."""
    expected, begun = sum(part.seconds for part in parts), time.monotonic()
    for i, part in enumerate(parts):
        spent, behind = time.monotonic() - begun, sum(each.seconds for each in parts[:i])
        left = (expected - behind) * (spent / behind if behind and "--full" in how_much else 1)
        if how_much:
            tell(f"-- {part.name} ({i + 1} of {len(parts)}; about {left / 60:.0f} min left)")
        try:
            given = cores_given() if part.wants_cores > 1 and how_much else 2
            figures, context = run_part(part, programs, how_much, folder)
            figures.given = min(given, cores_given() if part.wants_cores > 1 and how_much else 2)
            if figures.given < 1.6:
                figures.cores = 1
            if how_much:
                tell(f"   {time.monotonic() - begun - spent:.0f} s")
        except KeyboardInterrupt:
            tell(f"-- stopped; not measured: {' '.join(each.name for each in parts[i:])}")
            return
        yield part, figures, context


def machine(context):
    """What the figures were made on; no names."""
    model = "unknown processor"
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        for line in stream:
            if line.startswith("model name"):
                model = line.split(":", 1)[1].strip()
                break
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    load = context.get("load_avg") or [0]
    return (f"{context['num_cpus']} cores of {model}, best instruction set of the decoder "
            f"{context['instruction set']}, {memory:.0f} GiB of memory, {context['compiler']}, "
            f"load {load[0]:.1f} at the start, {context['date'][:10]}")


def depends_on_machine(metric, unit):
    """Times, their ratios and what the system does; not errors, sizes and shares."""
    is_time = re.match(r"(ns|ms|s|GB/s|MB/s)(/|$)", unit)
    return "yes" if is_time or re.search(r"against|ratio|speed|spread|time|faults|cores", metric) else "no"


def write_csv(path, results):
    with open(path, "w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(["part", "case", "metric", "value", "unit", "depends on the machine"])
        for part, figures in results:
            for case, told in figures.cases.items():
                for key, value in told.items():
                    metric, unit = key.rsplit(":", 1)
                    writer.writerow([part.name, case, metric, repr(value), unit, depends_on_machine(metric, unit)])


def draw(folder, results):
    """Names of the pictures that were made."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        print("-- no plots: Python's matplotlib was not found", file=sys.stderr)
        return set()
    drawn = set()
    for part, figures in results:
        plots = part.plot if isinstance(part.plot, dict) else {part.name: part.plot} if part.plot else {}
        for name, plot in plots.items():
            figure = plot(pyplot, figures)
            figure.savefig(os.path.join(folder, name + ".png"), dpi=100)
            pyplot.close(figure)
            drawn.add(name)
    return drawn


def missed(results):
    for part, figures in results:
        for target in part.targets:
            for case in figures.all(target.cases):
                value = figures.get(case, target.metric)
                judged = value is not None and figures.cores >= target.cores
                if judged and not is_met(target, value):
                    metric = target.metric.rsplit(":", 1)[0]
                    yield (f"{part.name}, {case}: {metric} {value:.2f}, "
                           f"wanted {target.how} {target.limit:g}")


def write_markdown(path, results, context, drawn, left_out, quick):
    lines = ["<!-- SPDX-License-Identifier: BSD-3-Clause -->", "# Speed and error", ""]
    if quick:
        lines += ["**A quick run: small files, one round. Its times mean nothing.**", ""]
    lines += [f"* {line}" for line in summary.lines_of(results)] + [""]
    lines += [machine(context) + ".", ""]
    lines += ["Each figure is a median over many short rounds in which all contenders take turns; "
              "ratios are medians of the ratios within a round, and spread is half the distance of "
              "their quartiles. Times are processor time, unless several threads or processes work: "
              "then they are those on the wall. All results were checked before they were "
              "timed. `report.csv` has every figure.", ""]
    for part, figures in results:
        lines += [f"## {part.title}", "", part.about, ""]
        lines += [] if quick else cores_missing(part, figures)
        for table in part.tables:
            lines += table(part, figures, quick)
        lines += part.words(figures) if part.words else []
        for name in part.plot if isinstance(part.plot, dict) else [part.name]:
            lines += [f"![{part.title}]({name}.png)", ""] if name in drawn else []
    if not quick:
        misses = list(missed(results))
        lines += ["## Targets of developers", "", "Not met:" if misses else "All are met.", ""]
        lines += [f"* {miss}" for miss in misses] + ([""] if misses else [])
    lines += [f"* Left out, because this build is without {part.needs or 'VTK'}: {part.name}" for part in left_out]
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("\n".join(lines).rstrip() + "\n")


def main():
    names = [part.name for part in ALL_PARTS]
    parser = argparse.ArgumentParser(prog="tests/bench/run")
    parser.add_argument("--quick", action="store_true", help="small files, one round")
    parser.add_argument("--large", action="store_true", help="also what takes many minutes")
    parser.add_argument("--docs", action="store_true", help="also docs/speed_and_error.md and its pictures")
    parser.add_argument("--programs", required=True, help="folder of the programs bench_*")
    parser.add_argument("--report", required=True, help="folder to write to")
    parser.add_argument("parts", nargs="*", metavar="part", help=" ".join(names))
    options = parser.parse_args()
    for name in options.parts:
        if name not in names:
            parser.error(f"no part {name}: there are {' '.join(names)}")
    if options.quick and (options.docs or options.large):
        parser.error("--quick means nothing but itself")
    how_much = [] if options.quick else ["--large" if options.large else "--full"]
    os.makedirs(options.report, exist_ok=True)
    wanted = [part for part in ALL_PARTS if not options.parts or part.name in options.parts]
    left_out = [part for part in wanted if (part.needs or part.script) and not has_program(part, options.programs)]
    for part in left_out:
        print(f"-- this build is without {part.needs or 'VTK'}: {part.name} is left out", file=sys.stderr)
    measured = [part for part in wanted if part not in left_out]
    if not measured:
        sys.exit("nothing is left to measure")
    results, context = [], None
    with tempfile.TemporaryDirectory() as folder:
        for part, figures, one in run_parts(measured, options.programs, how_much, folder,
                                            lambda text: print(text, file=sys.stderr, flush=True)):
            results.append((part, figures))
            context = context if context and context["instruction set"] != "of the processor" else one
    if not results:
        sys.exit(130)
    write_csv(os.path.join(options.report, "report.csv"), results)
    drawn = draw(options.report, results)
    write_markdown(os.path.join(options.report, "report.md"), results, context, drawn, left_out,
                   options.quick)
    if options.docs:
        page.write(os.path.join(HERE, "..", "..", "docs"), options.report, results, machine(context), drawn)
    if not options.quick:
        for line in summary.lines_of(results):
            print(line)
    print(os.path.join(options.report, "report.md"))
    if len(results) < len(measured):
        sys.exit(130)


if __name__ == "__main__":
    main()
