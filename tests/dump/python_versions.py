# SPDX-License-Identifier: BSD-3-Clause
"""The functions that know what ParaView's versions call things, and pvbatch() on several ranks."""
import sys

import vtkgranular as vg
from paraview import simple
from vtkmodules.vtkParallelCore import vtkMultiProcessController


def on_ranks(how):
    """What each of several processes does."""
    source = simple.Sphere()
    ids, name = vg.process_ids(source)
    ids.UpdatePipeline()
    print(vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses(), ids.PointData[name].GetRange(), how)
    if how == "fail":
        raise ValueError("as it was told")


def raised(kind, call, *arguments, **named):
    try:
        call(*arguments, **named)
    except kind as error:
        return str(error)
    raise AssertionError(f"{call.__name__}{arguments} raised nothing")


def on_one():
    # ---- colour presets ----------------------------------------------------------------------------
    colors = simple.GetColorTransferFunction("anything")
    points = set()
    for name in ("Plasma", "Plasma (matplotlib)", "Viridis", "Cool to Warm"):
        assert colors.ApplyPreset(vg.preset(name), True), name
        points.add(tuple(colors.RGBPoints))
    assert len(points) == 3  # the first two are the same
    assert "Plasmon" in raised(ValueError, vg.preset, "Plasmon")

    # ---- formats of colour bars --------------------------------------------------------------------
    bar = simple.GetScalarBar(colors, simple.CreateRenderView())
    expected = "%.1f m/s" if simple.GetParaViewVersion() < (6, 1) else "{:.1f} m/s"
    vg.set_properties(bar, Title="speed", **vg.label_format("%.1f m/s"))
    assert (bar.LabelFormat, bar.RangeLabelFormat, bar.AutomaticLabelFormat) == (expected, expected, 0)
    for text in ("", "%d", "%.1f %.1f", "{:.1f}"):
        assert "'%.1f'" in raised(ValueError, vg.label_format, text)
    raised(AttributeError, vg.set_properties, bar, NoSuchProperty=1)

    # ---- ranks -------------------------------------------------------------------------------------
    assert vg.pvbatch(__file__, "well", ranks=3).split("\n")[-2] == "3 (0.0, 2.0) well"
    said = raised(RuntimeError, vg.pvbatch, __file__, "fail", ranks=2)
    assert "failed on 2 ranks" in said and "as it was told" in said, said


if len(sys.argv) > 1:
    on_ranks(sys.argv[1])
else:
    on_one()
