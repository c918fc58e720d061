# SPDX-License-Identifier: BSD-3-Clause
"""granular.save chooses the writer by the data, then by the ending; numbers are exact unless told otherwise."""
import filecmp
import glob
import os
import tempfile
import xml.etree.ElementTree

import granular
import numpy
from granular.command import main
from paraview.simple import *

good = os.path.join(os.environ["GRANULAR_DATA"], "good")
samples = os.path.join(good, "..", "..", "..", "samples", "data")


def begins(name, text):
    with open(name, "rb") as file:
        got = file.read(len(text))
    assert got == text, (name, got)


def refused(proxy, name, *parts):
    try:
        granular.save(proxy, name)
    except ValueError as error:
        assert all(part in str(error) for part in parts), error
        assert not os.path.exists(name), name
    else:
        raise AssertionError(f"{name} was written")


particles = os.path.join(good, "grains.dump")
particles = granular.reader(particles)
granular.update(particles, particles.TimestepValues[-1])
contacts = granular.reader(os.path.join(samples, "bonds", "settled_contacts.dump.gz"), Preset="ContactsForce")
granular.update(contacts, contacts.TimestepValues[-1])
cells = GranularEulerAverage(Input=particles, CellCounts=[2, 2, 2])
domains = GranularDecomposition(Input=particles, ProcessorGrid=[2, 1, 2])

for name in ("a.dump", "a.lammpstrj", "a.liggghts", "dump.1000", "dump_of_mine", "a.dmp"):
    granular.save(particles, name)
    begins(name, b"ITEM: TIMESTEP")
granular.save(particles, "a.dump.gz")
begins("a.dump.gz", b"\x1f\x8b")
granular.save(particles, "a.bin")
begins("a.bin", b"\xf6\xff\xff\xff\xff\xff\xff\xffDUMPCUSTOM")
for name, text in (("a.vtp", b"<"), ("a.vtk", b"# vtk DataFile"), ("a.csv", b'"'), ("a.ply", b"ply")):
    granular.save(particles, name)
    begins(name, text)
for name in ("a.bonds", "a.dump", "a.dump.gz"):
    granular.save(contacts, name)
    granular.save(OutputPort(contacts, 1), "rows_" + name)
begins("a.bonds", b"ITEM: TIMESTEP")
begins("rows_a.dump", b"ITEM: TIMESTEP")
with open("rows_a.dump") as file:
    assert "ITEM: NUMBER OF ENTRIES" in file.read()
for name in ("a_domains.vtk", "a.decomposition"):
    granular.save(domains, name)
    begins(name, b"# vtk DataFile")
granular.save(domains, "a.vtu")
begins("a.vtu", b"<")
granular.save(cells, "a.euler")
granular.save(cells, "a_cells.vtk")
for name in ("a.euler", "a_cells.vtk"):
    begins(name, b"# vtk DataFile")
granular.save(cells, "a.vti")
begins("a.vti", b"<")
granular.save(Tube(Input=contacts), "a_tubes.vtp")
granular.save(GroupDatasets(Input=[particles, cells]), "a_group.vtm")
for name in ("a.vtp", "a.vti", "a_tubes.vtp", *glob.glob("a_group/*")):  # all versions of libexpat read what is XML for Python's
    xml.etree.ElementTree.parse(name)
    assert b"AppendedData" not in open(name, "rb").read(), name  # VTK's own parser refuses them with some versions of libexpat
last = particles.TimestepValues[-1]
whole = granular.fetch(particles, time=last)
for compressor in ("None", "ZLib", "LZ4", "LZMA"):
    granular.save(particles, "packed.vtp", last, CompressorType=compressor)
    assert b"AppendedData" not in open("packed.vtp", "rb").read(), compressor
    again = granular.fetch(XMLPolyDataReader(FileName=["packed.vtp"]))
    assert all(numpy.array_equal(again[name], whole[name]) for name in whole), compressor
for name, kind in (("b.vtp", XMLPolyDataReader), ("b.vtu", XMLUnstructuredGridReader)):
    assert main(["convert", particles, name, "--frames", "-1", "--quiet"]) == 0
    assert b"AppendedData" not in open(name, "rb").read(), name
    again = granular.fetch(kind(FileName=[name]))
    assert all(numpy.array_equal(again[name], whole[name]) for name in ("points", "id", "v", "radius"))
# a link to another name, on another disk where there is one: the ending is the user's
with tempfile.TemporaryDirectory(dir="/dev/shm") as disk:
    os.symlink(os.path.join(disk, "behind.txt"), "link.csv")
    granular.save(particles, "link.csv", last)
    begins("link.csv", b'"')
    assert os.path.islink("link.csv") and os.listdir(disk) == ["behind.txt"]
    os.remove("link.csv")
os.symlink("nowhere", "numbered_0.dump")
granular.save(particles, "numbered_*.dump", last)
os.remove("numbered_0.dump")
granular.save(particles, "chosen.vtp", DataMode="Ascii")
with open("chosen.vtp") as file:
    assert 'format="ascii"' in file.read()

# all frames by ParaView's writers, which call WriteTimeSteps by several names and number the files themselves
for ending in ("vtp", "csv"):
    granular.save(particles, f"all.{ending}", WriteTimeSteps=1)
    written = [name for name in os.listdir() if name.startswith("all") and name.endswith(ending)]
    assert len(written) == len(particles.TimestepValues) or ending == "csv", written
refused(particles, "all_*.vtp", "WriteTimeSteps", "got 'all_*.vtp'")

# what no writer has for such data
refused(particles, "b.xyz", "particles", ".dump", ".vtp", "got 'b.xyz'")
refused(particles, "b.vti", "particles", ".lammpsbin")
refused(particles, "noending", "particles")
refused(contacts, "b.vtu.gz", "lines or rows", ".bonds")
granular.save(particles, "a.xyz", writer="GranularDumpWriter")
begins("a.xyz", b"ITEM: TIMESTEP")

# frames without particles or contacts are what the others are
granular.update(particles, 0)
granular.save(particles, "empty.dump", time=0)
granular.save(contacts, "empty.bonds", time=contacts.TimestepValues[0])

# the whole run, and a filter's new array, by default: nothing is lost
granular.save(particles, "same.dump", WriteTimeSteps=1)
assert filecmp.cmp("same.dump", particles, shallow=False)
third = Calculator(Input=particles, ResultArrayName="third", Function="radius / 3")
turned = Transform(Input=third)
turned.Transform.Rotate = [10, 20, 30]
granular.update(turned, particles.TimestepValues[-1])
granular.save(turned, "turned.dump")
first, again = granular.fetch(turned), granular.fetch(granular.reader("turned.dump"))
for name in ("points", "third", "v", "radius"):
    assert (first[name] == again[name]).all(), name
    assert first[name].dtype == numpy.float64
SaveData("plain.dump", turned)  # as File, Save Data does
assert filecmp.cmp("plain.dump", "turned.dump", shallow=False)
with open("turned.dump") as file:
    text = file.read()
assert " 0.0025 " in text  # what did not change is as short as it was
try:
    granular.save(particles, "particles.euler")  # no other writer has this ending: it says what it expects
    raise AssertionError("particles were written as cells")
except RuntimeError as error:
    assert "v_avg" in str(error) or "expected" in str(error), error
# a writer of its own asks for the whole after others asked for pieces, also when a file was looked at again in between
algorithm = third.GetClientSideObject()
for touched in (False, True):
    algorithm.UpdatePiece(1, 3, 0)
    if touched:
        particles.GetClientSideObject().Modified()
    writer = granular.vtkGranularDumpWriter()
    writer.SetController(None)
    writer.SetInputConnection(algorithm.GetOutputPort())
    writer.SetFileName("whole.dump")
    assert writer.Write()
    with open("whole.dump") as file:
        assert int(file.read(100).split("\n")[3]) == len(whole["id"]), touched
print("all was saved")
