# SPDX-License-Identifier: BSD-3-Clause
"""Damaged files through the proxies of two readers, in one process of ParaView: it stays alive, and errors are messages that name the
file. Arguments: how many copies in all (default 100), the seed. A copy depends on its number alone; those of mutate_readers.cxx, for all
readers, are damaged in more ways."""
import os
import random
import sys

from paraview.simple import *

from said import said_by

GOOD = os.path.join(os.environ["GRANULAR_DATA"], "good")
WORDS = (b"nan", b"-1", b"1e308", b"9223372036854775807", b"word", b"\n", b"ITEM: ", b"\0\0\0\0", b"\xff" * 8, b"")


def damaged(data, chance):
    """One to three places changed, cut out or filled with a word."""
    data = bytearray(data)
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(min(len(data), chance.choice((512, len(data)))))
        data[at:at + chance.choice((0, 1, chance.randrange(1, 40)))] = chance.choice(WORDS)
    return data


def main(copies=100, seed=1):
    outcomes = {True: 0, False: 0}
    for name, file in (("GranularDumpReader", "grains_1000.dump"), ("GranularRestartReader", "restart/fibres.restart")):
        with open(os.path.join(GOOD, file), "rb") as stream:
            good = stream.read()
        proxy = globals()[name](FileNames=[os.path.join(GOOD, file)])
        said = said_by(proxy.GetClientSideObject())
        path = os.path.abspath("copy" + os.path.splitext(file)[1])
        proxy.FileNames = [path]
        for copy in range(copies // 2):
            with open(path, "wb") as stream:
                stream.write(damaged(good, random.Random(f"{seed} {copy}")))
            said.clear()
            ReloadFiles(proxy)
            proxy.UpdatePipeline()
            error = proxy.GetPropertyValue("ErrorMessage")
            outcomes[not error] += 1
            assert not error or path in " ".join(said), (file, copy, error, said)
    assert outcomes[True] > 0 < outcomes[False], outcomes
    print(f"{copies} copies: {outcomes[True]} gave data, {outcomes[False]} were refused; alive")


main(*map(int, sys.argv[1:3]))
