# SPDX-License-Identifier: BSD-3-Clause
"""Prints what it costs that files are on the disk before they get their names: pairs of writes with and without, one after the other in
changing order. Decides nothing."""
import os
import shutil
import statistics
import time

import numpy
import vtkgranular as vg

CASES = ((250, 1, 15), (25_000, 1, 15), (2_500_000, 1, 7), (25_000_000, 1, 3), (250, 1000, 3))  # rows, files, pairs


def write(arrays, files, durable):
    begin = time.monotonic()
    for number in range(files):
        vg.write(f"cost_{number}.bin", arrays, box=((0, 1),) * 3, durable=durable)
    return time.monotonic() - begin


shutil.rmtree("cost", ignore_errors=True)
os.mkdir("cost")
os.chdir("cost")
print(f"{'bytes':>12} {'files':>6} {'pairs':>6} {'off, s':>10} {'on, s':>10} {'on / off':>9} {'least':>7} {'most':>7}")
for rows, files, pairs in CASES:
    arrays = {"points": numpy.random.default_rng(1).random((rows, 3)), "id": numpy.arange(1, rows + 1), "type": numpy.ones(rows, int),
              "radius": numpy.ones(rows)}
    took = {False: [], True: []}
    for pair in range(pairs):
        for durable in (False, True) if pair % 2 else (True, False):
            took[durable].append(write(arrays, files, durable))
    ratios = [on / off for on, off in zip(took[True], took[False])]
    size = os.path.getsize("cost_0.bin")
    print(f"{size:12} {files:6} {pairs:6} {statistics.median(took[False]):10.4f} {statistics.median(took[True]):10.4f} "
          f"{statistics.median(ratios):9.2f} {min(ratios):7.2f} {max(ratios):7.2f}", flush=True)
os.chdir("..")
shutil.rmtree("cost")
