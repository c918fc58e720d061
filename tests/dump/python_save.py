# SPDX-License-Identifier: BSD-3-Clause
"""vg.save chooses the writer by the data, then by the ending; numbers are exact unless told otherwise."""
import filecmp
import glob
import os
import tempfile
import xml.etree.ElementTree

import numpy
import vtkgranular as vg
from vtkgranular.command import main
from paraview.simple import *

good = os.path.join(os.environ["GRANULAR_DATA"], "good")
samples = os.path.join(good, "..", "..", "..", "samples", "data")


def begins(name, text):
    with open(name, "rb") as file:
        got = file.read(len(text))
    assert got == text, (name, got)


def refused(proxy, name, *parts):
    try:
        vg.save(proxy, name)
    except ValueError as error:
        assert all(part in str(error) for part in parts), error
        assert not os.path.exists(name), name
    else:
        raise AssertionError(f"{name} was written")


all_particles = os.path.join(good, "grains.dump")
particles = vg.reader(all_particles)
vg.update(particles, particles.TimestepValues[-1])
contacts = vg.reader(os.path.join(samples, "bonds", "settled_contacts.dump.gz"), Preset="ContactsForce")
vg.update(contacts, contacts.TimestepValues[-1])
cells = GranularEulerAverage(Input=particles, CellCounts=[2, 2, 2])
domains = GranularDecomposition(Input=particles, ProcessorGrid=[2, 1, 2])

for name in ("a.dump", "a.lammpstrj", "a.liggghts", "dump.1000", "dump_of_mine", "a.dmp"):
    vg.save(particles, name)
    begins(name, b"ITEM: TIMESTEP")
vg.save(particles, "a.dump.gz")
begins("a.dump.gz", b"\x1f\x8b")
vg.save(particles, "a.bin")
begins("a.bin", b"\xf6\xff\xff\xff\xff\xff\xff\xffDUMPCUSTOM")
for name, text in (("a.vtp", b"<"), ("a.vtk", b"# vtk DataFile"), ("a.csv", b"x,y,z,id,type,"), ("a.ply", b"ply")):
    vg.save(particles, name)
    begins(name, text)
for name in ("a.bonds", "a.dump", "a.dump.gz"):
    vg.save(contacts, name)
    vg.save(OutputPort(contacts, 1), "rows_" + name)
begins("a.bonds", b"ITEM: TIMESTEP")
begins("rows_a.dump", b"ITEM: TIMESTEP")
with open("rows_a.dump") as file:
    assert "ITEM: NUMBER OF ENTRIES" in file.read()
for name in ("a_domains.vtk", "a.decomposition"):
    vg.save(domains, name)
    begins(name, b"# vtk DataFile")
vg.save(domains, "a.vtu")
begins("a.vtu", b"<")
vg.save(cells, "a.euler")
vg.save(cells, "a_cells.vtk")
for name in ("a.euler", "a_cells.vtk"):
    begins(name, b"# vtk DataFile")
vg.save(cells, "a.vti")
begins("a.vti", b"<")
vg.save(Tube(Input=contacts), "a_tubes.vtp")
vg.save(GroupDatasets(Input=[particles, cells]), "a_group.vtm")
for name in ("a.vtp", "a.vti", "a_tubes.vtp", *glob.glob("a_group/*")):  # all versions of libexpat read what is XML for Python's
    xml.etree.ElementTree.parse(name)
    assert b"AppendedData" not in open(name, "rb").read(), name  # VTK's own parser refuses them with some versions of libexpat
last = particles.TimestepValues[-1]
whole = vg.fetch(particles, time=last)
for compressor in ("None", "ZLib", "LZ4", "LZMA"):
    vg.save(particles, "packed.vtp", last, CompressorType=compressor)
    assert b"AppendedData" not in open("packed.vtp", "rb").read(), compressor
    again = vg.fetch(XMLPolyDataReader(FileName=["packed.vtp"]))
    assert all(numpy.array_equal(again[name], whole[name]) for name in whole), compressor
for name, kind in (("b.vtp", XMLPolyDataReader), ("b.vtu", XMLUnstructuredGridReader)):
    assert main(["convert", all_particles, name, "--frames", "-1", "--quiet"]) == 0
    assert b"AppendedData" not in open(name, "rb").read(), name
    again = vg.fetch(kind(FileName=[name]))
    assert all(numpy.array_equal(again[name], whole[name]) for name in ("points", "id", "v", "radius"))
# a link to another name, on another disk where there is one: the ending is the user's
with tempfile.TemporaryDirectory(dir="/dev/shm") as disk:
    os.symlink(os.path.join(disk, "behind.txt"), "link.csv")
    vg.save(particles, "link.csv", last)
    begins("link.csv", b"x,y,z,id,")
    assert os.path.islink("link.csv") and os.listdir(disk) == ["behind.txt"]
    os.remove("link.csv")
os.symlink("nowhere", "numbered_0.dump")
vg.save(particles, "numbered_*.dump", last)
os.remove("numbered_0.dump")
vg.save(particles, "chosen.vtp", DataMode="Ascii")
with open("chosen.vtp") as file:
    assert 'format="ascii"' in file.read()

# all frames by ParaView's writers, which call WriteTimeSteps by several names and number the files themselves
for name, files in (("all.vtp", 3), ("table.csv", 1), ("table_*.csv", 3), ("words.tsv", 1)):
    vg.save(particles, name, WriteTimeSteps=1)
    assert len(glob.glob("*".join(os.path.splitext(name)))) >= files, name
    if "csv" in name:  # as the command writes them
        assert main(["convert", all_particles, "of_command_" + name, "--quiet"]) == 0
        for each in glob.glob("of_command_" + name):
            assert filecmp.cmp(each, each[len("of_command_"):], shallow=False), each
vg.save(particles, "words.tsv", last)
assert numpy.array_equal(numpy.genfromtxt("words.tsv", names=True)["radius"], whole["radius"])
refused(particles, "all_*.vtp", "WriteTimeSteps", "got 'all_*.vtp'")

# what no writer has for such data
refused(particles, "b.xyz", "particles", ".dump", ".vtp", "got 'b.xyz'")
refused(particles, "b.vti", "particles", ".lammpsbin")
refused(particles, "noending", "particles")
refused(contacts, "b.vtu.gz", "lines or rows", ".bonds")
vg.save(particles, "a.xyz", writer="GranularDumpWriter")
begins("a.xyz", b"ITEM: TIMESTEP")

# frames without particles or contacts are what the others are
vg.update(particles, 0)
vg.save(particles, "empty.dump", time=0)
vg.save(contacts, "empty.bonds", time=contacts.TimestepValues[0])

# the whole run, and a filter's new array, by default: nothing is lost
vg.save(particles, "same.dump", WriteTimeSteps=1)
assert filecmp.cmp("same.dump", all_particles, shallow=False)
third = Calculator(Input=particles, ResultArrayName="third", Function="radius / 3")
turned = Transform(Input=third)
turned.Transform.Rotate = [10, 20, 30]
vg.update(turned, particles.TimestepValues[-1])
vg.save(turned, "turned.dump")
first, again = vg.fetch(turned), vg.fetch(vg.reader("turned.dump"))
for name in ("points", "third", "v", "radius"):
    assert (first[name] == again[name]).all(), name
    assert first[name].dtype == numpy.float64
SaveData("plain.dump", turned)  # as File, Save Data does
assert filecmp.cmp("plain.dump", "turned.dump", shallow=False)
with open("turned.dump") as file:
    text = file.read()
assert " 0.0025 " in text  # what did not change is as short as it was
try:
    vg.save(particles, "particles.euler")  # no other writer has this ending: it says what it expects
    raise AssertionError("particles were written as cells")
except RuntimeError as error:
    assert "v_avg" in str(error) or "expected" in str(error), error
# a writer of its own asks for the whole after others asked for pieces, also when a file was looked at again in between
algorithm = third.GetClientSideObject()
for touched in (False, True):
    algorithm.UpdatePiece(1, 3, 0)
    if touched:
        particles.GetClientSideObject().Modified()
    writer = vg.vtkGranularDumpWriter()
    writer.SetController(None)
    writer.SetInputConnection(algorithm.GetOutputPort())
    writer.SetFileName("whole.dump")
    assert writer.Write()
    with open("whole.dump") as file:
        assert int(file.read(100).split("\n")[3]) == len(whole["id"]), touched
print("all was saved")
