# SPDX-License-Identifier: BSD-3-Clause
"""Errors and warnings of a reader, each once."""
from __future__ import annotations

import re
from typing import Any, Callable

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkWeakReference

from .._library import _SETTINGS, Remark

#: ParaView's names of settings, by those of the package; a preset is a word, too.
_NAMES = {own: name for name, own in _SETTINGS.items() if own != "preset"}
_MOST = 10  # lines of one warning


def _pass_on(_: Any, __: str, text: str) -> None:
    """Passes on what an executive says, but what follows from an error that was told."""
    if "returned failure for request" not in text and "No whole extent has been set" not in text:
        vtkOutputWindow.GetInstance().DisplayErrorText(text)


_pass_on.CallDataType = "string0"  # type: ignore[attr-defined]


def message_of(error: Exception | str) -> str:
    """Returns the text of an error or a remark, with ParaView's names of settings."""
    text, path = str(error), getattr(error, "path", "")
    begin = len(path) if text.startswith(path) else 0
    return text[:begin] + re.sub("|".join(rf"\b{own}(?!\w)" for own in _NAMES), lambda match: _NAMES[match.group()], text[begin:])


def weakly(algorithm: Any) -> Callable[[], Any]:
    """Returns a function that returns an algorithm. What an algorithm keeps has it by such a function: in a cycle it stays for ever, with all
    its data, as no garbage collector looks into observers of VTK, or is at work on several ranks. One of Python's own references would end
    with its object, of which VTK makes another one."""
    reference = vtkWeakReference()
    reference.Set(algorithm)
    return reference.Get


class Told:
    """Tells the messages of an algorithm to whoever watches it, or to VTK's output window, as VTK's macros do."""

    def __init__(self, algorithm: Any):
        self._algorithm = weakly(algorithm)
        self._known: set[str] = set()
        self._kept: list[str] = []
        self._watched: Callable[[], Any] = lambda: None  # the executive
        self._topics: set[str] = set()  # of the last request of a filter
        self._topics_time = 0
        self._failed: Any = None  # the last error, and the time of the algorithm then

    def watch(self) -> None:
        """Watches the executive of the algorithm, of which ParaView gives it another one than it has at first."""
        executive = self._algorithm().GetExecutive()
        if executive is not self._watched():
            self._watched = weakly(executive)
            executive.AddObserver("ErrorEvent", _pass_on)

    def forget(self) -> None:
        """Begins anew, for other files."""
        self._known.clear()

    def warn(self, remark: Remark | str) -> None:
        """Takes a warning. The library tells each once a run; here it is once, though the run is opened again."""
        text = message_of(remark)
        if text not in self._known:
            self._known.add(text)
            self._kept.append(text)

    def tell(self) -> None:
        """Tells what was taken, as one warning, after something has gone well."""
        self._failed = None
        kept, self._kept = self._kept, []
        if kept:
            more = [f"and {len(kept) - _MOST} more"] if len(kept) > _MOST else []
            self._say("WarningEvent", "\n".join(kept[:_MOST] + more))

    def tell_topics(self, remarks: list[Remark]) -> None:
        """Tells each remark as a warning, of each topic once, until it is gone or something upstream is changed, which may be why."""
        time = self._algorithm().GetExecutive().GetPipelineMTime()
        before = self._topics if time == self._topics_time else set()
        self._topics, self._topics_time = set(), time
        for remark in remarks:
            topic = remark.topic or str(remark)
            if topic not in self._topics | before:
                self._say("WarningEvent", str(remark))
            self._topics.add(topic)

    def error(self, text: str) -> None:
        """Tells an error once, as pipelines repeat requests."""
        failed = text, self._algorithm().GetMTime()
        if failed != self._failed:
            self._failed = failed
            self._say("ErrorEvent", text)

    def _say(self, event: str, text: str) -> None:
        algorithm = self._algorithm()
        if algorithm.HasObserver(event):
            algorithm.InvokeEvent(event, text)
            return
        window = vtkOutputWindow.GetInstance()
        name = type(algorithm).__name__
        (window.DisplayErrorText if event == "ErrorEvent" else window.DisplayWarningText)(f"{name}: {text}\n")
