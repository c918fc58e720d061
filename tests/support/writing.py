# SPDX-License-Identifier: BSD-3-Clause
"""Steps that the tests of all writers share."""
import os
import shutil

import all_ranks
import vtkgranular as vg
from paraview.simple import ProgrammableFilter, servermanager


def good(name):
    return os.path.join(os.environ["GRANULAR_DATA"], "good", name)


def enter_empty_folder():
    shutil.rmtree("files", ignore_errors=True)
    os.mkdir("files")
    os.chdir("files")


def check_nothing_left():
    """No temporary file is in the folder."""
    assert not [name for name in os.listdir(".") if "tmp" in name or name.startswith(".")], os.listdir(".")


def content(path):
    """The bytes of a file that the ranks have written together."""
    all_ranks.wait()
    with open(path, "rb") as file:
        read = file.read()
    all_ranks.wait()
    return read


def files():
    """The names of what is in the folder, and the bytes of its files."""
    return {name: content(name) if os.path.isfile(name) else None for name in os.listdir(".")}


def lonely(kind, **properties):
    """An object of class vtkGranular<kind> that knows of no other process."""
    made = getattr(vg, f"vtkGranular{kind}")()
    made.SetController(None)
    for name, value in properties.items():
        getattr(made, f"Set{name}")(*value if isinstance(value, tuple) else (value,))
    return made


def alone(kind, source, end, port=0, **properties):
    """The bytes that a writer writes in a process that knows of no other."""
    name = f"alone_{all_ranks.ranks.GetLocalProcessId()}{end}"
    writer = lonely(kind, FileName=name, **properties)
    writer.SetInputConnection(source.GetOutputPort(port))
    assert writer.Write() == 1
    with open(name, "rb") as file:
        return file.read()


def changed_on(rank, source, change):
    """The output of `source`, which the Python line `change` changes on one rank of several; -1 is the last one."""
    return ProgrammableFilter(Input=source, CopyArrays=1, Script=f"""
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
data = output.VTKObject
data.DeepCopy(inputs[0].VTKObject)
count = ranks.GetNumberOfProcesses()
if count > 1 and ranks.GetLocalProcessId() == {rank} % count:
    {change}
""")


def empty_on(rank, source):
    """The output of `source` with nothing on one rank of several, not even arrays or field data."""
    return changed_on(rank, source, "data.Initialize()")


def check_refused(proxy, name, error=RuntimeError, **properties):
    """Saving raises the error, and the folder stays as it was."""
    before = files()
    try:
        vg.save(proxy, name, **properties)
    except error as raised:
        assert error is not RuntimeError or len(str(raised)) > 20, raised
        print(raised)
    else:
        raise AssertionError(f"{name} was written with {properties}")
    assert files() == before, os.listdir(".")


def check_properties(writer, source, **defaults):
    """The writer has these defaults, and documents each property."""
    proxy = getattr(servermanager.writers, writer)(Input=source, FileName="never.written")
    for name, default in defaults.items():
        value = getattr(proxy, name)
        assert (list(value) if isinstance(default, list) else value) == default, (name, value)
        text = proxy.SMProxy.GetProperty(name).GetDocumentation()
        assert text and len(text.GetDescription().strip()) > 40, name
    return proxy
