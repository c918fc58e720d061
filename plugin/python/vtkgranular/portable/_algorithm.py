# SPDX-License-Identifier: BSD-3-Clause
"""What readers, sources and filters have in common: properties, outputs, progress and errors."""
from __future__ import annotations

from typing import Any, Callable

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from ._ranks import no_garbage_collected
from ._told import Told, message_of


class Algorithm(VTKPythonAlgorithmBase):
    """Base of readers, sources and filters.

    ports     the types of the outputs
    defaults  the properties and their defaults, from the definitions
    values    what they are set to
    """

    ports: tuple[str, ...] = ()
    defaults: dict[str, Any] = {}

    def __init__(self, inputs: int = 0) -> None:
        super().__init__(nInputPorts=inputs, nOutputPorts=len(self.ports), outputType=self.ports[0])
        self.values = dict(self.defaults)
        self._message, self._cancelled = "", False
        self._told = Told(self)

    def GetErrorMessage(self) -> str:
        return self._message

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkDataObject.DATA_TYPE_NAME(), self.ports[port])
        return 1

    def _progress(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def _guarded(self, work: Callable[[], None], outputs: Any) -> int:
        """Does a part of an update. An error empties the outputs and is told once, though pipelines repeat requests."""
        self._told.watch()
        if self._cancelled:  # a request to stop holds for one update, and observers of progress may have repeated it
            self._cancelled = False
            self.SetAbortExecute(0)
        try:
            with no_garbage_collected():
                work()
        except c.Cancelled:
            self._message, self._cancelled = "", True
            self.Modified()
            for port in range(outputs.GetNumberOfInformationObjects()):  # or they would be up to date
                outputs.GetInformationObject(port).Set(Pipeline.DATA_NOT_GENERATED(), 1)
        except Exception as error:  # noqa: BLE001 (which ParaView would print and forget)
            if not self._message:
                self.Modified()  # or VTK takes what is left of an image for the last one
            self._message = message_of(error) or type(error).__name__
        else:
            self._message = ""
            self._told.tell()
            return 1
        for port in range(outputs.GetNumberOfInformationObjects()):
            data = vtkDataObject.GetData(outputs, port)
            if data:
                data.Initialize()
        if self._message:
            self._told.error(self._message)
        return 0


def asked_output(request: Any, outputs: Any) -> Any:
    """Returns the information of the output through which a request came."""
    port = request.Get(Pipeline.FROM_OUTPUT_PORT()) if request.Has(Pipeline.FROM_OUTPUT_PORT()) else 0
    return outputs.GetInformationObject(max(port, 0))


def piece_of(info: Any) -> tuple[int, int]:
    """Returns the piece that is asked of an output, and the number of pieces."""
    pieces = max(info.Get(Pipeline.UPDATE_NUMBER_OF_PIECES()), 1) if info.Has(Pipeline.UPDATE_NUMBER_OF_PIECES()) else 1
    return (info.Get(Pipeline.UPDATE_PIECE_NUMBER()) if pieces > 1 else 0), pieces
