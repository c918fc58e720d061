# SPDX-License-Identifier: BSD-3-Clause
"""Text to columns in memory: decode_rows for each instruction set against a loop of std::from_chars, as bench_decode measures them."""
import json
import os
import statistics
import subprocess

from scene import main, table


def study_of(study):
    out = study.folder / "decode.json"
    how = ["--benchmark_min_time=0.001"] if study.quick else ["--full", "--benchmark_min_time=0.02", "--benchmark_repetitions=9",
                                                              "--benchmark_enable_random_interleaving=true"]
    subprocess.run([os.path.join(os.environ["GRANULAR_PROGRAMS"], "bench_decode"), f"--benchmark_out={out}",
                    "--benchmark_out_format=json", *how], stdout=subprocess.DEVNULL, check=True)
    speeds = {}
    for each in json.loads(out.read_text(encoding="utf-8"))["benchmarks"]:
        if each["run_type"] == "iteration":
            study.check(not each.get("error_occurred"), each.get("error_message"))
            rows, way = each["name"].split("/")[:2]
            speeds.setdefault(rows, {}).setdefault(way, []).append(each["bytes_per_second"] / 1e9)
    speeds = {rows: {way: statistics.median(each) for way, each in ways.items()} for rows, ways in speeds.items()}
    names = list(next(iter(speeds.values())))
    study.block("decode", "GB of text a second (10^9 bytes), one thread, into memory that was touched before; and the speed against the loop of "
                "std::from_chars. All values equal those of strtod, bit for bit.",
                table(["rows", *(f"{name} GB/s" for name in names), *(f"{name} against from_chars" for name in names[1:])], [
                    [f"`{rows}`", *(f"{ways[name]:.2f}" for name in names), *(f"{ways[name] / ways[names[0]]:.2f}" for name in names[1:])]
                    for rows, ways in speeds.items()]))


main(study_of)
