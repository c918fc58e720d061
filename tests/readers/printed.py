# SPDX-License-Identifier: BSD-3-Clause
"""Each class prints all of its properties, under their names and with their values."""
import vtkgranular as vg
from vtkgranular import vtkGranular as module


def words_of(value):
    """The ways to print a value."""
    if value is None or isinstance(value, bool):
        return {None: ("(none)", "0"), True: ("On",), False: ("Off",)}[value]
    return (value if isinstance(value, str) else " ".join(f"{each:g}" for each in (value if isinstance(value, tuple) else (value,))),)


seen = 0
for kind in (name for name in dir(module) if name.startswith("vtkGranular")):
    try:
        made = getattr(vg, kind)()
    except TypeError:  # an abstract class, whose properties are those of the others
        continue
    assert not hasattr(made, "GetArraySelection") or "  ArraySelection:\n" in str(made), kind
    if hasattr(made, "AddFileName"):
        made.AddFileName("a.file")
        assert "a.file" in str(made), kind
    names = {name for each in type(made).__mro__ if each.__name__.startswith("vtkGranular") for name in vars(each)}
    for name in (name[3:] for name in names if name.startswith("Set") and "G" + name[1:] in names):
        value = getattr(made, f"Get{name}")()
        if isinstance(value, (str, float)):  # other types have few values
            value = value + "a b" if isinstance(value, str) else value + 0.25
        elif isinstance(value, tuple):
            value = tuple(each + i for i, each in enumerate(value))
        getattr(made, f"Set{name}")(value)
        printed = [line.split(": ", 1)[1] for line in str(made).split("\n") if line.startswith(f"  {name}: ")]
        words = words_of(value) + (("Points",) if (kind, name) == ("vtkGranularEulerReader", "OutputType") else ())
        assert len(printed) == 1 and printed[0] in words, (kind, name, printed, words)
        if isinstance(value, str):
            getattr(made, f"Set{name}")(None)
            assert f"  {name}: " in str(made), (kind, name)
        seen += 1
assert seen > 200, seen
