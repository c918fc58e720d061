# SPDX-License-Identifier: BSD-3-Clause
"""The ranks of ParaView for the C library."""
from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from .. import _library as c


class _Controller:
    """A controller of VTK as a communicator: what vtkgranular's Ranks ask for."""

    def __init__(self, controller: vtkMultiProcessController):
        self._controller = controller

    def Get_rank(self) -> int:
        return self._controller.GetLocalProcessId()

    def Get_size(self) -> int:
        return self._controller.GetNumberOfProcesses()

    def Allgather(self, mine: Any, gathered: Any) -> None:
        sent, received = numpy_to_vtk(numpy.frombuffer(mine, dtype=numpy.uint8)), vtkUnsignedCharArray()
        received.SetNumberOfValues(len(gathered))
        if not self._controller.AllGather(sent, received):
            raise c.Error("expected the ranks of ParaView to exchange data, got a failure of its controller")
        gathered[:] = vtk_to_numpy(received).tobytes()


def ranks_of_paraview() -> _Controller | None:
    """Returns the ranks of the global controller, or None for a single one."""
    controller = vtkMultiProcessController.GetGlobalController()
    return _Controller(controller) if controller and controller.GetNumberOfProcesses() > 1 else None
