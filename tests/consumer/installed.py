# SPDX-License-Identifier: BSD-3-Clause
"""Takes the prefix of an install: ParaView must have loaded the plugin from there, or do so when vg.load_plugin
asks for it where PV_PLUGIN_PATH is empty, Python must import the package from there, and neither may reach back into
the build folder."""
import os
import sys

import paraview.simple
from paraview.modules.vtkRemotingCore import vtkPVPluginTracker

import vtkgranular as vg

prefix = os.path.realpath(sys.argv[1])


def below_prefix(path):
    return os.path.realpath(path).startswith(prefix + os.sep)


loaded_by_itself = hasattr(paraview.simple, "GranularDumpReader")
assert loaded_by_itself == bool(os.environ["PV_PLUGIN_PATH"]), "is another plugin installed?"
if not loaded_by_itself:
    try:
        vg.reader(__file__)
        raise AssertionError("a reader without the plugin")
    except RuntimeError as error:
        assert "vtkgranular.load_plugin()" in str(error), error
loaded = vg.load_plugin()
tracker = vtkPVPluginTracker.GetInstance()
plugins = {tracker.GetPluginName(i): i for i in range(tracker.GetNumberOfPlugins())}
assert "Granular" in plugins, "ParaView does not know the plugin"
assert tracker.GetPluginLoaded(plugins["Granular"]), "the plugin is not loaded"
plugin_file = tracker.GetPluginFileName(plugins["Granular"])
assert below_prefix(plugin_file), plugin_file
assert loaded == plugin_file, loaded
assert below_prefix(vg.__file__), vg.__file__

with open("/proc/self/maps", encoding="ascii", errors="replace") as maps:
    libraries = {line.split(None, 5)[5].strip() for line in maps if "ranular" in line}
assert any(name.endswith("libvtkGranular.so") for name in libraries), libraries
for name in libraries:
    assert below_prefix(name), "loaded from outside the prefix: " + name
print("plugin and package from", prefix)
