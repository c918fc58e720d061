# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server of two ranks: open, step, an error on the server, delete, open again."""
import os
import re
import subprocess
import sys
import time

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


try:
    Connect("127.0.0.1", int(wait_for(r"Accepting connection\(s\): \S+:(\d+)\n").group(1)))
    good = os.path.join(os.environ["GRANULAR_DATA"], "good")
    series = [os.path.join(good, f"grains_{step}.dump") for step in (0, 1000, 2000)]
    for prefetch in (0, 1):
        reader = OpenDataFile(series)
        reader.Prefetch = prefetch
        assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
        for step, points in ((0, 0), (1000, 1200), (2000, 1200), (1000, 1200)):
            reader.UpdatePipeline(step)
            information = reader.GetDataInformation()
            assert information.GetNumberOfPoints() == points, (step, points)
        assert reader.PointData["id"].GetRange(0) == (1, 1200)
        assert OutputPort(reader, 1).GetDataInformation().GetNumberOfCells() == 1
        reader.FileNames = ["/nowhere/gone.dump"]
        reader.UpdatePipeline()
        assert reader.GetDataInformation().GetNumberOfPoints() == 0
        wait_for(r"gone\.dump: cannot open: No such file or directory \(on rank 0 of 2\)")
        reader.FileNames = series[1:]
        reader.UpdatePipeline(2000)
        assert reader.GetDataInformation().GetNumberOfPoints() == 1200
        Delete(reader)
        del reader
    assert server.poll() is None, log()
    Disconnect()
finally:
    server.terminate() # which does not end with its client
    server.wait()
print("served")
