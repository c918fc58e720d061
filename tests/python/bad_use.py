# SPDX-License-Identifier: BSD-3-Clause
"""What cannot be is an error that says where, what was expected and what there is; nothing crashes and nothing is lost."""
import os
import pickle
import shutil

import numpy

import vtkgranular as vg

DATA = os.environ["GRANULAR_DATA"]
SOURCE = os.path.join(DATA, "good", "grains.dump")


def raises(kind, call, *words):
    try:
        call()
    except Exception as error:  # noqa: BLE001
        assert type(error) is kind, (type(error), error)
        assert all(word in str(error) for word in words), error
        return error
    raise AssertionError(f"expected {kind}")


run = vg.open(SOURCE)
last = len(run) - 1
frame = run[-1]

# columns and frames that there are not
error = raises(vg.ColumnError, lambda: frame["velocity"], "radius", "'velocity'", "id")
assert isinstance(error, KeyError) and isinstance(error, ValueError) and isinstance(error, vg.Error)
assert frame.get("velocity") is None and "velocity" not in frame
# columns by their own names, too, and in one text
assert numpy.array_equal(frame["vx"], frame["v"][:, 0]) and "vx" in frame and numpy.array_equal(frame["y"], frame.points[:, 1])
assert list(run.read(columns="id vx")) == list(run.read(columns=["id", "v"])) == ["id", "v"]
raises(vg.ColumnError, lambda: run.read(columns=["v", "velocity"]), "'velocity'")
raises(IndexError, lambda: run[len(run)], f"from {-len(run)} to {last}", str(len(run)))
raises(IndexError, lambda: run[-len(run) - 1])
assert len(run[len(run):]) == 0 and list(run[2:2]) == []
raises(vg.ArgumentError, lambda: frame.bonds, "dump")

# requests that cannot be
raises(vg.ArgumentError, lambda: run.read(stride=0), "stride")
raises(vg.ArgumentError, lambda: run.read(region=[0, 1]), "six bounds")
for bounds in ([(1, 0), None, None], [(0, float("nan")), None, None]):
    raises(vg.ArgumentError, lambda: run.read(region=bounds), "bounds")  # noqa: B023
raises(vg.ArgumentError, lambda: run.read(coordinates="polar"), "absolute", "'polar'")
raises(vg.ArgumentError, lambda: run.read(precision="half"), "single")
raises(vg.ArgumentError, lambda: vg.open(SOURCE, kind="picture"), "dump", "'picture'")
raises(vg.ArgumentError, lambda: vg.open(SOURCE, dt=-1), "-1")

# messages name the settings that vg.open has
raises(vg.Error, lambda: vg.open(os.path.join(DATA, "good", "grains.bin"), column_names="id x"), "column_names")

# files that are not there, that are empty, that are damaged
raises(FileNotFoundError, lambda: vg.open("nowhere.dump"), "nowhere.dump")
raises(FileNotFoundError, lambda: vg.open("nowhere_*.dump"), "nowhere_*.dump")
bad = os.path.join(DATA, "bad", "row_word.dump")
error = raises(vg.Error, lambda: vg.open(bad)[0].read(), bad)
assert error.path == bad and error.line > 9 and error.column, (error.line, error.column)
again = pickle.loads(pickle.dumps(error))
assert str(again) == str(error) and (again.path, again.line, again.column) == (error.path, error.line, error.column)
for name in sorted(os.listdir(os.path.join(DATA, "bad"))):
    path = os.path.join(DATA, "bad", name)
    try:
        for each in vg.open(path, kind="dump"):
            each.read().points
    except vg.Error as error:
        assert path in str(error), (name, error)
    else:
        raise AssertionError(f"{name} was read")

# a file that is replaced or cut while the run is open
shutil.copy(SOURCE, "changing.dump")
changing = vg.open("changing.dump")
kept = changing[1]["v"]
before = kept.copy()
with open(SOURCE, "rb") as stream:
    half = stream.read()[:200000]
with open("other.dump", "wb") as stream:
    stream.write(half)
os.replace("other.dump", "changing.dump")
raises(vg.Error, lambda: changing[len(changing) - 1].read(), "changing.dump")
assert numpy.array_equal(kept, before)
changing.refresh()
assert 0 < len(changing) < len(run)
changing[0].read()
os.remove("changing.dump")
raises(FileNotFoundError, lambda: changing.refresh(), "changing.dump")

# frames that are kept while files change, here or on the way to another process, are never of two files, nor of another timestep
def write_step(step, speed):
    arrays = {"points": numpy.zeros((2, 3)), "id": [1, 2], "type": [1, 1], "speed": [speed, speed]}
    vg.write(f"kept_{step}.dump", arrays, box=vg.Box([0] * 3, [2] * 3, boundary="pp pp pp"), step=step)


for step in (100, 200, 300):
    write_step(step, step // 100)
kept = vg.open("kept_*.dump")
whole, part, unread, pickled, first = kept[1].read(), kept[1], kept[1], pickle.dumps(kept[1]), kept[0]
assert part["id"].tolist() == first["id"].tolist() == [1, 2] and pickle.loads(pickled)["speed"].tolist() == [2, 2]
write_step(200, 7)
kept.refresh()
raises(vg.ArgumentError, lambda: part["speed"], "kept_200.dump", "timestep 200", "take the frame anew")
assert part["id"].tolist() == [1, 2] and whole["speed"].tolist() == [2, 2] and kept[1]["speed"].tolist() == [7, 7]
assert unread["speed"].tolist() == [7, 7] and pickle.loads(pickled)["speed"].tolist() == [7, 7]
os.remove("kept_100.dump")
kept.refresh()
for frame in (pickle.loads(pickled), unread):
    raises(vg.ArgumentError, lambda: frame.points, "kept_200.dump: expected frame 1 to be timestep 200", "got timestep 300")  # noqa: B023
    assert frame.step == 200
raises(vg.ArgumentError, lambda: first["speed"], "timestep 100")
assert whole.step == 200 and whole.points.tolist() == [[0, 0, 0]] * 2 and kept[0]["speed"].tolist() == [7, 7]
assert [(frame["id"].sum(), frame["speed"].sum(), len(kept.refresh())) for frame in kept] == [(3, 14, 2), (3, 6, 2)]
frame = run[-1]

# a run that is closed: arrays stay, the rest says so
velocity, other = frame["v"], run[1]
expected = velocity.copy()
run.close()
run.close()
for call in (lambda: len(run), lambda: run.steps, lambda: run[0], lambda: other["v"], lambda: run.read(), lambda: run.refresh(),
             lambda: list(run), lambda: run.columns):
    raises(vg.ArgumentError, call, "closed", "grains.dump")
assert numpy.array_equal(velocity, expected) and "closed" in repr(run)
with vg.open(SOURCE) as opened:
    assert len(opened) == last + 1
raises(vg.ArgumentError, lambda: len(opened), "closed")

# a frame that was read does not need its run
with vg.open(SOURCE) as opened:
    whole, expected = opened.read(), opened.read()["v"].copy()
assert whole.step == 2000 and "v" in whole and list(whole)[0] == "id" and whole.points.shape == (whole.rows, 3)
assert numpy.array_equal(whole["v"], expected) and whole == whole and whole in {whole}
vg.write("closed.dump", whole)

# parts of kinds that have none
for path in (os.path.join(DATA, "good", "euler_1000.vtk"), os.path.join(DATA, "good", "local", "contacts.dump")):
    raises(vg.ArgumentError, lambda: vg.open(path).read(stride=10), "stride")  # noqa: B023

# functions of the caller: False stops, an exception is raised again
seen = []
vg.open(SOURCE).read(progress=seen.append)
assert seen and seen == sorted(seen) and 0 <= seen[0] and seen[-1] <= 1, seen
raises(vg.Cancelled, lambda: vg.open(SOURCE).read(progress=lambda fraction: False))
curious = vg.open(SOURCE)[-1]
curious.read(progress=lambda fraction: curious.step)
raises(ZeroDivisionError, lambda: vg.open(SOURCE).read(progress=lambda fraction: 1 / 0))
print("what cannot be is said")
