# SPDX-License-Identifier: BSD-3-Clause
"""Tasks in the window, as a person begins them: open a file or choose a filter, Apply, and look. None may end with an error, or with an
empty view; what is seen of what, as what, and by which colours, the table tells."""
import json
import os
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from window import Window

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")

# What is done, and {view: [what is visible in it]}. "new" begins with an empty window.
TASKS = [
    ("new; open grains.dump", {"RenderView": ["Grains", "Wireframe"]}),
    ("last frame", {"RenderView": ["Grains", "Wireframe"]}),
    ("filter Clip", {"RenderView": ["Wireframe", "Grains"]}),
    ("new; open paths/walk.dump.gz; filter GranularTrajectories", {"RenderView": ["Wireframe", "Surface by speed"]}),
    ("new; open paths/walk.dump.gz; filter GranularHistory", {"RenderView": ["Grains", "Wireframe"], "XYChartView": ["time: 10 series"]}),
    ("new; open local/contacts.dump", {"RenderView": ["Contacts", "Wireframe"]}),
    ("last frame", {"RenderView": ["Contacts", "Wireframe"]}),
    ("new; open local/ovito.local", {"RenderView": ["Contacts", "Wireframe"], "SpreadSheetView": [""]}),
]

NEW = """
from paraview.simple import *
for each in list(GetSources().values())[::-1]:
    Delete(each)
for each in GetViews():
    if each.SMProxy.GetXMLName() != "RenderView":
        Delete(each)
SetActiveView(GetViews()[0])
HideUnusedScalarBars()
GetAnimationScene().AnimationTime = 0
"""
LOOK = """
import json
from paraview.simple import *
seen = {{}}
for number, view in enumerate(GetViews()):
    kind = view.SMProxy.GetXMLName()
    displays = seen.setdefault(kind, [])
    for display in view.Representations:
        if display.SMProxy.GetProperty("Input") and display.Visibility:  # no legend
            colour = display.ColorArrayName[1] if "ColorArrayName" in display.ListProperties() else ""
            form = display.SMProxy.GetProperty("Representation")
            text = (form.GetElement(0) if form else "") + (" by " + colour if colour else "")
            if kind == "XYChartView":
                states = display.SMProxy.GetProperty("SeriesVisibility")  # name, "0" or "1", name, ...
                states = [states.GetElement(i) for i in range(states.GetNumberOfElements())]
                series = [name for name, on in zip(states[::2], states[1::2]) if on == "1"]
                text = display.SMProxy.GetProperty("XArrayName").GetElement(0) + ": " + (f"{{len(series)}} series" if len(series) > 2 else ", ".join(series))
            displays.append(text)
    if kind != "SpreadSheetView":
        view.ViewSize = [300, 300]
        SaveScreenshot("{number}_%d.png" % number, view)
with open("{number}.json", "w") as file:
    json.dump(seen, file)
"""


def drawn(name):
    """Returns the number of pixels of a picture that are not of its commonest colour."""
    png = vtkPNGReader()
    png.SetFileName(name)
    png.Update()
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return len(pixels) - numpy.unique(pixels, axis=0, return_counts=True)[1].max()


for name in os.listdir():
    if name.endswith((".png", ".json")):
        os.remove(name)
window = Window(sys.argv[1])
for number, (task, _) in enumerate(TASKS):
    for word, *rest in [step.split() for step in task.split("; ")]:
        if word == "new":
            window.in_shell(NEW)
        elif word == "open":
            window.open(os.path.join(GOOD, rest[0]))
            window.apply()
        elif word == "last":
            window.last_frame()
        else:
            window.choose(word.capitalize() + "s", rest[0])
            window.apply()
    window.in_shell(LOOK.format(number=number))
said = window.play()
assert "ERR|" not in said and "Traceback" not in said
wrong = []
for number, (task, expected) in enumerate(TASKS):
    with open(f"{number}.json") as file:
        found = json.load(file)
    pixels = [drawn(name) for name in sorted(os.listdir()) if name.startswith(f"{number}_")]
    if found != expected or not pixels or min(pixels) < 300:
        wrong.append(f"{task}: expected {expected}, got {found} with {pixels} pixels drawn")
assert not wrong, "\n" + "\n".join(wrong)
