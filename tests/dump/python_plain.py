# SPDX-License-Identifier: BSD-3-Clause
"""The package in a plain Python, without ParaView."""
import os
import sys

import vtkgranular as vg

assert not any(name.split(".")[0] == "paraview" for name in sys.modules)
reader = vg.vtkGranularDumpReader()
path = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump")
assert vg.vtkGranularDumpReader.CanReadFile(path)
reader.AddFileName(path)
reader.SetCoordinates(reader.SCALED)
reader.Update()
particles, box = reader.GetOutput(), reader.GetOutputDataObject(1)
assert particles.GetNumberOfPoints() == 1200
assert particles.GetPointData().GetArray("id").GetClassName() == "vtkTypeInt64Array"
assert box.GetNumberOfCells() == 1 and box.GetBounds() == (0, 1, 0, 1, 0, 1)
assert reader.GetErrorCode() == 0

selection = reader.GetPointDataArraySelection()
selection.DisableAllArrays()
selection.EnableArray("radius")
reader.SetRegionOfInterest(-1, 1, -1, 1, 0, 0.01)
reader.Update()
assert particles.GetPointData().GetNumberOfArrays() == 1
assert 0 < particles.GetNumberOfPoints() < 1200

# what editors and type checkers read: every function has hints, every compiled class a stub
import inspect  # noqa: E402
import pydoc  # noqa: E402

folder = os.path.dirname(vg.__file__)
assert vg.__version__.count(".") == 2 and os.path.exists(os.path.join(folder, "py.typed"))
assert set(vg.__all__) <= set(dir(vg)) and "reader" in vg.__all__
for name in vg.__all__:
    function = getattr(vg, name)
    if inspect.isfunction(function):
        hints = inspect.signature(function)
        assert hints.return_annotation is not inspect.Signature.empty, name
        assert all(p.annotation is not inspect.Parameter.empty for p in hints.parameters.values()), name
        summary = function.__doc__.split("\n")[0]
        assert summary.split()[0].endswith("s") and summary.endswith("."), (name, summary)
stub = os.path.join(folder, "vtkGranular.pyi")
if os.path.exists(stub):  # where VTK has its generator
    with open(stub) as file:
        text = file.read()
    assert all(f"class {name}(" in text for name in dir(vg.vtkGranular) if name.startswith("vtkGranular"))
page = pydoc.plain(pydoc.render_doc(vg))
assert "vtkgranular.fetch(reader" in page.split("FUNCTIONS")[0]
lines = 400 if sys.version_info < (3, 13) else 600  # which gives each parameter a line
assert len(page.splitlines()) < lines, "help(vtkgranular) is longer than anybody reads"
