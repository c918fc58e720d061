# SPDX-License-Identifier: BSD-3-Clause
"""granular.load_plugin: the proxies without any set-up of ParaView; without it a message that names it."""
import os

import granular

name = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")
try:
    granular.reader(name)
    raise AssertionError("a reader without the plugin")
except RuntimeError as error:
    assert "granular.load_plugin()" in str(error), error
path = granular.load_plugin()
assert os.path.isfile(path), path
from paraview.simple import *

reader = GranularDumpReader(FileNames=[name])
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == 1200
# the client's object is the class of the package
assert isinstance(reader.GetClientSideObject(), granular.vtkGranularDumpReader)
assert granular.load_plugin(ns=globals()) == path
