# SPDX-License-Identifier: BSD-3-Clause
"""Finding and loading the ParaView plugin that belongs to this package."""
from __future__ import annotations

import glob
import os
from typing import Any

from ._folders import LIBRARY_FOLDER


def expect_plugin(there: bool) -> None:
    """Raises RuntimeError unless the plugin is there."""
    if not there:
        raise RuntimeError("expected the plugin Granular, got a ParaView without it: load it first, as with "
                           "vtkgranular.load_plugin()")


def has_plugin() -> bool:
    """Returns true if the server knows the readers of the plugin, however it was loaded: ParaView's own LoadPlugin(path, ns=globals())
    adds no names to paraview.simple."""
    from paraview import servermanager

    definitions = servermanager.ProxyManager().SMProxyManager.GetProxyDefinitionManager()
    return bool(definitions.HasDefinition("sources", "GranularDumpReader"))


def _loaded_plugin(servermanager: Any) -> str | None:
    """Returns the path of the plugin that this process has loaded, or None."""
    plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager().GetLocalInformation()
    for i in range(plugins.GetNumberOfPlugins()):
        if plugins.GetPluginName(i) == "Granular" and plugins.GetPluginLoaded(i):
            return plugins.GetPluginFileName(i)
    return None


def _plugin_beside_package(servermanager: Any) -> str:
    """Returns the path of the plugin that belongs to this package, for the version of ParaView that runs."""
    version = servermanager.vtkSMProxyManager
    paraview = f"{version.GetVersionMajor()}.{version.GetVersionMinor()}"
    path = os.path.join(LIBRARY_FOLDER, f"paraview-{paraview}", "plugins", "Granular", "Granular.so")
    portable = os.path.join(os.path.dirname(__file__), "portable", "Granular.py")
    if os.path.isfile(path) or os.path.isfile(portable):
        return path if os.path.isfile(path) else portable
    others = glob.glob(os.path.join(glob.escape(LIBRARY_FOLDER), "paraview-*", "plugins", "Granular", "Granular.so"))
    found = ", ".join(sorted(others)) or "none"
    raise FileNotFoundError(f"expected a plugin for this ParaView, {paraview}, in {path}, got {found}: build it again with "
                            "the development files of this ParaView")


def load_plugin(ns: dict[str, Any] | None = None, remote: bool = False) -> str:
    """Loads the ParaView plugin of this package and returns its path.

    It is the one that was compiled for this version of ParaView, else the portable one.

    ns      globals() if `from paraview.simple import *` came first: the names are added there.
    remote  True: loads it on the server of a connection, where it must have the same path.

    A loaded plugin stays, as with Debian's packages or PV_PLUGIN_PATH. Raises FileNotFoundError or RuntimeError if there is none to load.
    """
    from paraview import servermanager, simple

    path = None if remote else _loaded_plugin(servermanager)
    if path is None:
        path = _plugin_beside_package(servermanager)
        simple.LoadPlugin(path, remote=remote)  # names into paraview.simple
    if not has_plugin():
        here = not remote and servermanager.ActiveConnection.IsRemote()
        raise RuntimeError(f"expected the plugin on the server, too, got {path} here alone: load_plugin(remote=True) loads it there" if here else
                           f"ParaView did not load {path}; its messages say why")
    # Not by a second LoadPlugin, which is an error in pvbatch.
    for name in list(vars(simple)) if ns is not None else ():
        if not name.startswith("_"):
            ns.setdefault(name, getattr(simple, name))
    return path
