# SPDX-License-Identifier: BSD-3-Clause
"""Fields at points: a real bed of LIGGGHTS against sums by numpy; arrays of the points; what is missing, or cannot be."""
import functools

import numpy
from contact_averages import ALL, GAUSSIAN, HEAVISIDE, LUCY, Averages, Run
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource

import plain_contacts as plain

WIDTH = 0.004
KERNELS = {GAUSSIAN: (3, lambda r: numpy.exp(-(r / WIDTH)**2 / 2)), LUCY: (2, lambda r: (1 + 3 * r / (2 * WIDTH)) * (1 - r / (2 * WIDTH))**3),
           HEAVISIDE: (1, numpy.ones_like)}


def value(kernel, r):
    support, shape = KERNELS[kernel]
    return numpy.where(r < support * WIDTH, shape(r), 0)


@functools.lru_cache(maxsize=None)
def volume(kernel):
    r = (numpy.arange(200000) + 0.5) * (3 * WIDTH / 200000)
    return (4 * numpy.pi * r**2 * value(kernel, r)).sum() * (3 * WIDTH / 200000)


def close(found, expected, error):
    assert found.shape == expected.shape, (found.shape, expected.shape)
    assert abs(found - expected).max() <= error * abs(expected).max(), abs(found - expected).max() / abs(expected).max()


# a section through the bed, in steps of two radii
plane = vtkPlaneSource()
plane.SetOrigin(-0.015, 0.001, 0)
plane.SetPoint1(0.015, 0.001, 0)
plane.SetPoint2(-0.015, 0.001, 0.036)
plane.SetResolution(6, 7)
plane.Update()
points = vtk_to_numpy(plane.GetOutput().GetPoints().GetData()).astype(float)

run = Run("bed", 70000)
averages = Averages("bed", "PointAverage", KernelWidth=WIDTH)
averages.filter.SetPointsConnection(plane.GetOutputPort())
for kernel in KERNELS:
    found = averages.update(Kernel=kernel)
    assert set(ALL) <= set(found)
    weights = value(kernel, numpy.linalg.norm(points[:, None] - run.particles.x, axis=2)) / volume(kernel)
    mass = weights @ run.particles.mass
    close(found["density"][:, 0], mass, 1e-4)  # the volume of the kernel is that of many shells
    close(found["volumefraction"][:, 0], weights @ (4 / 3 * numpy.pi * run.particles.radius**3), 1e-4)
    # the mean of the kernel along each line, by many parts of it
    s = (numpy.arange(400) + 0.5) / 400
    stress = numpy.zeros((len(points), 6))
    for start, branch, virial in zip(run.start, run.branch, run.virial):
        along = start + s[:, None] * branch
        means = value(kernel, numpy.linalg.norm(points[:, None] - along, axis=2)).mean(axis=1) / volume(kernel)
        stress += means[:, None] * virial
    contact = numpy.hstack((found["sigma_contact"], found["tau_contact"]))
    close(contact, stress, 1e-2 if kernel == HEAVISIDE else 1e-4)  # which ends in a step
    close(found["sigma"], found["sigma_kinetic"] + found["sigma_contact"], 1e-15)
    close(found["pressure"][:, 0], -found["sigma"].mean(axis=1), 1e-14)

# no array more than is on, and what is not needed is not looked at
averages.choose(["volumefraction"])
alone = averages.update(Kernel=LUCY)
assert not set(ALL) - {"volumefraction"} & set(alone)
averages.choose(ALL)
assert alone["volumefraction"].tobytes() == averages.update()["volumefraction"].tobytes()

# at the particles: their own arrays stay
own = Averages("bed", "PointAverage", KernelWidth=WIDTH)
own.filter.SetPointsConnection(own.particles.GetOutputPort())
found = own.update()
assert (found["radius"][:, 0] == run.particles.radius).all() and (found["mass"][:, 0] == run.particles.mass).all()
weights = value(GAUSSIAN, numpy.linalg.norm(run.particles.x[:, None] - run.particles.x, axis=2))
close(found["radius_avg"][:, 0], weights @ run.particles.radius / weights.sum(axis=1), 1e-12)

# without contacts
lonely = Averages("bed", "PointAverage", lines=False, walls=False, KernelWidth=WIDTH)
lonely.filter.SetPointsConnection(plane.GetOutputPort())
lonely = lonely.update()
assert "sigma_contact" not in lonely and "coordination" not in lonely
assert lonely["volumefraction"].tobytes() == averages.update(Kernel=GAUSSIAN)["volumefraction"].tobytes()

# far away, and no points
line = vtkLineSource()
line.SetPoint1(1, 1, 1)
line.SetPoint2(2, 2, 2)
averages.filter.SetPointsConnection(line.GetOutputPort())
assert not any(values.any() for name, values in averages.update().items() if name in ALL)
for bad, text in ((vtkTable(), "expected a vtkDataSet as Points"),):
    averages.filter.SetInputDataObject(3, bad)
    averages.filter.Update()
    assert text in averages.filter.GetErrorMessage(), averages.filter.GetErrorMessage()
averages.filter.SetInputConnection(3, plane.GetOutputPort())
averages.filter.SetKernelWidth(1e300)
averages.filter.Update()
assert averages.filter.GetErrorMessage() == "expected a KernelWidth from 1e-60 to 1e60, got 1e+300", averages.filter.GetErrorMessage()
averages.update(KernelWidth=WIDTH)
print("at points")
