# SPDX-License-Identifier: BSD-3-Clause
"""The window with the portable plugin: load it, open a dump, which no question precedes, Apply, last frame; all particles are drawn at
their places and with their radii. Then without one array, and saved as a dump: the words of the file but for that array."""
import os
import sys

import numpy
import vtkgranular
from discs import Camera
from paraview.simple import GetParaViewVersion
from window import PIXELS, Window, drawn, picture, read

WINDOW = sys.argv[1]
DUMP = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
PLUGIN = os.path.join(os.path.dirname(vtkgranular.__file__), "portable", "Granular.py")
FILES = "1pqFileDialog0" if GetParaViewVersion().version == (5, 13) else "pqFileDialog"
ARRAYS = ("propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel/"
          "PointArrayStatus/ArraySelectionWidget")
OFFERED = ["id", "type", "image", "v", "f", "omega", "radius", "mass", "x", "y", "z"]  # of the columns of the file; the panel sorts them
LEFT_OUT, GONE = "v", ["vx", "vy", "vz"]
LOOK = """
from paraview.simple import *
reader, view = GetActiveSource(), GetActiveView()
ResetCamera(view)  # the first frame, to which the window has set it, is empty
with open("look.txt", "w") as file:
    print([reader.GetXMLName(), GetDisplayProperties().Representation, reader.GetProperty("PointArrayStatus").Available,
           list(view.CameraPosition), list(view.CameraFocalPoint), view.CameraViewAngle], file=file)
"""


def rows_of(path):
    """Returns the names of the columns of the last frame of a dump, and the words of its rows."""
    with open(path) as file:
        header, *rows = file.read().split("ITEM: ATOMS ")[-1].splitlines()
    return header.split(), [row.split() for row in rows]


for name in ("last.png", "look.txt", "saved.dump"):
    if os.path.exists(name):
        os.remove(name)
names, rows = rows_of(DUMP)
window = Window(WINDOW)
window.event("menubar/menuTools", "activate", "actionManage_Plugins")
window.event("PluginManagerDialog/splitter/localGroup/loadLocal", "activate")
window.event(f"PluginManagerDialog/{FILES}", "filesSelected", PLUGIN)
window.event("PluginManagerDialog/buttonBox/1QPushButton0", "activate")
window.open(DUMP)
window.apply()
window.last_frame()
window.in_shell(LOOK + picture("last"))
window.event(ARRAYS, "setCheckState", f"{sorted(OFFERED).index(LEFT_OUT)}.0,0")
window.apply()
window.event("menubar/menu_File", "activate", "actionFileSaveData")
window.event("FileSaveDialog", "filesSelected", os.path.abspath("saved.dump"))
window.event("WriterSettingsDialog/widget/OKButton", "activate")
window.play(PV_PLUGIN_PATH="")
with open("look.txt") as file:
    reader, shown, offered, position, focus, angle = eval(file.read())
assert (reader, shown, offered) == ("GranularDumpReader", "Grains", OFFERED), (reader, shown, offered)

column = dict(zip(names, numpy.array(rows, dtype=float).T))
centres = numpy.stack([column[name] for name in "xyz"], axis=1)
seen = Camera(position, focus, angle=angle).seen(centres, column["radius"], column["id"], PIXELS)
last = drawn(read("last"))
assert (seen > 0).mean() > 0.1, "the truth itself shows little"
# Point Gaussian draws discs before the camera, dark at their rims, which the background may be, too
assert last[seen > 0].mean() > 0.97, f"only {last[seen > 0].mean():.3f} of the particles' pixels are drawn"
assert (last & (seen == 0)).mean() < 0.03, f"{(last & (seen == 0)).mean():.3f} of the picture is drawn where no particles are"

saved, words = rows_of("saved.dump")
kept = [i for i, name in enumerate(names) if name not in GONE]
assert saved == [names[i] for i in kept] and words == [[row[i] for i in kept] for row in rows], saved
