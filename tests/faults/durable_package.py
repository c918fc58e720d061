# SPDX-License-Identifier: BSD-3-Clause
"""What waits for the disk in the package, in `granular convert` and in the proxies of ParaView: the file and its name, two calls a file.
Argument: proxies, for those of ParaView alone."""
import os
import sys

import failing_calls

SOURCE = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")  # three frames


def syncs(use):
    return failing_calls.count(failing_calls.SYNC, use)


def check_package():
    import granular

    frames = list(granular.open(SOURCE))
    for path, durable, expected in [("one.dump", None, 2), ("one.dump", True, 2), ("one.dump", False, 0), ("many_*.dump", None, 0),
                                    ("many_*.dump", True, 6), ("many_*.dump", False, 0)]:
        made = syncs(lambda: granular.write(path, frames, durable=durable))
        assert made == expected, (path, durable, made)


def check_command():
    from granular.command import main

    for to, options, expected in [("one.bin", [], 2), ("one.bin", ["--durable", "on"], 2), ("one.bin", ["--durable", "off"], 0),
                                  ("many_*.bin", [], 0), ("many_*.bin", ["--durable", "on"], 6), ("one.csv", ["--frames", "0"], 2),
                                  ("one.csv", ["--frames", "0", "--durable", "off"], 0), ("many_*.csv", [], 0),
                                  ("many_*.csv", ["--durable", "on"], 6)]:
        sys.argv = ["granular", "convert", SOURCE, to, "--quiet", *options]
        made = syncs(main)
        assert os.path.exists(to.replace("*", "1000")) and made == expected, (to, options, made)


def check_proxies():
    from paraview import servermanager
    from paraview.simple import CreateExtractor, CreateWriter, GranularDumpReader

    for name in ("Dump", "Local", "Euler", "Decomposition"):
        proxy = servermanager.ProxyManager().NewProxy("writers", f"Granular{name}Writer")
        assert servermanager._getPyProxy(proxy).Durable == "Automatic", name
    reader = GranularDumpReader(FileNames=[SOURCE])
    writer = CreateWriter(os.path.abspath("proxy.dump"), reader)
    for durable, expected in (("Automatic", 2), ("On", 2), ("Off", 0)):
        writer.FileName = os.path.abspath(durable + ".dump")
        writer.Durable = durable
        made = syncs(writer.UpdatePipeline)
        assert os.path.exists(writer.FileName) and made == expected, (durable, made)
    # extracts are written in a loop, by programs that run
    assert CreateExtractor("GranularDump", reader).Writer.Durable == "Off"


if sys.argv[1:] == ["proxies"]:
    check_proxies()
else:
    check_package()
    check_command()
