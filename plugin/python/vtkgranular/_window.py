# SPDX-License-Identifier: BSD-3-Clause
"""Shows a frame in ParaView's window, which runs this file for `granular show --window`: it passes no arguments to a script."""
import json
import os
import sys

from paraview import simple


def fill(given: dict) -> None:
    """Shows particles and their box, or what the reader has.

    given: color; files, options and frame, or folder, dt and time; package, the folder with this package, which comes behind all others:
    what lies beside it may be of another Python.
    """
    sys.path.append(given["package"])
    import vtkgranular

    vtkgranular.load_plugin()
    if "folder" in given:
        vtkgranular.show_run(given["folder"], dt=given["dt"], color=given["color"])
        simple.GetAnimationScene().AnimationTime = given["time"]
        return
    run = vtkgranular.open(given["files"], **given["options"])
    reader = run.reader()
    if len(reader.TimestepValues) > 0:
        simple.GetAnimationScene().AnimationTime = reader.TimestepValues[given["frame"]]
    if run.kind in ("dump", "restart", "data"):
        vtkgranular.show(reader, color=given["color"], box=True, legend=bool(given["color"]))
    else:
        simple.Show(reader)
    view = simple.GetActiveView()
    view.ResetActiveCameraToPositiveY()  # z upwards
    simple.ResetCamera(view)
    simple.SetActiveSource(reader)
    simple.Render(view)


if __name__ == "__main__" and "GRANULAR_WINDOW" in os.environ:
    with open(os.environ["GRANULAR_WINDOW"]) as file:
        fill(json.load(file))
