# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the pipeline as exceptions."""
from __future__ import annotations

import contextlib
from typing import Any, Iterator

from ._library import shown


def expect_utf8(path: str) -> str:
    """Returns the name of a file. Raises ValueError for one that is not UTF-8, for which ParaView's libraries end the program."""
    try:
        path.encode()
    except UnicodeEncodeError:
        raise ValueError(f"expected a name in UTF-8, as ParaView takes them, got {shown(path)}: vtkgranular.open and vtkgranular.write "
                         "take any name") from None
    return path


def output_names(source: Any) -> list[str]:
    """Returns the names of the outputs of a source or filter."""
    return [source.SMProxy.GetOutputPortName(i) for i in range(source.SMProxy.GetNumberOfOutputPorts())]


def upstream(source: Any) -> list[Any]:
    """Returns a source and all that it depends on, the farthest first."""
    from paraview import servermanager

    # Without a recursive function: its cycle would keep proxies until Python's garbage collector comes, perhaps while ranks
    # update together.
    found = [source.SMProxy]
    for proxy in found:  # which grows
        for i in range(proxy.GetNumberOfProducers()):
            producer = proxy.GetProducerProxy(i)
            if producer.IsA("vtkSMSourceProxy") and producer not in found:
                found.append(producer)
    return [servermanager._getPyProxy(proxy) for proxy in reversed(found)]


def times_of(proxy: Any) -> list[float]:
    """Returns the times that a source or filter has, ascending; on a server, those of the sources before it."""
    proxy.UpdatePipelineInformation()
    algorithm = proxy.GetClientSideObject()
    if algorithm:
        from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

        return sorted(algorithm.GetOutputInformation(proxy.Port).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or ())
    sources = [each for each in upstream(proxy) if each.SMProxy.GetProperty("TimestepValues")]
    return sorted({time for each in sources for time in each.TimestepValues})


def message_of(source: Any) -> str:
    """Returns the error of the last update of a source of this plugin; of others an empty text."""
    if not source.SMProxy.GetProperty("ErrorMessage"):
        return ""
    source.UpdatePropertyInformation()
    return source.GetPropertyValue("ErrorMessage") or ""


@contextlib.contextmanager
def raised(sources: list[Any]) -> Iterator[None]:
    """Raises RuntimeError with the first error of these sources, instead of letting VTK print it.

    On a server its messages are printed there as well.
    """
    with contextlib.suppress(ImportError):  # there are none beside the portable plugin
        from . import vtkGranular  # noqa: F401 (whose classes Python must know before it sees one of their objects)

    tags = []
    for source in sources:
        algorithm = source.GetClientSideObject()
        if algorithm and source.SMProxy.GetProperty("ErrorMessage"):
            tags.append((algorithm, algorithm.AddObserver("ErrorEvent", lambda *_: None)))
    try:
        yield
    finally:
        for algorithm, tag in tags:
            algorithm.RemoveObserver(tag)
    for source in sources:
        message = message_of(source)
        if message:
            raise RuntimeError(message)


def default_time(proxy: Any) -> float | None:
    """Returns the animation's time for an output that was never updated, and None, the time of the last update, for others."""
    from paraview import simple

    if proxy.SMProxy.GetDataInformation(proxy.Port).GetHasTime():
        return None
    return simple.GetTimeKeeper().Time


def update(proxy: Any, time: float | None = None) -> None:
    """Updates a source or filter, and raises an error of the update as an exception.

    proxy  a source or filter of paraview.simple, or one of its output ports
    time   the time to update to; a reader shows the last frame at or before it. None: the time of the last update or, if there
           was none, the time that the animation shows.

    ParaView's UpdatePipeline prints errors and goes on. Raises RuntimeError with the message, which names path, line or byte,
    and column, if the source, or a reader, filter or source of this plugin before it, failed. Errors of ParaView's own
    filters are printed.
    """
    with raised(upstream(proxy)):
        if time is None:
            time = default_time(proxy)
        if time is None:
            proxy.UpdatePipeline()
        else:
            proxy.UpdatePipeline(time)
