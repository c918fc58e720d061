# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks opens, counts and saves; what goes wrong is said and passes."""
import os

import granular
from paraview.simple import *
from ranks_server import connected

data = os.path.join(os.environ["GRANULAR_DATA"], "good")

with connected() as server:
    grains = OpenDataFile(os.path.join(data, "grains_2000.dump"))
    divided = OpenDataFile(os.path.join(data, "decomposition/all.vtk"))
    assert divided.GetXMLName() == "GranularDecompositionReader"
    counted = GranularDecomposition(Input=grains, Mode="Subdomains", Subdomains=divided)
    by_grid = GranularDecomposition(Input=grains, ProcessorGrid=[2, 1, 2])
    for domains in (counted, by_grid):
        domains.UpdatePipeline()
        information = domains.GetDataInformation()
        assert information.GetNumberOfCells() == 4
        assert information.GetBounds() == (-0.05, 0.05, -0.05, 0.05, 0, 0.15)
    assert counted.CellData["nlocal"].GetRange() == by_grid.CellData["nlocal"].GetRange()
    granular.save(by_grid, os.path.abspath("counted_*.vtk"))
    written = OpenDataFile(os.path.abspath("counted_2000.vtk"))
    written.UpdatePipeline()
    assert written.CellData["nlocal"].GetRange() == by_grid.CellData["nlocal"].GetRange()
    by_grid.NumberOfProcesses = 5
    by_grid.UpdatePipeline()
    assert by_grid.GetDataInformation().GetNumberOfCells() == 0
    server.wait_for(r"got 5")
    by_grid.NumberOfProcesses = 4
    by_grid.UpdatePipeline()
    assert by_grid.GetDataInformation().GetNumberOfCells() == 4
print("served")
