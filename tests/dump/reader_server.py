# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks: open, step, an error on the server, delete, open again."""
import os

from paraview.simple import *
from ranks_server import connected

with connected() as server:
    good = os.path.join(os.environ["GRANULAR_DATA"], "good")
    series = [os.path.join(good, f"grains_{step}.dump") for step in (0, 1000, 2000)]
    reader = OpenDataFile(series)
    assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
    for step, points in ((0, 0), (1000, 1200), (2000, 1200), (1000, 1200)):
        reader.UpdatePipeline(step)
        information = reader.GetDataInformation()
        assert information.GetNumberOfPoints() == points, (step, points)
    assert reader.PointData["id"].GetRange(0) == (1, 1200)
    assert OutputPort(reader, 1).GetDataInformation().GetNumberOfCells() == 1
    reader.FileNames = ["/nowhere/gone.dump"]
    reader.UpdatePipeline()
    assert reader.GetDataInformation().GetNumberOfPoints() == 0
    server.wait_for(r"gone\.dump: cannot open: No such file or directory \(on rank 0 of 2\)")
    reader.FileNames = series[1:]
    reader.UpdatePipeline(2000)
    assert reader.GetDataInformation().GetNumberOfPoints() == 1200
    Delete(reader)
print("served")
