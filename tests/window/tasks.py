# SPDX-License-Identifier: BSD-3-Clause
"""Tasks in the window, as a person begins them: open a file or choose a filter, Apply, and look. None may end with an error, or with an
empty view; what is seen of what, as what, and by which colours, the table tells."""
import json
import os
import sys

import numpy
from paraview import servermanager, simple
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
    ("new; open local/settled_grains.dump.gz; filter GranularEulerAverage", {"RenderView": ["Wireframe", "Volume by volumefraction"]}),
    ("new; open local/settled_grains.dump.gz; filter GranularProfile",
     {"RenderView": ["Grains", "Wireframe"], "XYChartView": ["volumefraction: position"]}),
    ("new; open local/settled_contacts.dump.gz; open local/settled_grains.dump.gz; filter GranularContactSums Lines /0:0/0:0/0:0",
     {"RenderView": ["Wireframe", "Wireframe", "Grains", "Surface"]}),
    ("new; source GranularPackingSource", {"RenderView": ["Grains", "Wireframe", "Surface"]}),
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
# All that is on the screen, to be seen by the X server's own picture of it: 0x00RRGGBB for each pixel.
SCREEN = """
import ctypes
import numpy
class Image(ctypes.Structure):
    _fields_ = [(name, ctypes.c_int) for name in ("width", "height", "offset", "format")] + [("data", ctypes.c_void_p)]
x11 = ctypes.CDLL("libX11.so.6")
for function, kind in ((x11.XOpenDisplay, ctypes.c_void_p), (x11.XDefaultRootWindow, ctypes.c_ulong), (x11.XGetImage, ctypes.POINTER(Image))):
    function.restype = kind
display = ctypes.c_void_p(x11.XOpenDisplay(None))
size = x11.XDisplayWidth(display, 0), x11.XDisplayHeight(display, 0)
image = x11.XGetImage(display, ctypes.c_ulong(x11.XDefaultRootWindow(display)), 0, 0, *size, ctypes.c_ulong(0xffffffff), 2).contents
pixels = numpy.frombuffer(ctypes.string_at(image.data, 4 * image.width * image.height), numpy.uint32) & 0xffffff
numpy.save("screen.npy", pixels)
"""


# Words that find a filter by Ctrl+Space, which searches the names in menus; functions of scripts have other names.
WORDS = {"GranularEulerAverage": "solid fraction", "GranularProfile": "solid fraction", "GranularPointAverage": "coarse graining",
         "GranularContactSums": "coordination", "GranularHistory": "MSD", "GranularTrajectories": "Paths", "GranularCompare": "broken bonds",
         "GranularLocalJoin": "contacts and bonds", "GranularDecomposition": "load balance"}


def drawn(name):
    """Returns the number of pixels of a picture that are not of its commonest colour."""
    png = vtkPNGReader()
    png.SetFileName(name)
    png.Update()
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return len(pixels) - numpy.unique(pixels, axis=0, return_counts=True)[1].max()


for name, words in WORDS.items():
    label = servermanager.ProxyManager().GetPrototypeProxy("filters", name).GetXMLLabel()
    assert words in label and hasattr(simple, name), (name, label)

for name in os.listdir():
    if name.endswith((".png", ".json")):
        os.remove(name)
window = Window(sys.argv[1])
window.open(os.path.join(GOOD, "grains.dump"))
window.event("propertiesDock/propertiesPanel/Help", "activate")  # the button '?'
window.in_shell(SCREEN)
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
            if rest[1:]:
                window.select_input(*rest[1:])
            window.apply()
    window.in_shell(LOOK.format(number=number))
said = window.play()
assert "ERR|" not in said and "Traceback" not in said
screen = numpy.load("screen.npy")
white = screen == 0xffffff
page, text = white.mean(), ((screen < 0x404040) & (numpy.roll(white, 4) | numpy.roll(white, -4))).mean()
version = simple.GetParaViewVersion()
if "help" in sys.argv and (version.major, version.minor) != (5, 13):  # of Debian, which shows an empty page of its own filters, too
    assert page > 0.1 and text > 0.005, f"{page:.3f} of the screen is a white page, {text:.4f} dark text on it"
wrong = []
for number, (task, expected) in enumerate(TASKS):
    with open(f"{number}.json") as file:
        found = json.load(file)
    pixels = [drawn(name) for name in sorted(os.listdir()) if name.startswith(f"{number}_")]
    if found != expected or not pixels or min(pixels) < 300:
        wrong.append(f"{task}: expected {expected}, got {found} with {pixels} pixels drawn")
assert not wrong, "\n" + "\n".join(wrong)
