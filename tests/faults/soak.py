# SPDX-License-Identifier: BSD-3-Clause
"""A day of use in minutes: opens, steps, plays, filters, pictures, files and states, again and again. Files that grow and
properties that change: changing_updates.cxx.

soak.py MINUTES: goes on for that long. Nothing is kept between rounds. It prints memory, descriptors and
threads each minute, less what ParaView itself keeps of each view. At its end it fits slopes over the second half, and raises if
memory grows by more than 1 MiB in 1000 updates, or if descriptors or threads grow. Memory is also told by activity.
"""
import ctypes
import gc
import os
import sys
import time

import numpy
import vtkgranular as vg
from paraview import simple

SAMPLES = os.environ["GRANULAR_SAMPLES"]
MINUTES = float(sys.argv[1])
MOST_PER_THOUSAND = 1.0  # MiB per 1000 updates
TRIM = ctypes.CDLL(None).malloc_trim  # what is free is given back, so that the rest is what is held


def sample(*path):
    return os.path.join(SAMPLES, *path)


class Use:
    """What is done, and how often a pipeline was updated."""

    def __init__(self):
        self.updates = 0
        self.views = 0  # ParaView keeps of each one threads, a descriptor and memory, whatever is shown

    def update(self, source, moment=None):
        self.updates += 1
        vg.update(source, moment)

    def points(self, source):
        return source.GetDataInformation().GetNumberOfPoints()

    def new_view(self):
        self.views += 1
        view = simple.CreateView("RenderView")
        view.ViewSize = [300, 200]
        return view

    def empty_view(self):
        """A view without anything of this plugin."""
        view, sphere = self.new_view(), simple.Sphere()
        simple.Show(sphere, view)
        simple.SaveScreenshot("sphere.png", view)
        simple.Delete(sphere)
        simple.Delete(view)

    # ---- activities; each leaves nothing behind ------------------------------------------------

    def open_and_step(self):
        """Every frame of files of each class, forwards and back, with other arrays."""
        for path, expected in ((sample("grains.dump"), 1200), (sample("bonds", "chain.data"), None),
                               (sample("bonds", "chain_bonds.dump"), None), (sample("restart", "fibres.40000.restart"), None),
                               (sample("euler_*.vtk"), 112)):
            reader = vg.reader(path)
            times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__len__") else [reader.TimestepValues]
            for moment in times + times[::-1]:
                self.update(reader, moment)
            if expected:
                self.update(reader, times[-1])
                assert self.points(reader) == expected, (path, self.points(reader))
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
        """Spheres, colours, an animation and a picture."""
        view = self.new_view()
        reader = vg.reader(sample("grains.dump"))
        vg.show(reader, view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        scene.Play()
        self.updates += len(reader.TimestepValues)
        simple.SaveScreenshot("picture.png", view)
        assert os.path.getsize("picture.png") > 1000
        simple.Delete(reader)
        simple.Delete(view)

    def write(self):
        """Files, read back."""
        reader = vg.reader(sample("grains.dump"))
        self.update(reader, 2000)
        for name in ("saved.dump", "saved.dump.gz", "saved.vtp"):
            vg.save(reader, name)
        simple.Delete(reader)
        again = vg.reader("saved.dump.gz")
        self.update(again)
        assert self.points(again) == 1200
        simple.Delete(again)

    def state(self):
        """A state that is saved, and loaded."""
        reader = vg.reader(sample("grains.dump"))
        self.update(reader)
        for view in simple.GetRenderViews():
            simple.Delete(view)
        simple.SaveState("session.pvsm")
        simple.Delete(reader)
        vg.load_state("session.pvsm")
        for loaded in list(simple.GetSources().values()):
            self.update(loaded)
            simple.Delete(loaded)


def status():
    """Resident memory in MiB, descriptors, threads."""
    gc.collect()
    TRIM(0)
    with open("/proc/self/status") as file:
        lines = dict(line.split(":", 1) for line in file if ":" in line)
    return int(lines["VmRSS"].split()[0]) / 1024, len(os.listdir("/proc/self/fd")), int(lines["Threads"])


def cost_of_views(use):
    """What ParaView keeps of a view: MiB, descriptors, threads."""
    use.empty_view()
    before = status()
    for _ in range(10):
        use.empty_view()
    return [(after - first) / 10 for after, first in zip(status(), before)]


def main():
    activities = ["open_and_step", "filters", "look", "write", "state"]
    vg.load_plugin(ns=vars(simple))
    use, rounds, grown = Use(), 0, dict.fromkeys(activities, 0.0)
    start = told = time.monotonic()
    half = []
    cost = cost_of_views(use)
    print("soak | a view of ParaView with a sphere keeps %.2f MiB, %g descriptors, %g threads" % tuple(cost), flush=True)
    while time.monotonic() - start < 60 * MINUTES:
        for name in activities:
            before = status()[0]
            getattr(use, name)()
            if half:
                grown[name] += status()[0] - before
        rounds += 1
        seen = (use.updates, *(now - use.views * each for now, each in zip(status(), cost)))
        if time.monotonic() - start > 30 * MINUTES:
            half.append(seen)
        if time.monotonic() - told > 60 or rounds == 1:
            told = time.monotonic()
            print("soak | %.1f min | %d rounds | %d updates | %.1f MiB | %d descriptors | %d threads, without those of %d views"
                  % ((told - start) / 60, rounds, *seen, use.views), flush=True)
    print("soak | second half, by activity, MiB: " + ", ".join(f"{name} {mib:+.2f}" for name, mib in grown.items()))
    table = numpy.array(half, dtype=float)
    per_thousand = [1000 * numpy.polyfit(table[:, 0], table[:, column], 1)[0] for column in (1, 2, 3)]
    print("soak | %d rounds, %d updates; from update %d on, per 1000 updates: memory %+.3f MiB, descriptors %+.3f, threads %+.3f"
          % (rounds, use.updates, half[0][0], *per_thousand))
    assert per_thousand[0] < MOST_PER_THOUSAND, "memory grew"
    assert half[-1][2] <= half[0][2] and half[-1][3] <= half[0][3], "descriptors or threads grew"


main()
