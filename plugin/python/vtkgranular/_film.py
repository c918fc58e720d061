# SPDX-License-Identifier: BSD-3-Clause
"""Films with a picture for each frame of a run."""
from __future__ import annotations

import contextlib
import glob
import os
import re
from typing import Any, Iterator

from ._errors import expect_utf8, times_of, upstream
from ._library import shown
from ._save import written_by_paraview
from ._show import expect_display


#: Note of a proxy whose times are not those of a film.
FOLLOWS = "follows the times of others"


def _times(view: Any) -> list[float]:
    """Returns the times of all that a view shows, but for what follows the times of others; where nothing has times, those of the readers."""
    shown_now = [each.Input for each in view.Representations if each.SMProxy.GetProperty("Input") and each.Visibility and each.Input and
                 not each.Input.SMProxy.HasAnnotation(FOLLOWS)]
    return sorted({time for each in shown_now for time in times_of(each)} or
                  {time for each in shown_now for source in upstream(each) for time in times_of(source)})


@contextlib.contextmanager
def _playing(times: list[float]) -> Iterator[None]:
    """Makes the animation play these times, whatever other sources have. At the end it is as it was."""
    from paraview import simple

    scene, keeper = simple.GetAnimationScene(), simple.GetTimeKeeper()
    steps = keeper.SMProxy.GetProperty("TimestepValues")
    before, now = list(keeper.TimestepValues), scene.AnimationTime
    known = {"PlayMode": scene.PlayMode.GetData(), "StartTime": scene.StartTime, "EndTime": scene.EndTime}

    def play(values: list[float], properties: dict[str, Any]) -> None:
        steps.SetNumberOfElements(len(values))
        for i, value in enumerate(values):
            steps.SetElement(i, value)
        for name, value in properties.items():
            setattr(scene, name, value)

    play(times, {"PlayMode": "Snap To TimeSteps", "StartTime": times[0], "EndTime": times[-1]})
    try:
        yield
    finally:
        play(before, {**known, "AnimationTime": now})


def film(view: Any, path: str | os.PathLike[str], **properties: Any) -> list[str]:
    """Writes a film with a picture for each frame of what a view shows, and returns the names of its files.

    view        a view of paraview.simple; None: the active one
    path        film.png, or another ending of pictures, for film.0000.png, film.0001.png, ...; film.avi or film.ogv for one file
    properties  of ParaView's SaveAnimation: ImageResolution, FrameRate, FrameWindow, FrameStride, ...

    The frames are those of all that is shown, each once, in the order of their times. Further pictures of this name are removed. Raises
    RuntimeError if a picture could not be made; ValueError if nothing has times, or for an ending that this ParaView cannot write.
    """
    from paraview import servermanager, simple

    if servermanager.vtkProcessModule.GetProcessModule().GetSymmetricMPIMode():
        raise RuntimeError("expected pvbatch without --sym, with which ParaView writes no more than the first picture of a film")
    path = expect_utf8(os.fsdecode(path))
    stem, ending = os.path.splitext(path)
    known = re.findall(r"\*(\.\w+)", servermanager.misc.SaveAnimation().SMProxy.GetFileFormatFilters())
    if ending not in known:
        raise ValueError(f"{shown(path)}: expected an ending that this ParaView can write, {', '.join(known)}; ffmpeg makes other films of "
                         "pictures, as in `ffmpeg -i film.%04d.png film.mp4`")
    view = view or simple.GetActiveView()
    expect_display(view)
    times = _times(view)
    if not times:
        raise ValueError("expected a view of data with times, got none: SaveScreenshot makes a picture")
    written: list[str] = []
    with written_by_paraview(path, lambda file, old: written.append(old)) as temporary, _playing(times):
        simple.SaveAnimation(temporary, view, **properties)
        pictures = 0 if os.path.exists(temporary) else len(os.listdir(os.path.dirname(temporary)))
        if pictures not in (0, len(times)) and not {"FrameWindow", "FrameStride"} & set(properties):
            raise RuntimeError(f"{shown(path)}: expected pictures of {len(times)} frames, got {pictures}")
    files = sorted(os.path.join(os.path.dirname(path), os.path.basename(file)) for file in written)
    if files and files != [path]:
        for old in set(glob.glob(glob.escape(stem) + ".[0-9][0-9][0-9][0-9]" + glob.escape(ending))) - set(files):
            os.remove(old)
    return files
