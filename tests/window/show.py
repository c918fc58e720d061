# SPDX-License-Identifier: BSD-3-Clause
"""granular show --window: ParaView starts with the plugin, the particles and their box at the frame that was asked for."""
import os
import sys

from window import Window, drawn, picture, read

DUMP = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
LOOK = """
from paraview.simple import *
reader = GetActiveSource()
with open("look.txt", "w") as file:
    print([reader.GetXMLName(), GetDisplayProperties().Representation, GetActiveView().ViewTime, GetDisplayProperties().ColorArrayName[1],
           len(GetRepresentations())], file=file)
"""


def program(name, text):
    with open(f"bin/{name}", "w") as file:
        file.write("#!/bin/sh\n" + text)
    os.chmod(f"bin/{name}", 0o755)


os.makedirs("bin", exist_ok=True)
program("paraview", f'exec "{sys.argv[1]}" --dr "$@" $EVENTS\n')
program("show", f'EVENTS="$*" exec "{sys.executable}" "{sys.argv[2]}" show --window --dt 2e-5 --frame -2 --color v "{DUMP}"\n')
window = Window("bin/show")
window.command = ["bin/show"]
window.in_shell(LOOK + picture("shown"))
window.play(PATH=os.path.abspath("bin") + ":" + os.environ["PATH"], PV_PLUGIN_PATH="")
with open("look.txt") as file:
    reader, representation, time, color, count = eval(file.read())
assert (reader, representation, color) == ("GranularDumpReader", "Grains", "v"), (reader, representation, color)
assert time == 0.02 and count == 2, (time, count)  # particles and box
assert drawn(read("shown")).mean() > 0.02
