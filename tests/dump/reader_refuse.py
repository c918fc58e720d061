# SPDX-License-Identifier: BSD-3-Clause
"""Files of other programs under the same names are not taken, and ParaView says so itself."""
import os

from paraview.simple import *

texts = {
    "database.dump": "-- PostgreSQL database dump\n",
    "empty.dump": "",
}
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
factory.UpdateAvailableReaders()
session = servermanager.ActiveConnection.Session
for name, text in texts.items():
    with open(name, "w") as file:
        file.write(text)
    path = os.path.abspath(name)
    assert factory.TestFileReadability(path, session)
    assert not factory.CanReadFile(path, session), name
good = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
assert factory.CanReadFile(good, session)
assert factory.GetReaderName() == "GranularDumpReader"

# what counts other things than particles is another reader's
with open("local.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp ff\n"
               "0 1\n0 1\n0 1\nITEM: ENTRIES c_1\n1\n")
assert factory.CanReadFile(os.path.abspath("local.dump"), session)
assert factory.GetReaderName() == "GranularLocalReader"
