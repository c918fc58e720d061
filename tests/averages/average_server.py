# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks averages, slices and saves; what goes wrong is said and passes."""
import os

import plain_euler
import vtkgranular as vg
from paraview.simple import *
from ranks_server import connected

data = os.path.join(os.environ["GRANULAR_DATA"], "good")

with connected() as server:
    particles = OpenDataFile(os.path.join(data, "grains.dump"))
    average = GranularEulerAverage(Input=particles, CellCounts=[4, 4, 7], Weights="Centre")
    theirs = plain_euler.read(os.path.join(data, "euler_2000.vtk"))
    for output in ("Points", "ImageData"):
        average.Output = output
        average.UpdatePipeline(2000)
        assert average.GetDataInformation().GetNumberOfCells() == 112
        arrays = average.PointData if output == "Points" else average.CellData
        assert abs(arrays["volumefraction"].GetRange()[1] - theirs["volumefraction"].max()) < 5.001e-7
        vg.save(average, os.path.abspath("averaged_*.euler"))
        written = plain_euler.read("averaged_2000.euler")
        for name in ("centres", "volumefraction", "radius"):  # the last of six decimals
            assert abs(written[name] - theirs[name]).max() < 1.001e-6, (output, name)
        os.remove("averaged_2000.euler")
    cut = Slice(Input=average, SliceType="Plane")
    vg.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
    cut.UpdatePipeline(2000)
    assert cut.GetDataInformation().GetNumberOfCells() >= 28
    average.RadiusArray = "no_radius"
    average.Weights = "Overlap"
    average.UpdatePipeline(2000)
    assert average.GetDataInformation().GetNumberOfCells() == 0
    server.wait_for(r"expected an array 'no_radius' of radii")
    average.RadiusArray = "radius"
    average.TimeAverage = 1
    average.UpdatePipeline()
    assert average.GetDataInformation().GetNumberOfCells() == 112
    assert 0.1 < average.CellData["volumefraction"].GetRange()[1] < 0.3
print("served")
