# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks average the same to the bit, each has a part of the cells, and filters see no seams."""
import os

import all_ranks
import numpy
import vtkgranular as vg
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import (vtkCellDataToPointData, vtkContourFilter, vtkMassProperties,
                                       vtkTriangleFilter)

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
dump = os.path.join(data, "grains.dump")
rank, size = all_ranks.ranks.GetLocalProcessId(), all_ranks.ranks.GetNumberOfProcesses()
KINDS = {"Points": "vtkPolyData", "ImageData": "vtkImageData"}
KEYS = {"Output": "OutputType", "CellsBy": "CellsBy", "Weights": "Weights"}
VALUES = {"Points": 0, "ImageData": 1, "CellCounts": 0, "CellSize": 1, "CellSizeRelative": 2, "Centre": 0, "Overlap": 1}


def arrays(output):
    attributes = output.GetPointData() if output.IsA("vtkPolyData") else output.GetCellData()
    found = {name: vtk_to_numpy(attributes.GetArray(name)) for name in ("v_avg", "volumefraction", "radius", "pressure")}
    if output.IsA("vtkPolyData"):
        found["centres"] = vtk_to_numpy(output.GetPoints().GetData())
    return found


def alone(time, **properties):
    """The same by the classes, in this process without the others."""
    reader, average = vg.vtkGranularDumpReader(), vg.vtkGranularEulerAverage()
    reader.SetController(None)
    average.SetController(None)
    reader.AddFileName(dump)
    average.SetInputConnection(reader.GetOutputPort())
    for name, value in properties.items():
        value = VALUES[value] if isinstance(value, str) else value
        getattr(average, f"Set{KEYS.get(name, name)}")(*value if isinstance(value, list) else (value,))
    average.UpdateInformation()
    average.UpdateTimeStep(time)
    return average.GetOutputDataObject(0)


def check(proxy, time, **properties):
    """Against one process, which has all."""
    kind = properties.get("Output", "ImageData")
    together = all_ranks.whole(proxy, time, KINDS[kind])
    expected = alone(time, **properties)
    assert together.GetNumberOfCells() == expected.GetNumberOfCells(), properties
    if kind == "ImageData":
        assert together.GetExtent() == expected.GetExtent()
        assert numpy.allclose(together.GetBounds(), expected.GetBounds(), rtol=0, atol=1e-15)
    found = arrays(together)
    for name, values in arrays(expected).items():
        assert found[name].tobytes() == values.tobytes(), (properties, name, abs(found[name] - values).max())
    return expected


# ---- the same bits, in parts ------------------------------------------------------------------------------------

particles = GranularDumpReader(FileNames=[dump])
for properties in ({"CellCounts": [7, 5, 9]}, {"CellCounts": [7, 5, 9], "Output": "Points"},
                   {"CellCounts": [1, 1, 1]}, {"CellCounts": [1, 2, 1], "Output": "Points"},
                   {"CellCounts": [4, 4, 7], "Weights": "Centre"},
                   {"CellsBy": "CellSizeRelative", "Output": "Points", "Weights": "Centre"},
                   {"CellsBy": "CellSize", "CellSize": [0.013, 0.02, 0.013], "Bounds": [-0.05, 0.05, -0.05, 0.05, 0, 0.15]},
                   {"CellCounts": [6, 6, 6], "TimeAverage": 1}, {"CellCounts": [6, 6, 6], "TimeAverage": 1, "Output": "Points"}):
    proxy = GranularEulerAverage(Input=particles, **properties)
    for time in (0, 2000) if "Centre" not in properties.values() else (2000,):
        check(proxy, time, **properties)
    if properties.get("Output") == "Points" and size > 1 and all_ranks.symmetric:
        own = proxy.GetClientSideObject().GetOutputDataObject(0).GetNumberOfPoints()
        whole = alone(2000, **properties).GetNumberOfPoints()
        assert abs(own - whole / size) <= 1, (own, whole)
    Delete(proxy)

if size > 1:  # particles on other ranks, in another order; on one, D3 loses the field data
    proxy = GranularEulerAverage(Input=D3(Input=particles), CellCounts=[7, 5, 9])
    check(proxy, 2000, CellCounts=[7, 5, 9])

# ---- filters behind it --------------------------------------------------------------------------------------------

averaged = GranularEulerAverage(Input=particles, CellCounts=[8, 8, 12])
smooth = CellDatatoPointData(Input=averaged)
level = Contour(Input=smooth, ContourBy=["POINTS", "volumefraction"], Isosurfaces=[0.1])
cut = Slice(Input=averaged, SliceType="Plane")
vg.set_properties(cut.SliceType, Origin=[0.001, 0, 0], Normal=[1, 0, 0])
sums = {proxy: IntegrateVariables(Input=proxy) for proxy in (averaged, level, cut)}
for integral in sums.values():
    integral.UpdatePipeline(2000)
if rank == 0 and not all_ranks.symmetric:
    information = averaged.GetDataInformation()
    assert information.GetNumberOfCells() == 768, information.GetNumberOfCells()
    assert information.GetExtent() == (0, 8, 0, 8, 0, 12), information.GetExtent()
    cells = {proxy: servermanager.Fetch(integral).GetCellData() for proxy, integral in sums.items()}
    one = alone(2000, CellCounts=[8, 8, 12])
    solid = arrays(one)["volumefraction"].sum() * 0.0015 / 768
    assert abs(cells[averaged].GetArray("volumefraction").GetValue(0) - solid) < 1e-12 * solid
    assert abs(cells[cut].GetArray("Area").GetValue(0) - 0.1 * 0.15) < 1e-9
    filters = vtkCellDataToPointData(), vtkContourFilter(), vtkTriangleFilter(), vtkMassProperties()
    filters[0].SetInputData(one)
    for before, after in zip(filters, filters[1:]):
        after.SetInputConnection(before.GetOutputPort())
    filters[1].SetInputArrayToProcess(0, 0, 0, 0, "volumefraction")
    filters[1].SetValue(0, 0.1)
    filters[3].Update()
    area = filters[3].GetSurfaceArea()
    together = cells[level].GetArray("Area").GetValue(0)
    assert area > 0.005 and abs(together - area) < 1e-9 * area, (together, area)  # with ghost cells there is no seam

# ---- files ----------------------------------------------------------------------------------------------------------

for output in KINDS:
    averaged.Output = output
    averaged.UpdatePipeline(2000)
    vg.save(averaged, f"{output}.euler")
    if rank == 0:
        lone = vg.vtkGranularEulerWriter()
        lone.SetController(None)
        lone.SetInputData(alone(2000, CellCounts=[8, 8, 12], Output=output))
        lone.SetFileName(f"alone_{output}.euler")
        assert lone.Write()
        with open(f"{output}.euler") as file, open(f"alone_{output}.euler") as expected:
            assert file.read() == expected.read(), output

# ---- a rank alone, and a rank that wants to stop -------------------------------------------------------------------

if all_ranks.symmetric:
    Delete(cut)
    algorithm = vg.vtkGranularEulerAverage()
    reader = vg.vtkGranularDumpReader()
    reader.AddFileName(dump)
    algorithm.SetInputConnection(reader.GetOutputPort())
    algorithm.SetCellCounts(7, 5, 9)
    algorithm.UpdatePiece(rank, size, 0)
    expected = alone(0, CellCounts=[7, 5, 9])
    if rank == size - 1:
        mark = algorithm.AddObserver("ProgressEvent", lambda *_: algorithm.SetAbortExecute(1))
    algorithm.SetTimeAverage(True)
    algorithm.UpdatePiece(rank, size, 0)
    assert algorithm.GetOutputDataObject(0).GetNumberOfCells() == 0
    if rank == size - 1:
        algorithm.RemoveObserver(mark)
    algorithm.UpdatePiece(rank, size, 0)
    assert algorithm.GetOutputDataObject(0).GetNumberOfCells() > 0
    # each for itself, of all particles, though all take part
    algorithm.SetTimeAverage(False)
    algorithm.UpdateInformation()
    algorithm.UpdateTimeStep(2000, 0, 1)
    for name, values in arrays(alone(2000, CellCounts=[7, 5, 9])).items():
        assert arrays(algorithm.GetOutputDataObject(0))[name].tobytes() == values.tobytes(), name
print("all there")
