# SPDX-License-Identifier: BSD-3-Clause
"""Threads as ranks of mpi4py: together they get the frames that one process gets. Kinds of files, and what headers and remarks say."""
import os
import threading
import warnings

import numpy
import vtkgranular as vg


class Ranks:
    """Communicators of threads, with what is used of mpi4py's."""

    def __init__(self, size):
        self.barrier, self.sent = threading.Barrier(size, timeout=60), [b""] * size

    def __getitem__(self, number):
        ranks = self

        class Rank:
            def Get_rank(self):
                return number

            def Get_size(self):
                return len(ranks.sent)

            def Allgather(self, mine, gathered):
                assert memoryview(mine).format == memoryview(gathered).format == "B"  # which mpi4py knows
                ranks.sent[number] = bytes(mine)
                ranks.barrier.wait()
                gathered[:] = b"".join(ranks.sent)
                ranks.barrier.wait()
        return Rank()


def on_all(size, work):
    ranks, made = Ranks(size), [None] * size

    def run(number):
        try:
            made[number] = work(ranks[number])
        except Exception as error:
            made[number] = error
    threads = [threading.Thread(target=run, args=(i,)) for i in range(size)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return made


def good(name):
    return os.path.join(os.environ["GRANULAR_DATA"], "good", name)


warnings.simplefilter("ignore")
for name in ("grains.dump", "local/contacts.dump", "data_file/full.data"):
    parts = on_all(3, lambda rank: [{word: frame[word] for word in frame} | {"points": frame.points} for frame in vg.open(good(name), ranks=rank)])
    for frame, *pieces in zip(vg.open(good(name)), *parts):
        for word in (*frame, "points"):
            together = numpy.concatenate([piece[word] for piece in pieces])
            whole = frame.points if word == "points" else frame[word]
            assert together.dtype == whole.dtype and (together == whole).all(), (name, word)

errors = on_all(3, lambda rank: vg.open("no_such.dump", ranks=rank))
assert {(type(error), str(error)) for error in errors} == {(FileNotFoundError, str(errors[0]))} and "no_such.dump" in str(errors[0])


class Broken:
    def Get_rank(self):
        return 0

    def Get_size(self):
        return 2

    def Allgather(self, *_):
        raise ConnectionError("the other rank has gone")


try:
    raise AssertionError(vg.open(good("grains.dump"), ranks=Broken()))
except ConnectionError as error:
    assert str(error) == "the other rank has gone"

one, two = (vg.open(good("grains.dump")).read(columns="id", piece=i, pieces=2) for i in range(2))
assert (numpy.concatenate((one["id"], two["id"])) == vg.open(good("grains.dump"))[-1]["id"]).all()

# ---- kinds, headers, columns, remarks ------------------------------------------------------------------------------------
kinds = {"grains.dump": "dump", "local/contacts.dump": "local", "data_file/full.data": "data", "decomposition_1000.vtk": "decomposition"}
assert {name: vg.kind_of(good(name)) for name in kinds} == kinds
assert vg.kind_of(__file__) is vg.kind_of("no_such.dump") is None
contacts = vg.open(good("local/contacts.dump"))
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    assert contacts[-1].read().row_label == "ENTRIES"
remark = told[0].message
assert isinstance(remark, vg.Remark) and remark.path == good("local/contacts.dump") and str(remark).startswith(f"{remark.path}:{remark.line}: ")
assert {column.name: column.columns for column in contacts.columns}["force"] == ("forcex", "forcey", "forcez")
assert vg.open(good("shapes/superellipsoids.dump"))[0].shape_sizes == "diameters"
print("ranks get together what one process gets")
