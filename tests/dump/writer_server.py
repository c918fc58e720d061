# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks saves: the server writes, and the client hears how it went."""
import os
import re
import subprocess
import sys
import time

import granular
from paraview.simple import *

# this process is one of MPI, too: what that has left in the environment is not for the server's
ours = ("OMPI_ALLOW", "OMPI_MCA_rmaps", "OMPI_MCA_btl", "OMPI_MCA_mpi")
environment = {name: value for name, value in os.environ.items()
               if name.startswith(ours) or not name.startswith(("OMPI_", "ORTE_", "PMIX_"))}
server = subprocess.Popen([*sys.argv[1:], "--server-port=0"], env=environment,
                          stdout=open("server.log", "w"), stderr=subprocess.STDOUT)


def log():
    with open("server.log") as file:
        return file.read()


def wait_for(pattern):
    found = re.search(pattern, log())
    while not found:
        assert server.poll() is None, log()
        time.sleep(0.05)
        found = re.search(pattern, log())
    return found


def content(path):
    with open(path, "rb") as file:
        return file.read()


try:
    Connect("127.0.0.1", int(wait_for(r"Accepting connection\(s\): \S+:(\d+)\n").group(1)))
    source = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
    reader = OpenDataFile(source)
    for mode in ("Gather", "MPI-IO"):
        name = os.path.abspath(f"{mode}.dump")
        SaveData(name, reader, WriteTimeSteps=1, Dialect="LIGGGHTS", ParallelMode=mode)
        assert content(name) == content(source), mode
        granular.save(reader, os.path.abspath("dump.grains"), WriteTimeSteps=1, Dialect="LIGGGHTS",
                      ParallelMode=mode)
        assert content("dump.grains") == content(source), mode
    reader.UpdatePipeline(2000)
    granular.save(reader, os.path.abspath("part_%.dump"))
    assert sorted(name for name in os.listdir(".") if name.startswith("part_")) == \
        ["part_0.dump", "part_1.dump"]
    try:
        granular.save(reader, "/nowhere/gone.dump")
    except RuntimeError as error:
        assert "/nowhere/gone.dump could not be written" in str(error), error
    else:
        raise AssertionError("nothing was raised")
    wait_for(r"/nowhere/gone\.dump: cannot write: No such file or directory \(on rank 0 of 2\)")
    granular.save(reader, os.path.abspath("again.dump"))
    assert b"\n2000\n" in content("again.dump")
    assert server.poll() is None, log()
    Delete(reader)
    del reader
    Disconnect()
finally:
    server.terminate() # which does not end with its client
    server.wait()
print("saved on the server")
