# SPDX-License-Identifier: BSD-3-Clause
"""Binary, compressed and split dumps, opened as ParaView opens files; reader_numbers.py has every number of such files."""
import gzip
import os
import shutil
import struct

from paraview.simple import *

data = os.path.join(os.environ["GRANULAR_DATA"], "good")
PARTICLES = "id type x y z ix iy iz vx vy vz radius"  # of grains.bin, in the words of its `dump custom`


def good(name):
    return os.path.join(data, name)


def content(name):
    with open(good(name), "rb") as file:
        return file.read()


def write(name, content):
    with open(name, "wb") as file:
        file.write(content)
    return os.path.abspath(name)


def points(reader, time=None):
    reader.UpdatePipeline() if time is None else reader.UpdatePipeline(time)
    return reader.GetDataInformation().GetNumberOfPoints()


def zstandard(content):
    """One frame of Zstandard (RFC 8878) whose blocks are stored as they are."""
    packed = b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", len(content))
    starts = range(0, len(content), 100000)
    for start in starts:
        block = content[start:start + 100000]
        packed += struct.pack("<I", len(block) << 3 | (start == starts[-1]))[:3] + block
    return packed


# ---- every name that such files have -----------------------------------------------------------

text, binary, packed = content("grains_1000.dump"), content("ortho_image.bin"), \
    content("ortho_000050.dump.gz")
for name, content_of_it, count in (
        ("a.bin", binary, 500), ("a.lammpsbin", binary, 500), ("A.BIN", binary, 500),
        ("dump.100.bin", binary, 500), ("dump.binary", binary, 500),
        ("a.dump.gz", packed, 500), ("a.lammpstrj.gz", packed, 500), ("dump.50.gz", packed, 500),
        ("a.gz", packed, 500), ("a.bin.gz", gzip.compress(binary), 500),
        ("a.dump", packed, 500),  # compressed under a name that does not say so
        ("b.dump.gz", text, 1200),  # and the other way round
        ("two.dump.gz", gzip.compress(text[:3000]) + gzip.compress(text[3000:]), 1200),
        ("a.dump.zst", zstandard(text), 1200), ("a.lammpstrj.zst", zstandard(text), 1200),
        ("dump.1000.zst", zstandard(text), 1200), ("a.bin.zst", zstandard(binary), 500)):
    reader = OpenDataFile(write(name, content_of_it))
    assert reader is not None and reader.GetXMLName() == "GranularDumpReader", name
    assert points(reader) == count, (name, points(reader))
    Delete(reader)

# ---- what the files do not say -----------------------------------------------------------------

# a frame with its pieces in folders of their own: only Merge can know
for process in range(4):
    os.makedirs(f"process{process}", exist_ok=True)
    shutil.copy(good(f"pieces_1000.{process}.dump"), f"process{process}/1000.dump")
reader = GranularDumpReader(RepeatedSteps="Merge", FileNames=[
    os.path.abspath(f"process{process}/1000.dump") for process in range(4)])
assert points(reader) == 1200

# opened first, named afterwards: that is how it is done in the window
reader = OpenDataFile(good("grains.bin"))
assert reader is not None and reader.GetXMLName() == "GranularDumpReader"
assert (reader.ColumnNames, reader.RepeatedSteps, reader.RefreshOnUpdate) == ("", "Auto", 0)
reader.ColumnNames = PARTICLES
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == [0, 1000, 2000]
assert list(reader.PointArrayStatus) == ["id", "type", "image", "v", "radius"], reader.PointArrayStatus
for names, last in ((PARTICLES, "radius"), (PARTICLES.replace("radius", "size"), "size")):
    reader.ColumnNames = names
    assert points(reader, 1000) == 1200
    assert sorted(reader.PointData.keys()) == ["id", "image", last, "type", "v"], reader.PointData.keys()
