# SPDX-License-Identifier: BSD-3-Clause
"""A file may be saved over that from which its data are read: it has the bytes that it has under another name, and the reader shows it
when it is refreshed."""
import os

import all_ranks
import granular
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
        granular.save(shown, name, **form)
    except RuntimeError as error:
        assert "the file changed since it was indexed; reload the files" in str(error), error
    for file, bytes in expected.items():
        assert content(file) == bytes, (file, form)


def check(kind, sources, name, attributes, adds, **form):
    """Saves what a reader shows over the files that it reads, twice; `name` has * for a file a frame."""
    source = kind(FileNames=[good(source) for source in sources])
    granular.save(source, name, **form)
    Delete(source)
    all_ranks.wait()
    begin, end = name.split("*") if "*" in name else (name, "")
    own = sorted(file for file in os.listdir(".") if file.startswith(begin) and file.endswith(end))
    assert own, name
    reader = kind(FileNames=[os.path.abspath(file) for file in own], **({"Prefetch": 1} if kind is GranularDumpReader else {}))
    shown = Calculator(Input=reader, AttributeType=attributes, ResultArrayName="added", Function="7") if adds else reader
    granular.save(shown, "other_" + name, **form)
    expected = {file: content("other_" + file) for file in own}
    for times in range(2):  # the second time over what it has written itself
        granular.save(shown, name, **form)
        for file in own:
            assert content(file) == expected[file], (file, form, times)
        check_not_refreshed(shown, name, expected, form)
        reader.InvokeCommand("Refresh")
        reader.UpdatePipeline(reader.TimestepValues[-1] if len(reader.TimestepValues) else 0)
    if adds:
        data = getattr(reader, attributes.replace(" ", ""))
        arrays = [data.GetArray(i).Name for i in range(data.NumberOfArrays)]
        assert "added" in arrays, arrays
    granular.save(reader, "other_" + name, **form)
    for file in own:
        assert content("other_" + file) == expected[file], file
    Delete(shown)
    if adds:
        Delete(reader)
    left = [file for file in os.listdir(".") if file.startswith(".granular-")]
    assert not left, left
    wipe("other_", begin)


wipe("a", "other_")
ALL = {"WriteTimeSteps": 1}
few = all_ranks.ranks.GetNumberOfProcesses() > 1  # ranks wait for each other
for mode, names in (("Gather", ("a.dump", "a.dump.gz", "a.bin", "a.dump.zst", "a_*.dump", "a_*.dump.gz")), ("MPI-IO", ("a.dump", "a.bin"))):
    for name in names[:2] if few else names:
        check(GranularDumpReader, ["grains.dump"], name, "Point Data", True, ParallelMode=mode, **ALL)
for name in ("a.bonds",) if few else ("a.bonds", "a.bonds.gz", "a_*.bonds"):
    check(GranularLocalReader, ["local/contacts.dump"], name, "Cell Data", True, **ALL)
check(GranularEulerReader, [f"euler_{step}.vtk" for step in (1000, 2000)], "a_*.euler", "Point Data", False, **ALL)
check(GranularEulerReader, ["euler_1000.vtk"], "a.euler", "Point Data", False)
check(GranularDecompositionReader, [f"decomposition_{step}.vtk" for step in (1000, 2000)], "a_*.vtk", "Cell Data", False, **ALL)
check(GranularDecompositionReader, ["decomposition_1000.vtk"], "a.vtu", "Cell Data", False)
print("saved over")
