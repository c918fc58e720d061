# SPDX-License-Identifier: BSD-3-Clause
"""Each array that a class computes has a row in the table of docs/measurements/promises.md, and each row such an array.

Computed is what an output has and neither its file nor its inputs have under that name: values of files are told by the
columns that the file names."""
import os
import re
import sys

import vtkgranular as vg
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkFiltersSources import vtkPlaneSource

ROOT = sys.argv[1]
SAMPLES = os.path.join(ROOT, "samples", "data")


def names_of(data):
    """The arrays of an output, points among them."""
    found = set()
    if data.IsA("vtkPointSet") and data.GetNumberOfPoints():
        found.add("points")
    holders = ["GetFieldData"] + (["GetRowData"] if data.IsA("vtkTable") else ["GetPointData", "GetCellData"])
    for holder in holders:
        arrays = getattr(data, holder)()
        found |= {arrays.GetAbstractArray(i).GetName() for i in range(arrays.GetNumberOfArrays())}
    return found


def columns_of(data):
    """Names in the file, and of the vectors that they make."""
    array = data.GetFieldData().GetAbstractArray("Columns")
    names = [array.GetValue(i) for i in range(array.GetNumberOfValues())] if array else []
    vectors = {re.sub(r"\[\d+\]$", "", name) for name in names}
    return set(names) | vectors | {name[:-1] for name in names if name[-1] in "xyz" and len(name) > 1}


def outputs(algorithm):
    algorithm.UpdateInformation()
    key = algorithm.GetExecutive().TIME_STEPS()
    info = algorithm.GetOutputInformation(0)
    if info.Has(key) and info.Length(key):
        algorithm.UpdateTimeStep(info.Get(key)[-1])
    else:
        algorithm.Update()
    return [algorithm.GetOutputDataObject(port) for port in range(algorithm.GetNumberOfOutputPorts())]


def open_with(kind, *path, **properties):
    reader = getattr(vg, "vtkGranular" + kind)()
    for name, value in properties.items():
        getattr(reader, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    reader.AddFileName(os.path.join(*path))
    return reader


def made():
    """(class, arrays of its inputs, its algorithm), one for each way that makes other arrays."""
    dump = open_with("DumpReader", SAMPLES, "grains.dump", TimestepSize=2e-5)
    yield "DumpReader", set(), dump
    with open("diameters.dump", "w", encoding="ascii") as out:
        out.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                  "ITEM: ATOMS id x y z diameter\n1 0.5 0.5 0.5 0.1\n")
    yield "DumpReader", set(), open_with("DumpReader", "diameters.dump")
    bonds = open_with("LocalReader", SAMPLES, "bonds", "chain_bonds.dump", PeriodicLines=1)
    yield "LocalReader", set(), bonds
    contacts = open_with("LocalReader", SAMPLES, "bonds", "settled_contacts.dump.gz", PeriodicLines=1)
    yield "LocalReader", set(), contacts
    packing = vg.vtkGranularPackingSource()
    packing.SetNumberOfGrains(50)
    packing.SetSpeed(1)
    yield "PackingSource", set(), packing
    average = vg.vtkGranularEulerAverage()
    average.SetInputConnection(packing.GetOutputPort())
    average.SetCellCounts(2, 2, 2)
    yield "EulerAverage", names_of(outputs(packing)[0]) - {"radius"}, average
    bed = open_with("DumpReader", SAMPLES, "continuum", "bed.dump.gz")
    touching = open_with("LocalReader", SAMPLES, "continuum", "bed_contacts.dump.gz",
                         ColumnMap="pos id force force_normal force_tangential torque delta contactPoint")
    plane = vtkPlaneSource()
    for name, inputs, more in (("ContactSums", names_of(outputs(bed)[0]), {}), ("EulerAverage", set(), {"CellCounts": (2, 2, 2)}),
                               ("PointAverage", {"points", "Normals", "TextureCoordinates"}, {})):
        made_of_contacts = getattr(vg, "vtkGranular" + name)()
        made_of_contacts.SetInputConnection(0, bed.GetOutputPort())
        made_of_contacts.SetLinesConnection(touching.GetOutputPort())
        if name == "PointAverage":
            made_of_contacts.SetPointsConnection(plane.GetOutputPort())
        for key, value in more.items():
            getattr(made_of_contacts, "Set" + key)(*value)
        made_of_contacts.GetArraySelection().EnableAllArrays()
        made_of_contacts.GetArraySelection().DisableArray("mobilised_friction")
        yield name, inputs, made_of_contacts
    source = vg.vtkGranularDecompositionSource()
    yield "DecompositionSource", set(), source
    count = vg.vtkGranularDecomposition()
    count.SetInputConnection(packing.GetOutputPort())
    yield "Decomposition", names_of(outputs(packing)[0]), count
    particles = open_with("DumpReader", SAMPLES, "bonds", "chain.dump")
    join = vg.vtkGranularLocalJoin()
    join.SetInputConnection(0, particles.GetOutputPort())
    join.SetInputConnection(1, bonds.GetOutputPort(1))
    join.SetEquilibriumLength(1)
    join.SetAverages("*")
    join.SetDifferences("*")
    lines = outputs(bonds)[1]
    join.SetPeriodicLines(join.SPLIT)
    yield "LocalJoin", (names_of(outputs(particles)[0]) | columns_of(lines)) - {"points"}, join
    whole = vg.vtkGranularLocalJoin()
    whole.SetInputConnection(0, particles.GetOutputPort())
    whole.SetInputConnection(1, bonds.GetOutputPort(1))
    compare = vg.vtkGranularCompare()
    compare.SetInputConnection(0, particles.GetOutputPort())
    compare.SetLinesConnection(whole.GetOutputPort())
    compare.SetDifferences("*")
    compare.SetMassArray("mol")
    yield "Compare", names_of(outputs(particles)[0]) | names_of(outputs(whole)[0]), compare
    paths = vg.vtkGranularTrajectories()
    history = vg.vtkGranularHistory()
    history.SetMeanSquareDisplacement(True)
    history.SetOutputType(history.STATISTICS)
    for name, algorithm in (("Trajectories", paths), ("History", history)):
        algorithm.SetInputConnection(dump.GetOutputPort())
        algorithm.SetIds("1 2")
        algorithm.SetArrays("")
        yield name, set(), algorithm
    yield "RestartReader", set(), open_with("RestartReader", SAMPLES, "restart", "fibres.40000.restart")
    yield "DataFileReader", set(), open_with("DataFileReader", SAMPLES, "bonds", "chain.data")
    yield "EulerReader", set(), open_with("EulerReader", SAMPLES, "euler_4000.vtk")


# What readers pass on in words: forms and names, no quantities.
WORDS = {"Boundary", "ColumnDigits", "Columns", "Coordinates", "Dialect", "Groups", "units", "ParticlesLeftOut", "RowLabel"}
EVERYONE = "all readers and sources"


def promised():
    """{(class, array)} of the table; a class None stands for all, an array with a star for its ending."""
    with open(os.path.join(ROOT, "docs", "measurements", "promises.md"), encoding="utf-8") as stream:
        table = stream.read()
    for line in re.findall(r"^\| (`.*) \| (.*?) \| (.+?) \|$", table, re.M):
        for array in re.findall(r"`([^`]+)`", line[0]):
            for name in [None] if line[1] == EVERYONE else line[1].split(", "):
                yield name, array


def is_of(array, promise):
    return array.endswith(promise[1:]) if promise.startswith("*") else array == promise


def main():
    vtkObject.GlobalWarningDisplayOff()
    promises, kept = set(promised()), set()
    for name, inputs, algorithm in made():
        for data in outputs(algorithm):
            columns = columns_of(data) if name != "PackingSource" else set()
            for array in names_of(data) - columns - inputs - WORDS:
                found = {(who, what) for who, what in promises if who in (None, name) and is_of(array, what)}
                if not found:
                    sys.exit(f"docs/measurements/promises.md: no promise about the array {array} of {name}")
                kept |= found
    if promises != kept:
        sys.exit("docs/measurements/promises.md: promises about arrays that were not there: "
                 f"{sorted(promises - kept, key=str)}")


main()
