# SPDX-License-Identifier: BSD-3-Clause
"""A day of use in minutes: opens, steps, plays, filters, pictures, files and errors, again and again, beside a simulation that appends.

soak.py MINUTES [ROUNDS]: goes on for that long, or for that many rounds. Nothing is kept between rounds but one view: ParaView keeps
memory and threads of each view. It prints memory, descriptors and threads each minute. At its end it fits slopes over the second half,
and raises if memory grows by more than 1 MiB in 1000 updates, or if descriptors or threads grow."""
import contextlib
import ctypes
import gc
import os
import subprocess
import sys
import time

import granular
import numpy
from paraview import simple

SAMPLES = os.environ["GRANULAR_SAMPLES"]
MOST_PER_THOUSAND = 1.0  # MiB per 1000 updates
TRIM = ctypes.CDLL(None).malloc_trim  # what is free is given back, so that the rest is what is held
SIMULATION = r"""
import os, sys, time
path, step = sys.argv[1], 0
while True:
    rows = "".join(f"{i} 1 {(i * 7 + step) % 64 / 8} {i % 32 / 4} {i % 128 / 16} 0.05 {step} 0 0\n" for i in range(1, 1001))
    frame = (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n1000\nITEM: BOX BOUNDS pp pp pp\n0 8\n0 8\n0 8\n"
             f"ITEM: ATOMS id type x y z radius vx vy vz\n{rows}")
    fresh = step % 100 == 0  # it starts again, in a new file
    with open(path + ".new" if fresh else path, "w" if fresh else "a") as out:
        out.write(frame)
    if fresh:
        os.replace(path + ".new", path)
    step = (step + 1) % 100
    time.sleep(0.2)
"""


def sample(*path):
    return os.path.join(SAMPLES, *path)


class Use:
    """Activities, each of which leaves nothing behind, and the number of updates."""

    def __init__(self):
        self.updates = 0
        self.random = numpy.random.default_rng(1)
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [300, 200]

    def update(self, source, moment=None, points=None):
        self.updates += 1
        granular.update(source, moment)
        found = source.GetDataInformation().GetNumberOfPoints()
        assert points in (None, found), (found, points)

    def open_and_step(self):
        """Every frame of files of each class, forwards and back."""
        for path in (sample("grains.dump"), sample("bonds", "chain.data"), sample("bonds", "chain_bonds.dump"),
                     sample("restart", "fibres.40000.restart"), sample("euler_*.vtk")):
            reader = granular.reader(path)
            times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__len__") else [reader.TimestepValues]
            for moment in times + times[::-1]:
                self.update(reader, moment)
            simple.Delete(reader)

    def change(self):
        """Other arrays, coordinates, strides and threads."""
        reader = simple.GranularDumpReader(FileNames=[sample("grains.dump")])
        for _ in range(20):
            reader.SortById = int(self.random.integers(2))
            reader.Stride = int(self.random.integers(1, 4))
            reader.Threads = int(self.random.integers(3))
            reader.Coordinates = ["Absolute", "Unwrapped", "Scaled"][self.random.integers(3)]
            reader.PointArrayStatus = ["id", "radius", "v"][:self.random.integers(1, 4)]
            self.update(reader, float(self.random.choice([1000, 2000])), 1200 // reader.Stride)
        simple.Delete(reader)

    def follow(self):
        """A file that grows, and is now and then replaced."""
        reader = simple.GranularDumpReader(FileNames=[os.path.abspath("growing.dump")], RefreshOnUpdate=1)
        for _ in range(5):
            self.update(reader, None, 1000)
            frame = granular.fetch(reader)
            assert (frame["v"][:, 0] == frame["timestep"]).all()
            simple.ReloadFiles(reader)
        simple.Delete(reader)

    def filters(self):
        """Each filter and source once."""
        bed = simple.GranularDumpReader(FileNames=[sample("continuum", "bed.dump.gz")])
        contacts = simple.GranularLocalReader(FileNames=[sample("continuum", "bed_contacts.dump.gz")],
            ColumnMap="pos id force force_normal force_tangential torque delta contactPoint")
        chain = simple.GranularDumpReader(FileNames=[sample("bonds", "chain.dump")])
        bonds = simple.GranularLocalReader(FileNames=[sample("bonds", "chain_bonds.dump")])
        plane = simple.Plane()
        packing = simple.GranularPackingSource(NumberOfGrains=200)
        join = simple.GranularLocalJoin(Input=chain, Lines=simple.OutputPort(bonds, 1))
        made = [
            packing, join,
            simple.GranularContactSums(Input=bed, Lines=contacts),
            simple.GranularEulerAverage(Input=bed, Lines=contacts),
            simple.GranularPointAverage(Input=bed, Lines=contacts, Points=plane),
            simple.GranularDecomposition(Input=packing),
            simple.GranularDecompositionSource(),
            simple.GranularCompare(Input=chain, Lines=join),
            simple.GranularTrajectories(Input=chain),
            simple.GranularHistory(Input=chain, Ids="1-5"),
        ]
        for source in made:
            self.update(source)
        for source in made[::-1] + [plane, bonds, chain, contacts, bed]:
            simple.Delete(source)

    def look(self):
        """Particles, an animation and a picture."""
        reader = granular.reader(sample("grains.dump"))
        granular.show(reader, self.view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.Play()
        self.updates += len(reader.TimestepValues)
        simple.SaveScreenshot("picture.png", self.view)
        assert os.path.getsize("picture.png") > 1000
        simple.Delete(reader)

    def write(self):
        """Files, one of which is read back."""
        reader = granular.reader(sample("grains.dump"))
        self.update(reader, 2000)
        for name in ("saved.dump", "saved.dump.gz", "saved.vtp"):
            granular.save(reader, name)
        simple.Delete(reader)
        again = granular.reader("saved.dump.gz")
        self.update(again, None, 1200)
        simple.Delete(again)

    def errors(self):
        """A damaged file, and one that is not there."""
        with open("broken.dump", "w") as out:
            out.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                      "ITEM: ATOMS id x y z\n1 0 zero 0\n")
        for name, told in (("broken.dump", "expected a number, got 'zero'"), ("gone.dump", "No such file")):
            reader = simple.GranularDumpReader(FileNames=[os.path.abspath(name)])
            with contextlib.suppress(RuntimeError):
                self.update(reader)
                raise AssertionError(name + " was read")
            assert told in reader.GetPropertyValue("ErrorMessage"), reader.GetPropertyValue("ErrorMessage")
            simple.Delete(reader)


def status():
    """Resident memory in MiB, descriptors, threads."""
    gc.collect()
    TRIM(0)
    with open("/proc/self/status") as file:
        lines = dict(line.split(":", 1) for line in file if ":" in line)
    return int(lines["VmRSS"].split()[0]) / 1024, len(os.listdir("/proc/self/fd")), int(lines["Threads"])


def main(minutes, rounds=None):
    granular.load_plugin(ns=vars(simple))
    use, seen = Use(), []
    start = told = time.monotonic()
    simulation = subprocess.Popen(["/usr/bin/python3", "-c", SIMULATION, "growing.dump"])
    try:
        while not os.path.exists("growing.dump"):
            time.sleep(0.1)
        while time.monotonic() - start < 60 * minutes and (rounds is None or len(seen) < rounds):
            for activity in (use.open_and_step, use.change, use.follow, use.filters, use.look, use.write, use.errors):
                activity()
            seen.append((use.updates, *status()))
            if time.monotonic() - told > 60 or len(seen) == 1:
                told = time.monotonic()
                print("soak | %.1f min | %d rounds | %d updates | %.1f MiB | %d descriptors | %d threads" %
                      ((told - start) / 60, len(seen), *seen[-1]), flush=True)
    finally:
        simulation.kill()
        simulation.wait()
    half = numpy.array(seen[len(seen) // 2:], dtype=float)
    slope = 1000 * numpy.polyfit(half[:, 0], half[:, 1], 1)[0]
    print("soak | %d rounds, %d updates; from update %d on, memory by %+.3f MiB per 1000 updates, descriptors by %+d, threads by %+d"
          % (len(seen), use.updates, half[0][0], slope, *(half[-1] - half[0])[2:]))
    assert slope < MOST_PER_THOUSAND, "memory grew"
    assert (half[-1] <= half[0])[2:].all(), "descriptors or threads grew"


main(float(sys.argv[1]), *map(int, sys.argv[2:3]))
