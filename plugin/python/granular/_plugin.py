# SPDX-License-Identifier: BSD-3-Clause
"""Finding and loading the ParaView plugin that belongs to this package."""
import os

from ._folders import LIBRARY_FOLDER


def load_plugin(ns=None, remote=False):
    """Loads the ParaView plugin that was built or installed with this package, and returns its path.

    Afterwards `from paraview.simple import *` knows GranularDumpReader and the other names; if that
    line came first, pass ns=globals(). remote=True loads it on the server of a connection: both
    machines then need it under the same path. Not needed where PV_PLUGIN_PATH names its folder, or where Debian's
    package of the plugin is installed.

    Raises FileNotFoundError if it is not where this package looks for it, RuntimeError if ParaView
    refuses to load it.
    """
    from paraview import servermanager, simple

    version = servermanager.vtkSMProxyManager
    paraview = f"paraview-{version.GetVersionMajor()}.{version.GetVersionMinor()}"
    path = os.path.join(LIBRARY_FOLDER, paraview, "plugins", "Granular", "Granular.so")
    if not os.path.isfile(path):
        raise FileNotFoundError(f"no plugin for this ParaView: {path} does not exist")
    simple.LoadPlugin(path, remote=remote)  # names into paraview.simple
    if ns is not None:
        simple.LoadPlugin(path, remote=remote, ns=ns)
    if not hasattr(simple, "GranularDumpReader"):
        raise RuntimeError(f"ParaView did not load {path}; its messages say why")
    return path
