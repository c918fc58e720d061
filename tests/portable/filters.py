# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the filters and sources of a plugin make: filters.py PLUGIN FOLDER, on one or more ranks.

FOLDER/NAME.json has what is told of one row of FILTERS by rank: all outputs that each rank has at up to three times, warnings and errors.
Of deleted ones nothing stays, though no garbage is collected.
"""
import collections
import gc
import json
import os
import re
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

HERE = os.path.dirname(os.path.abspath(__file__))
plugin, folder = sys.argv[1:]
simple.LoadPlugin(plugin)
GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")


def reader(name, *files, port=0, **properties):
    """A port of a reader of good files."""
    made = getattr(simple, name)(FileNames=[os.path.join(GOOD, file) for file in files])
    for prop, value in properties.items():
        setattr(made, prop, value)
    return servermanager.OutputPort(made, port)


def changed(source, script, kind="Same as Input"):
    """A source behind a script, which makes `output` of `given` on each rank, of which it knows rank and ranks."""
    lines = ["from vtkmodules.vtkParallelCore import vtkMultiProcessController", "world = vtkMultiProcessController.GetGlobalController()",
             "rank, ranks = world.GetLocalProcessId(), world.GetNumberOfProcesses()",
             "given, output = self.GetInputDataObject(0, 0), self.GetOutputDataObject(0)"]
    return simple.ProgrammableFilter(Input=source, OutputDataSetType=kind, Script="\n".join([*lines, script]))


def chain(**properties):
    return reader("GranularDumpReader", "local/chain.dump", **properties)


def bonds(port=1, **properties):
    return reader("GranularLocalReader", "local/chain_bonds.dump", port=port, **properties)


def grains(**properties):
    return reader("GranularDumpReader", "grains.dump", **properties)


def subdomains():
    return simple.GranularDecompositionSource(Bounds=[-0.05, 0.05, -0.05, 0.05, 0, 0.15], ProcessorGrid=[2, 2, 1])


def breaking(**properties):
    return reader("GranularDumpReader", "paths/breaking.dump", **properties)


def breaking_bonds(port=1):
    return reader("GranularLocalReader", "paths/breaking_bonds.dump", port=port, Preset="BondTypeIds")


def breaking_lines(**properties):
    return simple.GranularLocalJoin(Input=breaking(), Lines=breaking_bonds(), **properties)


def split():
    """Lines that are split at the faces of the box."""
    return simple.GranularLocalJoin(Input=chain(), Lines=bonds(), PeriodicLines="Split", EquilibriumLength=1)


#: The columns of contacts between particles, and with walls.
COLUMNS = {"periodic_bed_contacts": "pos id force delta contactPoint", "periodic_bed_walls": "pos wall_id force delta",
           "moving_contacts": "pos vel id force delta", "moving_walls": "pos vel wall_id force delta",
           "bed_contacts": "pos id force force_normal force_tangential torque delta contactPoint"}


def bed(name="periodic_bed", **properties):
    return reader("GranularDumpReader", f"contacts/{name}.dump.gz", **properties)


def contacts(name="periodic_bed_contacts", **properties):
    file = f"contacts/{name}.dump"
    return reader("GranularLocalReader", file if os.path.exists(os.path.join(GOOD, file)) else file + ".gz", ColumnMap=COLUMNS[name], **properties)


def walls(name="periodic_bed_walls", **properties):
    return contacts(name, **properties)


def plane():
    return simple.Plane(Origin=[-0.015, 0.001, 0], Point1=[0.015, 0.001, 0], Point2=[-0.015, 0.001, 0.036], XResolution=4, YResolution=5)


LOSE_BOX = """output.ShallowCopy(given)
for name in ("BoxOrigin", "BoxVectors", "BoxBounds", "Boundary"):
    output.GetFieldData().RemoveArray(name)"""
SHORT = """output.ShallowCopy(given)
if rank == ranks - 1:
    output.GetPointData().GetArray("v").SetNumberOfTuples(3)"""

ALL_SUMS = ["coordination", "contact_force", "contact_torque", "fabric", "contact_stress", "principal_stress", "von_mises", "rattler",
            "coordination_without_rattlers", "mobilised_friction"]

ALL_AVERAGES = ["v_avg", "volumefraction", "radius", "pressure", "sigma", "tau", "density", "momentum", "granular_temperature", "coordination",
                "fabric", "sigma_kinetic", "tau_kinetic", "sigma_contact", "tau_contact"]
BED = {"Input": bed, "Lines": contacts, "Walls": walls}
MOVING = {"Input": lambda: bed("moving"), "Lines": lambda: contacts("moving_contacts"), "Walls": lambda: walls("moving_walls")}

SOME = """from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
step = given.GetFieldData().GetArray("timestep").GetValue(0)
ids = vtk_to_numpy(given.GetPointData().GetArray("id")) if given.GetNumberOfPoints() else []
output.Initialize()
rows, points = vtkIdList(), vtkPoints()
for row, id in enumerate(ids):
    if CONDITION:
        rows.InsertNextId(row)
points.SetDataTypeToDouble()
if rows.GetNumberOfIds():
    given.GetPoints().GetPoints(rows, points)
    output.SetPoints(points)
    output.GetPointData().CopyAllOn()
    output.GetPointData().CopyAllocate(given.GetPointData())
    output.GetPointData().CopyData(given.GetPointData(), rows, 0)
output.GetFieldData().ShallowCopy(given.GetFieldData())"""


def some(condition):
    """The particles of broken bonds for whose id, at this step, a condition holds; no arrays where none is left."""
    return changed(breaking(), SOME.replace("CONDITION", condition), "vtkPolyData")


#: The rows: the filter or source, its properties, and its inputs by their properties.
FILTERS = [
    ("GranularPackingSource", {"NumberOfGrains": 300, "Speed": 1.0, "BondFactor": 1.5, "Boundary": "p p f"}, {}),
    ("GranularPackingSource", {"Arrangement": "FaceCentredCubic", "BoxLengths": [0.1, 0.12, 0.15], "BoxTilts": [0.02, 0, 0.01], "Radii": "One"}, {}),
    ("GranularPackingSource", {"Arrangement": "Chain", "NumberOfGrains": 2, "BondFactor": 1, "BoxOrigin": [1, 2, 3]}, {}),
    ("GranularPackingSource", {"BoxTilts": [1, 0, 0]}, {}),
    ("GranularPackingSource", {"SolidFraction": 0.8}, {}),
    ("GranularLocalJoin", {"Averages": "v type", "Differences": "*", "EquilibriumLength": 1.05}, {"Input": chain, "Lines": bonds}),
    ("GranularLocalJoin", {"PeriodicLines": "Split", "Averages": "*"},
     {"Input": lambda: chain(Coordinates="Scaled", PointOrigin=[0.5, 0, 0]), "Lines": bonds}),
    ("GranularLocalJoin", {"PeriodicLines": "Split"}, {"Input": lambda: chain(Coordinates="Unwrapped"), "Lines": bonds}),
    ("GranularLocalJoin", {"PeriodicLines": "AsWritten", "Averages": "missing"}, {"Input": chain, "Lines": bonds}),
    ("GranularLocalJoin", {}, {"Input": lambda: chain(Stride=2), "Lines": bonds}),
    ("GranularLocalJoin", {"EquilibriumLength": -1}, {"Input": chain, "Lines": bonds}),
    ("GranularLocalJoin", {"PeriodicLines": "Split"}, {"Input": lambda: changed(chain(), LOSE_BOX), "Lines": bonds}),
    ("GranularLocalJoin", {}, {"Input": lambda: changed(chain(), LOSE_BOX), "Lines": split}),
    ("GranularLocalJoin", {"EquilibriumLengthArray": "dist"}, {"Input": lambda: chain(TimestepSize=0.5), "Lines": bonds}),
    ("GranularLocalJoin", {}, {"Input": lambda: changed(chain(), SHORT), "Lines": bonds}),
    ("GranularLocalJoin", {}, {"Input": bonds, "Lines": bonds}),
    ("GranularLocalJoin", {}, {"Input": chain, "Lines": lambda: bonds(port=0)}),
    ("GranularDecompositionSource", {"ProcessorGrid": [2, 0, 3], "NumberOfProcesses": 12, "XCuts": [0.25]}, {}),
    ("GranularDecompositionSource", {"Bounds": [0, 1, 0, 2, 0, 3], "XCuts": [0.25, 0.2], "ProcessorGrid": [3, 1, 1]}, {}),
    ("GranularDecomposition", {"ProcessorGrid": [2, 1, 3]}, {"Input": grains}),
    ("GranularDecomposition", {"ProcessorGrid": [2, 2, 1], "Bounds": [0, 0.02, 1, -1, 1, -1], "ZCuts": []},
     {"Input": lambda: grains(PointOrigin=[1, 2, 3])}),
    ("GranularDecomposition", {"Mode": "Subdomains"}, {"Input": lambda: grains(Coordinates="Scaled"), "Subdomains": subdomains}),
    ("GranularDecomposition", {"Mode": "Subdomains"}, {"Input": grains}),
    ("GranularDecomposition", {"Mode": "ProcessArray"}, {"Input": grains}),
    ("GranularDecomposition", {"Mode": "ProcessArray", "ProcessArray": "type", "NumberOfProcesses": 7}, {"Input": grains}),
    ("GranularDecomposition", {"Mode": "Ranks"}, {"Input": grains}),
    ("GranularCompare", {"Differences": "*"}, {"Input": breaking, "Lines": breaking_lines}),
    ("GranularCompare", {"Reference": "Previous", "Differences": "image mass"}, {"Input": lambda: some("id % 3 or step % 800 == 0"), "Lines": lambda:
                                                                             breaking_lines(PeriodicLines="Split")}),
    ("GranularCompare", {"Reference": "Time", "ReferenceTime": 500, "MassArray": "x"}, {"Input": lambda: breaking(Coordinates="Scaled")}),
    ("GranularCompare", {"Reference": "Time", "ReferenceTime": float("nan")}, {"Input": breaking}),
    ("GranularCompare", {"Differences": "missing"}, {"Input": breaking}),
    ("GranularCompare", {}, {"Input": breaking_lines}),
    ("GranularCompare", {}, {"Input": breaking_lines, "Lines": breaking_lines}),
    ("GranularCompare", {}, {"Input": breaking, "Lines": breaking_bonds}),
    ("GranularCompare", {}, {"Input": breaking_bonds}),
    ("GranularCompare", {}, {"Input": breaking, "Lines": lambda: breaking_bonds(port=0)}),
    ("GranularCompare", {}, {"Input": lambda: changed(some("step > 0"), LOSE_BOX), "Lines": breaking_lines}),
    ("GranularCompare", {}, {"Input": grains}),
    ("GranularTrajectories", {}, {"Input": breaking}),
    ("GranularTrajectories", {"PeriodicLines": "Split", "NumberOfSamples": 0, "Arrays": "*"},
     {"Input": lambda: some("id % 3 or step % 800 == 0")}),
    ("GranularTrajectories", {"Tail": 1, "Ids": "1-20, 500"}, {"Input": lambda: breaking(PointOrigin=[1, 2, 3])}),
    ("GranularTrajectories", {"RegionOfInterest": [0, 9, 1, -1, 1, -1], "TimeWindow": [100, 1200], "FrameStride": 2},
     {"Input": lambda: breaking(Coordinates="Unwrapped")}),
    ("GranularTrajectories", {"NumberOfSamples": 3, "SelectionFrame": 9}, {"Input": breaking}),
    ("GranularTrajectories", {"TimeWindow": [1, 2]}, {"Input": breaking}),
    ("GranularTrajectories", {"Arrays": "missing"}, {"Input": breaking}),
    ("GranularTrajectories", {}, {"Input": breaking_lines}),
    ("GranularHistory", {}, {"Input": breaking}),
    ("GranularHistory", {"Output": "Statistics", "Arrays": "*", "Quantiles": "0.1, 0.9", "MeanSquareDisplacement": 1},
     {"Input": lambda: some("step > 0")}),
    ("GranularHistory", {"Ids": "5 777 10-12", "Arrays": "mass", "MeanSquareDisplacement": 1}, {"Input": breaking}),
    ("GranularHistory", {"Output": "Statistics", "Quantiles": "2"}, {"Input": breaking}),
    ("GranularHistory", {"Arrays": "missing", "Output": "Statistics"}, {"Input": breaking}),
    ("GranularDecomposition", {"Bounds": [float("nan"), 1, 0, 1, 0, 1]}, {"Input": grains}),
    ("GranularContactSums", {}, BED),
    ("GranularContactSums", {"Arrays": ALL_SUMS, "LeverArm": "HalfBranch", "MinimumForce": 0.001, "FrictionCoefficient": 0.5}, MOVING),
    ("GranularContactSums", {"Arrays": ["fabric", "mobilised_friction", "missing"], "MinimumOverlap": 1e-5, "RattlerContacts": 4},
     {"Input": lambda: bed(Stride=3), "Lines": lambda: contacts(PeriodicLines="Split")}),
    ("GranularContactSums", {"Arrays": ["rattler", "von_mises", "mobilised_friction"]},
     {"Input": lambda: bed(Coordinates="Scaled"), "Lines": lambda: contacts(port=1), "Walls": walls}),
    ("GranularContactSums", {"Arrays": ALL_SUMS}, {"Input": lambda: bed("bed"), "Lines": lambda: contacts("bed_contacts")}),
    ("GranularContactSums", {}, {"Input": bed}),
    ("GranularContactSums", {"FrictionCoefficient": 0}, {"Input": bed, "Lines": contacts}),
    ("GranularContactSums", {}, {"Input": bed, "Walls": contacts}),
    ("GranularContactSums", {}, {"Input": bed, "Lines": bed}),
    ("GranularContactSums", {}, {"Input": chain, "Lines": bonds}),
    ("GranularPointAverage", {"KernelWidth": 0.004, "Arrays": ALL_AVERAGES}, {**BED, "Points": plane}),
    ("GranularPointAverage", {"Kernel": "Lucy"}, {"Input": lambda: bed("moving", PointOrigin=[0.01, 0, 0]), "Points": lambda: bed("moving")}),
    ("GranularPointAverage", {"Kernel": "Heaviside", "KernelWidth": 0.005},
     {"Input": lambda: bed(Stride=2), "Points": lambda: simple.GranularEulerAverage(Input=bed(), CellCounts=[2, 2, 3])}),
    ("GranularPointAverage", {}, {"Input": lambda: bed(Coordinates="Scaled"), "Points": plane}),
    ("GranularPointAverage", {"KernelWidth": -1, "Arrays": ["density", "missing"]}, {"Input": bed, "Points": plane}),
    ("GranularEulerAverage", {"CellCounts": [3, 4, 5], "Arrays": ALL_AVERAGES}, BED),
    ("GranularEulerAverage", {"Output": "Points", "CellsBy": "CellSizeRelative", "Weights": "Centre", "Periodic": "None"}, BED),
    ("GranularEulerAverage", {"Output": "Points", "TimeAverage": 1, "CellCounts": [2, 2, 3], "Arrays": ALL_AVERAGES}, MOVING),
    ("GranularEulerAverage", {"TimeAverage": 1, "CellsBy": "CellSize", "CellSize": [0.009, 0.008, 0.02], "Bounds": [-0.01, 0.01, -0.01, 0.01, 0, 0.04]},
     {"Input": lambda: bed("moving", PointOrigin=[0.01, 0, 0])}),
    ("GranularEulerAverage", {"CellsBy": "CellSize"}, BED),
    ("GranularEulerAverage", {"CellsBy": "CellSizeRelative", "Bounds": [0, 0, -0.01, 0.01, 0, 0]}, BED),
    ("GranularEulerAverage", {"TimeAverage": 1, "TimeWindow": [1e9, 2e9]}, MOVING),
    ("GranularProfile", {"Layers": 7, "ProfileAxis": "Y", "Weights": "Lucy", "KernelBounds": "Inside", "Arrays": ALL_AVERAGES}, BED),
    ("GranularProfile", {"Layers": 2}, {"Input": lambda: bed(Coordinates="Scaled", Stride=2)}),
    ("GranularProfile", {"Thickness": 0.004, "ProfileAxis": "X", "TimeAverage": 1, "TimeWindow": [0, 200]}, MOVING),
    ("GranularEulerAverage", {"CellCounts": [3, 0, 5]}, BED),
    ("GranularEulerAverage", {"CellCounts": [1, 1, 1], "StressArray": "v"}, {"Input": bed}),
    ("GranularEulerAverage", {"CellCounts": [1, 1, 1], "StressArray": "c_s"}, BED),
    ("GranularEulerAverage", {"Output": "Points", "CellCounts": [2, 2, 2]}, {"Input": lambda: changed(bed(), LOSE_BOX)}),
]


def of_message(text):
    """The words of a warning or error, without the place and class that VTK names. The rank is not told if all ranks get as far as the
    error before one tells the others."""
    return re.sub(r"(?s)^.*?\(0x[0-9a-f]+\): | \(on rank \d of \d\)", "", text).strip()


def tell(key, source, port):
    """Lets each rank write what it has of an output."""
    script = f"""import json, sys
from vtkmodules.vtkParallelCore import vtkMultiProcessController
sys.path.insert(0, {HERE!r})
from told_data import of_data
world = vtkMultiProcessController.GetGlobalController()
with open({os.path.join(folder, key)!r} + f"_{{world.GetLocalProcessId()}}.json", "w") as file:
    json.dump(of_data(self.GetInputDataObject(0, 0)), file, indent=1)"""
    return simple.ProgrammableFilter(Input=servermanager.OutputPort(source, port), OutputDataSetType="vtkTable", Script=script)


def alive():
    """Returns how many algorithms of the portable plugin there are, and runs and frames of the library."""
    names = collections.Counter(type(each).__name__ for each in gc.get_objects() if str(type(each).__module__).startswith("vtkgranular"))
    return len([name for name in names.elements() if name.startswith("Granular")]), names["_Handle"]


def memory():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


gc.disable()
used = []
for number, (name, properties, inputs) in enumerate(FILTERS):
    made = getattr(simple, name)(**{prop: make() for prop, make in inputs.items()})
    for prop, value in properties.items():
        setattr(made, prop, value)
    said, key = [], f"{number}_{name}"
    for event in ("WarningEvent", "ErrorEvent"):
        def hear(_, kind, text, said=said):
            said.extend([[kind, of_message(text)]] if [kind, of_message(text)] not in said else [])

        hear.CallDataType = "string0"
        made.GetClientSideObject().AddObserver(event, hear)
    made.UpdatePipelineInformation()
    times = list(made.GetClientSideObject().GetOutputInformation(0).Get(Pipeline.TIME_STEPS()) or ())
    for time in times[:2] + times[2:][-1:] or [None]:
        for port in range(made.SMProxy.GetNumberOfOutputPorts()):
            teller = tell(f"{key}_{port}_{time}", made, port)
            teller.UpdatePipeline(*([] if time is None else [time]))
            simple.Delete(teller)
        made.UpdatePropertyInformation()
        said.append([time, of_message(made.GetPropertyValue("ErrorMessage"))])
    rank = simple.servermanager.vtkProcessModule.GetProcessModule().GetPartitionId()
    with open(os.path.join(folder, f"{key}_said_{rank}.json"), "w", encoding="utf-8") as file:
        json.dump({"row": [name, repr(properties)], "times": repr(times), "said": said}, file, indent=1)
    for source in (made, *simple.GetSources().values()):
        simple.Delete(source)
    del made, source, teller
    used.append(memory())
    algorithms, handles = alive()  # VTK keeps the attributes of those that were deleted at once until another one is
    assert not algorithms and handles <= 8, f"{key}: expected nothing to stay, got {algorithms} algorithms, {handles} runs and frames"
assert used[-1] - used[10] < 200, f"expected less than 200 MiB to stay, got {used}"
