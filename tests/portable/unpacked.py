# SPDX-License-Identifier: BSD-3-Clause
"""Opens, shows, averages and saves the dump of a folder that was unpacked.

UNPACKED names the folder, and PROGRAM what runs this: python3, wheel (Python with the package installed), or a program of ParaView.
"""
import os
import sys
import time
import traceback

began = time.monotonic()
folder, program = os.environ["UNPACKED"], os.environ["PROGRAM"]


def in_python(dump, frames=5):
    import vtkgranular as vg

    run = vg.open(dump)
    assert len(run) == frames and run[-1].rows == 1200, run
    assert (run[-1]["radius"].min(), run[-1]["radius"].max()) == (0.0025, 0.0035)
    vg.write(f"{program}.dump.gz", run[-1])
    assert (vg.open(f"{program}.dump.gz")[0]["v"] == run[-1]["v"]).all()
    return vg


def in_paraview(dump):
    from paraview import simple

    simple.LoadPlugin(os.path.join(folder, "Granular.py"), ns=globals())
    reader = simple.OpenDataFile(dump)
    assert reader.GetXMLName() == "GranularDumpReader" and len(reader.TimestepValues) == 5, reader
    view = simple.GetActiveViewOrCreate("RenderView")
    simple.GetAnimationScene().AnimationTime = reader.TimestepValues[-1]
    display = simple.Show(reader, view)
    assert display.Representation == "Grains", display.Representation
    simple.ColorBy(display, ("POINTS", "v"))
    view.ResetActiveCameraToPositiveY()
    simple.ResetCamera(view)
    simple.SaveScreenshot(f"{program}.png", view, ImageResolution=[400, 400])
    simple.SaveData(f"{program}.dump", proxy=reader)
    simple.SaveData(f"{program}.euler", proxy=globals()["GranularEulerAverage"](Input=reader, CellCounts=[2, 3, 4]))

    vg = in_python(f"{program}.dump", 1)
    cells = vg.open(f"{program}.euler")[0]
    assert cells.rows == 24 and 0.0025 < cells["radius"].max() < 0.0035, cells
    assert vg.load_plugin() == os.path.join(folder, "Granular.py"), vg.load_plugin()
    return vg


try:
    if program == "python3":
        sys.path.insert(0, folder)
    work = in_python if program in ("python3", "wheel") else in_paraview
    package = work(os.path.join(folder, "grains.dump"))
    assert package.__file__.startswith(folder) == (program != "wheel"), package.__file__
    os.write(1, f"passed: {program}, in {time.monotonic() - began:.1f} s\n".encode())
    status = 0
except BaseException:
    os.write(2, traceback.format_exc().encode())
    status = 1
os._exit(status)  # the window stays open after a script
