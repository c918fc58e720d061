# SPDX-License-Identifier: BSD-3-Clause
"""A broken file: the error names file, line and column; ParaView stays alive and goes on."""
import os

from paraview.simple import *

with open("broken.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n"
               "0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n1 0 zero 0\n")
reader = OpenDataFile(os.path.abspath("broken.dump"))
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == 0
reader.FileNames = [os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")]
reader.UpdatePipeline()
assert reader.GetDataInformation().GetNumberOfPoints() == 1200
print("alive")
