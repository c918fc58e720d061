# SPDX-License-Identifier: BSD-3-Clause
"""Files of other programs under the same names are not taken. ParaView says so itself where we do not know them; where we do, the
error says what they are, by the same words in the window, in scripts and in the command."""
import contextlib
import io
import os

import vtkgranular as vg
from vtkgranular.command import main

from paraview.simple import *

texts = {
    "database.dump": "-- PostgreSQL database dump\n",
    "mesh.vtk": "# vtk DataFile Version 5.1\nmine\nASCII\nDATASET TABLE\n",
}
factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
factory.UpdateAvailableReaders()
session = servermanager.ActiveConnection.Session


def names_of_readers(path):
    found = factory.GetReaders(path, session)
    return [found.GetString(i) for i in range(1, found.GetNumberOfStrings(), 3)]


for name, text in texts.items():
    with open(name, "w") as file:
        file.write(text)
    path = os.path.abspath(name)
    assert factory.TestFileReadability(path, session)
    assert not factory.CanReadFile(path, session) or factory.GetReaderName() == "LegacyVTKFileReader", name

known = {
    "empty.dump": ("", "an empty file"),
    "log.mine": ("LAMMPS (4 Jul 2026)\n", "a log of LAMMPS: vtkgranular.read_log reads it"),
    "thermo.yaml": ("---\nkeywords: ['Step', ]\n", "a thermo table in YAML"),
    "run.restart": ("LammpS RestartT", "a restart file of LAMMPS: `lmp -restart2data FILE NEW.data`"),
}
for name, (text, what) in known.items():
    with open(name, "w") as file:
        file.write(text)
    path = os.path.abspath(name)
    assert len(names_of_readers(path)) == 1, (name, names_of_readers(path))  # ParaView asks for one if several take a file
    said = []
    for read in (vg.open, vg.reader):
        try:
            read(path)
        except RuntimeError as error:
            said.append(str(error))
    with contextlib.redirect_stderr(io.StringIO()) as command:
        assert main(["info", path]) == 1
    assert said[0].startswith(f"{path}: expected a ") and f", got {what}" in said[0], said
    assert said[1] == said[0] and said[0] in command.getvalue(), (said, command.getvalue())
    assert vg.kind_of(path) in (None, "restart")
good = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
assert factory.CanReadFile(good, session)
assert factory.GetReaderName() == "GranularDumpReader"

# what counts other things than particles is another reader's
with open("local.dump", "w") as file:
    file.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp ff\n"
               "0 1\n0 1\n0 1\nITEM: ENTRIES c_1\n1\n")
assert factory.CanReadFile(os.path.abspath("local.dump"), session)
assert factory.GetReaderName() == "GranularLocalReader"
