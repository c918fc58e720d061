# SPDX-License-Identifier: BSD-3-Clause
"""The limit of the memory that readers keep."""
import ctypes
import os

import vtkgranular as vg


def refused(limit):
    try:
        vg.set_pool_limit(limit)
    except ValueError as error:
        return str(limit) in str(error)
    return False


def seen_by_the_readers():
    getenv = ctypes.CDLL(None).getenv
    getenv.restype = ctypes.c_char_p
    return getenv(b"GRANULAR_POOL_MIB")


os.environ.pop("GRANULAR_POOL_MIB", None)
assert vg.pool_limit() is None
for mib in (512, 0):
    vg.set_pool_limit(mib)
    assert vg.pool_limit() == mib
    assert seen_by_the_readers() == str(mib).encode()
for wrong in (-1, 0.5):
    assert refused(wrong)
assert vg.pool_limit() == 0
reader = vg.vtkGranularDumpReader()
reader.AddFileName(os.path.join(os.environ["GRANULAR_DATA"], "good", "grains_1000.dump"))
reader.Update()
assert reader.GetOutput().GetNumberOfPoints() == 1200
vg.set_pool_limit(None)
assert vg.pool_limit() is None and seen_by_the_readers() is None
os.environ["GRANULAR_POOL_MIB"] = "much"
try:
    vg.pool_limit()
except ValueError:
    pass
else:
    raise AssertionError("'much' is no limit")
