# SPDX-License-Identifier: BSD-3-Clause
"""Any number of ranks draw and list the same to the bit as one, straight from the files and through a filter."""
import os
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkElevationFilter

import all_ranks
import plain_paths
import vtkgranular as vg
from stopping import stopped

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
RUNS = [(["grains.dump"], "v radius", {}), (["paths/walk.dump.gz"], "*", {}), (["local/chain.dump"], "mol v", {}),
        (["ortho_unwrapped.dump"], "", {"Coordinates": "Unwrapped"}), (["tri_000000.dump.gz", "tri_000050.dump.gz"], "", {})]
ALL = {"NumberOfSamples": 0}
CHOICES = [{"NumberOfSamples": 0}, {"Ids": "3"}, {"EveryNth": 7, "FrameStride": 2}, {"NumberOfSamples": 12, "Seed": 4}, {"Ids": "-1"},
           {"RegionOfInterest": [1, -1, 1, -1, -100, 1]}]
MORE = [{}, {"PeriodicLines": 1}, {"Tail": 1}]
FORMS = {"Absolute": 0, "Unwrapped": 1}
first = all_ranks.ranks.GetLocalProcessId() == 0


def alone(kind, names, form, time, **properties):
    """The same by the classes, in this process without the others."""
    reader, filter_ = vg.vtkGranularDumpReader(), getattr(vg, f"vtkGranular{kind}")()
    for algorithm in (reader, filter_):
        algorithm.SetController(None)
        for event in ("WarningEvent", "ErrorEvent"):
            algorithm.AddObserver(event, lambda *_: None)
    for name in names:
        reader.AddFileName(os.path.join(data, name))
    reader.SetCoordinates(FORMS[form.get("Coordinates", "Absolute")])
    filter_.SetInputConnection(reader.GetOutputPort())
    for name, value in properties.items():
        name = "OutputType" if name == "Output" else name
        getattr(filter_, f"Set{name}")(*value if isinstance(value, list) else (value,))
    filter_.UpdateTimeStep(time)
    return filter_.GetOutput()


def columns_of(table):
    row = table.GetRowData()
    return {row.GetArrayName(i): vtk_to_numpy(row.GetArray(i)).copy() for i in range(row.GetNumberOfArrays())}


def check_table(source, names, form, time, **properties):
    proxy = GranularHistory(Input=source, **{**ALL, **properties})
    proxy.UpdatePipeline(time)
    found = columns_of(proxy.GetClientSideObject().GetOutput())
    if not first:
        assert not found
    else:
        expected = columns_of(alone("History", names, form, time, **properties))
        assert list(found) == list(expected) and expected
        for name in found:
            assert found[name].tobytes() == expected[name].tobytes(), (names, properties, name)
    Delete(proxy)


for run, (names, arrays, form) in enumerate(RUNS):
    reader = GranularDumpReader(FileNames=[os.path.join(data, name) for name in names], **form)
    reader.UpdatePipelineInformation()
    time = reader.TimestepValues[-1]
    through = Calculator(Input=reader, Function="1", ResultArrayName="one")
    some = arrays.replace("*", "v c_shift")
    for number, properties in enumerate(CHOICES):
        more = MORE[(number + len(names[0])) % 3]
        # all arrays of the filter are one more
        sources, wanted = ((reader,), "*") if arrays == "*" and number == 0 else ((reader, through), some)
        source = sources[(run + number) % len(sources)]
        proxy = GranularTrajectories(Input=source, Arrays=wanted, **{**ALL, **properties, **more})
        whole = all_ranks.whole(proxy, time)
        if first:
            found = plain_paths.lines_of(whole)
            expected = plain_paths.lines_of(alone("Trajectories", names, form, time, Arrays=wanted, **properties, **more))
            assert sorted(found) == sorted(expected), (names, properties, more)
            assert plain_paths.same(dict(sorted(found.items())), dict(sorted(expected.items()))), (names, properties, more)
        Delete(proxy)
        few = properties if "EveryNth" in properties else {**properties, "EveryNth": 2}
        tables = ({"MeanSquareDisplacement": 1, **few}, {"Output": 1, "Quantiles": "0 0.3 0.5 1", **properties},
                  {"Output": 1, "MeanSquareDisplacement": 1, "Quantiles": "", **properties})
        check_table(source, names, form, time, Arrays=some, **tables[(run + number) % 3])
    for each in (through, reader):
        Delete(each)

# each rank has its own particles, and lower ranks smaller ids
reader = GranularDumpReader(FileNames=[os.path.join(data, "paths", "walk.dump.gz")])
proxy = GranularTrajectories(Input=reader)
proxy.UpdatePipeline(0)
ids = vtk_to_numpy(proxy.GetClientSideObject().GetOutput().GetCellData().GetArray("id")).tolist()
rank, size = all_ranks.ranks.GetLocalProcessId(), all_ranks.ranks.GetNumberOfProcesses()
assert ids == list(range(1 + 30 * rank // size, 1 + 30 * (rank + 1) // size)), ids


# one rank that wants to stop stops all, at whatever moment, and the next update is good
def size_of(output):
    return output.GetNumberOfColumns() if output.IsA("vtkTable") else output.GetNumberOfPoints()


reader = vg.vtkGranularDumpReader()
reader.AddFileName(os.path.join(data, "paths", "walk.dump.gz"))
through = vtkElevationFilter()
through.SetInputConnection(reader.GetOutputPort())
for kind, properties in (("Trajectories", {}), ("Trajectories", {"NumberOfSamples": 5}), ("History", {}),
                         ("History", {"OutputType": 1, "MeanSquareDisplacement": True}), ("Compare", {"Differences": "v"})):
    for source in (reader, through):
        filter_ = getattr(vg, f"vtkGranular{kind}")()
        filter_.SetInputConnection(source.GetOutputPort())
        for name, value in properties.items():
            getattr(filter_, f"Set{name}")(value)
        reports = []
        mark = filter_.AddObserver("ProgressEvent", lambda *_: reports.append(1))
        filter_.UpdateTimeStep(600, rank, size)
        filter_.RemoveObserver(mark)
        whole = size_of(filter_.GetOutput())
        assert (whole > 0) == (kind != "History" or rank == 0)
        for stopper in range(size):
            for stop in (1, 2, len(reports) // 2):
                with stopped(filter_, stop if rank == stopper else 0):
                    filter_.Modified()
                    filter_.UpdateTimeStep(600, rank, size)
                assert size_of(filter_.GetOutput()) == 0, (kind, properties, stopper, stop)
                filter_.Modified()
                filter_.UpdateTimeStep(600, rank, size)
                assert size_of(filter_.GetOutput()) == whole, (kind, properties, stopper, stop)

# an id that repeats, on whatever rank: one error of all, empty outputs, and ParaView lives on
HEAD = "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
rows = [f"{i} 0.{i % 90:02}5 0.5 0.5\n" for i in range(1, 201)]
if first:
    with open("repeated.dump", "w") as file:
        file.write(HEAD.format(0, 200) + "".join(rows))
        file.write(HEAD.format(100, 201) + "".join(rows) + "17 0.5 0.5 0.5\n")
    with open("none.dump", "w") as file:
        file.write((HEAD.format(0, 200) + "".join(rows)).replace("id", "q"))
all_ranks.wait()
for name, said in (("repeated.dump", "got id 17 in rows 16 and 200 of timestep 100"), ("none.dump", "paths need ids")):
    reader = GranularDumpReader(FileNames=[os.path.abspath(name)])
    through = Calculator(Input=reader, Function="1", ResultArrayName="one")
    for source in (reader, through):
        for kind, properties in ((GranularTrajectories, ALL), (GranularHistory, ALL), (GranularTrajectories, {"Ids": "10-20"}),
                                 (GranularHistory, {"Output": 1, "MeanSquareDisplacement": 1}), (GranularHistory, {"Output": 1})):
            proxy = kind(Input=source, **properties)
            proxy.UpdatePipeline(0)
            assert said in proxy.GetClientSideObject().GetErrorMessage(), (name, proxy.GetClientSideObject().GetErrorMessage())
            output = proxy.GetClientSideObject().GetOutput()
            assert (output.GetNumberOfColumns() if output.IsA("vtkTable") else output.GetNumberOfPoints()) == 0
            Delete(proxy)
print("all there", file=sys.stderr)  # behind what was said
