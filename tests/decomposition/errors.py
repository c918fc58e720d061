# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be is an error on all ranks, the output is empty, none waits, and ParaView lives on."""
import os

import granular
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
source = GranularDecompositionSource(ProcessorGrid=[2, 2, 2], NumberOfProcesses=9)
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfCells() == 0
source.NumberOfProcesses = 8
source.UpdatePipeline()
assert source.GetDataInformation().GetNumberOfCells() == 8

grains = GranularDumpReader(FileNames=[os.path.join(data, "grains_2000.dump")])
counted = GranularDecomposition(Input=grains, Mode="ProcessArray")
counted.UpdatePipeline()
assert counted.GetDataInformation().GetNumberOfCells() == 0
counted.Mode = "Subdomains"
counted.UpdatePipeline()
assert counted.GetDataInformation().GetNumberOfCells() == 0
granular.set_properties(counted, Mode="ProcessorGrid", ProcessorGrid=[2, 1, 1], XCuts=[7])
counted.UpdatePipeline()
assert counted.GetDataInformation().GetNumberOfCells() == 0
counted.XCuts = []
counted.UpdatePipeline()
assert counted.GetDataInformation().GetNumberOfCells() == 2

tilted = GranularDecomposition(Input=GranularDumpReader(FileNames=[os.path.join(data, "tri_plain.dump")]))
tilted.UpdatePipeline()
assert tilted.GetDataInformation().GetNumberOfCells() == 0
print("alive")
