# SPDX-License-Identifier: BSD-3-Clause
"""Which part of the grains has each process of ParaView? Four of them show their own share as boxes."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import granular
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = Path(__file__).parent / "data"


def show(name):
    grains = OpenDataFile(str(data / "grains.dump"))
    # Mode Ranks: the bounds of what each process has. A piece of a dump is a part of its lines, wherever
    # these grains are; D3 (Redistribute Data Set) sends each to a process that has the others around it.
    near = D3(Input=grains)
    shares = {"as they are read": (grains, GranularDecomposition(Input=grains, Mode="Ranks")),
              "redistributed": (near, GranularDecomposition(Input=near, Mode="Ranks"))}
    LoadPalette("WhiteBackground")
    strip = CreateLayout()
    strip.SplitHorizontal(0, 0.5)
    for place, (text, (inside, boxes)) in zip((1, 2), shares.items()):
        view = CreateRenderView(OrientationAxesVisibility=0, ViewTime=2000)
        AssignViewToLayout(view, strip, place)
        granular.show(ProcessIdScalars(Input=inside), view, color="ProcessId")
        Show(boxes, view, Representation="Wireframe", LineWidth=3)
        ColorBy(GetDisplayProperties(boxes, view), ("CELLS", "proc"))
        Show(Text(Text=text), view, WindowLocation="Upper Center", FontSize=18)
        Render(view)  # the first picture moves the camera
        SetProperties(view, CameraPosition=[0.22, -0.35, 0.20], CameraFocalPoint=[0, 0, 0.07],
                      CameraViewUp=[0, 0, 1])
    strip.SetSize(1000, 560)
    SaveScreenshot(f"{name}.png", strip, SeparatorWidth=0)
    for text, (_, boxes) in shares.items():
        boxes.UpdatePipeline(2000)
        voxels = servermanager.Fetch(boxes)
        counts = vtk_to_numpy(voxels.GetCellData().GetArray("nlocal")).tolist()
        imbalance = voxels.GetFieldData().GetArray("imbalance").GetValue(0)
        print(f"{text}: {counts} grains, imbalance {imbalance:.2f}")
        assert sum(counts) == 1200


def run(*command):
    # not what the MPI of this process left in the environment
    environment = {key: value for key, value in os.environ.items()
                   if not key.startswith(("OMPI_", "PMIX_", "ORTE_"))}
    # for root, and for a machine with fewer cores than processes
    environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1",
                       OMPI_MCA_hwloc_base_binding_policy="none")
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert done.returncode == 0 and "ERR|" not in done.stderr, done.stdout + done.stderr
    return done.stdout


if len(sys.argv) > 1:
    show(sys.argv[1])
else:
    print(run(shutil.which("mpirun"), "-n", "4", shutil.which("pvbatch"), __file__, "four"), end="")
