# SPDX-License-Identifier: BSD-3-Clause
"""Without ParaView: a dump in a pipeline of VTK's own classes, drawn as spheres with the radii of the particles."""
import sys
from pathlib import Path

import vtkgranular as vg
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (draws what vtkRenderingCore describes)
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersPoints import vtkExtractPoints
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkDataSetMapper, vtkPointGaussianMapper,
                                         vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

path = sys.argv[1] if sys.argv[1:] else str(Path(__file__).parent / "data/grains.dump")

# A reader is an algorithm like any other: look at the times it offers, and update to the last.
reader = vg.vtkGranularDumpReader()
reader.AddFileName(path)
reader.SetTimestepSize(2e-5)  # seconds, from the input script
reader.UpdateInformation()
times = reader.GetOutputInformation(0).Get(reader.GetExecutive().TIME_STEPS())
reader.UpdateTimeStep(times[-1])
particles = reader.GetOutput()

# VTK's filters follow it: the particles behind the plane y = 0 alone.
plane = vtkPlane()
plane.SetNormal(0, -1, 0)
behind = vtkExtractPoints()
behind.SetInputConnection(reader.GetOutputPort(0))
behind.SetImplicitFunction(plane)

# Each point is a disc of its radius, shaded like a sphere and coloured by its speed.
colors = vtkLookupTable()
colors.SetVectorModeToMagnitude()
colors.SetHueRange(0.66, 0.0)  # blue to red
spheres = vtkPointGaussianMapper()
spheres.SetInputConnection(behind.GetOutputPort())
spheres.SetScaleArray("radius")
spheres.SetScaleFactor(1.0)
spheres.EmissiveOff()
spheres.SetSplatShaderCode("""
    //VTK::Color::Impl
    float edge = 1.0 - dot(offsetVCVSOutput, offsetVCVSOutput);
    if (edge < 0.0) { discard; }
    diffuseColor *= sqrt(edge);
    ambientColor *= sqrt(edge);
""")
spheres.SetScalarModeToUsePointFieldData()
spheres.SelectColorArray("v")
spheres.SetLookupTable(colors)
spheres.SetScalarRange(0, 1.5)
spheres.UseLookupTableScalarRangeOff()

# The second output of the reader is the simulation box.
box = vtkDataSetMapper()
box.SetInputConnection(reader.GetOutputPort(1))
box.ScalarVisibilityOff()
frame = vtkActor()
frame.SetMapper(box)
frame.GetProperty().SetRepresentationToWireframe()
frame.GetProperty().SetColor(0.3, 0.3, 0.3)
frame.GetProperty().LightingOff()

actor = vtkActor()
actor.SetMapper(spheres)
renderer = vtkRenderer()
renderer.SetBackground(1, 1, 1)
renderer.AddActor(actor)
renderer.AddActor(frame)
camera = renderer.GetActiveCamera()
camera.SetPosition(0.22, -0.30, 0.19)
camera.SetFocalPoint(0.0, 0.0, 0.069)
camera.SetViewUp(0, 0, 1)
renderer.ResetCameraClippingRange()
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(700, 680)
window.AddRenderer(renderer)
window.Render()

picture = vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtkPNGWriter()
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName("plain_vtk.png")
writer.Write()

# Writers take what filters give: the particles behind the plane as a dump, which holds the same.
dump = vg.vtkGranularDumpWriter()
dump.SetInputConnection(behind.GetOutputPort())
dump.SetFileName("behind.dump")
assert dump.Write()

header, *rows = Path(path).read_text().split("ITEM: ATOMS ")[-1].splitlines()
y = header.split().index("y")
expected = sum(float(row.split()[y]) > 0 for row in rows)
written = Path("behind.dump").read_text().split("ITEM: ATOMS ")[-1].splitlines()[1:]
assert particles.GetNumberOfPoints() == len(rows)
assert behind.GetOutput().GetNumberOfPoints() == len(written) == expected > 0
print(f"{expected} of {len(rows)} particles are behind the plane; see plain_vtk.png and behind.dump")
