# SPDX-License-Identifier: BSD-3-Clause
"""The window: open a run whose first frame is empty, Apply, last frame, save the state; load it in pvbatch.

Then a Clip, and Apply: its particles come up as particles. The camera is where arithmetic puts it, around the box. The first picture shows the box and nothing else, the last one
the particles of the file, pixel by pixel; pvbatch shows the same from the state."""
import math
import os
import subprocess
import sys
from xml.sax.saxutils import quoteattr

import numpy
from discs import Camera
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PIXELS = 500
ANGLE = 30  # degrees, ParaView's default
WINDOW, PVBATCH = sys.argv[1:]
DUMP = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
LOWER, UPPER = numpy.array([-0.05, -0.05, 0]), numpy.array([0.05, 0.05, 0.15])  # the header's
PICTURE = """
from paraview.simple import *
view = GetActiveView()
view.OrientationAxesVisibility = 0
SaveScreenshot({path!r}, view, ImageResolution=[{pixels}, {pixels}])
"""
CLIP = """
from paraview.simple import *
Clip(Input=GetActiveSource(), ClipType="Box")
"""
LOOK = """
from paraview.simple import *
with open("look.txt", "w") as file:
    file.write(GetDisplayProperties().SMProxy.GetProperty("Representation").GetElement(0))
"""


def run(*command, **environment):
    """Runs a program to its end and prints what it says; kills it after a minute."""
    said = subprocess.run(command, env={**os.environ, **environment}, timeout=60, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(said.stdout, flush=True)
    assert said.returncode == 0, f"exit status {said.returncode} of {command}"


def script(name):
    """Writes a script that saves a picture, and returns the scripts' path."""
    with open(f"{name}.py", "w") as file:
        file.write(PICTURE.format(path=os.path.abspath(f"{name}.png"), pixels=PIXELS))
    return os.path.abspath(f"{name}.py")


def event(widget, command, arguments=""):
    """Returns an event of ParaView's own tests of its window."""
    return f"<pqevent object={quoteattr('pqClientMainWindow/' + widget)} command={quoteattr(command)} " \
           f"arguments={quoteattr(arguments)}/>"


def in_shell(name, text=None):
    """Returns the event of a script, or of a picture, that the window's Python shell runs or saves."""
    if text:
        with open(f"{name}.py", "w") as file:
            file.write(text)
    path = os.path.abspath(f"{name}.py") if text else script(name)
    return event("pythonShellDock/pythonShell/consoleWidget", "executeCommand", f"exec(open({path!r}).read())")


def read(name):
    """Returns the colours of a picture, rows from below."""
    png = vtkPNGReader()
    png.SetFileName(f"{name}.png")
    png.Update()
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(PIXELS, PIXELS, -1)[:, :, :3].astype(int)


def drawn(pixels):
    """Returns where something is before the background, the colour of the corner."""
    return abs(pixels - pixels[-1, -1]).max(axis=2) > 1


# ---- in the window ----------------------------------------------------------------------------------
for name in ("first.png", "last.png", "loaded.png", "look.txt", "session.pvsm"):
    if os.path.exists(name):
        os.remove(name)
os.makedirs("home", exist_ok=True)
os.chmod("home", 0o700)
home = os.path.abspath("home")
state = os.path.abspath("session.pvsm")
with open("events.xml", "w") as file:
    file.write("\n".join([
        "<?xml version='1.0'?>", "<pqevents>",
        event("propertiesDock/propertiesPanel/Accept", "activate"),
        in_shell("first"),
        event("VCRToolbar/actionVCRLastFrame", "activate"),
        in_shell("last"),
        event("menubar/menu_File", "activate", "actionFileSaveServerState"),
        event("FileSaveServerStateDialog", "filesSelected", state),
        in_shell("clip", CLIP),
        event("propertiesDock/propertiesPanel/Accept", "activate"),
        in_shell("look", LOOK),
        "</pqevents>\n"]))
# --dr and a home of its own: whatever the user has set in the window counts for nothing
run(WINDOW, "--dr", DUMP, "--test-script=" + os.path.abspath("events.xml"), "--exit", HOME=home, XDG_RUNTIME_DIR=home)

with open("look.txt") as file:
    assert file.read() == "Grains", "the clip is not shown as particles"

# ---- in pvbatch -------------------------------------------------------------------------------------
with open("load.py", "w") as file:
    file.write(f"from paraview.simple import *\nLoadState({state!r})\n"
               f"SetActiveView(GetViews()[0])\nexec(open({script('loaded')!r}).read())\n")
run(PVBATCH, "--dr", os.path.abspath("load.py"))

# ---- what is to be seen -----------------------------------------------------------------------------
# The camera looks along -z at the sphere around the box; near is the face of the box at the top of z.
centre, radius = (LOWER + UPPER) / 2, numpy.linalg.norm(UPPER - LOWER) / 2
distance = radius / math.sin(math.radians(ANGLE / 2))
camera = Camera(centre + [0, 0, distance], centre, angle=ANGLE)
half = (distance - (UPPER - LOWER)[2] / 2) * math.tan(math.radians(ANGLE / 2))
near = PIXELS / 2 * (UPPER - LOWER)[0] / 2 / half  # half the width of that face, in pixels
first = drawn(read("first"))
for axis in (0, 1):
    line = numpy.flatnonzero(first.any(axis=axis))
    assert len(line), "the first picture is empty"
    assert abs(line[0] - (PIXELS / 2 - near)) < 2.5 and abs(line[-1] + 1 - (PIXELS / 2 + near)) < 2.5, \
        f"the box is from {line[0]} to {line[-1] + 1}, expected {PIXELS / 2 - near:.1f} to {PIXELS / 2 + near:.1f}"
assert first.mean() < 0.03, "more than a wire frame in the empty frame"

with open(DUMP) as file:
    header, *rows = file.read().split("ITEM: ATOMS ")[-1].splitlines()
column = dict(zip(header.split(), numpy.array([row.split() for row in rows], dtype=float).T))
centres = numpy.stack([column[name] for name in "xyz"], axis=1)
seen = camera.seen(centres, column["radius"], column["id"], PIXELS)
last = drawn(read("last"))
inside = seen > 0
# Neighbours of edges are mixed with the background; dark sides may be of its colour.
assert inside.mean() > 0.1, "the truth itself shows little"
assert last[inside].mean() > 0.99, f"only {last[inside].mean():.3f} of the particles' pixels are drawn"
beyond = last & ~first & (seen == 0)
assert beyond.mean() < 0.02, f"{beyond.mean():.3f} of the picture is drawn where neither box nor particles are"

# The window may smooth edges in another way than pvbatch: these pixels are few, all others are the same.
away = abs(read("last") - read("loaded")).max(axis=2)
print(f"{(away > 0).mean():.5f} of the pixels differ, {(away > 8).mean():.5f} by more than 8 levels")
assert (away > 8).mean() < 0.02, "pvbatch shows another picture from the state"
