# SPDX-License-Identifier: BSD-3-Clause
"""vg.reader and vg.update: the reader that fits, and errors as exceptions, each once."""
import gc
import os
import subprocess
import sys

import vtkgranular as vg
from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
BAD = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n1 0 zero 0\n"


def good(name):
    return os.path.join(data, name)


def write(name, text):
    with open(name, "w") as file:
        file.write(text)
    return os.path.abspath(name)


def refused(call, kind, *parts):
    try:
        call()
    except kind as error:
        assert all(part in str(error) for part in parts), error
    else:
        raise AssertionError(f"nothing was raised: {parts}")


if sys.argv[1:] == ["said"]:
    # all that a person does with a broken file, in the plain way: one message is printed
    for name in ("broken.dump", "header.dump"):
        reader = GranularDumpReader(FileNames=[os.path.abspath(name)])
        for _ in range(2):
            reader.UpdatePipelineInformation()
            reader.UpdatePipeline()
        Clip(Input=reader).UpdatePipeline()
    sys.exit()

# ---- which reader ------------------------------------------------------------------------------
samples = os.path.join(data, "..", "..", "..", "samples", "data")
for path, kind in ((good("grains.dump"), "GranularDumpReader"), (good("grains_1000.dump"), "GranularDumpReader"),
                   (good("ortho_custom.bin"), "GranularDumpReader"), (good("local/contacts.dump"), "GranularLocalReader"),
                   (good("decomposition_1000.vtk"), "GranularDecompositionReader"), (good("euler_1000.vtk"), "GranularEulerReader"),
                   (os.path.join(samples, "restart/fibres.40000.restart"), "GranularRestartReader"),
                   (os.path.join(samples, "bonds/chain.data"), "GranularDataFileReader")):
    reader = vg.reader(path)
    assert reader.GetXMLName() == kind, (path, reader.GetXMLName())
    Delete(reader)

# patterns as the dump command has them, and lists of them; a step of 2e-5
reader = vg.reader(good("euler_*.vtk"), dt=2e-5)
assert list(reader.TimestepValues) == [0.02, 0.04, 0.06, 0.08], reader.TimestepValues
reader = vg.reader(good("pieces_*.%.dump"), SortById=1, Stride=7)
assert len(reader.FileNames) == 12 and len(reader.TimestepValues) == 3
assert reader.SortById == 1 and reader.Stride == 7
reader = vg.reader([good("ortho_000050.dump.gz"), good("ortho_0001*.dump")])
assert list(reader.TimestepValues) == [50, 100]
assert GetSources()[("ortho_000050.dump.gz", str(reader.GetGlobalID()))] == reader  # it is in the pipeline browser

# ---- errors ------------------------------------------------------------------------------------
before = len(GetSources())
broken, header = write("broken.dump", BAD), write("header.dump", "ITEM: TIMESTEP\nx\n")
refused(lambda: vg.reader(header), RuntimeError, f"{header}:2: expected an integer timestep, got 'x'")
refused(lambda: vg.reader("gone.dump"), FileNotFoundError, "gone.dump: no such file or folder")
refused(lambda: vg.reader("gone_*.dump"), FileNotFoundError, "gone_*.dump")
refused(lambda: vg.reader([]), ValueError, "no files")
refused(lambda: vg.reader(broken, NoProperty=1), AttributeError, "NoProperty")
assert len(GetSources()) == before  # what failed is not left in the pipeline
message = f"{broken}:10: column 'y': expected a number, got 'zero'"
reader = vg.reader(broken)
refused(lambda: vg.update(reader), RuntimeError, message)
refused(lambda: vg.update(reader), RuntimeError, message)  # again
refused(lambda: vg.update(OutputPort(reader, 1)), RuntimeError, message)
clip = Clip(Input=Calculator(Input=reader))
refused(lambda: vg.update(clip), RuntimeError, message)  # through filters of ParaView's
reader.FileNames = [good("grains_1000.dump")]
vg.update(clip)  # and it is forgotten
assert reader.GetPropertyValue("ErrorMessage") == ""
average = GranularEulerAverage(Input=reader, CellsBy="CellSizeRelative", CellSizeRelative=0)
refused(lambda: vg.update(average), RuntimeError, "expected a CellSizeRelative above 0")

# a second argument that is no time of a step
refused(lambda: vg.reader(good("grains.dump"), "Contacts"), TypeError, "dt", "'Contacts'")

# times
series = vg.reader(good("grains.dump"))
vg.update(series, 2000)
assert series.FieldData["timestep"].GetRange() == (2000, 2000)

# no proxy waits for the garbage collector, which may come while ranks update together, and would then have them wait for ever
for use in (lambda: vg.update(clip), lambda: vg.fetch(clip), lambda: vg.save(clip, "kept.dump"),
            lambda: vg.save(clip, "kept.vtu"), lambda: vg.reader(good("grains_1000.dump"))):
    gc.collect()
    gc.disable()
    use()
    gc.set_debug(gc.DEBUG_SAVEALL)
    gc.collect()
    kept = [type(each).__name__ for each in gc.garbage if "Proxy" in type(each).__name__ or "vtkSM" in type(each).__name__]
    gc.set_debug(0)
    gc.garbage.clear()
    gc.enable()
    assert not kept, kept

said = subprocess.run([sys.executable if "pvpython" in sys.executable else "pvpython", __file__, "said"], capture_output=True,
                      text=True)
errors = [line for line in said.stderr.splitlines() if "ERR|" in line]
assert said.returncode == 0 and len(errors) == 2, said.stderr
assert "broken.dump:10: column 'y'" in errors[0] and "header.dump:2" in errors[1], errors
print("all errors were raised")
