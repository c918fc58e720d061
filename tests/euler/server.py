# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks opens, slices and saves; what goes wrong is said and passes."""
import os

import granular
import plain_euler
from paraview.simple import *
from ranks_server import connected

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
cells = plain_euler.cells(plain_euler.grid((0, 0, 0), (1, 1, 1), (2, 2, 2)))
cells["centres"][5] = [7, 7, 7]
with open("no_grid_1.vtk", "w") as file:
    file.write(plain_euler.text(cells))

with connected() as server:
    name = os.path.join(data, "euler_4000.vtk")
    reader = OpenDataFile(name)
    assert reader.GetXMLName() == "GranularEulerReader"
    for output in ("Points", "ImageData"):
        reader.Output = output
        reader.UpdatePipeline()
        assert reader.GetDataInformation().GetNumberOfCells() == 112
        granular.save(reader, os.path.abspath("again_*.euler"))
        with open("again_4000.euler") as written, open(name) as original:
            assert written.read() == original.read(), output
        os.remove("again_4000.euler")
    cut = Slice(Input=reader, SliceType="Plane")
    granular.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
    cut.UpdatePipeline()
    assert cut.GetDataInformation().GetNumberOfCells() >= 28
    bad = OpenDataFile(os.path.abspath("no_grid_1.vtk"), Output="ImageData")
    bad.UpdatePipeline()
    assert bad.GetDataInformation().GetNumberOfCells() == 0
    server.wait_for(r"no_grid_1.vtk")
    print("no_grid_1.vtk was refused")
    bad.Output = "Points"
    bad.UpdatePipeline()
    assert bad.GetDataInformation().GetNumberOfCells() == 8
print("served")
