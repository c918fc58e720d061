# SPDX-License-Identifier: BSD-3-Clause
"""Discrete-element data in VTK and ParaView, and as numpy arrays.

Open, show, fetch and save with paraview.simple:

    granular.reader("post/*.dump", dt=2e-5)   the reader that fits the files
    granular.show(reader, color="v", box=True)   particles as spheres, and the simulation box
    granular.fetch(reader, time=0.02)         points and arrays as a dict of numpy arrays
    granular.save(filter, "run.dump")         a file of the format that fits the data and the name
    granular.update(filter, time=0.02)        an update that raises its errors

Around them:

    granular.load_plugin()                    loads the plugin into paraview.simple
    granular.files("post/*.%.dump.gz")        the names of the files of a run
    granular.load_state("run.pvsm")           a state file, also after its folder was moved
    granular.write_series(files, dt)          a .series file: times for STL and VTK files
    granular.pvbatch("script.py", ranks=4)    a script on several ranks
    granular.set_pool_limit(mib)              memory that readers keep for the next frame

The same in all versions of ParaView:

    granular.preset("Plasma")                 the name of a colour preset
    granular.label_format("%.1f")             properties for the numbers of a colour bar
    granular.process_ids(filter)              a filter that gives each point its rank
    granular.set_properties(proxy, ...)       several properties at once

help(granular.fetch) describes one function. The VTK classes, such as granular.vtkGranularDumpReader, work in pvpython and in
plain python3; help(granular.vtkGranularDumpReader) describes one with all that it inherits. Importing this package does not
import paraview; functions that need ParaView import it when they are called.
"""
from ._errors import update
from ._fetch import fetch
from ._files import files
from ._folders import VERSION as __version__
from ._plugin import load_plugin
from ._pool import pool_limit, set_pool_limit
from ._ranks import pvbatch
from ._reader import reader
from ._save import save
from ._series import write_series
from ._show import show
from ._state import load_state
from ._versions import label_format, preset, process_ids, set_properties
from .vtkGranular import *  # noqa: F401,F403 (the compiled classes)

# Not the compiled classes: help() would print all that they inherit from VTK, and nobody would find the functions.
__all__ = ["__version__", "fetch", "files", "label_format", "load_plugin", "load_state", "pool_limit", "preset", "process_ids", "pvbatch",
           "reader", "save", "set_pool_limit", "set_properties", "show", "update", "write_series"]
