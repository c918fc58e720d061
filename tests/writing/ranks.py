# SPDX-License-Identifier: BSD-3-Clause
"""On any number of ranks the files are those that one process writes. The arguments name the systems whose writers these are."""
import gzip
import os
import sys

import all_ranks
import numpy
import plain_dump
import plain_euler
import plain_local
import vtkgranular as vg
from paraview.simple import *
from writing import alone, content, empty_on, good, lonely

RANK, RANKS = all_ranks.ranks.GetLocalProcessId(), all_ranks.ranks.GetNumberOfProcesses()
MODES = ("Gather", "MPI-IO")
STEPS = (1000, 2000, 3000, 4000)  # of the files of Euler cells


def saved(proxy, name, **properties):
    vg.save(proxy, os.path.abspath(name), **properties)
    return content(name)


def saved_data(proxy, name, **properties):
    """By ParaView's own means."""
    SaveData(os.path.abspath(name), proxy, **properties)
    return content(name)


# ---- particles ----------------------------------------------------------------------------------------------


def dump():
    reader = GranularDumpReader(FileNames=[good("grains.dump")])
    dump_of_programs(reader)
    dump_of_one_process(reader)
    processes = dump_of_each_process(reader)
    dump_without_rows(reader, processes)


def dump_of_programs(reader):
    """Programs' own bytes are written again."""
    whole = content(good("grains.dump"))
    image = GranularDumpReader(FileNames=[good("ortho_image.bin")])
    for mode in MODES:
        liggghts = {"WriteTimeSteps": 1, "Dialect": "LIGGGHTS", "ParallelMode": mode}
        assert saved_data(reader, "a.dump", **liggghts) == whole, mode
        assert saved(reader, "dump.grains", **liggghts) == whole, mode
        atom = {"WriteTimeSteps": 1, "Style": "Atom", "Scaled": 0, "Image": 1, "ParallelMode": mode}
        assert saved_data(image, "a.bin", **atom) == content(good("ortho_image.bin")), mode
    vg.write(f"expected_{RANK}.csv", vg.open(good("grains.dump")))  # with all digits: see tests/python/writing.py
    with open(f"expected_{RANK}.csv", "rb") as table:
        assert saved(reader, "table.csv", WriteTimeSteps=1) == table.read()
    vg.save(reader, "table_*.csv", WriteTimeSteps=1, Columns="id v")
    assert content("table_1000.csv").startswith(b"id,vx,vy,vz\n157,0.0,0.0,0.30982\n")
    for step, frame in zip((0, 1000, 2000), whole.split(b"ITEM: TIMESTEP")[1:]):
        vg.save(reader, "step_*.dump.gz", WriteTimeSteps=1, Dialect="LIGGGHTS")
        assert gzip.decompress(content(f"step_{step}.dump.gz")) == b"ITEM: TIMESTEP" + frame


def dump_of_one_process(reader):
    lonely_reader = lonely("DumpReader")
    lonely_reader.AddFileName(good("grains.dump"))
    for end in (".dump", ".dump.gz", ".dump.zst", ".bin"):
        for sort in (0, 1):
            expected = alone("DumpWriter", lonely_reader, end, SortById=sort, WriteTimeSteps=1)
            for mode in MODES:
                form = {"WriteTimeSteps": 1, "SortById": sort, "ParallelMode": mode}
                assert saved_data(reader, "a" + end, **form) == expected, (end, sort, mode)


def dump_of_each_process(reader):
    """One file a process; their number is returned, which without --sym only ParaView knows."""
    vg.save(reader, "piece_*.%.dump", WriteTimeSteps=1, Dialect="LIGGGHTS")
    content("piece_0.0.dump")
    names = [f"piece_{step}.{i}.dump" for step in (1000, 2000) for i in range(8)
             if os.path.exists(f"piece_{step}.{i}.dump")]
    pieces = [plain_dump.read(name)[0] for name in names]
    assert len(names) % 2 == 0 and (not all_ranks.symmetric or len(names) == 2 * RANKS)
    for step, frame in zip((1000, 2000), plain_dump.read(good("grains.dump"))[1:]):
        assert [word for piece in pieces if piece.timestep == step for word in piece.columns["id"]] == \
            frame.columns["id"]
    again = GranularDumpReader(FileNames=[os.path.abspath(name) for name in names])
    assert list(again.TimestepValues) == [1000, 2000], again.TimestepValues
    again.UpdatePipeline(2000)
    last = content(good("grains.dump")).split(b"ITEM: TIMESTEP")[3]
    assert saved_data(again, "union.dump", Dialect="LIGGGHTS") == b"ITEM: TIMESTEP" + last
    return len(names) // 2


def dump_without_rows(reader, count):
    """A rank without rows."""
    marked = ProgrammableFilter(Input=reader, CopyArrays=1, Script="""
import numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController
number = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
output.PointData.append(numpy.full(output.GetNumberOfPoints(), number), "process")
""")
    marked.UpdatePipeline(2000)
    saved_data(marked, "a.dump", SortById=1)
    marks, = plain_dump.read("a.dump")
    processes = marks.numbers("process")
    assert marks.rows == 1200 and len(set(processes)) == count, set(processes)
    for first in (True, False) if count > 1 else ():
        left_out = processes.min() if first else processes.max()
        rest = Threshold(Input=marked, Scalars=["POINTS", "process"])
        rest.ThresholdMethod = "Above Upper Threshold" if first else "Below Lower Threshold"
        rest.UpperThreshold, rest.LowerThreshold = float(left_out) + 0.5, float(left_out) - 0.5
        for mode in MODES:
            saved_data(rest, "b.dump", ParallelMode=mode)
            frame, = plain_dump.read("b.dump")
            assert frame.timestep == 2000 and list(frame.columns) == list(marks.columns)
            assert set(frame.numbers("process")) == set(processes) - {left_out}
            assert sorted(frame.numbers("id")) == sorted(marks.numbers("id")[processes != left_out])


# ---- contacts and bonds ---------------------------------------------------------------------------------------


def local():
    local_of_one_process()
    local_of_joins()
    contacts = GranularLocalReader(FileNames=[good("local/contacts.dump")], Preset="ContactsForce")
    whole = plain_local.read(good("local/contacts.dump"))[2]
    local_without_rows(contacts, whole)
    # one file a process
    vg.save(contacts, "piece_*.%.bonds", WriteTimeSteps=1, Dialect="LIGGGHTS")
    content("piece_2000.0.bonds")
    pieces = [plain_local.read(f"piece_2000.{i}.bonds")[0] for i in range(RANKS)]
    assert [row[6:] for piece in pieces for row in piece.rows] == [row[6:] for row in whole.rows]


def local_of_one_process():
    """Real files, as lines, split and not, and as tables."""
    ways = ["MinimumImage", "Split", "AsWritten"]
    reader_class = vg.vtkGranularLocalReader
    for file, preset, port, way in (("contacts.dump", "ContactsForce", 0, 0), ("contacts.dump", "ContactsForce", 0, 1),
                                    ("contacts.dump", "ContactsForce", 0, 2),
                                    ("chain_bonds.dump", "BondTypeIdsForce", 1, 0)):
        number = {"ContactsForce": reader_class.CONTACTS_FORCE, "BondTypeIdsForce": reader_class.BOND_TYPE_IDS_FORCE}
        lonely_reader = lonely("LocalReader", PeriodicLines=way, Preset=number[preset])
        lonely_reader.AddFileName(good("local/" + file))
        form = {"Label": "BONDS", "WriteTimeSteps": 1}
        expected = alone("LocalWriter", lonely_reader, ".bonds", port, **form)
        assert expected.count(b"ITEM: NUMBER OF BONDS") > 2
        reader = GranularLocalReader(FileNames=[good("local/" + file)], Preset=preset, PeriodicLines=ways[way])
        output = OutputPort(reader, port)
        for mode in MODES:
            found = saved(output, "real.bonds", ParallelMode=mode, Threads=2, **form)
            assert found == expected, (file, port, way, mode)
            assert saved_data(output, "data.bonds", ParallelMode=mode, **form) == expected, (file, port, way, mode)
        packed = saved(output, "real.bonds.gz", writer="GranularLocalWriter", **form)
        assert gzip.decompress(packed) == expected
        Delete(reader)


def local_of_joins():
    """Each bond once, wherever it is, in any order."""
    all_particles = GranularDumpReader(FileNames=[good("local/chain.dump")])
    bonds = GranularLocalReader(FileNames=[good("local/chain_bonds.dump")], Preset="BondTypeIdsForce")
    names = ["id1", "id2", "elongation", "x1", "y1", "z1", "x2", "y2", "z2"]
    expected = plain_local.read(good("local/chain_bonds.dump"))[2]
    for way in ("MinimumImage", "Split"):
        joined = GranularLocalJoin(Input=all_particles, Lines=OutputPort(bonds, 1), PeriodicLines=way, EquilibriumLength=1)
        saved(joined, "joined.bonds", Columns=names, time=1000)
        frame, = plain_local.read("joined.bonds")
        assert frame.timestep == 1000 and frame.names == names
        assert sorted(row[:2] for row in frame.rows) == sorted(row[1:3] for row in expected.rows)
        Delete(joined)


def local_without_rows(contacts, whole):
    """Ranks without rows, that know nothing."""
    for left_out in range(RANKS if RANKS > 1 else 0):
        holes = empty_on(left_out, contacts)
        holes.UpdatePipeline(2000)
        saved(holes, "holes.bonds")
        frame, = plain_local.read("holes.bonds")
        assert frame.timestep == 2000 and frame.bounds == whole.bounds and frame.boundary == whole.boundary
        ids, every = ([row[6:8] for row in of.rows] for of in (frame, whole))
        assert 0 < len(ids) < len(every) and [row for row in every if row in ids] == ids
        Delete(holes)


# ---- Euler cells ------------------------------------------------------------------------------------------------


def euler():
    """Points in the order of the ranks, cells of a grid in that of LIGGGHTS."""
    series = GranularEulerReader(FileNames=[good(f"euler_{step}.vtk") for step in STEPS])
    parallel = GranularEulerReader(FileNames=[good("euler/parallel_2000.vtk")])
    for output in ("Points", "ImageData"):  # of an image each rank has a part
        series.Output = parallel.Output = output
        vg.save(series, "real_*.euler", WriteTimeSteps=1)
        for step in STEPS:
            assert content(f"real_{step}.euler") == content(good(f"euler_{step}.vtk")), (output, step)
        assert saved(parallel, "parallel.euler") == content(good("euler/parallel_2000.vtk")), output
    euler_shapes()
    euler_wavelet()
    series.Output = "Points"
    holes = empty_on(0, series)
    holes.UpdatePipeline(2000)
    vg.save(holes, "holes_*.euler")  # the others know the timestep
    content("holes_2000.euler")
    found, whole = plain_euler.read("holes_2000.euler"), plain_euler.read(good("euler_2000.vtk"))
    left = 0 if RANKS == 1 else 112 // RANKS
    assert abs(len(found["centres"]) - (112 - left)) <= 1
    assert (found["pressure"] == whole["pressure"][-len(found["pressure"]):]).all()


def euler_shapes():
    """Grids of every shape, which are cut along other axes, without and with ghost cells, which are others'."""
    for i, counts in enumerate(((2, 2, 5), (7, 2, 2), (2, 9, 3), (8, 6, 4), (16, 2, 2))):
        name = f"shape_{i}_10.vtk"
        if RANK == 0:
            with open(name, "w") as file:
                file.write(plain_euler.text(plain_euler.cells(plain_euler.grid((0, 0, 0), counts, counts), seed=i)))
        all_ranks.wait()
        reader = GranularEulerReader(FileNames=[os.path.abspath(name)], Output="ImageData")
        assert saved(reader, "shape.euler") == content(name), counts
        ghosts = GhostCells(Input=reader) if "GhostCells" in globals() else GhostCellsGenerator(Input=reader)
        assert saved(ghosts, "ghosts.euler") == content(name), counts
        Delete(ghosts)
        Delete(reader)


def euler_wavelet():
    """An image of ParaView's own, whose extent begins below 0."""
    wavelet = PointDatatoCellData(Input=Wavelet(WholeExtent=[-4, 5, -3, 3, -2, 6]), PassPointData=0)
    arrays = wavelet
    for name, function in (("v_avg", "RTData*iHat+jHat"), ("volumefraction", "RTData/300"), ("radius", "1"),
                           ("pressure", "RTData")):
        arrays = Calculator(Input=arrays, AttributeType="Cell Data", ResultArrayName=name, Function=function)
    saved(arrays, "wavelet.euler")
    found = plain_euler.read("wavelet.euler")
    assert (found["centres"] == plain_euler.grid((-4, -3, -2), (5, 3, 6), (9, 6, 8))).all()
    assert numpy.allclose(found["v_avg"][:, :1], found["pressure"], rtol=0, atol=1e-6) and found["pressure"].min() > 30
    assert numpy.allclose(found["volumefraction"] * 300, found["pressure"], rtol=0, atol=3e-4)


# ---- decompositions -----------------------------------------------------------------------------------------------


def decomposition():
    """With the cells in the order of the ranks."""
    own, writer = {"writer": "GranularDecompositionWriter"}, "DecompositionWriter"
    for grid in ((1, 1, 1), (1, 2, 1), (3, 5, 7)):  # fewer subdomains than ranks, as many, and more
        bounds = (-1 / 3, 1, 0, 2, 1e9, 1e9 + 1)
        source = GranularDecompositionSource(Bounds=bounds, ProcessorGrid=grid)
        lonely_source = lonely("DecompositionSource", Bounds=bounds, ProcessorGrid=grid)
        for end in (".vtk", ".vtu", ".decomposition"):
            assert saved(source, "a" + end, **own) == alone(writer, lonely_source, end), (grid, end)
        public = alone(writer, lonely_source, ".vtk", Dialect=1)
        assert saved(source, "public.vtk", Dialect="PUBLIC", **own) == public, grid

    # with particles, at all times; the first ranks have no particles at step 0
    all_particles = GranularDumpReader(FileNames=[good("grains.dump")])
    domains = GranularDecomposition(Input=all_particles, ProcessorGrid=[2, 3, 4])
    reader, counts = lonely("DumpReader"), lonely("Decomposition", ProcessorGrid=(2, 3, 4))
    reader.AddFileName(good("grains.dump"))
    counts.SetInputConnection(reader.GetOutputPort())
    for end in (".vtk", ".vtu"):
        vg.save(domains, "step_*" + end, WriteTimeSteps=1)
        for step in (0, 1000, 2000):
            counts.UpdateTimeStep(step)
            assert content(f"step_{step}{end}") == alone(writer, counts, end), (step, end)

    holes = empty_on(0, domains)
    holes.UpdatePipeline(2000)
    vg.save(holes, "holes_*.vtk", **own)  # the other ranks know the timestep
    text = content("holes_2000.vtk")
    assert b"nlocal 1 " in text and text.startswith(b"# vtk DataFile Version 3.0"), text[:300]


for system in sys.argv[1:]:
    {check.__name__: check for check in (dump, local, euler, decomposition)}[system]()
print("written")
