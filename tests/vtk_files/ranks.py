# SPDX-License-Identifier: BSD-3-Clause
"""Each rank keeps its share of the particles; all of them together have the whole, and a wall once."""
import os

from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import all_ranks
import vtkgranular as vg

HOPPER = os.path.join(os.environ["GRANULAR_DATA"], "good", "hopper")

particles = vg.reader(os.path.join(HOPPER, "particles_*.vtk"))
walls = vg.reader(os.path.join(HOPPER, "walls_*.vtk"))
for step in (4000, 0, 2000):
    alone = vg.vtkGranularVTKParticleReader()
    alone.SetController(None)
    for name in particles.FileNames:
        alone.AddFileName(name)
    alone.UpdateTimeStep(step)
    together = all_ranks.whole(particles, step)
    assert together.GetNumberOfPoints() == alone.GetOutput().GetNumberOfPoints()
    for name in ("id", "radius", "v") if step else ():
        expected, found = (vtk_to_numpy(data.GetPointData().GetArray(name)) for data in (alone.GetOutput(), together))
        assert len(found) > 20 and (found == expected).all(), (step, name)
    assert all_ranks.whole(walls, step).GetNumberOfCells() == 14
