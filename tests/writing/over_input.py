# SPDX-License-Identifier: BSD-3-Clause
"""A file may be saved over that from which its data are read: it has the bytes that it has under another name, and the reader shows it
when it is refreshed."""
import os

import all_ranks
import vtkgranular as vg
from paraview.simple import *
from writing import content, good

RANK = all_ranks.ranks.GetLocalProcessId()


def wipe(*begins):
    all_ranks.wait()
    if RANK == 0:
        for file in os.listdir("."):
            if file.startswith(begins):
                os.remove(file)
    all_ranks.wait()


def check_not_refreshed(shown, name, expected, form):
    """A reader whose files are others by now either knows it or has the frame in memory: no file is a mixture."""
    try:
        vg.save(shown, name, **form)
    except RuntimeError as error:
        assert "the file changed since it was indexed; reload the files" in str(error), error
    for file, bytes in expected.items():
        assert content(file) == bytes, (file, form)


def check(kind, sources, name, attributes, adds, **form):
    """Saves what a reader shows over the files that it reads, twice; `name` has * for a file a frame."""
    source = kind(FileNames=[good(source) for source in sources])
    vg.save(source, name, **form)
    Delete(source)
    all_ranks.wait()
    begin, end = name.split("*") if "*" in name else (name, "")
    own = sorted(file for file in os.listdir(".") if file.startswith(begin) and file.endswith(end))
    assert own, name
    reader = kind(FileNames=[os.path.abspath(file) for file in own])
    shown = Calculator(Input=reader, AttributeType=attributes, ResultArrayName="added", Function="7") if adds else reader
    vg.save(shown, "other_" + name, **form)
    expected = {file: content("other_" + file) for file in own}
    for times in range(2):  # the second time over what it has written itself
        vg.save(shown, name, **form)
        for file in own:
            assert content(file) == expected[file], (file, form, times)
        check_not_refreshed(shown, name, expected, form)
        reader.InvokeCommand("Refresh")
        reader.UpdatePipeline(reader.TimestepValues[-1] if len(reader.TimestepValues) else 0)
    if adds:
        data = getattr(reader, attributes.replace(" ", ""))
        arrays = [data.GetArray(i).Name for i in range(data.NumberOfArrays)]
        assert "added" in arrays, arrays
    vg.save(reader, "other_" + name, **form)
    for file in own:
        assert content("other_" + file) == expected[file], file
    Delete(shown)
    if adds:
        Delete(reader)
    left = [file for file in os.listdir(".") if file.startswith(".granular-")]
    assert not left, left
    wipe("other_", begin)


def lay(name, *sources, end=b""):
    """Makes a file of others, one behind the other."""
    if RANK == 0:
        with open(name, "wb") as out:
            for source in sources:
                with open(good(source), "rb") as file:
                    out.write(file.read())
            out.write(end)
    all_ranks.wait()


def check_shared(**form):
    """Files that hold several frames of the run, or a part of one, are still read when the first frame is written."""
    lay("a_0.dump", "grains_0.dump", "grains_1000.dump")
    lay("a_2000.dump", "grains_2000.dump")
    if RANK == 0:
        os.symlink(".", "a_link")
    all_ranks.wait()
    reader = GranularDumpReader(FileNames=[os.path.abspath(f"a_{step}.dump") for step in (0, 2000)])
    shown = Calculator(Input=reader, ResultArrayName="added", Function="7")
    vg.save(shown, "other_a_*.dump", WriteTimeSteps=1, **form)
    vg.save(shown, "a_link/a_*.dump", WriteTimeSteps=1, **form)
    for step in (0, 1000, 2000):
        assert content(f"a_{step}.dump") == content(f"other_a_{step}.dump"), step
    Delete(shown)
    Delete(reader)

    # a frame that a simulation is writing
    lay("a_2000.dump", "grains_2000.dump", end=b"ITEM: TIMESTEP\n3000\n")
    for rank in range(4):
        lay(f"a_piece.{rank}.dump", f"pieces_1000.{rank}.dump")
    before = {name: content(name) for name in sorted(os.listdir(".")) if name.endswith(".dump")}
    refused = {("a_0.dump", "a_2000.dump"): ("a_link/a_*.dump", "a_link/a_2000.dump"),
               tuple(f"a_piece.{rank}.dump" for rank in range(4)): ("a_link/a_piece.%.dump", "a_piece.0.dump")}
    for names, outputs in refused.items():
        reader = GranularDumpReader(FileNames=[os.path.abspath(name) for name in names])
        for output in outputs:
            try:
                vg.save(Calculator(Input=reader, Function="7"), output, time=2000, **form)
                raise AssertionError(output)
            except RuntimeError as error:
                assert "one that is read" in str(error) and ("not complete" in str(error)) == ("piece" not in output), error
            all_ranks.wait()
            assert {name: content(name) for name in sorted(os.listdir(".")) if name.endswith(".dump")} == before, output
        Delete(reader)
    wipe("other_", "a_")


wipe("a", "other_")
ALL = {"WriteTimeSteps": 1}
few = all_ranks.ranks.GetNumberOfProcesses() > 1  # ranks wait for each other
for mode, names in (("Gather", ("a.dump", "a.dump.gz", "a.bin", "a.dump.zst", "a_*.dump", "a_*.dump.gz")), ("MPI-IO", ("a.dump", "a.bin"))):
    for name in names[:2] if few else names:
        check(GranularDumpReader, ["grains.dump"], name, "Point Data", True, ParallelMode=mode, **ALL)
    check_shared(ParallelMode=mode)
for name in ("a.bonds",) if few else ("a.bonds", "a.bonds.gz", "a_*.bonds"):
    check(GranularLocalReader, ["local/contacts.dump"], name, "Cell Data", True, **ALL)
check(GranularEulerReader, [f"euler_{step}.vtk" for step in (1000, 2000)], "a_*.euler", "Point Data", False, **ALL)
check(GranularEulerReader, ["euler_1000.vtk"], "a.euler", "Point Data", False)
check(GranularDecompositionReader, [f"decomposition_{step}.vtk" for step in (1000, 2000)], "a_*.vtk", "Cell Data", False, **ALL)
check(GranularDecompositionReader, ["decomposition_1000.vtk"], "a.vtu", "Cell Data", False)
print("saved over")
