# SPDX-License-Identifier: BSD-3-Clause
"""A second opinion on contacts and their sums, by numpy alone and without code of the library."""
import itertools
import os

import numpy

import plain_dump
import plain_local

FOLDER = os.path.join(os.environ["GRANULAR_DATA"], "good", "contacts")
# What the columns are: as a column map of the local reader.
COLUMNS = {
    "bed_contacts": "pos id force force_normal force_tangential torque delta contactPoint",
    "bed_walls": "pos wall_id force force_normal force_tangential torque delta",
    "periodic_bed_contacts": "pos id force delta contactPoint",
    "periodic_bed_walls": "pos wall_id force delta",
    "moving_contacts": "pos vel id force delta",
    "moving_walls": "pos vel wall_id force delta",
    "moving_step_contacts": "pos id force contactPoint",
    "moving_step_walls": "pos wall_id force",
    "tilted_contacts": "index id1 id2 dist fmag force_normalx force_normaly force_normalz force_tangentialx force_tangentialy "
                       "force_tangentialz p4",
}
COLUMNS["tilted_granular_contacts"] = COLUMNS["tilted_contacts"] + " p5 p6 p7 p8"
# How many columns the words above stand for, and their names here.
_WIDTHS = {"pos": 6, "vel": 6, "id": 3, "wall_id": 3, "force": 3, "force_normal": 3, "force_tangential": 3, "torque": 3,
           "contactPoint": 3}
GRAVITY = numpy.array([0, 0, -9.81])
SIX = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # xx yy zz xy xz yz


def path(name):
    for ending in (".dump.gz", ".dump"):
        if os.path.exists(os.path.join(FOLDER, name + ending)):
            return os.path.join(FOLDER, name + ending)
    raise FileNotFoundError(name)


def steps(name):
    return [frame.timestep for frame in plain_dump.read(path(name))]


class Particles:
    """Particles of a run at a timestep, in the order of the file, and the box."""

    def __init__(self, name, step):
        frame = [frame for frame in plain_dump.read(path(name)) if frame.timestep == step][0]
        self.ids = frame.numbers("id").astype(int)
        self.x = frame.stack("xyz")
        self.f = frame.stack(["fx", "fy", "fz"])
        self.radius, self.mass = frame.numbers("radius"), frame.numbers("mass")
        self.stress = frame.stack([f"c_s[{i}]" for i in range(1, 7)])
        self.coordination = frame.numbers("c_cn")
        self.frame = frame
        self.origin, self.vectors = frame.box()
        self.row = {number: row for row, number in enumerate(self.ids.tolist())}

    def rows(self, ids):
        return numpy.array([self.row[number] for number in ids.tolist()], dtype=int)


class Contacts:
    """Rows of a file: ends (if the file has them), id1 and id2 (of walls id2 alone), and all that has a name."""

    def __init__(self, name, step):
        frame = [frame for frame in plain_local.read(path(name)) if frame.timestep == step][0]
        table = numpy.array(frame.rows, dtype=float).reshape(len(frame.rows), -1)
        self.periodic = numpy.array([flag == "pp" for flag in frame.boundary.split()])
        self.named, at = {}, 0
        for word in COLUMNS[name].split():
            width = _WIDTHS.get(word, 1)
            self.named[word] = table[:, at:at + width]
            at += width
        assert at == table.shape[1]
        self.count = len(table)
        if "id1" in self.named:
            self.ids = [self.named["id1"][:, 0].astype(int), self.named["id2"][:, 0].astype(int)]
            self.normal = self.stack("force_normal")
            self.tangential = self.stack("force_tangential")
            self.force = self.normal + self.tangential
        else:
            ids = self.named["id" if "id" in self.named else "wall_id"].astype(int)
            self.ids = [ids[:, 0], ids[:, 1]] if "id" in self.named else [None, ids[:, 2]]
            self.ends = self.named["pos"].reshape(-1, 2, 3)
            self.force = self.named["force"]

    def stack(self, name):
        return numpy.hstack([self.named[name + axis] for axis in "xyz"])


def nearest(difference, vectors, periodic):
    """The shortest images of vectors, and what was added: all that are at most two box vectors away are tried."""
    best, added = difference.copy(), numpy.zeros_like(difference)
    for counts in itertools.product(*(range(-2, 3) if each else (0,) for each in periodic)):
        image = difference + numpy.array(counts) @ vectors
        shorter = (image ** 2).sum(axis=1) < (best ** 2).sum(axis=1) * (1 - 1e-12)
        best[shorter], added[shorter] = image[shorter], (numpy.array(counts) @ vectors)
    return best, added


def branches(particles, contacts):
    """From the first to the second particle, and the sum of box vectors in it."""
    first, second = (particles.x[particles.rows(ids)] for ids in contacts.ids)
    return nearest(second - first, particles.vectors, contacts.periodic)


def products(a, b):
    """a_i b_j, xx yy zz xy xz yz, of each row."""
    return numpy.stack([a[:, i] * b[:, j] for i, j in SIX], axis=1)


def add_up(particles, contacts, first, second):
    """What each particle has of the values at the first and the second end of its contacts; of walls at the second."""
    sums = numpy.zeros((len(particles.ids), second.shape[1]))
    numpy.add.at(sums, particles.rows(contacts.ids[1]), second)
    if contacts.ids[0] is not None:
        numpy.add.at(sums, particles.rows(contacts.ids[0]), first)
    return sums


def last_row(name):
    """{column: number} of the last thermo row of the run's log."""
    with open(os.path.join(FOLDER, name + "_log.txt"), encoding="ascii") as file:
        lines = [line.split() for line in file]
    head = [i for i, words in enumerate(lines) if words[:1] == ["Step"]][-1]
    return dict(zip(lines[head], (float(word) for word in lines[head + 1])))
