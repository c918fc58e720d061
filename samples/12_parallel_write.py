# SPDX-License-Identifier: BSD-3-Clause
"""Four processes write one file together, and it has the bytes that one process writes."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

import granular
from paraview.simple import *

data = Path(__file__).parent / "data/grains.dump"


def write(name):
    """What anybody would write: each process reads, filters and writes a part of the grains."""
    reader = OpenDataFile(str(data))
    small = Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=0,
                      UpperThreshold=0.003)
    # Gather: the first process writes for all. MPI-IO: each writes where its part belongs.
    for mode in "Gather", "MPI-IO":
        granular.save(small, f"{name}_{mode}.dump", WriteTimeSteps=1, Dialect="LIGGGHTS",
                      ParallelMode=mode)

    LoadPalette("WhiteBackground")
    view = GetActiveViewOrCreate("RenderView")
    SetProperties(view, ViewSize=[560, 600], ViewTime=3000, OrientationAxesVisibility=0)
    granular.show(ProcessIdScalars(Input=small), view, color="ProcessId")
    Show(OutputPort(reader, 1), view, AmbientColor=[0.3] * 3, DiffuseColor=[0.3] * 3)
    colors = GetColorTransferFunction("ProcessId")
    SetProperties(colors, InterpretValuesAsCategories=1,
                  Annotations=[text for i in range(4) for text in (str(i), str(i))],
                  IndexedColors=[0.27, 0.45, 0.7, 0.95, 0.6, 0.2, 0.3, 0.65, 0.45, 0.75, 0.3, 0.3])
    SetProperties(GetScalarBar(colors, view), Title="process", ComponentTitle="", Visibility=1)
    Render(view)  # the first picture moves the camera
    SetProperties(view, CameraPosition=[0.20, -0.33, 0.19], CameraFocalPoint=[0.008, 0, 0.07],
                  CameraViewUp=[0, 0, 1])
    SaveScreenshot(f"{name}.png", view)


def run(*command):
    # not what the MPI of this process left in the environment
    environment = {key: value for key, value in os.environ.items()
                   if not key.startswith(("OMPI_", "PMIX_", "ORTE_"))}
    # for root, and for a machine with fewer cores than processes
    environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1",
                       OMPI_MCA_hwloc_base_binding_policy="none")
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr


if len(sys.argv) > 1:
    write(sys.argv[1])
else:
    write("one")
    run(shutil.which("mpirun"), "-n", "4", shutil.which("pvbatch"), __file__, "four")
    written = {file.read_bytes() for file in Path().glob("*.dump")}
    assert len(written) == 1 and len(list(Path().glob("*.dump"))) == 4

    # The same from the text of the run: its lines of small grains, as they are. Others are shorter.
    lines = written.pop().decode().splitlines()
    rows = [line for line in data.read_text().splitlines() if len(line.split()) == 19]
    small = [row for row in rows if float(row.split()[17]) < 0.003]
    assert small == [line for line in lines if len(line.split()) == 19]
    print(f"4 files of {len(lines)} lines are the same; see four.png")
