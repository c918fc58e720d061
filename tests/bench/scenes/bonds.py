# SPDX-License-Identifier: BSD-3-Clause
"""Bonded particles in messages and restart records, against memcpy, as bench_bonds measures them."""
import json
import os
import statistics
import subprocess

from scene import main, table

WAYS = ("memcpy", "pack", "unpack")
KINDS = ("comm", "comm_vel", "border", "border_hybrid", "exchange", "record")


def study_of(study):
    out = study.folder / "bonds.json"
    how = ["--benchmark_filter=/10000$", "--benchmark_min_time=0.001"] if study.quick else [
        "--benchmark_min_time=0.02", "--benchmark_repetitions=11", "--benchmark_enable_random_interleaving=true"]
    subprocess.run([os.path.join(os.environ["GRANULAR_PROGRAMS"], "bench_bonds"), f"--benchmark_out={out}",
                    "--benchmark_out_format=json", *how], stdout=subprocess.DEVNULL, check=True)
    times = {}
    for each in json.loads(out.read_text(encoding="utf-8"))["benchmarks"]:
        if each["run_type"] == "iteration":
            study.check(not each.get("error_occurred"), each.get("error_message"))
            kind, way, count = each["name"].split("/")[:3]
            times.setdefault((int(count), kind), {}).setdefault(way, []).append(1e9 / each["items_per_second"])
    rows = []
    for (count, kind), ways in sorted(times.items(), key=lambda each: (each[0][0], KINDS.index(each[0][1]))):
        memcpy, pack, unpack = (statistics.median(ways[way]) for way in WAYS)
        rows.append([f"`{kind}, {count} particles`", f"{memcpy:.1f}", f"{pack:.1f}", f"{pack / memcpy:.1f}", f"{unpack:.1f}", f"{unpack / memcpy:.1f}"])
    study.block("bonds", "granular_bonds.h: rows one after the other are packed, and unpacked into new rows, whose fields that are not sent become "
                "0; memcpy copies as many doubles. exchange and record: two bonds of twelve history values a particle. What was unpacked is packed "
                "again: every bit comes back, or this fails. One thread, processor time.",
                table(["case", "memcpy ns/particle", "pack ns/particle", "against memcpy", "unpack ns/particle", "against memcpy"], rows))


main(study_of)
