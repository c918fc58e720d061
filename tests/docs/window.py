# SPDX-License-Identifier: BSD-3-Clause
"""The steps of docs/guide/window.md in the real window, on a display whose pixels are a file: makes the pictures of the page."""
import os
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

ROOT = Path(__file__).resolve().parents[2]
DUMP = ROOT / "samples" / "data" / "hopper" / "hopper.dump.gz"
SIZE = "1000x640"
COLOUR = "ColorBy(GetDisplayProperties(), ('POINTS', 'v')); GetDisplayProperties().SetScalarBarVisibility(GetActiveView(), True); Render()"
CLOSER = "view = GetActiveView(); view.CameraFocalPoint = [0, 0, 0.06]; view.CameraPosition = [0, -0.35, 0.06]; " \
         "view.CameraViewUp = [0, 0, 1]; Render()"


def event(widget, command, arguments=""):
    return f"<pqevent object={quoteattr('pqClientMainWindow/' + widget)} command={quoteattr(command)} arguments={quoteattr(arguments)}/>"


def shell(text):
    return event("pythonShellDock/pythonShell/consoleWidget", "executeCommand", text)


def picture(name):
    """Copies the pixels of the display when the window has drawn what came before."""
    return shell("Render()") + shell(f"import shutil; shutil.copy('pixels/Xvfb_screen0', '{name}')")


def as_png(name):
    """Makes NAME.png of a copy of the display, and returns its colours from the middle of the view."""
    dump = Path(name).read_bytes()
    head = struct.unpack(">25I", dump[:100])
    width, height, line = head[4], head[5], head[12]
    pixels = numpy.frombuffer(dump, numpy.uint8, height * line, head[0] + 12 * head[19]).reshape(height, line // 4, 4)[:, :width, 2::-1]
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.ascontiguousarray(pixels[::-1]).reshape(-1, 3)))
    png = vtkPNGWriter()
    png.SetFileName(f"{name}.png")
    png.SetInputData(image)
    png.Write()
    return {tuple(pixel // 32) for pixel in pixels[300:500, 500:700].reshape(-1, 3)}


shutil.rmtree("home", ignore_errors=True)
os.makedirs("home", mode=0o700)
os.makedirs("pixels", exist_ok=True)
Path("events.xml").write_text("\n".join([
    "<?xml version='1.0'?>", "<pqevents>",
    event("menubar/menu_File", "activate", "actionFileOpen"), event("FileOpenDialog", "filesSelected", str(DUMP)),
    shell("from paraview.simple import *; GetActiveSource().TimestepSize = 2e-5"),
    event("propertiesDock/propertiesPanel/Accept", "activate"),
    shell("Render()"), shell(CLOSER), picture("window_open"),
    shell("GetAnimationScene().AnimationTime = 0.28; " + COLOUR), picture("window_colour"),
    "</pqevents>\n"]))
ready, number = os.pipe()
display = subprocess.Popen(["Xvfb", "-displayfd", str(number), "-screen", "0", SIZE + "x24", "-fbdir", "pixels", "-nolisten", "tcp"],
                           pass_fds=[number], stderr=subprocess.DEVNULL)
try:
    home = os.path.abspath("home")  # of its own: the user's settings count for nothing
    command = [sys.argv[1], "--dr", "--test-script=" + os.path.abspath("events.xml"), "--exit", "-geometry", SIZE + "+0+0"]
    said = subprocess.run(command, timeout=100, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, "DISPLAY": ":" + os.read(ready, 10).decode().strip(), "HOME": home, "XDG_RUNTIME_DIR": home})
finally:
    display.terminate()
    display.wait()
print(said.stdout)
assert said.returncode == 0, said.returncode
for name in re.findall(r"\(pictures/(\w+)\.png\)", (ROOT / "docs" / "guide" / "window.md").read_text()):
    assert len(as_png(name)) > 10, f"no particles in {name}.png"
