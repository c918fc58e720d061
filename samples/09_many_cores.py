# SPDX-License-Identifier: BSD-3-Clause
"""The same script on one core, on all cores, and on four ranks: the results are the same."""
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *


def widen(source, target, tiles):
    """The last three frames of 1200 particles, each tiles x tiles times side by side."""
    frames = source.read_text().split("ITEM: TIMESTEP\n")[-3:]
    with open(target, "w") as out:
        for frame in frames:
            header, body = frame.split("ITEM: ATOMS ")
            names, *rows = body.splitlines()
            identity, x, y = map(names.split().index, ("id", "x", "y"))
            header = re.sub(r"^1200$", str(1200 * tiles ** 2), header, flags=re.M)
            header = re.sub(r"^(-0.05) 0.05$", f"-0.05 {0.1 * tiles - 0.05:g}", header, flags=re.M)
            out.write("ITEM: TIMESTEP\n" + header + "ITEM: ATOMS " + names + "\n")
            for tile in range(tiles ** 2):
                for row in rows:
                    words = row.split()
                    words[identity] = str(int(words[identity]) + 1200 * tile)
                    words[x] = f"{float(words[x]) + 0.1 * (tile % tiles):.6g}"
                    words[y] = f"{float(words[y]) + 0.1 * (tile // tiles):.6g}"
                    out.write(" ".join(words) + "\n")


def look(file, threads, picture):
    """An ordinary script; only Threads is about cores."""
    start = time.perf_counter()
    reader = vg.reader(file, Threads=threads, dt=2e-5)
    times = reader.TimestepValues
    for moment in times:
        reader.UpdatePipeline(moment)
    took = time.perf_counter() - start
    particles = reader.GetDataInformation().GetNumberOfPoints()
    fastest = reader.PointData["v"].GetRange(-1)[1]

    view = GetActiveViewOrCreate("RenderView")
    vg.set_properties(view, ViewSize=[640, 360], ViewTime=times[-1], OrientationAxesVisibility=0)
    vg.show(reader, view, color="v")
    colors = GetColorTransferFunction("v")
    colors.ApplyPreset(vg.preset("Cool to Warm"))
    colors.RescaleTransferFunction(0, 1.5)
    Render(view)  # the first picture moves the camera
    vg.set_properties(view, CameraPosition=[0.35, -0.75, 0.65], CameraFocalPoint=[0.35, 0.25, 0])
    SaveScreenshot(picture, view, OverrideColorPalette="WhiteBackground")
    print(f"{particles} particles, the fastest at {fastest:.17g} m/s: {len(times)} frames in {took:.2f} s")


def result(name, said):
    """Prints the output of a run; it is the same for all runs except for the time."""
    print(f"{name:15}{said}", end="")
    return said.partition(": ")[0]


def python(threads, picture):
    """In a ParaView with one rank, like this one."""
    command = [shutil.which("pvpython"), __file__, "wide.dump", threads, picture]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


if len(sys.argv) > 1:
    look(sys.argv[1], int(sys.argv[2]), sys.argv[3])
else:
    widen(Path(__file__).parent / "data/grains.dump", "wide.dump", 8)
    results = {
        result("one core", python("1", "one_core.png")),
        result("all cores", python("0", "all_cores.png")),
        result("four processes",
               vg.pvbatch(__file__, "wide.dump", "0", "four_processes.png", ranks=4)),
    }
    assert len(results) == 1, results
    print("the same particles at the same speeds; see one_core.png and four_processes.png")
