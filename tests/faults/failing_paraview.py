# SPDX-License-Identifier: BSD-3-Clause
"""Each call of the system that opens, asks, reads or writes a file fails in turn in ParaView, which stays alive: after each fault the
same reader shows everything again, and the same file can be written."""
import os

from paraview.simple import *

import failing_calls

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good") + "/"
HERE = os.getcwd() + "/"
MOST = 5  # calls of a kind that are tried, where not all are wanted

FILES = ["chain.dump", "ortho_scaled.bin", "ortho_000050.dump.gz", "local/chain_bonds.dump", "data_file/full.data",
         "restart/fibres.restart", "euler_1000.vtk", "decomposition_1000.vtk", "decomposition/text.vtu"]


def shown(reader):
    counts = []
    for port in range(reader.SMProxy.GetNumberOfOutputPorts()):
        reader[port].UpdatePipeline()
        info = reader[port].GetDataInformation()
        counts += [info.GetNumberOfPoints(), info.GetNumberOfCells(), info.GetNumberOfRows()]
    return counts


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
        for seen in failing_calls.each(kinds, fault, number, GOOD, update, most=MOST):
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

    def content():
        with open(path, "rb") as stream:
            return stream.read()

    def prepare():
        with open(path, "wb") as stream:
            stream.write(b"old")

    def save():
        try:
            SaveData(path, reader)
        except RuntimeError:
            pass

    for kinds, fault, number, harmless in failing_calls.WRITER_FAULTS:
        for _ in failing_calls.each(kinds, fault, number, HERE, save, most=MOST, prepare=prepare):
            faults += 1
            assert content() == whole or (content() == b"old" and not harmless), (path, kinds, fault)
            save()
            assert content() == whole, (path, kinds, fault)
print(faults, "faults in writers: alive")
