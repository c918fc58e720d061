# SPDX-License-Identifier: BSD-3-Clause
"""granular.load_plugin: the proxies without any set-up of ParaView."""
import os
import subprocess

import granular

path = granular.load_plugin()
assert os.path.isfile(path), path
from paraview.simple import *

reader = GranularDumpReader(
    FileNames=[os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")])
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == 1200
# the client's object is the class of the package
assert isinstance(reader.GetClientSideObject(), granular.vtkGranularDumpReader)
assert granular.load_plugin(ns=globals()) == path

# ParaView's own way to load it adds no names to paraview.simple
SCRIPT = f"""
from paraview.simple import *
import granular
LoadPlugin({path!r}, ns=globals())
reader = granular.reader({reader.FileNames[0]!r})
assert granular.fetch(reader)["id"].size == 1200
assert granular.history(reader, ids=7, arrays="radius")["radius"].shape == (1, 1)
assert granular.load_plugin() == {path!r}
"""
with open("own_way.py", "w") as file:
    file.write(SCRIPT)
subprocess.run(["pvpython", "--dr", file.name], check=True)
