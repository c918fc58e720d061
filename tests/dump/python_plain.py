# SPDX-License-Identifier: BSD-3-Clause
"""The package in a plain Python, without ParaView."""
import os
import sys

import granular

assert not any(name.split(".")[0] == "paraview" for name in sys.modules)
reader = granular.vtkGranularDumpReader()
path = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")
assert granular.vtkGranularDumpReader.CanReadFile(path)
reader.AddFileName(path)
reader.SetCoordinates(reader.SCALED)
reader.Update()
particles, box = reader.GetOutput(), reader.GetOutputDataObject(1)
assert particles.GetNumberOfPoints() == 1200
assert particles.GetPointData().GetArray("id").GetClassName() == "vtkTypeInt64Array"
assert box.GetNumberOfCells() == 1 and box.GetBounds() == (0, 1, 0, 1, 0, 1)
assert reader.GetErrorCode() == 0

selection = reader.GetPointDataArraySelection()
selection.DisableAllArrays()
selection.EnableArray("radius")
reader.SetRegionOfInterest(-1, 1, -1, 1, 0, 0.01)
reader.Update()
assert particles.GetPointData().GetNumberOfArrays() == 1
assert 0 < particles.GetNumberOfPoints() < 1200
