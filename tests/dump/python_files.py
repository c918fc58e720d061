# SPDX-License-Identifier: BSD-3-Clause
"""The files of a run by their pattern, in the order of their numbers."""
import os

import vtkgranular as vg

here = os.getcwd()
names = ["run_10.0.dump", "run_10.1.dump", "run_2.0.dump", "run_2.1.dump.gz", "run_100.0.dump.zst",
         "run_boundingBox_2.dump", "other.dump"]
for name in names:
    open(name, "w").close()

expected = ["run_2.0.dump", "run_2.1.dump.gz", "run_10.0.dump", "run_10.1.dump", "run_100.0.dump.zst"]
assert vg.files("run_*.%.dump") == [os.path.join(here, name) for name in expected]
assert vg.files(os.path.join(here, "run_2.%.dump")) == [
    os.path.join(here, name) for name in expected[:2]]
assert vg.files("run_2.*", "run_2.0.*", "other.dump") == [
    os.path.join(here, name) for name in ("other.dump", "run_2.0.dump", "run_2.1.dump.gz")]
assert vg.files("run_*.*") == vg.files("run_*.%.dump")
# numbers for '*' before anything else, in the last part of the path alone
os.makedirs("case_b/post", exist_ok=True)
for name in ("step_first.dump", "step_0.5.dump", "step_70.dump.gz", "case_b/post/1.dump", "case_b/post/1.dump.gz", "case_b/post/last.dump"):
    open(name, "w").close()
assert vg.files("step_*.dump") == [os.path.join(here, name) for name in ("step_0.5.dump", "step_70.dump.gz")]
assert vg.files("step_f*.dump") == [os.path.join(here, "step_first.dump")]
assert vg.files("case_*/post/*.dump") == [os.path.join(here, "case_b/post", name) for name in ("1.dump", "1.dump.gz")]
assert vg.files("case_[!a]/post/[l-z]*.dump") == [os.path.join(here, "case_b/post/last.dump")]

assert vg.files("case_b/post/1.dump") == [os.path.join(here, "case_b/post/1.dump")]  # not its compressed namesake
for pattern in ("nothing_*", "run_boundingBox*"):
    try:
        vg.files(pattern)
    except FileNotFoundError as error:
        assert pattern in str(error), error
    else:
        raise AssertionError(f"{pattern} should fit no file")
