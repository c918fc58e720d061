# SPDX-License-Identifier: BSD-3-Clause
"""PyVista finds the reader of dumps by the entry points in pyproject.toml. Where PyVista of version 0.48 or later is not installed, a
stand-in with the interface that its documentation describes is in its place, once for each of two versions."""
import importlib.util
import os
import sys
import tomllib
import types
from abc import ABC, abstractmethod

import plain_dump
from command import SAMPLES

if not importlib.util.find_spec("vtkmodules"):
    print("skipped: VTK for Python is not installed")
    sys.exit()
from vtkmodules.util.numpy_support import vtk_to_numpy

SOURCE = os.path.join(SAMPLES, "grains.dump")
frames = plain_dump.read(SOURCE)
with open(os.path.join(os.environ["GRANULAR_ROOT"], "pyproject.toml"), "rb") as stream:
    ENTRY_POINTS = tomllib.load(stream)["project"]["entry-points"]["pyvista.readers"]


def stand_in(fields):
    """The part of PyVista that a reader needs: https://docs.pyvista.org/api/readers"""
    class BaseVTKReader(ABC):
        def __init__(self):
            self._data_object = None

        def SetFileName(self, name):
            self._filename = name

        UpdateInformation = Update = abstractmethod(lambda self: None)

    class BaseReader:
        def __init__(self, path):
            self.reader, self.path = self._class_reader(), path
            self.reader.SetFileName(path)
            self.reader.UpdateInformation()

        def read(self):
            self.reader.Update()
            return self.reader._data_object

    class TimeReader(ABC):
        number_time_points = active_time_value = property(abstractmethod(lambda self: None))
        time_point_value = set_active_time_value = set_active_time_point = abstractmethod(lambda self, value: None)

        @property
        def time_values(self):
            return [self.time_point_value(i) for i in range(self.number_time_points)]

    registry = types.ModuleType("pyvista.core.utilities.reader_registry")
    registry.ReaderRegistration = type("ReaderRegistration", (), {"_fields": fields})
    made = types.ModuleType("pyvista")
    made.BaseVTKReader, made.BaseReader, made.TimeReader = BaseVTKReader, BaseReader, TimeReader
    utilities, core = types.ModuleType("pyvista.core.utilities"), types.ModuleType("pyvista.core")
    utilities.reader_registry = registry
    for module in made, core, utilities, registry:
        sys.modules[module.__name__] = module

    def get_reader(path):
        found = load(path)
        assert isinstance(found, type), "expected a class, which get_reader needs"
        return found(path)

    def read(path, **attributes):
        found = load(path)
        if not isinstance(found, type):
            return found(path, **attributes)
        reader = found(path)
        for name, value in attributes.items():
            setattr(reader, name, value)
        return reader.read()

    def load(path):
        module, name = ENTRY_POINTS[os.path.splitext(path)[1]].split(":")
        return getattr(importlib.reload(importlib.import_module(module)), name)

    made.get_reader, made.read = get_reader, read
    return made


def check(pyvista, has_classes):
    def expect(mesh, frame):
        assert mesh.GetNumberOfPoints() == frame.rows, mesh
        assert vtk_to_numpy(mesh.GetFieldData().GetArray("timestep"))[0] == frame.timestep
        ids = vtk_to_numpy(mesh.GetPointData().GetArray("id"))
        assert ids.tolist() == [int(value) for value in frame.numbers("id")]

    expect(pyvista.read(SOURCE), frames[-1])
    expect(pyvista.read(SOURCE, dt=2e-5, active_time_value=0.04), frames[2])
    if has_classes:
        reader = pyvista.get_reader(SOURCE)
        assert reader.time_values == [0, 1000, 2000, 3000, 4000] and reader.active_time_value == 4000
        reader.dt = 2e-5
        assert reader.time_values == [0, 0.02, 0.04, 0.06, 0.08]
        reader.set_active_time_point(1)
        expect(reader.read(), frames[1])
        for wrong, error in ((lambda: reader.set_active_time_value(0.05), ValueError), (lambda: reader.set_active_time_point(5), IndexError)):
            try:
                wrong()
            except error:
                continue
            raise AssertionError("expected an error")
    try:
        pyvista.read(os.path.join(os.environ["GRANULAR_DATA"], "bad", "box_short.dump"))
    except RuntimeError as error:
        assert "box_short.dump:" in str(error), error
    else:
        raise AssertionError("expected an error")


try:
    import pyvista
    from pyvista.core.utilities import reader_registry
except ImportError:
    check(stand_in(("extension", "handler", "source", "reader_class")), True)
    check(stand_in(("extension", "handler", "source")), False)
    print("a stand-in for PyVista")
else:
    from importlib import metadata
    if not any(point.value.startswith("vtkgranular.") for point in metadata.entry_points(group="pyvista.readers")):
        for extension, value in ENTRY_POINTS.items():  # a build tree has no entry points
            module, name = value.split(":")
            pyvista.register_reader(extension, getattr(importlib.import_module(module), name))
    check(pyvista, "reader_class" in reader_registry.ReaderRegistration._fields)
    print("PyVista", pyvista.__version__)
