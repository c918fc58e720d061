# SPDX-License-Identifier: BSD-3-Clause
"""The plugin for any ParaView from 5.11 on: load this file (Tools, Manage Plugins, Load New), with the folder vtkgranular beside it.

It needs nothing compiled for one version of ParaView: the readers and writers are Python over the C library.
"""
import os
import sys

_folder = os.path.dirname(os.path.abspath(__file__))
if os.path.isdir(os.path.join(_folder, "vtkgranular")) and _folder not in sys.path:
    sys.path.insert(0, _folder)

import vtkgranular  # noqa: E402
from vtkgranular.portable import definitions  # noqa: E402, F401 (ParaView looks here for what has definitions)

paraview_plugin_name = "Granular"
paraview_plugin_version = vtkgranular.__version__
