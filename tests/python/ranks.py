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
    for frame, *pieces in zip(vg.open(good(name)), *parts, strict=True):
        for word in (*frame, "points"):
            together = numpy.concatenate([piece[word] for piece in pieces])
            whole = frame.points if word == "points" else frame[word]
            assert together.dtype == whole.dtype and (together == whole).all(), (name, word)

errors = on_all(3, lambda rank: vg.open("no_such.dump", ranks=rank))
assert {(type(error), str(error)) for error in errors} == {(FileNotFoundError, str(errors[0]))} and "no_such.dump" in str(errors[0])


def refused(work):
    try:
        work()
    except vg.ArgumentError as error:
        return str(error)
    raise AssertionError("expected an error")


def stop(rank):
    run = vg.open(good("grains.dump"), ranks=rank)
    try:
        run.read(progress=lambda _: rank.Get_rank() != 1)
    except vg.Cancelled:
        return run.refresh().read(columns="id").rows  # the run goes on
    return None


assert sum(on_all(3, stop)) == 1200
asked_inside = on_all(2, lambda rank: refused(lambda run=vg.open(good("grains.dump"), ranks=rank): run.read(progress=lambda _: run.refresh())))
assert all("from a function for progress" in text for text in asked_inside), asked_inside
written = on_all(2, lambda rank: refused(lambda: vg.write("part.dump", vg.open(good("grains.dump"), ranks=rank)[-1])))
assert all("a part" in text for text in written), written
assert "cells or subdomains" in refused(lambda: vg.open(good("decomposition_1000.vtk")).read(piece=0, pieces=2))
assert on_all(3, lambda rank: vg.open(good("decomposition_1000.vtk"), ranks=rank)[0].rows) == [vg.open(good("decomposition_1000.vtk"))[0].rows] * 3
for name, number in (("pieces", 2**32 + 2), ("piece", -1), ("threads", 2**31), ("stride", 2**64 + 2), ("stride", 0)):
    assert refused(lambda: vg.open(good("grains.dump")).read(**{name: number})).startswith(f"expected {name} from ")


class Broken:
    def Get_rank(self):
        return 0

    def Get_size(self):
        return 2

    calls = 0

    def Allgather(self, *_):
        self.calls += 1
        assert self.calls == 1  # the ranks are at odds
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
contacts = vg.open(good("local/chain_bonds.dump"))
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    assert contacts[-1].read().row_label == "BONDS"
remark = told[0].message
assert isinstance(remark, vg.Remark) and remark.path == good("local/chain_bonds.dump") and str(remark).startswith(f"{remark.path}:{remark.line}: ")
assert {column.name: column.columns for column in contacts.columns}["force"] == ("forcex", "forcey", "forcez")
assert vg.open(good("shapes/superellipsoids.dump"))[0].shape_sizes == "diameters"
print("ranks get together what one process gets")
