# SPDX-License-Identifier: BSD-3-Clause
"""Runs and frames in threads and processes: pickled by their files, forked with the file open, iterated with reading ahead."""
import multiprocessing
import os
import subprocess
import sys
import threading

import numpy

import vtkgranular as vg

SOURCE = os.path.join(os.environ["GRANULAR_DATA"], "good", "grains.dump")
# Python ends while threads read, one of them in a function for progress
ENDING = """
import sys, threading, time, vtkgranular as vg
run, inside = vg.open(sys.argv[1], threads=2), threading.Event()

def slow(fraction):
    inside.set()
    time.sleep(0.01)

def read(progress):
    while True:
        run.read(progress=progress)

for progress in (None, None, slow):
    threading.Thread(target=read, args=(progress,), daemon=True).start()
inside.wait()
"""


def total(frame):
    return frame.step, frame["v"].sum()


def main():
    run = vg.open(SOURCE, dt=2e-5, threads=2)
    expected = [(frame.step, frame["v"].sum()) for frame in (run[i] for i in range(len(run)))]

    # reading ahead gives what reading one by one gives, whichever columns are asked for
    assert [total(frame) for frame in run] == expected
    assert [total(frame) for frame in run[::-1]] == expected[::-1]
    for frame, alone in zip(run, (run[i] for i in range(len(run)))):
        names = list(frame)[: 1 + frame.number % 3]
        for name in names:
            assert numpy.array_equal(frame[name], alone[name]), name
        assert numpy.array_equal(frame.points, alone.points)
    for frame in run:
        frame["id"]
        break  # what was read ahead is of no harm

    for way in ("fork", "spawn"):
        with multiprocessing.get_context(way).Pool(2) as pool:
            assert pool.map(total, run) == expected, way
            assert pool.map(total, run[1:3]) == expected[1:3], way

    # a child of a process whose run is open, and has been read by several threads
    run[-1].read()
    child = os.fork()
    if child == 0:
        os._exit(0 if total(run[-1]) == expected[-1] and total(run[1]) == expected[1] else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert total(run[-1]) == expected[-1]

    # a child of a process that reads ahead
    for frame in run:
        frame["v"]
        child = os.fork()
        if child == 0:
            os._exit(0 if total(run[-1]) == expected[-1] and [total(each) for each in run] == expected else 1)
        assert os.waitpid(child, 0)[1] == 0

    # a child does not touch the file that its parent is writing, whatever ends it
    if os.path.exists("parent.dump"):
        os.remove("parent.dump")
    writer = vg.Writer("parent.dump")
    writer.write(run[0])
    for leave in (writer.abandon, writer.finish, lambda: writer.write(run[1]), lambda: writer.__del__()):
        child = os.fork()
        if child == 0:
            try:
                leave()
            except OSError as error:
                assert "a child" in str(error) and "parent.dump" in str(error), error
            finally:
                writer.abandon()
                os._exit(0 if "parent.dump" not in os.listdir() else 1)
        assert os.waitpid(child, 0)[1] == 0
    writer.write(run[1])
    writer.finish()
    vg.write("alone.dump", run[:2])
    with open("parent.dump", "rb") as mine, open("alone.dump", "rb") as alone:
        assert mine.read() == alone.read()

    # one run, one frame, several threads; closed while others read
    found, frame = [], run[-1]
    threads = [threading.Thread(target=lambda: found.append((total(frame), [total(each) for each in run]))) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [(expected[-1], expected)] * 6

    looked = []

    def look_at_names():
        for _ in range(200):
            assert [column.name for column in run.columns][0] == "id" and run.files == [SOURCE] and len(run.steps) == len(expected)
        looked.append(True)

    threads = [threading.Thread(target=look_at_names) for _ in range(3)]
    for thread in threads:
        thread.start()
    for _ in range(50):
        run.refresh()
    for thread in threads:
        thread.join()
    assert len(looked) == 3

    try:
        run.read(progress=lambda fraction: run.refresh())  # which would wait for the end of the reading
        raise AssertionError("refreshed")
    except vg.ArgumentError as error:
        assert "function for progress" in str(error)
    assert total(run[-1]) == expected[-1] and len(run.refresh()) == len(expected)
    seen = []
    run.refresh(progress=lambda fraction: seen.append((len(run), run.steps[0], total(run[0]))))
    assert set(seen) == {(len(expected), 0, expected[0])}, seen

    for _ in range(8):
        done = subprocess.run([sys.executable, "-c", ENDING, SOURCE], capture_output=True, text=True)
        assert done.returncode == 0 and not done.stderr, done

    results = []

    def read_until_closed():
        try:
            for _ in range(1000):
                results.append(total(run[-1]) == expected[-1])
        except ValueError as error:
            results.append("closed" in str(error))

    threads = [threading.Thread(target=read_until_closed) for _ in range(3)]
    for thread in threads:
        thread.start()
    while len(results) < 10:
        pass
    run.close()
    for thread in threads:
        thread.join()
    assert all(results) and 10 <= len(results) < 3000


if __name__ == "__main__":
    main()
    print("threads and processes agree")
