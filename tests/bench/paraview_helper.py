# SPDX-License-Identifier: BSD-3-Clause
"""What bench_pipeline and bench_vtp have done in ParaView: answers questions, see helper.h.

A question is a verb and its arguments, with | between them."""
import os
import time
import zlib

import granular
from paraview.modules.vtkRemotingCore import vtkPVDataInformation
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

# Of the rows that the benchmarks make, in their order; the points are third.
ARRAYS = ("id", "type", None, "v", "f", "radius")

steppers = {}


def output(proxy):
    return proxy.GetClientSideObject().GetOutputDataObject(0)


def checksums(dataset):
    """The CRC-32 of each array; "unreadable" if there is no data."""
    if not dataset or not dataset.GetPoints():
        return "unreadable"
    arrays = [dataset.GetPointData().GetArray(name) if name else dataset.GetPoints().GetData()
              for name in ARRAYS]
    return " ".join(str(zlib.crc32(vtk_to_numpy(array))) if array else "none" for array in arrays)


# ---- a run that is stepped through -----------------------------------------------------------------
class Stepper:
    """A reader with some properties, and what is updated, which may be a filter."""

    def __init__(self, reader, last=None, after=lambda data: None, **properties):
        self.reader, self.last, self.after, self.properties = reader, last or reader, after, properties

    def start(self):
        for name, value in self.properties.items():
            self.reader.GetProperty(name).SetElement(0, value)
        self.reader.UpdateVTKObjects()

    def stop(self):
        self.reader.Prefetch = 0  # what it does ahead must not go on while others work
        self.reader.UpdateVTKObjects()


def gather_information(data):
    """What the window's client does after each update: the ranges of all arrays, and the bounds."""
    vtkPVDataInformation().CopyFromObject(data)


def open_run(path):
    granular.set_pool_limit(0)
    poolless = OpenDataFile(path)
    poolless.UpdatePipeline()
    granular.set_pool_limit(None)
    reader, filtered = OpenDataFile(path), OpenDataFile(path)
    half = Threshold(Input=filtered, Scalars=["POINTS", "radius"], LowerThreshold=0.0015,
                     UpperThreshold=0.002)
    one = {"Threads": 1, "Prefetch": 0}
    ahead = {"Threads": 1, "Prefetch": 1}
    steppers.update({
        "1 thread": Stepper(reader, **one),
        "1 thread, no pool": Stepper(poolless, **one),
        "1 thread, and data information": Stepper(reader, after=gather_information, **one),
        "1 thread, prefetch": Stepper(reader, **ahead),
        "1 thread, and a filter": Stepper(filtered, half, **one),
        "1 thread, prefetch, and a filter": Stepper(filtered, half, **ahead),
        "all threads": Stepper(reader, Threads=0, Prefetch=0)})
    return "open"


def check(name, frame):
    """The checksums of a frame, as this stepper gets it."""
    stepper = steppers[name]
    stepper.start()
    stepper.last.UpdatePipeline(float(frame))
    stepper.stop()
    return checksums(output(stepper.reader))


def steps(name, first, count):
    """Seconds, and seconds of processors, of so many steps after the first frame."""
    stepper = steppers[name]
    stepper.start()
    stepper.last.UpdatePipeline(float(first))
    times = [int(first) + 1 + step for step in range(int(count))]
    shown = []
    start, processor = time.perf_counter(), time.process_time()
    for moment in times:
        stepper.last.UpdatePipeline(float(moment))
        stepper.after(output(stepper.last))
        shown.append(output(stepper.last).GetFieldData().GetArray("timestep").GetValue(0))
    answer = f"{time.perf_counter() - start:.9f} {time.process_time() - processor:.9f}"
    stepper.stop()
    assert shown == times
    return answer


# ---- files that are opened anew --------------------------------------------------------------------
def load(path, threads):
    reader = OpenDataFile(path)
    if threads is not None:
        reader.Threads = int(threads)
    reader.UpdatePipeline()
    return reader


def look(path, threads=None):
    reader = load(path, threads)
    sums = checksums(output(reader))
    Delete(reader)
    return sums


def time_opening(path, threads=None):
    """Seconds until the data is there."""
    start = time.perf_counter()
    reader = load(path, threads)
    seconds = time.perf_counter() - start
    assert output(reader).GetNumberOfPoints() > 0
    Delete(reader)
    return f"{seconds:.9f}"


def save(path, to, compressor):
    reader = OpenDataFile(path)
    SaveData(to, proxy=reader, DataMode="Appended", EncodeAppendedData=0, CompressorType=compressor)
    Delete(reader)
    return str(os.path.getsize(to))


QUESTIONS = {"open": open_run, "check": check, "steps": steps, "look": look,
             "time": time_opening, "save": save}

# pvpython has streams of its own in the place of Python's
with open(0, encoding="utf-8") as questions, open(1, "w", encoding="utf-8") as answers:
    for line in questions:
        verb, *arguments = line.rstrip("\n").split("|")
        print("=", QUESTIONS[verb](*arguments), file=answers, flush=True)
