# SPDX-License-Identifier: BSD-3-Clause
"""Discrete-element data in VTK and ParaView.

    granular.vtkGranularDumpReader()   the VTK classes, in pvpython and in plain python3
    granular.files("dump_*.%.gz")      the files of a run, for FileNames of a reader
    granular.load_plugin()             the proxies for paraview.simple: GranularDumpReader, ...
    granular.show(reader)              particles as spheres of their radius
    granular.save(filter, "run.dump")  what a filter shows as a particle dump, contacts, decomposition, Euler cells
    granular.set_pool_limit(mib)       how much memory readers keep for the next frame
    granular.write_series(files, dt)   a .series file: one clock for STL, VTK and dump files
    granular.pvbatch(file, ranks=4)    runs a script on several processes of ParaView
    granular.preset("Plasma")          what this version of ParaView calls a colour preset;
                                       label_format, process_ids and set_properties do the same for theirs

Importing this package does not import paraview; what needs ParaView imports it when it is called.
"""
from ._files import files
from ._plugin import load_plugin
from ._pool import pool_limit, set_pool_limit
from ._ranks import pvbatch
from ._save import save
from ._series import write_series
from ._show import show
from ._versions import label_format, preset, process_ids, set_properties
from .vtkGranular import *  # noqa: F401,F403 (the compiled classes)
