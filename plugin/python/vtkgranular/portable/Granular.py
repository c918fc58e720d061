# SPDX-License-Identifier: BSD-3-Clause
"""The plugin for any ParaView from 5.11 on: load this file (Tools, Manage Plugins, Load New). The package vtkgranular is beside it, or is the
one that it lies in.

It needs nothing that is compiled for one version of ParaView: the readers and writers are Python over the C library.
"""
import os
import sys

_folder = os.path.dirname(os.path.abspath(__file__))
for _there in (_folder, os.path.dirname(os.path.dirname(_folder))):
    if os.path.isfile(os.path.join(_there, "vtkgranular", "__init__.py")):
        if _there not in sys.path:
            sys.path.insert(0, _there)
        break

import vtkgranular  # noqa: E402
from vtkgranular.portable import definitions  # noqa: E402, F401 (ParaView looks here for what has definitions)

paraview_plugin_name = "Granular"
paraview_plugin_version = vtkgranular.__version__
