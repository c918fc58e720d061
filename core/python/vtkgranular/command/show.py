# SPDX-License-Identifier: BSD-3-Clause
"""Makes a picture of a frame: particles as spheres in their box, contacts and bonds as lines."""
from __future__ import annotations

import argparse
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
from typing import Any

from .._folder import Folder
from .._whole_file import whole_file
from . import add_files, chosen, json_text, open_run

MORE = """It draws by the VTK of this Python or of ParaView. Without a display, it draws on a virtual one (Debian packages xvfb and \
xauth)."""


def options(parser: argparse.ArgumentParser) -> None:
    """Adds the options of show."""
    add_files(parser)
    parser.add_argument("-o", "--output", metavar="PICTURE", help="name of the picture, which ends in .png (default: that of the first "
                        "file with .png, in this folder)")
    parser.add_argument("--frame", default="-1", metavar="N", help="number of the frame, from 0, or from the end (default: -1, the last one)")
    parser.add_argument("--color", metavar="NAME", help="column to colour by")
    parser.add_argument("--window", action="store_true", help="starts ParaView on the frame, with the plugin and the box, instead of a picture")
    parser.add_argument("--size", default="1200x900", metavar="WxH", help="pixels (default: 1200x900)")


def _with_display(command: list[str]) -> list[str]:
    """A command that may draw."""
    if os.environ.get("DISPLAY"):
        return command
    if not shutil.which("xvfb-run"):
        raise ImportError("expected a display to draw on, or xvfb-run, got neither (Debian: xvfb xauth)")
    return ["xvfb-run", "-a", *command]


def _interpreter() -> str | None:
    """The Python that has VTK: this one, or that of ParaView."""
    if importlib.util.find_spec("vtkmodules"):
        return sys.executable
    return shutil.which("pvpython")


def _one(frames: Any, arguments: argparse.Namespace) -> Any:
    """Returns the frame that --frame names, as frames of one."""
    found = chosen(frames, arguments.frame)
    if len(found) != 1:
        raise ValueError(f"--frame: expected one number, got {arguments.frame!r}")
    return found


def _find(arguments: argparse.Namespace, folder: Folder | None) -> tuple[dict[str, Any], dict[str, Any]]:
    """Returns the frame to draw, and what is told of it."""
    particles = folder and folder.particles
    if folder and not particles:
        raise ValueError(f"{folder.path}: expected particles, got {', '.join(folder) or 'no files'}")
    if particles and particles.kind == "particles":  # in VTK files
        step = _one(particles.steps or [0], arguments)[0]  # one file without a number
        number = particles.steps.index(step) if particles.steps else 0
        files, times = particles.files_at(step), particles.times(folder.dt) or [0.0]
        return {"files": files, "boxes": folder.box_of(files[0]), "frame": None}, {"frame": number, "step": step, "time": times[number]}
    if particles:
        arguments = argparse.Namespace(**{**vars(arguments), "files": particles.files, "dt": folder.dt})
    with open_run(arguments) as opened:
        frames = _one(opened, arguments)
        if arguments.color and not frames[0]._is_array(arguments.color):
            frames[0]._raise_no_column(arguments.color)
        facts = {"frame": frames._numbers()[0], "step": frames[0].step, "time": frames[0].time}
        return {"files": opened.files, "options": opened._options, "frame": facts["frame"]}, facts


def _start_window(given: dict[str, Any]) -> None:
    """Starts ParaView on a frame, and waits for its end."""
    paraview = shutil.which("paraview")
    if not paraview:
        raise ImportError("expected the program paraview in PATH, got none (Debian: paraview)")
    if not os.environ.get("DISPLAY") and not os.environ.get("WAYLAND_DISPLAY"):
        raise ImportError("expected a display for the window, got none: without --window, granular show makes a picture")
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:  # a variable takes few names of files
        json.dump({**given, "package": os.path.dirname(package)}, file)
        file.flush()
        done = subprocess.run([paraview, "--script=" + os.path.join(package, "_window.py")], env={**os.environ, "GRANULAR_WINDOW": file.name})
    if done.returncode:
        raise RuntimeError(f"{paraview}: expected the exit status 0, got {done.returncode}")


def run(arguments: argparse.Namespace) -> None:
    """Makes the picture."""
    parts = arguments.size.lower().split("x")
    if len(parts) != 2 or not all(part.isdigit() and int(part) > 0 for part in parts):
        raise ValueError(f"--size: expected WxH, as 1200x900, got {arguments.size!r}")
    folder = Folder(arguments.files[0], arguments.dt) if len(arguments.files) == 1 and os.path.isdir(arguments.files[0]) else None
    given, facts = _find(arguments, folder)
    walls = [path for each in folder.walls for path in each.files_at(facts["step"])] if folder else []
    if arguments.window:
        _start_window({**({"folder": folder.path, "dt": arguments.dt, "time": facts["time"]} if folder else given), "color": arguments.color})
        return
    given |= {"color": arguments.color, "size": list(map(int, parts)), "walls": walls}
    name = folder.path if folder else os.path.splitext(given["files"][0])[0]
    picture = arguments.output or os.path.basename(name) + ".png"
    if not picture.endswith(".png"):
        raise ValueError(f"--output: expected a name that ends in .png, got {picture!r}")
    python = _interpreter()
    if python is None:
        raise ImportError("expected VTK or ParaView to draw with, got neither (Debian: python3-vtk9 or python3-paraview; pip: vtk)")
    picture = os.path.abspath(picture)
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "draw.py")
    with whole_file(picture) as temporary:
        # a path, because with -m Python looks for modules in the current folder, too
        done = subprocess.run(_with_display([python, program]), input=json.dumps({**given, "picture": temporary}), capture_output=True, text=True)
        if done.returncode or not os.path.getsize(temporary):
            raise RuntimeError("; ".join(filter(None, map(str.strip, (done.stdout + done.stderr).splitlines()))) or f"{picture}: it was not drawn")
    shown = {"given": arguments.files, "picture": picture, **facts, "color": arguments.color, "size": given["size"]}
    print(json_text(shown) if arguments.json else arguments.output or os.path.basename(picture))
