# SPDX-License-Identifier: BSD-3-Clause
"""vg.load_plugin: the proxies without any set-up of ParaView."""
import os
import subprocess

import vtkgranular as vg

path = vg.load_plugin()
assert os.path.isfile(path), path
from paraview.simple import *

reader = GranularDumpReader(
    FileNames=[os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")])
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == 1200
# the client's object is the class of the package
assert isinstance(reader.GetClientSideObject(), vg.vtkGranularDumpReader)
assert vg.load_plugin(ns=globals()) == path

# ParaView's own way to load it adds no names to paraview.simple
SCRIPT = f"""
from paraview.simple import *
import vtkgranular as vg
LoadPlugin({path!r}, ns=globals())
reader = vg.reader({reader.FileNames[0]!r})
assert vg.fetch(reader)["id"].size == 1200
assert vg.history(reader, ids=7, arrays="radius")["radius"].shape == (1, 1)
assert vg.load_plugin() == {path!r}
"""
with open("own_way.py", "w") as file:
    file.write(SCRIPT)
subprocess.run(["pvpython", "--dr", file.name], check=True)
