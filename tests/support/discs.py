# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of spheres, and what arithmetic in doubles says of them: in each pixel the nearest surface."""
import numpy
import ray_caster
from paraview.simple import ColorBy, CreateRenderView, GetColorTransferFunction, Render, SaveScreenshot
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkCamera

ROUNDED = 3  # pixels of a picture where two surfaces, or a surface and nothing, meet within what floats hold
LEVELS = 1.5  # of 255: the table of colours has 256, and each value is rounded


def made(points, source=None, **arrays):
    """A source of particles, or the one given with these in place of its own."""
    from paraview.simple import TrivialProducer  # a proxy: there once ParaView is connected

    data, places = vtkPolyData(), vtkPoints()
    places.SetData(numpy_to_vtk(numpy.asarray(points, float), deep=True))
    data.SetPoints(places)
    for name, values in {**arrays, "id": numpy.arange(1, len(points) + 1)}.items():
        array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    source = source or TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.MarkModified(source)
    source.UpdatePipeline()
    return source


def black_view(pixels):
    """Returns a square render view of so many pixels a side that shows nothing but data."""
    view = CreateRenderView()
    view.ViewSize = [pixels, pixels]
    view.UseColorPaletteForBackground = 0
    view.Background = [0, 0, 0]
    view.OrientationAxesVisibility = 0
    view.UseFXAA = 0  # it would mix neighbours
    return view


def show_white(source, view, lit=False):
    """Shows a source as it is seen without light, or by that of the camera alone."""
    import vtkgranular as vg

    display = vg.show(source, view)
    display.Ambient, display.Diffuse, display.Specular = (0, 1, 0) if lit else (1, 0, 0)
    display.AmbientColor = display.DiffuseColor = [1, 1, 1]
    return display


def seen(view):
    """The camera, and the depths and the red of the pixels, of what is shown: before ParaView draws axes, which clear the depth."""
    depths, colors, renderer, (width, height) = vtkFloatArray(), vtkUnsignedCharArray(), view.GetRenderer(), view.ViewSize

    def take(*_):
        view.GetRenderWindow().GetZbufferData(0, 0, width - 1, height - 1, depths)
        view.GetRenderWindow().GetPixelData(0, 0, width - 1, height - 1, 0, colors, 0)

    watch = renderer.AddObserver("EndEvent", take)
    Render(view)
    renderer.RemoveObserver(watch)
    return (ray_caster.Camera(view.GetActiveCamera(), width, height), vtk_to_numpy(depths).reshape(height, width).astype(float),
            vtk_to_numpy(colors).reshape(height, width, 3)[..., 0].astype(float))


def color_by_id(display, view, last):
    """Colours particles by id: 1 is red, `last` is blue."""
    colors = GetColorTransferFunction("id")
    colors.AutomaticRescaleRangeMode = "Never"
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [1, 1, 0, 0, last, 0, 0, 1]
    ColorBy(display, ("POINTS", "id"))
    display.RescaleTransferFunctionToDataRange(False)
    display.Ambient, display.Diffuse, display.Specular = 1, 0, 0  # colours as they are
    display.LookupTable = colors
    display.SetScalarBarVisibility(view, False)
    colors.RescaleTransferFunction(1, last)


def picture(view, name):
    """Returns the colours of the view's pixels, rows from below, and keeps them as name.png."""
    SaveScreenshot(f"{name}.png", view, ImageResolution=view.ViewSize)
    png = vtkPNGReader()
    png.SetFileName(f"{name}.png")
    png.Update()
    width, height = view.ViewSize
    pixels = vtk_to_numpy(png.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3].astype(float)


class Camera:
    """A camera at `position` that looks at `focal`: parallel, with `scale` as half the height of the
    picture, or in perspective with an `angle` in degrees."""

    def __init__(self, position, focal, scale=None, angle=None):
        self.position, self.focal = numpy.array(position, float), numpy.array(focal, float)
        self.scale, self.angle = scale, angle

    def look(self, view, shift=(0, 0, 0)):
        """Gives the view this camera, moved by `shift`."""
        view.CameraPosition = list(self.position + shift)
        view.CameraFocalPoint = list(self.focal + shift)
        view.CameraViewUp = [0, 1, 0]
        view.CameraParallelProjection = int(self.scale is not None)
        if self.scale is not None:
            view.CameraParallelScale = self.scale
        else:
            view.CameraViewAngle = self.angle

    def seen(self, centres, radii, ids, pixels, axes=None, turns=None, powers=None):
        """Returns of each pixel the id of the particle whose surface is seen there, or 0."""
        look = vtkCamera()
        look.SetPosition(self.position)
        look.SetFocalPoint(self.focal)
        look.SetViewUp(0, 1, 0)
        look.SetParallelProjection(self.scale is not None)
        look.SetParallelScale(self.scale or 1)
        look.SetViewAngle(self.angle or 30)
        look.SetClippingRange(1e-6, 1e6)
        axes = numpy.repeat(numpy.c_[radii], 3, axis=1) if axes is None else axes
        number = ray_caster.cast(ray_caster.Camera(look, pixels, pixels), centres, axes, turns, powers)[2]
        return numpy.append(ids, 0)[number]

    def compare(self, pixels, centres, radii, ids, last, **shapes):
        """Raises AssertionError unless the pixels show these particles, without light and coloured by id as color_by_id does."""
        seen = self.seen(centres, radii, ids, len(pixels), **shapes)
        assert (seen > 0).sum() > 5000, "the truth itself shows little"
        wrong = pixels.any(axis=2) != (seen > 0)
        assert wrong.sum() <= ROUNDED, f"nothing, or something, where it is not: {wrong.sum()} pixels"
        blue = (seen - 1) / (last - 1)
        exact = 255 * numpy.stack([1 - blue, 0 * blue, blue], axis=2)
        away = abs(pixels - exact).max(axis=2)[(seen > 0) & ~wrong] >= LEVELS
        assert away.sum() <= ROUNDED, f"{away.sum()} pixels of {away.size} have another colour"
