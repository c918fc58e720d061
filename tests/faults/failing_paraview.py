# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that opens, asks, reads or writes a file fails in turn in ParaView, which stays alive: an error names the
file, a file to write is the old one or the new one, and after each fault the same reader shows everything again, and the same file can
be written. Every fault must come up for every file. ParaView keeps what was said, so that memory is not counted."""
import os

from paraview.simple import *

import failing_calls
from said import said_by

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
HERE = os.getcwd()
MOST = 2  # calls of a kind that are tried, where not all are wanted; those of the VTK classes are in failing_classes.cxx

FILES = ["chain.dump", "ortho_scaled.bin", "ortho_000050.dump.gz", "local/chain_bonds.dump", "data_file/full.data",
         "restart/fibres.restart", "euler_1000.vtk", "decomposition_1000.vtk", "decomposition/text.vtu"]

WRITERS = [("new.dump", "chain.dump"), ("new.dump.gz", "chain.dump")]
if failing_calls.wants_all():
    WRITERS += [("new.bin", "chain.dump"), ("new.bonds", "local/chain_bonds.dump"), ("new.euler", "euler_1000.vtk"), ("new.decomposition", "decomposition_1000.vtk")]


def words(said):
    """What was said, without the address of who said it."""
    return [text.split("): ", 1)[-1] for text in said]


def shown(reader):
    counts = []
    for port in range(reader.SMProxy.GetNumberOfOutputPorts()):
        reader[port].UpdatePipeline()
        info = reader[port].GetDataInformation()
        counts += [info.GetNumberOfPoints(), info.GetNumberOfCells(), info.GetNumberOfRows()]
    return counts


def check_reader(file):
    reader = OpenDataFile(os.path.join(GOOD, file))
    said = said_by(reader.GetClientSideObject())

    def update():
        said.clear()
        ReloadFiles(reader)
        reader.UpdatePipeline()
        return shown(reader), words(said)

    update()
    whole, count = update(), 0
    assert sum(whole[0]) > 0, file
    for one in failing_calls.READER_FAULTS:
        for seen in failing_calls.each(one, GOOD, update, whole, MOST, memory=False):
            count += 1
            where = (file, one.name, seen)
            assert seen == whole or not one.harmless, where
            assert seen[0] == whole[0] or any(GOOD in text for text in seen[1]), where
            assert update() == whole, where
    Delete(reader)
    return count


def check_writer(file, source):
    path = os.path.join(HERE, file)
    reader = OpenDataFile(os.path.join(GOOD, source))

    def save():
        """What a writer of its own says, as SaveData has one: some write a timestep once."""
        writer = CreateWriter(path, reader)
        said = said_by(writer.GetClientSideObject())
        writer.UpdatePipeline()
        told = words(said)
        Delete(writer)
        return told

    def content():
        with open(path, "rb") as stream:
            return stream.read()

    def error_in(told):
        return next((text for text in reversed(told) if path in text), None)

    count = failing_calls.check_writer(path, save, failing_calls.WRITER_FAULTS, save(), error_in, content, MOST, memory=False)
    Delete(reader)
    return count


for file in FILES:
    print(check_reader(file), "faults in", file)
for file, source in WRITERS:
    print(check_writer(file, source), "faults in", file)
print("faults in writers: alive")
