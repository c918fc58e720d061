# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that opens, asks, reads or writes a file fails in turn in ParaView, which stays alive: after each fault the
same reader shows everything again, and the same file can be written."""
import os

from paraview.simple import *

import failing_calls

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good") + "/"
HERE = os.getcwd() + "/"

FILES = ["chain.dump", "ortho_scaled.bin", "ortho_000050.dump.gz", "local/contacts.dump", "data_file/full.data",
         "restart/fibres.restart", "euler_1000.vtk", "decomposition_1000.vtk", "decomposition/text.vtu"]


def shown(reader):
    info = reader.GetDataInformation()
    return info.GetNumberOfPoints(), info.GetNumberOfCells()


faults = 0
for file in FILES:
    reader = OpenDataFile(GOOD + file)
    reader.UpdatePipeline()
    whole = shown(reader)
    assert sum(whole) > 0, file

    def update():
        ReloadFiles(reader)
        reader.UpdatePipeline()
        return shown(reader)

    for kinds, fault, number, harmless in failing_calls.READER_FAULTS:
        for seen in failing_calls.each(kinds, fault, number, GOOD, update):
            faults += 1
            assert seen == whole or not harmless, (file, kinds, fault, seen)
            assert update() == whole, (file, kinds, fault, seen)
    Delete(reader)
print(faults, "faults in readers")

faults = 0
reader = OpenDataFile(GOOD + "chain.dump")
for path in (HERE + "new.dump", HERE + "new.bin", HERE + "new.dump.gz"):
    SaveData(path, reader)
    with open(path, "rb") as stream:
        whole = stream.read()

    def save():
        with open(path, "wb") as stream:
            stream.write(b"old")
        try:
            SaveData(path, reader)
        except RuntimeError:
            pass
        with open(path, "rb") as stream:
            return stream.read()

    for kinds, fault, number, harmless in failing_calls.WRITER_FAULTS:
        for written in failing_calls.each(kinds, fault, number, "/.granular-", save):
            faults += 1
            assert written == whole or (written == b"old" and not harmless), (path, kinds, fault)
            assert save() == whole, (path, kinds, fault)
print(faults, "faults in writers: alive")
