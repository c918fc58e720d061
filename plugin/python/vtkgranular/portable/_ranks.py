# SPDX-License-Identifier: BSD-3-Clause
"""The ranks of ParaView for the C library."""
from __future__ import annotations

import contextlib
import functools
import gc
import os
import pickle
import socket
from typing import Any, Callable, Iterator

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from .. import _library as c

_TAG = 5120  # of messages with rows


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


@contextlib.contextmanager
def no_garbage_collected() -> Iterator[None]:
    """Keeps Python's garbage collector away while ranks work together: on the first one it may delete proxies of ParaView, which waits then
    for ranks that wait for this one."""
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            gc.enable()


def own_piece() -> tuple[int, int]:
    """Returns the part that a rank has of what all have: its number, and how many there are."""
    ranks = ranks_of_paraview()
    return (ranks.Get_rank(), ranks.Get_size()) if ranks else (0, 1)


def is_own_piece(piece: tuple[int, int]) -> bool:
    """Returns true if a rank asks for that part."""
    return piece == own_piece()


def is_first() -> bool:
    """Returns true on the first rank, or where there is one."""
    controller = vtkMultiProcessController.GetGlobalController()
    return not controller or controller.GetLocalProcessId() == 0


def gather(mine: Any) -> list[Any]:
    """Returns the objects of all ranks, by rank, on the first one; nothing on the others."""
    controller = vtkMultiProcessController.GetGlobalController()
    if not controller or controller.GetNumberOfProcesses() < 2:
        return [mine]
    if controller.GetLocalProcessId():
        controller.Send(_bytes_to_vtk(pickle.dumps(mine)), 0, _TAG)
        return []
    received = vtkUnsignedCharArray()
    made = [mine]
    for rank in range(1, controller.GetNumberOfProcesses()):
        controller.Receive(received, rank, _TAG)
        made.append(pickle.loads(vtk_to_numpy(received).tobytes()))
    return made


def share(mine: Any) -> Any:
    """Returns the object of the first rank on all ranks."""
    controller = vtkMultiProcessController.GetGlobalController()
    if not controller or controller.GetNumberOfProcesses() < 2:
        return mine
    array = _bytes_to_vtk(pickle.dumps(mine)) if is_first() else vtkUnsignedCharArray()
    controller.Broadcast(array, 0)
    return pickle.loads(vtk_to_numpy(array).tobytes())


def everyone(mine: Any) -> list[Any]:
    """Returns the objects of all ranks, by rank, on all ranks."""
    return share(gather(mine))


def together(work: Callable[[], Any]) -> Any:
    """Does something on each rank, and returns what it made. Where it fails on one, all raise the error of the lowest such rank."""
    made, failure = None, None
    try:
        made = work()
    except Exception as error:  # noqa: BLE001 (raised on all ranks)
        failure = error
    failures = everyone(failure)
    try:
        for cancelled in (False, True):
            for rank, each in enumerate(failures):
                if each is not None and isinstance(each, c.Cancelled) == cancelled:
                    same = cancelled or all(str(other) == str(each) for other in failures)
                    raise each if same else c.Error(f"{each} (on rank {rank} of {len(failures)})")
    finally:
        failure = failures = each = None  # or this frame, which the traceback has, keeps the error, and with it the proxies of all callers
    return made


@functools.lru_cache(maxsize=None)
def threads_of_rank() -> int:
    """Returns this rank's share of the cores of its machine; 0, which the library takes for all that it may use, if it is the only rank."""
    machines = share(gather(socket.gethostname()))
    ranks = machines.count(socket.gethostname())
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, min((os.cpu_count() or 1) // ranks, usable)) if ranks > 1 else 0


def _bytes_to_vtk(data: bytes) -> Any:
    return numpy_to_vtk(numpy.frombuffer(data, dtype=numpy.uint8), deep=True)
