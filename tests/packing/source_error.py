# SPDX-License-Identifier: BSD-3-Clause
"""More grains than there is room for is an error on all ranks, none waits, and ParaView lives on."""
from paraview.simple import *

source = GranularPackingSource(NumberOfGrains=10000, BoxLengths=[0.1, 0.1, 0.1])
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfPoints() == 0
source.NumberOfGrains = 100
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfPoints() == 100
print("alive")
