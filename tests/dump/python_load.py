# SPDX-License-Identifier: BSD-3-Clause
"""granular.load_plugin: the proxies without any set-up of ParaView."""
import os

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
