# SPDX-License-Identifier: BSD-3-Clause
"""The arrays that a user has chosen from those of the files, by the rules of the compiled readers."""
from __future__ import annotations

import weakref
from typing import Any, Iterable

from vtkmodules.vtkCommonCore import vtkDataArraySelection

from ._told import weakly


class ArrayChoice:
    """The list of arrays that ParaView shows, each on or off.

    follow  new arrays are off if the user has deselected others: a history that gets other names is off where parts of it were
    """

    def __init__(self, reader: Any, follow: bool):
        self.selection = vtkDataArraySelection()
        self.follow = follow
        self._usual: dict[str, bool] = {}  # what is offered
        self._gone: dict[str, bool] = {}  # what was chosen of those that are no more
        self._offering = False
        own, of_reader = weakref.ref(self), weakly(reader)
        self.selection.AddObserver("ModifiedEvent", lambda *_: None if own()._offering else of_reader().Modified())

    def _states(self) -> dict[str, bool]:
        chosen = self.selection
        return {chosen.GetArrayName(i): bool(chosen.GetArraySetting(i)) for i in range(chosen.GetNumberOfArrays())}

    def _all_on(self) -> bool:
        states = self._states()
        return all(states.get(name, False) for name, is_usual in self._usual.items() if is_usual)

    def offer(self, arrays: Iterable[tuple[str, bool]]) -> None:
        """Makes the list anew from names, and whether each is usual. Names that were there keep their state, also those that come back.

        State files, and users who name the columns of a binary file, choose from names that are not offered yet, and leave the old ones
        off: new ones that were not chosen are off.
        """
        offered, states, all_on = dict(arrays), self._states(), self._all_on()
        ahead = any(on and name in offered and name not in self._usual for name, on in states.items())
        off = any(not on and name not in offered for name, on in states.items())
        by_name = (self.follow and not all_on) or (ahead and off)
        made = {name: on for name, on in states.items() if name in offered}
        for name in states.keys() - offered.keys():
            self._gone.pop(name, None)
            if not all_on:
                self._gone[name] = states[name]
        for name, is_usual in offered.items():
            made.setdefault(name, self._gone.get(name, is_usual and not by_name))
        self._offering = True
        try:
            self.selection.RemoveAllArrays()
            for name, on in made.items():
                self.selection.AddArray(name, on)
        finally:
            self._offering = False
        self._usual = offered

    def choose(self, arrays: Iterable[tuple[str, bool]]) -> list[str]:
        """Returns which of the arrays of a frame are on; those that the list does not have are if all usual ones of the list are."""
        states, all_on = self._states(), self._all_on()
        return [name for name, is_usual in arrays if states.get(name, all_on and is_usual)]

    def missing(self) -> set[str]:
        """Returns the chosen names that no frame offers."""
        return {name for name, on in self._states().items() if on and name not in self._usual}
