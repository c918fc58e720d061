# SPDX-License-Identifier: BSD-3-Clause
"""Binary, compressed and split dumps, opened as ParaView opens files, and what is said of them by the
names of the properties."""
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

# ---- files of a run ----------------------------------------------------------------------------

for box in ("ortho", "tri"):
    reader = OpenDataFile([good(f"{box}_{step}.dump.gz") for step in ("000100", "000000", "000050")])
    assert list(reader.TimestepValues) == [0, 50, 100], reader.TimestepValues
    assert list(reader.PointArrayStatus) == ["id", "type"], reader.PointArrayStatus
    assert points(reader, 50) == 500
    # the same numbers as those of the text, to the digits that it has
    other = OpenDataFile(good(f"{box}_scaled.dump"))
    points(reader, 100)
    points(other, 100)
    bounds, expected = (one.GetDataInformation().GetBounds() for one in (reader, other))
    assert all(abs(a - b) < 1e-4 for a, b in zip(bounds, expected)), (bounds, expected)
    for form, arrays in (("scaled", ["id", "type"]), ("image", ["id", "type", "image"])):
        reader = OpenDataFile(good(f"{box}_{form}.bin"))
        assert list(reader.TimestepValues) == [0, 100], reader.TimestepValues
        assert list(reader.PointArrayStatus) == arrays, reader.PointArrayStatus
        other = OpenDataFile(good(f"{box}_{form}.dump"))
        assert points(reader, 100) == points(other, 100) == 500
        bounds, expected = (one.GetDataInformation().GetBounds() for one in (reader, other))
        assert all(abs(a - b) < 1e-4 for a, b in zip(bounds, expected)), (bounds, expected)

# one file a process, chosen in any order
pieces = [good(f"pieces_{step}.{process}.dump")
          for process in (3, 0, 2, 1) for step in (2000, 0, 1000)]
reader = OpenDataFile(pieces)
assert reader.RepeatedSteps == "Auto"
assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
assert [points(reader, time) for time in (0, 1000, 2000)] == [0, 1200, 1200]
assert reader.PointData["id"].GetRange(0) == (1, 1200)
assert OutputPort(reader, "Box").GetDataInformation().GetNumberOfCells() == 1
reader.RepeatedSteps = "Merge"
assert points(reader, 1000) == 1200

# a frame with its pieces in folders of their own: only Merge can know
for process in range(4):
    os.makedirs(f"process{process}", exist_ok=True)
    shutil.copy(good(f"pieces_1000.{process}.dump"), f"process{process}/1000.dump")
reader = GranularDumpReader(RepeatedSteps="Merge", FileNames=[
    os.path.abspath(f"process{process}/1000.dump") for process in range(4)])
assert points(reader) == 1200
try:
    reader.RepeatedSteps = "Sometimes"
except ValueError:
    pass
else:
    raise AssertionError("a RepeatedSteps that does not exist was accepted")

# ---- columns without names ---------------------------------------------------------------------

reader = GranularDumpReader(FileNames=[good("grains.bin")], ColumnNames=PARTICLES)
reader.UpdatePipelineInformation()
assert list(reader.TimestepValues) == [0, 1000, 2000], reader.TimestepValues
assert list(reader.PointArrayStatus) == ["id", "type", "image", "v", "radius"], \
    reader.PointArrayStatus
assert points(reader, 1000) == 1200
low, high = reader.PointData["radius"].GetRange(0)
assert (low, high) == (0.0025, 0.0035), (low, high)
bounds = reader.GetDataInformation().GetBounds()
expected = OpenDataFile(good("grains_1000.dump"))
points(expected)
expected = expected.GetDataInformation().GetBounds()
assert all(abs(a - b) < 1e-6 for a, b in zip(bounds, expected)), (bounds, expected)

# opened first, named afterwards: that is how it is done in the window
reader = OpenDataFile(good("grains.bin"))
assert reader is not None and reader.GetXMLName() == "GranularDumpReader"
reader.ColumnNames = PARTICLES
assert points(reader, 1000) == 1200
assert sorted(reader.PointData.keys()) == ["id", "image", "radius", "type", "v"], \
    reader.PointData.keys()
assert list(reader.TimestepValues) == [0, 1000, 2000]
# another name
reader.ColumnNames = PARTICLES.replace("radius", "size")
points(reader, 1000)
assert sorted(reader.PointData.keys()) == ["id", "image", "size", "type", "v"], \
    reader.PointData.keys()

# ---- names, defaults, words, and the state -----------------------------------------------------

reader = OpenDataFile(good("grains_1000.dump"))
for name, default in (("ColumnNames", ""), ("RepeatedSteps", "Auto"), ("RefreshOnUpdate", 0)):
    assert getattr(reader, name) == default, (name, getattr(reader, name))
    explained = reader.SMProxy.GetProperty(name).GetDocumentation()
    assert explained and len(explained.GetDescription().strip()) > 60, name

ResetSession()
reader = OpenDataFile(good("grains.bin"))
reader.ColumnNames = PARTICLES
reader.RepeatedSteps = "Last"
reader.RefreshOnUpdate = 1
reader.UpdatePipelineInformation()
reader.PointArrayStatus = ["id", "radius"]
assert points(reader, 1000) == 1200
SaveState(os.path.abspath("forms.pvsm"))
ResetSession()
LoadState(os.path.abspath("forms.pvsm"))
loaded = [proxy for proxy in GetSources().values() if proxy.GetXMLName() == "GranularDumpReader"]
assert len(loaded) == 1, GetSources()
reader = loaded[0]
assert reader.ColumnNames == PARTICLES and reader.RepeatedSteps == "Last"
assert reader.RefreshOnUpdate == 1
assert list(reader.PointArrayStatus) == ["id", "radius"], reader.PointArrayStatus
assert points(reader, 1000) == 1200
assert sorted(reader.PointData.keys()) == ["id", "radius"], reader.PointData.keys()

# what may be chosen is what there is, also when the names of the columns came later
reader = OpenDataFile(good("grains.bin"))
reader.ColumnNames = PARTICLES
reader.UpdatePipelineInformation()
assert list(reader.PointArrayStatus) == ["id", "type", "image", "v", "radius"], \
    reader.PointArrayStatus
