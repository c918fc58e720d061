# SPDX-License-Identifier: BSD-3-Clause
"""Damaged files through the proxies of all readers, in one process of ParaView: it stays alive, and errors are messages that name
the file. Arguments: how many copies in all (default 100), the seed. A copy depends on its number alone."""
import os
import random
import resource
import sys
import time

from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from said import said_by

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
FILES = {
    "GranularDumpReader": ("grains_1000.dump", "tri_image.dump", "ortho_000050.dump.gz", "ortho_custom.bin", "plain.bin", "chain.dump"),
    "GranularLocalReader": ("local/contacts.dump", "local/chain_bonds.dump", "local/settled_contacts.dump.gz"),
    "GranularDataFileReader": ("data_file/full.data", "data_file/ellipsoid.data"),
    "GranularEulerReader": ("euler_1000.vtk", "euler/grid_42_binary.vtk", "euler/hexahedra_51.vtk"),
    "GranularDecompositionReader": ("decomposition_1000.vtk", "decomposition/inl.vtu", "decomposition/arrays_42_binary.vtk"),
    "GranularRestartReader": ("restart/fibres.restart", "restart/hybrid.restart"),
}
WORDS = (b"nan", b"-1", b"1e308", b"4294967296", b"9223372036854775807", b"word", b" ", b"\n", b"ITEM: ", b"\0\0\0\0", b"\xff" * 8)
LONGEST, MOST_BYTES = 10, 256 << 20


def damaged(data, chance):
    """One to three places changed, cut out, doubled or filled with a word."""
    data = bytearray(data)
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(min(len(data), chance.choice((512, len(data)))) or 1)
        length = chance.randrange(1, 40)
        data[at:at + chance.choice((0, 1, length))] = chance.choice(
            (bytes([chance.randrange(256)]), chance.choice(WORDS), data[at:at + length], b""))
        if chance.random() < 0.1:
            del data[at:]
    return bytes(data)


def check_arrays(dataset):
    """That every array has a value for each of its points, cells or rows."""
    for kind in (dataset.POINT, dataset.CELL, dataset.ROW):
        count = dataset.GetNumberOfElements(kind)
        arrays = dataset.GetAttributes(kind)
        for i in range(arrays.GetNumberOfArrays() if arrays else 0):
            array = arrays.GetAbstractArray(i)
            assert array.GetNumberOfTuples() == count, f"{array.GetNumberOfTuples()} tuples of {array.GetName()}, expected {count}"
            if array.IsA("vtkDataArray"):
                vtk_to_numpy(array).sum()


def update(proxy, chance):
    """Updates a reader at one of its times; returns True if it has data."""
    proxy.UpdatePipelineInformation()
    times = proxy.TimestepValues
    times = list(times) if hasattr(times, "__len__") else [times]
    proxy.UpdatePipeline(chance.choice(times or [0.0]))
    reader = proxy.GetClientSideObject()
    for port in range(reader.GetNumberOfOutputPorts()):
        output = reader.GetOutputDataObject(port)
        if not output.IsA("vtkCompositeDataSet"):
            check_arrays(output)
    return not proxy.GetProperty("ErrorMessage").GetData()


def main(copies=100, seed=1):
    proxies = {name: globals()[name](FileNames=[os.path.join(GOOD, files[0])]) for name, files in FILES.items()}
    heard = {name: said_by(proxy.GetClientSideObject()) for name, proxy in proxies.items()}
    outcomes, slowest = {True: 0, False: 0}, 0.0
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for copy in range(copies):
        chance = random.Random(f"{seed} {copy}")
        name = chance.choice(list(FILES))
        good = os.path.join(GOOD, chance.choice(FILES[name]))
        with open(good, "rb") as file:
            data = damaged(file.read(), chance)
        path = os.path.abspath(f"copy{copy % 3}{os.path.splitext(good)[1]}")
        with open(path, "wb") as file:
            file.write(data)
        proxy = proxies[name]
        start, what = time.process_time(), f"copy {copy} of {good}"
        heard[name].clear()
        proxy.FileNames = [path]
        ReloadFiles(proxy)
        proxy.UpdatePipelineInformation()
        read = update(proxy, chance)
        outcomes[read] += 1
        text = " ".join(heard[name])
        assert read or path in text, f"{what}: an error that names no file: {text}"
        slowest = max(slowest, time.process_time() - start)
        assert slowest < LONGEST, f"{what}: {slowest} s of processors"
    risen = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) << 10
    assert risen <= MOST_BYTES, f"{risen >> 20} MiB more than before"
    assert outcomes[True] > 0 < outcomes[False]
    print(f"{copies} copies: {outcomes[True]} gave data, {outcomes[False]} were refused; slowest {slowest:.2f} s of processors, "
          f"{risen / 2**20:.1f} MiB more than before; alive")


main(*map(int, sys.argv[1:3]))
