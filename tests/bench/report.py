# SPDX-License-Identifier: BSD-3-Clause
"""Runs the studies in scenes/, each a program that writes blocks of Markdown and pictures, and makes report.md of them.

A study fails where a result is wrong, and then so does this; times are told, never judged."""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCS = HERE.parents[1] / "docs"
PAGES, PICTURES = (DOCS / "speed_and_error.md", *sorted((DOCS / "measurements").glob("*.md"))), DOCS / "speed_and_error"
STUDIES = ("store", "look", "draw", "choose", "average", "paths", "cores", "ranks", "others", "bonds", "voxels", "decode")
NEEDS = {"draw": "pvpython", "ranks": "pvbatch"}  # besides the VTK classes


def can_run(study, programs):
    if study in ("bonds", "decode"):
        return (programs / f"bench_{study}").exists()
    classes = any(Path(folder, "vtkgranular").exists() for folder in os.environ.get("PYTHONPATH", "").split(":") if folder)
    return classes and (study not in NEEDS or bool(shutil.which(NEEDS[study])))


def run(study, how_much, programs, out):
    """Leaves this script where results are wrong."""
    command = ["/usr/bin/python3", "-B", str(HERE / "scenes" / f"{study}.py"), "--out", str(out), *how_much]
    done = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
                            env={**os.environ, "GRANULAR_PROGRAMS": str(programs)})
    try:
        said, _ = done.communicate()
    except KeyboardInterrupt:
        os.killpg(done.pid, signal.SIGTERM)
        done.wait()
        raise
    if done.returncode != 0:
        sys.exit(f"{said}\n{study} failed ({done.returncode})")


def machine():
    """The processor, without names."""
    with open("/proc/cpuinfo", encoding="utf-8") as stream:
        models = re.findall(r"^model name\s*:\s*(.*)$", stream.read(), re.M) or ["unknown processor"]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{os.cpu_count()} cores of {models[0]}, {memory:.0f} GiB of memory"


def write_pages(blocks, pictures):
    """Replaces the lines between <!-- NAME --> and <!-- end of NAME -->, and the pictures of the pages."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for name, block in blocks.items():
            mark = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)", re.S)
            text = mark.sub(lambda match, block=block: f"{match.group(1)}{block}\n{match.group(2)}", text)
        page.write_text(text, encoding="utf-8")
    for picture in pictures:
        shutil.copy(picture, PICTURES)


def main():
    parser = argparse.ArgumentParser(prog="tests/bench/run")
    parser.add_argument("--quick", action="store_true", help="small files, one round")
    parser.add_argument("--large", action="store_true", help="also what takes many minutes")
    parser.add_argument("--docs", action="store_true", help="also docs/speed_and_error.md, docs/measurements and their pictures")
    parser.add_argument("--programs", required=True, type=Path, help="folder of bench_bonds and bench_decode")
    parser.add_argument("--report", required=True, type=Path, help="folder to write to")
    parser.add_argument("studies", nargs="*", metavar="study", help=" ".join(STUDIES))
    options = parser.parse_args()
    if not set(options.studies) <= set(STUDIES):
        parser.error(f"there are the studies {' '.join(STUDIES)}")
    if options.quick and (options.docs or options.large):
        parser.error("--quick means nothing but itself")
    how_much = ["--quick"] if options.quick else ["--large"] if options.large else []
    load, blocks, left_out, stopped = os.getloadavg()[0], {}, [], False
    options.report.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        for study in options.studies or STUDIES:
            if not can_run(study, options.programs):
                left_out.append(study)
                continue
            print(f"-- {study}", file=sys.stderr, flush=True)
            try:
                run(study, how_much, options.programs, out)
            except KeyboardInterrupt:
                stopped = True
                break
            for block in sorted(set(out.glob("*.md")) - {out / f"{name}.md" for name in blocks}):
                blocks[block.stem] = block.read_text(encoding="utf-8")
        pictures = [Path(shutil.copy(picture, options.report)) for picture in sorted(out.glob("*.png"))]
    if not blocks:
        sys.exit(f"nothing was measured; this build or machine has no means for: {', '.join(left_out)}")
    blocks["machine"] = f"{machine()}, load {load:.1f} at the start, {time.strftime('%Y-%m-%d')}.\n"
    lines = ["<!-- SPDX-License-Identifier: BSD-3-Clause -->", "# Speed and error", ""]
    lines += ["**A quick run: small files, one round. Its times mean nothing.**", ""] if options.quick else []
    lines += [f"**The load of {load:.1f} at the start disturbs times.**", ""] if load > os.cpu_count() / 2 else []
    for name in ("machine", *(name for name in blocks if name != "machine")):
        lines += [f"## {name.capitalize()}", "", blocks[name]]
        lines += [f"![{name}]({name}.png)", ""] if any(picture.stem == name for picture in pictures) else []
    lines += [f"Left out, because this build or machine has no means for it: {', '.join(left_out)}.", ""] if left_out else []
    report = options.report / "report.md"
    report.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    if options.docs:
        write_pages(blocks, pictures)
    print(report)
    if stopped:
        sys.exit(130)


if __name__ == "__main__":
    main()
