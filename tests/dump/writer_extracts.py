# SPDX-License-Identifier: BSD-3-Clause
"""An extractor writes a dump of each time step of a run."""
import gzip
import os

from paraview.simple import *

source = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
with open(source, "rb") as file:
    frames = [b"ITEM: TIMESTEP" + part for part in file.read().split(b"ITEM: TIMESTEP")[1:]]


def content(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
        return file.read()


reader = OpenDataFile(source)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
extractor = CreateExtractor("GranularDump", reader)
assert extractor.Writer.FileName.endswith("_{timestep:06d}.dump"), extractor.Writer.FileName
extractor.Writer.FileName = "grains_{timestep:06d}.dump"
extractor.Writer.Dialect = "LIGGGHTS"
SaveExtracts(ExtractsOutputDirectory=os.path.abspath("counted"))
assert [content(f"counted/grains_{i:06d}.dump") for i in range(3)] == frames
extractor.Writer.FileName = "grains_*.dump.gz"
SaveExtracts(ExtractsOutputDirectory=os.path.abspath("stepped"))
assert [content(f"stepped/grains_{step}.dump.gz") for step in (0, 1000, 2000)] == frames
