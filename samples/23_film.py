# SPDX-License-Identifier: BSD-3-Clause
"""A film by several processes: each loads the same state file and renders its share of the frames.

pvpython 23_film.py                     saves a state, and starts two processes
pvpython 23_film.py film.pvsm 0 2       is the first of two: frames 0, 2, 4, ...
"""
import subprocess
import sys
from pathlib import Path

import vtkgranular as vg
from paraview.simple import *

data = Path(__file__).parent / "data/grains.dump"


def save_state(name):
    reader = vg.reader(data, dt=2e-5)
    view = GetActiveViewOrCreate("RenderView")
    vg.set_properties(view, ViewSize=[600, 580], OrientationAxesVisibility=0, CameraPosition=[0.22, -0.30, 0.19],
                      CameraFocalPoint=[0.0, 0.01, 0.069], CameraViewUp=[0, 0, 1])
    vg.show(reader, view, color="v", box=True)
    colours = GetColorTransferFunction("v")
    colours.ApplyPreset(vg.preset("Plasma"))
    colours.RescaleTransferFunction(0, 1.5)
    SaveState(name)


def render(state, first, step):
    vg.load_state(state)
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = list(GetTimeKeeper().TimestepValues)
    view = GetActiveViewOrCreate("RenderView")
    for frame in range(first, len(times), step):
        scene.AnimationTime = times[frame]
        SaveScreenshot(f"film_{frame:04d}.png", view)


def film():
    save_state("film.pvsm")
    workers = [subprocess.Popen(["pvpython", __file__, "film.pvsm", str(i), "2"]) for i in range(2)]
    assert all(worker.wait() == 0 for worker in workers)
    pictures = sorted(Path().glob("film_*.png"))
    assert len(pictures) == 5
    print(len(pictures), "pictures: film_0000.png to film_0004.png; ffmpeg -i film_%04d.png film.mp4 makes a film of them")


if sys.argv[1:]:
    render(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
else:
    film()
