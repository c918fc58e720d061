# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server, on both of which the portable plugin is loaded, opens, draws and saves a dump: as without a server."""
import os

import vtkgranular as vg
from paraview.simple import *
from ranks_server import connected

SOURCE = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
PLUGIN = os.path.join(os.environ.pop("PV_PLUGIN_PATH"), "Granular.py")  # the server does not find it by itself


def made(name):
    """Returns the bytes of a picture of the last frame, and of the file that is written of all frames."""
    reader = vg.reader(SOURCE)
    view = CreateRenderView(ViewSize=[300, 300])
    view.ViewTime = reader.TimestepValues[-1]
    vg.show(reader, view, color="radius", box=True)
    ResetCamera(view)
    SaveScreenshot(f"{name}.png", view)
    SaveData(os.path.abspath(f"{name}.dump"), reader, WriteTimeSteps=1)
    Delete(view)
    Delete(reader)
    with open(f"{name}.png", "rb") as picture, open(f"{name}.dump", "rb") as file:
        return picture.read(), file.read()


expected = made("alone")
with open(SOURCE, "rb") as file:
    assert expected[1] == file.read()
with connected():
    try:
        vg.load_plugin()
    except RuntimeError as error:
        assert "load_plugin(remote=True)" in str(error), error
    assert not vg._plugin.has_plugin()
    LoadPlugin(PLUGIN, remote=True, ns=globals())
    LoadPlugin(PLUGIN, remote=False, ns=globals())
    found = made("served")
assert found[1] == expected[1], "the server writes another file"
assert found[0] == expected[0], "the server draws another picture"
print("served")
