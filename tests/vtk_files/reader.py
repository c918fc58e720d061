# SPDX-License-Identifier: BSD-3-Clause
"""Particles, walls and contacts in VTK and STL files: as the dump of the same run has them, and as VTK reads them; on one clock."""
import os
import shutil

import numpy as np
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOXML import vtkXMLGenericDataObjectReader

import vtkgranular as vg

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
HOPPER = os.path.join(GOOD, "hopper")
DT = 2e-5


def hopper(name):
    return os.path.join(HOPPER, name)


def write(name, text):
    with open(name, "w", encoding="ascii") as file:
        file.write(text)
    return os.path.abspath(name)


def arrays_of(data):
    """{name: values} of points and of cells, and the positions."""
    found = [{}, {}]
    for kind, attributes in enumerate((data.GetPointData(), data.GetCellData())):
        for i in range(attributes.GetNumberOfArrays()):
            found[kind][attributes.GetArrayName(i)] = vtk_to_numpy(attributes.GetArray(i))
    return found, vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))


def fetched(reader, step, port=0):
    reader.UpdatePipeline(step * DT)
    return servermanager.Fetch(reader, idx=port)


def rows_of(step):
    with open(hopper(f"dump_{step}.liggghts"), encoding="ascii") as file:
        rows = np.array([line.split() for line in file.readlines()[9:]], float)
    return rows[np.argsort(rows[:, 0])]


def check_particles():
    box = (-0.04, 0.04, -0.04, 0.04, 0, 0.12)
    for pattern, steps, arrays in (("particles_*.vtk", (0, 2000, 4000), "id type v radius"), ("packed_*.vtp", (2000,), "id type v radius"),
                                   ("blocks_*.vtm", (0, 4000), "id type v radius"), ("ranks_*.pvtp", (4000,), "id type radius")):
        reader = vg.reader(hopper(pattern), dt=DT)
        assert reader.GetXMLName() == "GranularVTKParticleReader" and list(reader.TimestepValues) == [step * DT for step in steps], pattern
        for step in steps:
            data = fetched(reader, step)
            (points, cells), positions = arrays_of(data)
            assert set(points) == set(arrays.split()) and not cells, (pattern, step, points)
            assert data.GetFieldData().GetArray("timestep").GetValue(0) == step
            assert points["id"].dtype == np.int64 and points["type"].dtype == np.int32 and data.GetPointData().GetPedigreeIds()
            boxes = [fetched(reader, step, 1).GetBounds(), tuple(data.GetFieldData().GetArray("BoxBounds").GetTuple(0))]
            assert boxes == [box, box], (pattern, boxes)
            if step == 0:
                assert data.GetNumberOfPoints() == 0
                continue
            rows, order = rows_of(step), np.argsort(points["id"])
            assert data.GetNumberOfVerts() == data.GetNumberOfPoints() == len(rows)
            for found, expected in ((points["id"], rows[:, 0]), (points["type"], rows[:, 1]), (positions, rows[:, 2:5]),
                                    (points.get("v"), rows[:, 5:8]), (points["radius"], rows[:, 8])):
                if found is not None:  # six digits of floats and of doubles
                    assert np.allclose(found[order], expected, rtol=1e-5, atol=1e-30), (pattern, step)


def check_meshes():
    """All that VTK reads, and the times of each series."""
    for pattern, steps, own in (("walls_*.vtk", (0, 1500, 3000), vtkGenericDataObjectReader), ("plate_*.stl", range(0, 4500, 500), vtkSTLReader),
                                ("contacts_*.vtk", (0, 2000, 4000), vtkGenericDataObjectReader)):
        reader = vg.reader(hopper(pattern), dt=DT)
        assert reader.GetXMLName() == "GranularMeshReader" and np.allclose(reader.TimestepValues, [step * DT for step in steps]), pattern
        for step in steps:
            found = fetched(reader, step)
            vtk = own()
            vtk.SetFileName(hopper(pattern.replace("*", str(step))))
            vtk.Update()
            (points, cells), positions = arrays_of(found)
            expected, own_positions = arrays_of(vtk.GetOutput())
            assert np.allclose(positions, own_positions, rtol=1e-6), (pattern, step)
            for i in range(found.GetNumberOfCells()):
                ids = [[data.GetCell(i).GetPointId(k) for k in range(data.GetCell(i).GetNumberOfPoints())] for data in (found, vtk.GetOutput())]
                assert ids[0] == ids[1], (pattern, step, i)
            if found.GetNumberOfPoints() == 0:  # the arrays of the next file
                assert set(cells) == {"force", "id1", "id2"} and not len(cells["id1"]), cells
                continue
            assert set(points) == set(expected[0]) and set(cells) == set(expected[1]), (pattern, step)
            assert all(np.array_equal(cells[name], expected[1][name]) for name in cells), (pattern, step)
    blocks = vg.reader(hopper("blocks_*.vtm"))
    walls = GranularMeshReader(FileNames=blocks.FileNames)
    walls.UpdatePipeline(4000)
    meshes = walls.GetClientSideObject().GetOutputDataObject(0)  # Fetch of ParaView 6.1 gives blocks other names
    names = [meshes.GetMetaData(i).Get(meshes.NAME()) for i in range(meshes.GetNumberOfBlocks())]
    assert names == ["funnel", "plate"] and meshes.GetBlock(0).GetCellData().HasArray("wear"), names


def check_clock():
    """Where one series lacks a step, its last one before is shown; the plate is under the particles that lie on it."""
    plate, walls = vg.reader(hopper("plate_*.stl"), dt=DT), vg.reader(hopper("walls_*.vtk"), dt=DT)
    for step, shown in ((1999, 1500), (2000, 1500), (4000, 3000), (-5, 0)):
        data = fetched(walls, step)
        assert data.GetFieldData().GetArray("timestep").GetValue(0) == shown, (step, shown)
    nearest = {}
    for at in (4000, 3500):
        corners = arrays_of(fetched(plate, at))[1]
        origin, x, y = corners[0], corners[1] - corners[0], corners[3] - corners[0]
        normal = np.cross(x, y) / np.linalg.norm(np.cross(x, y))
        (points, _), positions = arrays_of(fetched(vg.reader(hopper("particles_*.vtk"), dt=DT), 4000))
        along = np.linalg.lstsq(np.array([x, y]).T, (positions - origin).T, rcond=None)[0]
        over = np.all((along > 0) & (along < 1), axis=0)
        nearest[at] = np.min(np.abs((positions - origin) @ normal)[over] - points["radius"][over])
    assert -1e-4 < nearest[4000] < 1e-4 and nearest[3500] < -3e-4, nearest  # of a radius of 4e-3


def check_files():
    """Only the frame that is shown is read; files that are not whole are named; others' files are left to ParaView."""
    for step in (0, 2000, 4000):
        shutil.copy(hopper(f"particles_{step}.vtk"), ".")
    with open("particles_4000.vtk", encoding="ascii") as file:
        whole = file.read()
    write("particles_4000.vtk", whole.replace("radius 1", "radius 2"))
    reader = vg.reader([os.path.abspath(f"particles_{step}.vtk") for step in (2000, 4000)])
    vg.update(reader, 2000)
    assert reader.GetDataInformation().GetNumberOfPoints() == len(rows_of(2000))
    assert servermanager.Fetch(reader, idx=1).GetNumberOfCells() == 0  # the box is not here
    for text, error in ((whole.replace("radius 1", "radius 2"), "expected 48 numbers"), (whole[:-9], "the end of the file"),
                        (whole[:len(whole) // 2], "the end of the file")):
        write("particles_4000.vtk", text)
        ReloadFiles(reader)
        try:
            vg.update(reader, 4000)
        except RuntimeError as raised:
            assert str(raised).startswith(os.path.abspath("particles_4000.vtk:")) and error in str(raised), raised
        else:
            raise AssertionError(error)
    with open(hopper("packed_2000.vtp"), encoding="ascii") as file:
        whole = file.read()
    names = [write("p_1.vtp", whole), write("p_2.vtp", whole[:-12])]
    reader = vg.reader(names)
    assert list(reader.TimestepValues) == [1]
    write("p_2.vtp", whole)
    ReloadFiles(reader)
    reader.UpdatePipelineInformation()
    assert list(reader.TimestepValues) == [1, 2]
    write("p_2.vtp", whole.replace("<Points>", "<Point>"))
    ReloadFiles(reader)
    try:
        vg.update(reader, 2)
    except RuntimeError as raised:
        assert "p_2.vtp: expected a file that VTK can read" in str(raised), raised

    cube = write("cube_1.vtk", "# vtk DataFile Version 3.0\nvtk output\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n")
    for name, kind in ((hopper("particles_4000.vtk"), "GranularVTKParticleReader"), (hopper("packed_2000.vtp"), "GranularVTKParticleReader"),
                       (hopper("blocks_4000.vtm"), "GranularVTKParticleReader"), (hopper("walls_1500.vtk"), "GranularMeshReader"),
                       (hopper("plate_500.stl"), "GranularMeshReader"), (hopper("funnel.stl"), "stlreader"), (cube, "LegacyVTKFileReader"),
                       (hopper("blocks_4000/blocks_4000_0.vtp"), "XMLPolyDataReader"), (hopper("particles_boundingBox_0.vtk"), "LegacyVTKFileReader"),
                       (os.path.join(GOOD, "euler_1000.vtk"), "GranularEulerReader"), (os.path.join(GOOD, "grains.dump"), "GranularDumpReader")):
        opened = OpenDataFile(name)
        assert opened.GetXMLName() == kind, (name, opened.GetXMLName())
    assert vg.reader(cube).GetXMLName() == "GranularMeshReader"


def check_made():
    """A tilted box in LAMMPS' way, its boundaries, and radii of diameters; particles in unstructured grids."""
    write("t_7_boundingBox.vtk", "# vtk DataFile Version 5.1\nGenerated by LAMMPS\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
          "0 0 0 4 0 0 5 2 0 1 2 0 0 0 1 4 0 1 5 2 1 1 2 1\nCELLS 2 8\nOFFSETS vtktypeint64\n0 8\nCONNECTIVITY vtktypeint64\n"
          "0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n")
    name = write("t_7.vtk", "# vtk DataFile Version 3.0\nGenerated by LAMMPS\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n1 1 0.5 2 1 0.5\n"
                 "VERTICES 2 4\n1 0 1 1\nPOINT_DATA 2\nSCALARS id int\nLOOKUP_TABLE default\n4 9\nSCALARS diameter double\n"
                 "LOOKUP_TABLE default\n0.5 0.25\n")
    reader = vg.reader(name, Boundary="p p f")
    data = fetched(reader, 0)
    assert list(arrays_of(data)[0][0]["radius"]) == [0.25, 0.125]
    fields = data.GetFieldData()
    assert fields.GetAbstractArray("Boundary").GetValue(0) == "pp pp ff"
    assert fields.GetArray("BoxBounds").GetTuple(0) == (0, 5, 0, 2, 0, 1, 1, 0, 0), fields.GetArray("BoxBounds").GetTuple(0)
    for step in (100, 200):  # `%`, a file a rank
        for rank in (0, 1):
            shutil.copy(hopper(f"ranks_4000_{rank}.vtp"), f"r_{step}_{rank}.vtp")
    reader = vg.reader("r_*_%.vtp")
    assert list(reader.TimestepValues) == [100, 200]
    for reader, time in ((reader, 200), (vg.reader("r_100_%.vtp"), 100)):  # of several timesteps, and of one
        reader.UpdatePipeline(time)
        assert sorted(arrays_of(servermanager.Fetch(reader))[0][0]["id"]) == sorted(rows_of(4000)[:, 0])
    assert list(vg.reader("r_100_%.vtp").TimestepValues) == [100]
    grid = GranularVTKParticleReader(FileNames=[hopper("blocks_4000/blocks_4000_2.vtu")])
    grid.UpdatePipeline()
    assert servermanager.Fetch(grid).GetNumberOfVerts() == len(rows_of(4000))


def check_filters():
    """What filters make of these particles and contacts is what they make of the dumps."""
    made = []
    for particles, contacts, preset in (("dump_*.liggghts", "contacts_*.dump", {"Preset": "ContactsForce"}), ("particles_*.vtk", "contacts_*.vtk", {})):
        particles, contacts = vg.reader(hopper(particles), dt=DT), vg.reader(hopper(contacts), dt=DT, **preset)
        sums = arrays_of(fetched(GranularContactSums(Input=particles, Lines=contacts), 2000))[0][0]
        cells = fetched(GranularEulerAverage(Input=particles, MassArray="radius"), 2000)
        made.append([sums["coordination"], sums["contact_force"], vtk_to_numpy(cells.GetCellData().GetArray("volumefraction"))])
        assert cells.GetBounds()[:2] == (-0.04, 0.04), cells.GetBounds()
    assert made[0][0].sum() > 0
    for dump, vtk in zip(*made):
        assert np.allclose(dump, vtk, rtol=1e-4, atol=1e-6 * np.abs(dump).max())


check_particles()
check_meshes()
check_clock()
check_files()
check_made()
check_filters()
