# SPDX-License-Identifier: BSD-3-Clause
"""Inputs of filters at other times than the shown one."""
from __future__ import annotations

import bisect
from typing import Any

from vtkmodules.vtkCommonCore import vtkInformationVector
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

from .. import _library as c
from ._ranks import everyone, share
from ._told import weakly


class InputFrames:
    """An input of an algorithm, frame by frame. The algorithm asks for frames itself, not through its own executive, which would pass the
    blocks of a composite one by one, and restart the progress with each frame. All functions but those for facts are collective."""

    def __init__(self, consumer: Any, port: int, piece: tuple[int, int]):
        connection = consumer.GetInputConnection(port, 0)
        self._source, self._port, self._piece = connection.GetProducer(), connection.GetIndex(), piece
        self._source.UpdateInformation()
        self._info = self._source.GetOutputInformation(self._port)
        self._shown: float | None = None  # where another time was asked for

    def times(self) -> list[float]:
        return list(self._info.Get(Pipeline.TIME_STEPS()) or ()) if self._info.Has(Pipeline.TIME_STEPS()) else []

    def shared_times(self) -> list[float]:
        """Returns the times, of which ranks with others would wait for each other. Raises Error if they differ. Collective."""
        times = self.times()
        if any(each != times for each in everyone(times)):
            raise c.Error("expected the time steps of the first process, got others")
        return times

    def shown_number(self) -> int:
        """Returns the number of the frame that the data are of; 0 without times."""
        time = self.time()
        time = self._shown_time() if time is None else time
        return 0 if time is None else max(bisect.bisect_right(self.times(), time) - 1, 0)

    def data(self) -> Any:
        return self._source.GetOutputDataObject(self._port)

    def time(self) -> float | None:
        info = self.data().GetInformation() if self.data() else None
        return info.Get(vtkDataObject.DATA_TIME_STEP()) if info and info.Has(vtkDataObject.DATA_TIME_STEP()) else None

    def update(self, time: float | None) -> None:
        """Asks for the data of a time, or of the shown one. Raises Error on all ranks if one cannot have them; Cancelled."""
        made = self._update_here(time)
        stopped = hasattr(vtkAlgorithm, "ABORTED") and bool(self._info.Get(vtkAlgorithm.ABORTED()))
        outcomes = everyone((made and self.data() is not None, stopped))
        if any(aborted for _, aborted in outcomes):
            raise c.Cancelled
        if not all(there for there, _ in outcomes):
            raise c.Error("the input could not be made: see the messages before")

    def restore(self) -> None:
        """Asks for the shown time again if another one was asked for: whoever shares the input finds its data as they were."""
        if self._shown is not None:
            self.update(self._shown)
        self.close()

    def close(self) -> None:
        """Makes the shown time the one that is asked for, without data."""
        if self._shown is not None:
            self._info.Set(Pipeline.UPDATE_TIME_STEP(), self._shown)
            self._source.GetExecutive().PropagateUpdateExtent(self._port)

    def _update_here(self, time: float | None) -> bool:
        if time is not None:
            if self._shown is None:
                shown = self._shown_time()
                self._shown = (self.times() or [time])[0] if shown is None else shown
            self._info.Set(Pipeline.UPDATE_TIME_STEP(), time)
        requests = vtkInformationVector()
        requests.SetNumberOfInformationObjects(self._port + 1)
        request = requests.GetInformationObject(self._port)
        request.Set(Pipeline.UPDATE_PIECE_NUMBER(), self._piece[0])
        request.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), self._piece[1])
        request.Set(Pipeline.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        self._source.UpdateInformation()
        return bool(self._source.Update(self._port, requests))

    def _shown_time(self) -> float | None:
        """The time that the nearest of those before was asked for: a filter that is new has not been asked yet."""
        algorithm, port = self._source, self._port
        while algorithm:
            info = algorithm.GetOutputInformation(port)
            if info.Has(Pipeline.UPDATE_TIME_STEP()):
                return info.Get(Pipeline.UPDATE_TIME_STEP())
            if not algorithm.GetNumberOfInputPorts() or not algorithm.GetNumberOfInputConnections(0):
                break
            connection = algorithm.GetInputConnection(0, 0)
            algorithm, port = connection.GetProducer(), connection.GetIndex()
        return None


class KeptFrames:
    """Frames of all connected inputs of an algorithm, kept between updates, so that a frame that many updates need is made once. Frames are
    forgotten when an input has changed. All functions are collective.

    times   of the first input
    number  that of the shown frame; 0 without times
    """

    def __init__(self, consumer: Any):
        self._consumer, self._changed = weakly(consumer), None
        self._kept: dict[float, list[Any]] = {}  # by their times
        self._asked: dict[int, list[Any]] = {}  # in this update

    def begin(self, piece: tuple[int, int]) -> None:
        """Begins an update with the frame that is shown. Raises Error if the ranks have different times."""
        self._piece, consumer = piece, self._consumer()
        self._ports = [port for port in range(consumer.GetNumberOfInputPorts()) if consumer.GetNumberOfInputConnections(port)]
        changed = piece, [consumer.GetInputExecutive(port, 0).GetPipelineMTime() for port in self._ports]
        if any(everyone(changed != self._changed)):
            self._kept = {}
        self._changed = changed
        shown = [copy_of(consumer.GetInputDataObject(port, 0)) for port in self._ports]
        frames = InputFrames(consumer, 0, piece)
        self.times, self.number = frames.shared_times(), frames.shown_number()
        self._asked, self._last = {self.number: shown}, self.number

    def get(self, number: int) -> list[Any]:
        """Returns the data of a frame: of the shown one, a kept one, or one that is asked for. Raises Error if an input cannot make it."""
        self._last = number
        if number not in self._asked:
            time = self.times[number]
            if any(everyone(time not in self._kept)):
                self._kept[time] = self._read(time)
            self._asked[number] = self._kept[time]
        return self._asked[number]

    def end(self, keep_shown: bool) -> None:
        """Ends an update: keeps the frames that were asked for, and on request the shown one, too."""
        keep_shown = keep_shown or self._last == self.number
        self._kept = {self.times[number]: data for number, data in self._asked.items() if self.times and (keep_shown or number != self.number)}
        self._asked = {}

    def _read(self, time: float) -> list[Any]:
        inputs = [InputFrames(self._consumer(), port, self._piece) for port in self._ports]
        made = []
        for frames in inputs:
            frames.update(time)
            made.append(copy_of(frames.data()))
        for frames in inputs:
            frames.restore()
        return made


def copy_of(data: Any) -> Any:
    """Returns a shallow copy: an input may go on to other times."""
    made = data.NewInstance() if data else None
    if made:
        made.ShallowCopy(data)
    return made


def timestep_of(data: Any) -> int | None:
    """Returns the timestep that the field data of a data object tell, if they tell one."""
    array = data.GetFieldData().GetArray("timestep")
    return int(array.GetComponent(0, 0)) if array and array.GetNumberOfValues() == 1 else None


def rows_of_timestep(consumer: Any, port: int, particles: Any, piece: tuple[int, int]) -> Any:
    """Returns the rows of an input of many times that have the timestep of the particles, or else the last one before it that is found. The
    rows of the shown time may have another one: a file with ITEM: TIME and a file without give a timestep different times. Collective."""
    best = consumer.GetInputDataObject(port, 0)
    wanted, there = timestep_of(particles), timestep_of(best)
    if not all(everyone(wanted is not None and there is not None and wanted != there)):
        return best
    frames = InputFrames(consumer, port, piece)
    times = frames.times()
    for _ in range(3):  # the first guess may have to do with a timestep of 0
        step, time, following = timestep_of(frames.data()), frames.time(), None
        if len(times) > 1 and step is not None and time is not None and step != wanted:
            scale = 1.0 if step == 0 else time / step
            number = max(bisect.bisect_right(times, wanted * scale) - 1, 0)
            following = None if times[number] == time else number
        following = share(following)
        if following is None:
            break
        frames.update(times[following])
        found = timestep_of(frames.data())
        if found is not None and found <= wanted and (there > wanted or found > there):
            there, best = found, copy_of(frames.data())
    frames.restore()
    return best
