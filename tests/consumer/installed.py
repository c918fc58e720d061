# SPDX-License-Identifier: BSD-3-Clause
"""Takes the prefix of an install: ParaView must have loaded the plugin from there, Python must
import the package from there, and neither may reach back into the build folder."""
import os
import sys

import paraview.simple
from paraview.modules.vtkRemotingCore import vtkPVPluginTracker

import granular

prefix = os.path.realpath(sys.argv[1])


def below_prefix(path):
    return os.path.realpath(path).startswith(prefix + os.sep)


tracker = vtkPVPluginTracker.GetInstance()
plugins = {tracker.GetPluginName(i): i for i in range(tracker.GetNumberOfPlugins())}
assert "Granular" in plugins, "ParaView does not know the plugin"
assert tracker.GetPluginLoaded(plugins["Granular"]), "the plugin is not loaded"
plugin_file = tracker.GetPluginFileName(plugins["Granular"])
assert below_prefix(plugin_file), plugin_file
assert below_prefix(granular.__file__), granular.__file__

with open("/proc/self/maps", encoding="ascii", errors="replace") as maps:
    libraries = {line.split(None, 5)[5].strip() for line in maps if "ranular" in line}
assert any(name.endswith("libvtkGranular.so") for name in libraries), libraries
for name in libraries:
    assert below_prefix(name), "loaded from outside the prefix: " + name
print("plugin and package from", prefix)
