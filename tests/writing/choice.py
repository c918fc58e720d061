# SPDX-License-Identifier: BSD-3-Clause
"""Which writer vg.save and SaveData take, and what is refused. The arguments name the systems whose writers these
are."""
import sys

import vtkgranular as vg
from paraview.simple import *
from writing import check_refused, content, enter_empty_folder, good


def saved(proxy, name, **properties):
    vg.save(proxy, name, **properties)
    return content(name)


def saved_data(proxy, name, **properties):
    """By ParaView's own means."""
    SaveData(name, proxy, **properties)
    return content(name)


def local():
    reader = GranularLocalReader(FileNames=[good("local/contacts.dump")])
    reader.UpdatePipeline(2000)
    head = b"ITEM: TIMESTEP\n2000\nITEM: NUMBER OF ENTRIES\n35\n"
    lines = saved(reader, "fresh.bonds")
    assert lines.startswith(head) and b" x1 " in lines
    assert saved_data(reader, "saved.bonds") == lines
    assert saved(OutputPort(reader, 0), "port.bonds") == lines
    assert saved(reader, "named.txt", writer="GranularLocalWriter") == lines
    # the rows
    rows = saved(OutputPort(reader, 1), "rows.bonds")
    assert rows.startswith(head) and b" x1 " not in rows
    assert saved_data(OutputPort(reader, 1), "rows_saved.bonds") == rows
    # others keep their names
    assert b"NUMBER OF ATOMS\n70\n" in saved(reader, "ends.dump", writer="GranularDumpWriter", Columns="x y z")
    assert saved(reader, "lines.dump") == lines
    # a table, whose first frame is empty
    table = saved(reader, "all.csv", WriteTimeSteps=1)
    assert table.startswith(b"step,time,x1,y1,z1,x2,y2,z2,id1,id2,periodic,forcex,")
    assert [table.count(b"\n%d," % step) for step in (0, 1000, 2000, 3000, 4000)] == [0, 4, 35, 108, 261]
    SaveData("paraview.vtp", reader)
    assert saved_data(OutputPort(reader, 1), "paraview.csv").startswith(b'"')

    chosen = Threshold(Input=reader, Scalars=["CELLS", "id1"], LowerThreshold=0, UpperThreshold=100)
    chosen.UpdatePipeline(2000)
    check_refused(reader, "mass.bonds", Columns="id1 mass")
    check_refused(reader, "label.bonds", Label="MY BONDS")
    check_refused(reader, "gone/a.bonds")
    check_refused(Sphere(), "sphere.bonds")
    check_refused(chosen, "grid.bonds")
    check_refused(reader, "never.bonds", AttributeError, Style="Atom")
    check_refused(reader, "never.bonds", ValueError, Dialect="Wide")
    # what a filter made cells of any kind of are lines again
    assert 0 < saved(ExtractSurface(Input=chosen), "chosen.bonds").count(b"\n") < lines.count(b"\n")


def euler():
    cells = GranularEulerReader(FileNames=[good(f"euler_{step}.vtk") for step in (1000, 2000)])
    original = content(good("euler_1000.vtk"))
    assert saved(cells, "fresh.euler") == original
    assert saved_data(cells, "saved.euler") == original
    assert saved(OutputPort(cells, 0), "port.euler") == original
    assert saved(cells, "named.vtk", writer="GranularEulerWriter") == original
    assert saved(cells, "later.euler", time=2000) == content(good("euler_2000.vtk"))
    assert saved(cells, "cells.dump").startswith(b"ITEM: TIMESTEP")
    cells.Output = "ImageData"
    SaveData("paraview.vti", cells)  # ParaView's own writers keep their names

    partial = PassArrays(Input=GranularEulerReader(FileNames=[good("euler_1000.vtk")]),
                         PointDataArrays=["v_avg", "volumefraction", "radius"])
    check_refused(cells, "all.euler", WriteTimeSteps=1)
    check_refused(partial, "partial.euler")
    check_refused(cells, "of_%.euler")
    check_refused(cells, "gone/a.euler")
    check_refused(Sphere(), "sphere.euler")
    check_refused(cells, "never.euler", AttributeError, Style="Atom")
    check_refused(cells, "never.euler", ValueError, Dialect="LAMMPS")


def decomposition():
    all_particles = GranularDumpReader(FileNames=[good("grains.dump")], TimestepSize=2e-5)
    domains = GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 1, 2])
    divided = GranularDecompositionReader(FileNames=[good("decomposition/all.vtk")])
    fresh = GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 1, 2])  # nobody has looked at it yet
    voxels, particles = b"DATASET UNSTRUCTURED_GRID", b"ITEM: TIMESTEP"
    assert voxels in saved(fresh, "fresh.vtk")
    assert saved(OutputPort(domains, 0), "port.vtk", time=1000 * 2e-5) == saved(domains, "other.vtk", time=1000 * 2e-5)
    assert voxels in saved(divided, "no_counts.decomposition")
    all_particles.UpdatePipeline(1000 * 2e-5)
    assert saved(divided, "divided.vtk", Dialect="PUBLIC") == content(good("decomposition/all.vtk"))[:248]
    assert saved(domains, "domains.dump").startswith(particles)
    assert saved(domains, "domains", writer="GranularDumpWriter").startswith(particles)
    check_refused(domains, "domains", ValueError)
    assert b"DATASET POLYDATA" in saved(all_particles, "grains.vtk")  # by ParaView
    assert saved(domains, "domains.vtk", writer="GranularDumpWriter").startswith(particles)
    assert voxels in saved_data(domains, "run.decomposition")
    assert b"appended" in saved_data(domains, "paraview.vtu")  # ParaView's own writers keep their names

    check_refused(domains, "never.vtk", AttributeError, writer="GranularSomethingWriter")
    check_refused(domains, "never.vtk", AttributeError, Style="Atom")
    check_refused(domains, "never.vtk", ValueError, Dialect="LAMMPS")
    check_refused(domains, "all.vtk", WriteTimeSteps=1)
    check_refused(domains, "never.vtu", Dialect="PUBLIC")


enter_empty_folder()
for system in sys.argv[1:]:
    {check.__name__: check for check in (local, euler, decomposition)}[system]()
print("chosen")
