# SPDX-License-Identifier: BSD-3-Clause
"""Paths against those that LAMMPS has computed itself, on any number of ranks, straight from the files and by a filter in between."""
import os

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg

folder = os.path.join(os.environ["GRANULAR_DATA"], "good", "paths")
STEPS = range(0, 601, 20)

walk = vg.reader(os.path.join(folder, "walk.dump.gz"))
between = Calculator(Input=walk, ResultArrayName="twice", Function="2*v")
for source, arrays in ((walk, "v c_shift"), (between, "v c_shift twice")):
    data = all_ranks.whole(GranularTrajectories(Input=source, Arrays=arrays))
    assert data.GetNumberOfLines() == 30 and data.GetNumberOfPoints() == 30 * len(STEPS) and data.GetNumberOfVerts() == 0
    assert sorted(vtk_to_numpy(data.GetCellData().GetArray("id"))) == list(range(1, 31))
    found = {name: vtk_to_numpy(data.GetPointData().GetArray(name)) for name in ["displacement", "timestep", *arrays.split()]}
    # LAMMPS adds up the same doubles in another order
    assert numpy.abs(found["displacement"] - found["c_shift"]).max() < 1e-12
    assert sorted(set(found["timestep"].tolist())) == list(STEPS)
    assert source is walk or (found["twice"] == 2 * found["v"]).all()
    print("displacements are those of LAMMPS")
print("all there")
