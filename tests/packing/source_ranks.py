# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks make the same grains, each its own part of them."""
import hashlib

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

import vtkgranular as vg
from all_ranks import symmetric, whole


def alone(**properties):
    """The same by the class, in this process without the others."""
    source = vg.vtkGranularPackingSource()
    source.SetController(None)
    for name, value in properties.items():
        getattr(source, f"Set{name}")(*value if isinstance(value, tuple) else (value,))
    source.Update()
    return source.GetOutput(), source.GetOutputDataObject(2)


def digest(data, values, names):
    arrays = [data.GetPoints().GetData()] + [values.GetArray(name) for name in names]
    return [hashlib.sha256(vtk_to_numpy(array).tobytes()).hexdigest() for array in arrays]


def particles_of(data):
    return digest(data, data.GetPointData(), ("id", "type", "radius", "v"))


def bonds_of(data):
    return digest(data, data.GetCellData(), ("id1", "id2", "btype", "equilibrium_length", "length"))


for properties in ({"NumberOfGrains": 1000, "Speed": 1.0, "BoxLengths": (0.1, 0.1, 0.1)},
                   {"NumberOfGrains": 20000, "Boundary": "p p p", "Radii": 0},
                   {"NumberOfGrains": 5000, "Arrangement": 2, "Seed": 7},
                   {"NumberOfGrains": 30000, "Boundary": "p p p", "BondFactor": 1.5},
                   {"NumberOfGrains": 8000, "Arrangement": 1, "BondFactor": 1.1},
                   {"NumberOfGrains": 10, "Arrangement": 4, "BondFactor": 1.0},
                   {"NumberOfGrains": 2}):
    source = GranularPackingSource(**properties)
    data = whole(source)
    number = properties["NumberOfGrains"]
    assert data.GetNumberOfPoints() == data.GetNumberOfVerts() == number
    assert (vtk_to_numpy(data.GetPointData().GetArray("id")) == numpy.arange(1, number + 1)).all()
    particles, bonds = alone(**properties)
    assert particles_of(data) == particles_of(particles), properties
    if "BondFactor" in properties:
        lines = whole(OutputPort(source, 2))
        assert lines.GetNumberOfLines() == bonds.GetNumberOfLines() > 0, properties
        assert bonds_of(lines) == bonds_of(bonds), properties
    if not symmetric:
        assert OutputPort(source, 1).GetDataInformation().GetNumberOfCells() == 1
        assert source.GetDataInformation().GetNumberOfPoints() == number
    Delete(source)
print("all there")
