# SPDX-License-Identifier: BSD-3-Clause
"""Files of discrete-element simulations as numpy arrays, and in VTK and ParaView.

Arrays, with numpy alone:

    run = vtkgranular.open("post/*.dump", dt=2e-5)   the frames of a run
    print(vtkgranular.open("post/"))             what is in the folder of a run
    run[-1]["v"]                              an array of the last frame
    run.read(columns=["id", "v"], stride=10)  a part of a frame
    vtkgranular.write("new.dump", {"points": x}) a file from arrays or frames
    vtkgranular.read_log("log.liggghts")         the thermo output of a run: its columns as arrays
    vtkgranular.read_table("ave_time.dat")       a table of a fix: its columns as arrays
    vtkgranular.kind_of("post/run.dump")         what a file is, by its contents
    vtkgranular.Run, Frame, Box, Folder, Writer, Log, Table, Error, Remark   what these return, take, raise and warn of

Open, show, fetch and save with paraview.simple:

    vtkgranular.reader("post/*.dump", dt=2e-5)   the reader that fits the files
    vtkgranular.show(reader, color="v", box=True)   particles as spheres, and the simulation box
    vtkgranular.chart("ave_time.dat", "c_ke")    a table or log against time
    vtkgranular.show_run("post/")                particles, box, walls and contacts of a folder, on one clock
    vtkgranular.fetch(reader, time=0.02)         points and arrays as a dict of numpy arrays
    vtkgranular.history(reader, [1, 7], "v")     places and arrays of particles at all times
    vtkgranular.save(filter, "run.dump")         a file of the format that fits the data and the name
    vtkgranular.film(view, "run.avi")            a film, or pictures, of all frames
    vtkgranular.update(filter, time=0.02)        an update that raises its errors
    vtkgranular.load_plugin()                    loads the plugin into paraview.simple
    vtkgranular.files("post/*.%.dump.gz")        the names of the files of a run
    vtkgranular.load_state("run.pvsm")           a state file, also after its folder was moved
    vtkgranular.write_series(files, dt)          a .series file: times for STL and VTK files
    vtkgranular.pvbatch("script.py", ranks=4)    a script on several ranks
    vtkgranular.set_pool_limit(mib)              memory that readers keep for the next frame

The same in all versions of ParaView:

    vtkgranular.preset, label_format, process_ids, set_properties

help(vtkgranular.open) describes one function. The VTK classes, such as vtkgranular.vtkGranularDumpReader, work in pvpython and in
plain python3; help(vtkgranular.vtkGranularDumpReader) describes one with all that it inherits. Importing this package imports
neither numpy nor VTK nor ParaView: what needs them imports them when it is called.
"""
from __future__ import annotations

import contextlib
import importlib
import sys
from typing import TYPE_CHECKING, Any

from ._files import files
from ._folder import Folder, Series
from ._folders import VERSION as __version__
from ._library import ArgumentError, Cancelled, ColumnError, Error, Remark
from ._log import Log, LogTable, read_log
from ._table import Table, read_table
from ._run import Box, Frame, Run, kind_of, open  # noqa: A004 (vtkgranular.open, as there are gzip.open and wave.open)
from ._write import Writer, write

if TYPE_CHECKING:
    from ._chart import chart
    from ._errors import update
    from ._fetch import fetch
    from ._film import film
    from ._history import history
    from ._plugin import load_plugin
    from ._pool import pool_limit, set_pool_limit
    from ._ranks import pvbatch
    from ._reader import reader
    from ._save import save
    from ._series import write_series
    from ._show import show
    from ._show_run import show_run
    from ._state import load_state
    from ._versions import label_format, preset, process_ids, set_properties
    from .vtkGranular import *  # noqa: F403 (the compiled classes, which have stubs)

# Functions of scripts of ParaView, and their modules, which are imported when the first of theirs is asked for.
_LATER = {"chart": "_chart", "fetch": "_fetch", "film": "_film", "history": "_history", "label_format": "_versions", "load_plugin": "_plugin", "load_state": "_state",
          "pool_limit": "_pool", "preset": "_versions", "process_ids": "_versions", "pvbatch": "_ranks", "reader": "_reader",
          "save": "_save", "set_pool_limit": "_pool", "set_properties": "_versions", "show": "_show",
          "show_run": "_show_run", "update": "_errors",
          "write_series": "_series"}

# Not the classes: help() would print all that they inherit, and nobody would find the functions.
__all__ = ["__version__", "chart", "fetch", "files", "film", "history", "kind_of", "label_format", "load_plugin", "load_state", "open", "pool_limit", "preset",
           "process_ids", "pvbatch", "read_log", "read_table", "reader", "save", "set_pool_limit", "set_properties", "show", "show_run", "update", "write",
           "write_series"]


def __getattr__(name: str) -> Any:
    """Returns a function, or a compiled class, which imports VTK."""
    if name in _LATER:
        value = getattr(importlib.import_module("." + _LATER[name], __name__), name)
    elif name.startswith("vtkGranular"):
        try:
            classes = importlib.import_module(".vtkGranular", __name__)
        except ImportError as error:
            raise ImportError(f"vtkgranular.{name} needs VTK and the compiled classes of this package (Debian: "
                              f"python3-vtkgranular-paraview): {error}") from error
        value = classes if name == "vtkGranular" else getattr(classes, name)
    else:
        raise AttributeError(f"module 'vtkgranular' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_LATER})


# VTK takes an object whose class Python does not know for one of a base class, and does so ever after. Where VTK is at work, it
# learns the classes now.
if "vtkmodules.vtkCommonCore" in sys.modules:
    with contextlib.suppress(ImportError):
        importlib.import_module(".vtkGranular", __name__)
