# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that opens, asks, reads or writes a file fails in turn in ParaView, which stays alive: an error names the
file, a file to write is the old one or the new one, and after each fault the same reader shows everything again, and the same file can
be written. Then the calls that wait for the disk are counted. ParaView keeps what was said, so that memory is not counted."""
import os

from paraview.simple import *

import failing_calls
from said import said_by

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
PATH = os.path.join(os.getcwd(), "new.dump")
MOST = 2  # calls of a kind that are tried, where not all are wanted; those of the VTK classes are in failing_classes.cxx


def words(said):
    """What was said, without the address of who said it."""
    return [text.split("): ", 1)[-1] for text in said]


def check_reader(reader):
    said = said_by(reader.GetClientSideObject())

    def update():
        said.clear()
        ReloadFiles(reader)
        reader.UpdatePipeline()
        information = reader.GetDataInformation()
        return (information.GetNumberOfPoints(), information.GetNumberOfCells()), words(said)

    update()
    whole, count = update(), 0
    assert whole[0][0] > 0
    for one in failing_calls.READER_FAULTS:
        for seen in failing_calls.each(one, GOOD, update, whole, MOST, memory=False):
            count += 1
            assert seen == whole or not one.harmless, (one.name, seen)
            assert seen[0] == whole[0] or any(GOOD in text for text in seen[1]), (one.name, seen)
            assert update() == whole, (one.name, seen)
    print(count, "faults in a reader")


def save(reader):
    """What a writer of its own says, as SaveData has one: some write a timestep once."""
    writer = CreateWriter(PATH, reader)
    said = said_by(writer.GetClientSideObject())
    writer.UpdatePipeline()
    told = words(said)
    Delete(writer)
    return told


def content():
    with open(PATH, "rb") as stream:
        return stream.read()


def error_in(told):
    return next((text for text in reversed(told) if PATH in text), None)


reader = OpenDataFile(os.path.join(GOOD, "chain.dump"))
check_reader(reader)
print(failing_calls.check_writer(PATH, lambda: save(reader), failing_calls.WRITER_FAULTS, save(reader), error_in, content, MOST, memory=False),
      "faults in a writer")
assert failing_calls.count(failing_calls.SYNC, lambda: save(reader)) == 2  # for the bytes of the file, and for its name
assert CreateExtractor("GranularDump", reader).Writer.Durable == "Off"  # extracts are written in a loop, by programs that run
print("alive")
