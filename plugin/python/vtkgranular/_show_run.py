# SPDX-License-Identifier: BSD-3-Clause
"""Particles, box, walls and contacts of a folder on one clock."""
from __future__ import annotations

import os
from typing import Any, Iterable

from ._errors import upstream
from ._film import FOLLOWS
from ._folder import Folder, Series
from ._library import Remark
from ._plugin import expect_plugin, has_plugin
from ._reader import reader
from ._run import _warn
from ._show import _GREY, expect_display, show


def _active_reader() -> Any:
    """The reader that the active source is, or stands on."""
    from paraview import simple

    active = simple.GetActiveSource()
    for each in reversed(upstream(active) if active else []):
        if each.SMProxy.GetProperty("FileNames"):
            return each
    raise ValueError("expected a folder, or an active source that reads files, got neither")


def _chosen(folder: Folder, given: bool | str | Iterable[str], default: list[Series]) -> list[Series]:
    if isinstance(given, bool):
        return default if given else []
    return [folder[name] for name in ([given] if isinstance(given, str) else given)]


def show_run(folder: str | os.PathLike[str] | None = None, dt: float | None = None, view: Any = None, color: str | None = None,
             walls: bool | str | Iterable[str] = True, contacts: bool | str | Iterable[str] = False, box: bool = True,
             legend: bool = True) -> dict[str, Any]:
    """Shows the particles of a run with their box, walls and contacts, and returns the displays by the names of the series.

    folder    as for vtkgranular.open; None: that of the files of the active source, which is hidden, and whose times are left out
    dt        the time of one timestep; None: as a log in the folder or in the one above tells it, and a remark says so
    color     name of the array to colour particles by; by default their velocities, or their types
    walls     True: those that move with the particles; or names of series, such as "walls_*.vtk"; False: none
    contacts  True: the contacts or bonds with most timesteps, as lines through translucent particles; or names of series

    The animation plays the times of the particles, and is at the last one. A remark names walls and contacts that lack one of these: the
    file before is shown. Raises ValueError if there is nothing to show, and what vtkgranular.reader and show raise.
    """
    from paraview import servermanager, simple

    expect_plugin(has_plugin())
    active = [_active_reader()] if folder is None else []
    found = Folder(os.path.dirname(active[0].FileNames[0]) if active else os.fspath(folder), dt)
    has_vtk = hasattr(servermanager.sources, "GranularMeshReader")
    particles = found.particles if has_vtk else found.best("dump")
    lines = found.best("local", "contacts") if has_vtk else found.best("local")
    others = _chosen(found, walls, found.walls) + _chosen(found, contacts, [lines] if lines else [])
    for each in [each for each in others if each.kind in ("walls", "contacts") and not has_vtk]:
        others.remove(each)
        _warn(Remark(f"{each.name} is left out: the portable plugin has no reader of VTK and STL files"))
    if not particles and not others:
        raise ValueError(f"{found.path}: expected particles, walls or contacts, got {', '.join(found) or 'no files'}")
    view = view or simple.GetActiveViewOrCreate("RenderView")
    expect_display(view)
    if active:
        simple.HideAll(view)
    source = reader(particles.files, found.dt) if particles else None
    readers = {each.name: reader(each.files, found.dt) for each in others if each is not particles}
    if particles in others:
        name = f"walls of {particles.name}"
        readers[name] = simple.GranularMeshReader(registrationName=name, FileNames=particles.files, TimestepSize=found.dt or 1)
    keeper = simple.GetTimeKeeper()  # walls and contacts follow the clock of the particles
    keeper.SuppressedTimeSources = [*keeper.SuppressedTimeSources, *active, *(readers.values() if source else ())]
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = scene.EndTime
    made = {}
    if source:
        colors = [color] if color else [name for name in ("v", "type") if name in particles.columns]
        made[particles.name] = show(source, view, color=colors[0] if colors else None, box=box, legend=legend)
    kinds = {each.name: each.kind for each in others}
    for name, shown in readers.items():
        is_wall = kinds.get(name, "walls") == "walls"
        if source and kinds.get(name) == "local" and "id1" in found[name].columns:
            shown.UpdatePipeline(scene.AnimationTime)
            if not shown.GetDataInformation().GetNumberOfPoints():  # the file has no places
                shown = simple.GranularLocalJoin(Input=source, Lines=simple.OutputPort(shown, 1))
        if source:
            shown.SMProxy.SetAnnotation(FOLLOWS, particles.name)
        made[name] = simple.Show(shown, view)
        made[name].ColorArrayName = [None, ""]
        grey = [0.6] * 3 if is_wall else _GREY
        for key, value in {"AmbientColor": grey, "DiffuseColor": grey, "LineWidth": 3, "Opacity": 0.4 if is_wall else 1}.items():
            setattr(made[name], key, value)
        if source and not is_wall:
            made[particles.name].Opacity = 0.3
    view.ResetActiveCameraToPositiveY()
    simple.ResetCamera(view)
    told = [f"the time of a timestep, {found.dt:g}, is from {found.dt_path}"] if found.dt_path else []
    for text in told + [text for text in found.remarks if text.split(" lacks ")[0] in made]:
        _warn(Remark(text))
    return made
