# SPDX-License-Identifier: BSD-3-Clause
"""The base of sources and filters: the work of the C library on data of the pipeline."""
from __future__ import annotations

from typing import Any, Callable, Sequence

from vtkmodules.vtkCommonCore import vtkDataArraySelection
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from .._run import _Handle
from ._algorithm import Algorithm, asked_output, piece_of
from ._arrays import Table
from ._contents import Content
from ._ranks import is_own_piece, ranks_of_paraview
from ._told import weakly


class Filter(Algorithm):
    """Base of sources and filters, whose name is that of the class.

    inputs    for each input port the function of _contents that takes its data
    optional  ports that need no connection
    """

    inputs: tuple[Callable[[Any], Content], ...] = ()
    optional: tuple[int, ...] = ()

    def __init__(self) -> None:
        super().__init__(len(self.inputs))
        self._selection = vtkDataArraySelection()
        on = c.c_int()
        while name := c.library().granular_made_array(type(self).__name__.encode(), self._selection.GetNumberOfArrays(), c.byref(on)):
            self._selection.AddArray(c.text(name), bool(on.value))
        algorithm = weakly(self)
        self._selection.AddObserver("ModifiedEvent", lambda *_: algorithm().Modified())

    def GetArraySelection(self) -> vtkDataArraySelection:
        return self._selection

    def SetArrayStatus(self, name: str, status: Any) -> None:
        self._selection.SetArraySetting(name, int(status))

    def ClearArrays(self) -> None:
        self._selection.DisableAllArrays()

    # ---- the pipeline ----
    def FillInputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject")  # of any type: all ranks look at them together
        info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), int(port in self.optional))
        return 1

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        for port in range(len(self.ports)):
            outputs.GetInformationObject(port).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestUpdateExtent(self, request: Any, inputs: Any, outputs: Any) -> int:
        piece, pieces = self.piece_of_inputs(piece_of(asked_output(request, outputs)))
        for vector in inputs:
            for i in range(vector.GetNumberOfInformationObjects()):
                info = vector.GetInformationObject(i)
                info.Set(Pipeline.UPDATE_PIECE_NUMBER(), piece)
                info.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), pieces)
                info.Set(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        return 1

    @staticmethod
    def piece_of_inputs(piece: tuple[int, int]) -> tuple[int, int]:
        """Returns the piece of the inputs that a rank needs: its own, or the whole to make another piece from."""
        return piece if is_own_piece(piece) else (0, 1)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        def work() -> None:
            self.piece = piece_of(asked_output(request, outputs))
            self.data = [vtkDataObject.GetData(vector, 0) if vector.GetNumberOfInformationObjects() else None for vector in inputs]
            try:
                self.fill(self.apply(), [vtkDataObject.GetData(outputs, port) for port in range(len(self.ports))])
            finally:
                self.data = []

        return self._guarded(work, outputs)

    # ---- the work ----
    def settings(self) -> dict[str, Any]:
        """Returns the properties that the library gets: numbers, several numbers, or texts."""
        made, chosen = {name: value for name, value in self.values.items() if name != "Threads"}, self._selection
        if chosen.GetNumberOfArrays():
            made["Arrays"] = " ".join(chosen.GetArrayName(i) for i in range(chosen.GetNumberOfArrays()) if chosen.GetArraySetting(i))
        return made

    def take(self, port: int, frame: int) -> Content | None:
        """Returns an input as the library takes it, or None where nothing is connected. All ranks are asked in the same order."""
        if self.data[port] is None and port in self.optional:
            return None
        return self.inputs[port](self.data[port])

    def fill(self, tables: list[Table], outputs: list[Any]) -> None:
        """Fills the outputs with what the library has made of self.data, for self.piece."""
        raise NotImplementedError

    def apply(self, split: bool = False, times: Sequence[float] = (), shown: int = 0) -> list[Table]:
        """Lets the library do its work, tells its remarks, and returns what it has made. split: lines are parts of rows. times: of the frames
        of the inputs, and the number of the shown one."""
        library, task, kept = c.library(), c.Task(), {}
        library.granular_task_init(c.byref(task))
        settings = [_setting(name, value) for name, value in self.settings().items()]
        task.filter, task.frames, task.shown = type(self).__name__.encode(), max(1, len(times)), shown
        task.times = (c.c_double * len(times))(*times) if times else None
        task.settings, task.setting_count = (c.Setting * max(1, len(settings)))(*settings), len(settings)
        task.piece, task.pieces = self.piece
        task.threads = self.values.get("Threads", 0)

        def give(port: int, frame: int, content: Any, failure: Any, _: Any) -> int:
            try:
                made = self.take(port, frame)
                if made is not None:
                    kept[port], content[0] = made, c.POINTER(c.Content)(made)
                return 0
            except c.Cancelled:
                return 1
            except BaseException as error:  # noqa: BLE001 (which all ranks get)
                kept["failure"] = failure[0] = (str(error) or type(error).__name__).encode()
                return 1

        if self.inputs:
            task.input = c.INPUT(give)
        ranks = ranks_of_paraview()
        of_task = c.Ranks(ranks) if ranks else None
        if of_task:
            task.ranks = c.pointer(of_task)
        remarks: list[c.Remark] = []
        results, count = (c.c_void_p * c.MOST_RESULTS)(), c.c_size_t()
        with c.Calls(self._progress, remarks.append, of_task) as calls:
            task.progress, task.notice = calls.progress, calls.notice
            library.granular_apply(c.byref(task), results, len(results), c.byref(count))
        handles = [_Handle(c.c_void_p(pointer), library.granular_release) for pointer in results[:count.value]]
        self._told.tell_topics(remarks)
        return [Table(handle, split) for handle in handles]


def _setting(name: str, value: Any) -> c.Setting:
    made = c.Setting()
    made.name = name.encode()
    if isinstance(value, str):
        made.text = value.encode()
    else:
        numbers = value if isinstance(value, tuple) else (value,)
        made.numbers, made.count = (c.c_double * max(1, len(numbers)))(*numbers), len(numbers)
    return made
