# SPDX-License-Identifier: BSD-3-Clause
"""open_dump.py NAME [HOST:PORT] opens the dump NAME, in this process or on a server, as a user does after installing
the packages: nothing here loads a plugin. Prints "opened" if ParaView had loaded the plugin and the data are right."""
import os
import sys
import traceback


def open_dump(name, server=None):
    from paraview import simple
    from paraview.modules.vtkRemotingCore import vtkPVPluginTracker

    tracker = vtkPVPluginTracker.GetInstance()
    loaded = [tracker.GetPluginFileName(i) for i in range(tracker.GetNumberOfPlugins())
              if tracker.GetPluginLoaded(i) and tracker.GetPluginName(i) == "Granular"]
    assert len(loaded) == 1 and loaded[0].startswith("/usr/"), loaded
    if server:
        host, port = server.split(":")
        simple.Connect(host, int(port))
        session = simple.servermanager.ActiveConnection.Session
        assert session.IsA("vtkSMSessionClient"), session.GetClassName()

    reader = simple.OpenDataFile(name)
    assert reader.GetXMLName() == "GranularDumpReader", reader
    assert len(reader.TimestepValues) == 5, reader.TimestepValues
    reader.UpdatePipeline(reader.TimestepValues[-1])
    information = reader.GetDataInformation()
    assert information.GetNumberOfPoints() == 1200, information.GetNumberOfPoints()
    assert reader.PointData["radius"].GetRange() == (0.0025, 0.0035), reader.PointData["radius"].GetRange()

    import vtkgranular as vg
    assert vg.__file__ == "/usr/lib/python3/dist-packages/vtkgranular/__init__.py", vg.__file__
    assert os.path.samefile(vg.load_plugin(), loaded[0])


# ParaView's window passes no arguments to a script, captures its output, and stays open after it.
in_window = "OPEN_DUMP" in os.environ
arguments = os.environ["OPEN_DUMP"].split() if in_window else sys.argv[1:]
try:
    open_dump(*arguments)
    os.write(1, b"opened\n")
    status = 0
except BaseException:
    os.write(2, traceback.format_exc().encode())
    status = 1
if in_window:
    os._exit(status)
sys.exit(status)
