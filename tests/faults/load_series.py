# SPDX-License-Identifier: BSD-3-Clause
"""A long series in ParaView, of many more files than the process may have open: load.py FILES. It opens by its pattern, shows its
times, and its frames are those of its files. Prints seconds and memory: at most 8 KiB a file beside 4 MiB, and no more after a second
pass over the same files than after the first."""
import ctypes
import gc
import os
import resource
import shutil
import sys
import time

import vtkgranular as vg
from paraview import simple

COUNT = int(sys.argv[1])
TRIM = ctypes.CDLL(None).malloc_trim  # what is free is given back, so that the rest is what is held


def status(name):
    """A number of this process in MiB."""
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) / 1024 for line in file if line.startswith(name + ":"))


def held():
    """Resident memory in MiB; the system looks for the peak anew."""
    gc.collect()
    TRIM(0)
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")
    return status("VmRSS")


def open_and_delete():
    """Readers that are opened and deleted leave nothing: a proxy that stays has a tenth of a MiB."""
    def grown(count):
        before = held()
        for _ in range(count):
            simple.Delete(vg.reader("series/run_0.dump"))
        return held() - before

    grown(20)
    mib = grown(60)
    print("load | 60 readers opened and deleted | %.1f MiB" % mib, flush=True)
    assert mib < 2, mib


def read_series():
    """Opens the series, reads three frames and deletes the reader. Returns the most memory in MiB beside what was held."""
    before, start = held(), time.monotonic()
    reader = vg.reader("series/run_*.dump")
    opened = time.monotonic() - start
    assert len(reader.FileNames) == COUNT, len(reader.FileNames)
    assert list(reader.TimestepValues) == list(range(COUNT))
    for step in (0, COUNT // 3, COUNT - 1):
        frame = vg.fetch(reader, time=step)
        assert frame["timestep"] == step and frame["points"].tolist() == [[step, 0, 0]], step
    simple.Delete(reader)
    mib = status("VmHWM") - before
    print("load | %d files in ParaView | opened in %.1f s, all in %.1f s | %.1f MiB" %
          (COUNT, opened, time.monotonic() - start, mib), flush=True)
    return mib


def main():
    vg.load_plugin()
    shutil.rmtree("series", ignore_errors=True)
    os.makedirs("series")
    for step in range(COUNT):
        with open(f"series/run_{step}.dump", "w") as out:
            out.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                      f"ITEM: ATOMS id x y z\n1 {step} 0 0\n")
    open_and_delete()
    few = len(os.listdir("/proc/self/fd")) + 64
    resource.setrlimit(resource.RLIMIT_NOFILE, (few, few))
    read_series()
    first = held()
    mib = read_series()
    grown = held() - first
    print("load | %d files once more | %.1f MiB more than after the first time" % (COUNT, grown), flush=True)
    assert mib < 4 + COUNT * 8 / 1024, mib
    assert grown < 1 + COUNT * 0.5 / 1024, grown
    shutil.rmtree("series")


main()
