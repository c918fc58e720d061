# SPDX-License-Identifier: BSD-3-Clause
"""Files of contacts through the classes of the library: readers, and the filter vtkGranularContactSums."""
from vtkmodules.util.numpy_support import vtk_to_numpy

import plain_contacts
import vtkgranular as vg
from said import said_by

NAMES = ["coordination", "contact_force", "contact_torque", "fabric", "contact_stress", "principal_stress", "von_mises",
         "rattler", "coordination_without_rattlers", "mobilised_friction"]


def reader_of(kind, name, **properties):
    reader = getattr(vg, f"vtkGranular{kind}Reader")()
    reader.SetController(None)
    reader.AddFileName(plain_contacts.path(name))
    for key, value in properties.items():
        getattr(reader, f"Set{key}")(value)
    reader.said = said_by(reader)
    return reader


def local_of(name, **properties):
    return reader_of("Local", name, ColumnMap=plain_contacts.COLUMNS[name], **properties)


def arrays_of(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)) for i in range(attributes.GetNumberOfArrays())
            if attributes.GetArray(i)}


class Sums:
    """The filter after the readers of a run. lines: lines of the reader, or its rows; both of them if it is None."""

    def __init__(self, name, walls=True, rows=False, on=NAMES, lines=True, local=None, **properties):
        self.particles = reader_of("Dump", name)
        self.filter = vg.vtkGranularContactSums()
        self.filter.SetController(None)
        self.filter.SetInputConnection(0, self.particles.GetOutputPort())
        self.contacts = local_of(name + "_contacts", **(local or {}))
        if lines:
            self.filter.SetLinesConnection(self.contacts.GetOutputPort(1 if rows else 0))
        if walls:
            self.walls = local_of(name + "_walls", **(local or {}))
            self.filter.SetWallsConnection(self.walls.GetOutputPort())
        self.choose(on)
        for key, value in properties.items():
            getattr(self.filter, f"Set{key}")(value)
        self.said = said_by(self.filter)

    def choose(self, on):
        selection = self.filter.GetArraySelection()
        for name in NAMES:
            (selection.EnableArray if name in on else selection.DisableArray)(name)

    def update(self, step=None):
        """The arrays of the particles."""
        self.filter.Update() if step is None else self.filter.UpdateTimeStep(step)
        assert self.said == [] and not self.filter.GetErrorMessage(), self.said
        return arrays_of(self.filter.GetOutput().GetPointData())

    def of_lines(self):
        """The arrays of the second output."""
        return arrays_of(self.filter.GetLinesOutput().GetCellData())

    def field(self, name):
        return self.filter.GetOutput().GetFieldData().GetArray(name).GetValue(0)
