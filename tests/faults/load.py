# SPDX-License-Identifier: BSD-3-Clause
"""A long series in ParaView: load.py FILES. It opens by its pattern, shows its times, and its frames are those of its files. Prints
seconds and memory; memory stays below 8 KiB a file."""
import os
import resource
import shutil
import sys
import time

import granular
from paraview import simple

COUNT = int(sys.argv[1])


def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024  # MiB


def open_and_delete():
    """Readers that are opened and deleted leave nothing: a proxy that stays has a tenth of a MiB."""
    def grown(count):
        before = peak()
        for _ in range(count):
            simple.Delete(granular.reader("series/run_0.dump"))
        return peak() - before

    grown(20)
    mib = grown(60)
    print("load | 60 readers opened and deleted | %.1f MiB" % mib, flush=True)
    assert mib < 4, mib


def main():
    granular.load_plugin()
    shutil.rmtree("series", ignore_errors=True)
    os.makedirs("series")
    for step in range(COUNT):
        with open(f"series/run_{step}.dump", "w") as out:
            out.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                      f"ITEM: ATOMS id x y z\n1 {step} 0 0\n")
    open_and_delete()
    before, start = peak(), time.monotonic()
    reader = granular.reader("series/run_*.dump")
    opened = time.monotonic() - start
    assert len(reader.FileNames) == COUNT, len(reader.FileNames)
    assert list(reader.TimestepValues) == list(range(COUNT))
    for step in (0, COUNT // 3, COUNT - 1):
        frame = granular.fetch(reader, time=step)
        assert frame["timestep"] == step and frame["points"].tolist() == [[step, 0, 0]], step
    mib = peak() - before
    print("load | %d files in ParaView | opened in %.1f s, all in %.1f s | %.0f MiB" %
          (COUNT, opened, time.monotonic() - start, mib), flush=True)
    assert mib < 64 + COUNT * 8 / 1024, mib
    simple.Delete(reader)
    shutil.rmtree("series")


main()
