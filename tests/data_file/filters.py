# SPDX-License-Identifier: BSD-3-Clause
"""Data files as ParaView's users meet them: styles, outputs, and what follows the reader."""
import os

import numpy
from paraview.simple import *
from paraview.vtk.util.numpy_support import vtk_to_numpy

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
sphere = os.path.join(data, "data_file", "sphere.data")

# ---- styles and outputs --------------------------------------------------------------------------------------

reader = OpenDataFile(sphere)
styles = reader.SMProxy.GetProperty("AtomStyle").FindDomain("vtkSMStringListDomain")
assert [styles.GetString(i) for i in range(styles.GetNumberOfStrings())][:2] == ["automatic", "atomic"]
view = CreateRenderView()
assert Show(reader, view).Representation == "Grains"
assert Show(OutputPort(reader, "Box"), view).Representation == "Wireframe"
OutputPort(reader, "Bonds").GetDataInformation()

# ---- what follows it: cells, and bonds between particles that a filter has moved ------------------------------

six = OpenDataFile(os.path.join(data, "data_file", "granular.data"), AtomStyle="granular")
average = GranularEulerAverage(Input=six)
average.UpdatePipeline()
cells = servermanager.Fetch(average)
filled = vtk_to_numpy(cells.GetCellData().GetArray("volumefraction")).sum() * numpy.prod(cells.GetSpacing())
assert numpy.isclose(filled, 6 * 4 / 3 * numpy.pi * 0.15**3, rtol=1e-12), filled

chain = OpenDataFile(os.path.join(data, "local", "chain.data"), AtomStyle="bond")
moved = Transform(Input=chain)
lines = GranularLocalJoin(Input=moved, Lines=OutputPort(chain, 1))
lines.UpdatePipeline()
joined = servermanager.Fetch(lines)
assert joined.GetNumberOfCells() == 96
assert (vtk_to_numpy(joined.GetCellData().GetArray("length")) == 1).all()
# they join with the particles of the run's dumps, too
dump = OpenDataFile(os.path.join(data, "local", "chain.dump"))
lines = GranularLocalJoin(Input=dump, Lines=OutputPort(chain, 1))
lines.UpdatePipeline(500)
assert lines.GetDataInformation().GetNumberOfCells() == 96

# ---- a style that the file does not say -----------------------------------------------------------------------

with open(sphere) as file:
    text = file.read().replace("Atoms # sphere", "Atoms")
head, rows = text.split("Atoms\n")
with open("silent.data", "w") as file:
    file.write(head.replace("40 atoms", "1 atoms") + "Atoms\n\n1 2 1 5 3 4 5\n")
unsure = OpenDataFile(os.path.abspath("silent.data"))
unsure.UpdatePipeline()
assert unsure.GetDataInformation().GetNumberOfPoints() == 0
unsure.AtomStyle = "sphere"
unsure.UpdatePipeline()
assert unsure.GetDataInformation().GetNumberOfPoints() == 1
assert "radius" in unsure.PointArrayStatus.Available
print("set once", flush=True)
guessed = OpenDataFile(os.path.join(data, "local", "chain.data"))
guessed.UpdatePipeline()
assert guessed.GetDataInformation().GetNumberOfPoints() == 100
print("opened")
