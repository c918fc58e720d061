# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's window, driven by events of its own tests, and pictures that scripts in its Python shell save."""
import os
import subprocess
from xml.sax.saxutils import quoteattr

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PIXELS = 500

PICTURE = """
from paraview.simple import *
view = GetActiveView()
view.OrientationAxesVisibility = 0
SaveScreenshot({path!r}, view, ImageResolution=[{pixels}, {pixels}])
"""

# What fails is told outside of the window, too.
SCRIPT = """import os, sys, traceback
os.chdir({folder!r})
try:
    exec({text!r})
except BaseException:
    traceback.print_exc(file=sys.__stderr__)
"""


class Window:
    """Events to be played one after the other in a window, in the folder at hand. It has a home of its own: nothing that the user has set
    counts."""

    def __init__(self, program, *arguments):
        self.command = [program, "--dr", *arguments]
        self.events = []
        self.scripts = 0

    def event(self, widget, command, arguments=""):
        """Adds an event of a widget of the main window, or a dialog."""
        self.events.append(f"<pqevent object={quoteattr('pqClientMainWindow/' + widget)} command={quoteattr(command)} "
                           f"arguments={quoteattr(arguments)}/>")

    def open(self, path):
        self.event("menubar/menu_File", "activate", "actionFileOpen")
        self.event("FileOpenDialog", "filesSelected", path)

    def choose(self, menu, name):
        """Adds the choice of a source or filter in the menu Sources or Filters, which is opened: what can be chosen is found out then."""
        self.event("menubar", "activate", f"menu{menu}")
        self.event(f"menubar/menu{menu}/pqProxyGroupMenuManager0/{name}", "activate")

    def select_input(self, name, place):
        """Adds the choice of a second input in the dialog that a filter opens; place: in the tree of the pipeline."""
        self.event(f"SelectInputDialog/buttonFrame/{name}", "set_boolean", "true")
        for command, buttons in (("mousePress", "1,1"), ("mouseRelease", "1,0")):
            self.event("SelectInputDialog/pipelineView", command, f"{buttons},0,100,6,{place}")
        self.event("SelectInputDialog/buttonBox/1QPushButton0", "activate")

    def last_frame(self):
        self.event("VCRToolbar/actionVCRLastFrame", "activate")

    def apply(self):
        self.event("propertiesDock/propertiesPanel/Accept", "activate")

    def in_shell(self, text):
        """Adds a script that the window's Python shell runs, in the folder at hand."""
        path = os.path.abspath(f"script_{self.scripts}.py")
        self.scripts += 1
        with open(path, "w") as file:
            file.write(SCRIPT.format(folder=os.getcwd(), text=text))
        self.event("pythonShellDock/pythonShell/consoleWidget", "executeCommand", f"exec(open({path!r}).read())")

    def play(self, **environment):
        """Plays the events to their end, and returns what the program says; kills it after a while."""
        home = os.path.abspath("home")
        os.makedirs(home, exist_ok=True)
        os.chmod(home, 0o700)
        with open("events.xml", "w") as file:
            file.write("\n".join(["<?xml version='1.0'?>", "<pqevents>", *self.events, "</pqevents>\n"]))
        return run(*self.command, "--test-script=" + os.path.abspath("events.xml"), "--exit", HOME=home, XDG_RUNTIME_DIR=home, **environment)


def run(*command, **environment):
    """Runs a program to its end, prints what it says and returns that; kills it after a while."""
    said = subprocess.run(command, env={**os.environ, **environment}, timeout=280, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(said.stdout, flush=True)
    assert said.returncode == 0, f"exit status {said.returncode} of {command}"
    return said.stdout


def picture(name):
    """Returns a script that saves a picture."""
    return PICTURE.format(path=os.path.abspath(f"{name}.png"), pixels=PIXELS)


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
