# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts one after another in one pvbatch, as several processes take longer to start than most scripts to run:

in_turn.py OUTPUT NAME=SCRIPT[,ARGUMENT...]...   each in its folder below OUTPUT
"""
import gc
import os
import runpy
import sys
import traceback

from paraview import simple

output, *scripts = sys.argv[1:]
failed = []
for each in scripts:
    name, _, words = each.partition("=")
    print("--", name, file=sys.stderr, flush=True)
    folder = os.environ["GRANULAR_OUTPUT"] = os.path.join(output, name)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    sys.argv[:] = words.split(",")
    sys.path[0] = os.path.dirname(sys.argv[0])
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    except BaseException:
        traceback.print_exc()
        failed.append(name)
    for proxy in [*simple.GetRenderViews(), *simple.GetSources().values()]:
        simple.Delete(proxy)
    gc.collect()
assert not failed, failed
