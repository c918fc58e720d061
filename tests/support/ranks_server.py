# SPDX-License-Identifier: BSD-3-Clause
"""A server of several ranks for a script that is its client."""
import contextlib
import re
import subprocess
import sys
import time

from vtkgranular._ranks import mpirun_environment
from paraview.simple import Connect, Disconnect


class RanksServer:
    """The command of the server is what the script got as its arguments."""

    def __init__(self):
        self.process = subprocess.Popen([*sys.argv[1:], "--server-port=0"], env=mpirun_environment(),
                                        stdout=open("server.log", "w"), stderr=subprocess.STDOUT)

    def log(self):
        with open("server.log") as file:
            return file.read()

    def check(self):
        assert self.process.poll() is None, self.log()

    def wait_for(self, pattern):
        """Until the server says so."""
        found = re.search(pattern, self.log())
        while not found:
            self.check()
            time.sleep(0.05)
            found = re.search(pattern, self.log())
        return found


@contextlib.contextmanager
def connected():
    server = RanksServer()
    try:
        found = server.wait_for(r"Accepting connection\(s\): \S+:(\d+)\n")
        Connect("127.0.0.1", int(found.group(1)))
        yield server
        server.check()
        Disconnect()
    finally:
        server.process.terminate()  # which does not end with its client
        server.process.wait()
