# SPDX-License-Identifier: BSD-3-Clause
"""A file that another run of the process has open is not looked through again; one that changed is."""
import os

import granular

SOURCE = os.path.join(os.environ["GRANULAR_ROOT"], "samples", "data", "grains.dump")
PATH = os.path.abspath("twice.dump")


def put(steps, seconds):
    """Write the file again with another digit in its timesteps, at a time in the past."""
    with open(SOURCE, "rb") as file:
        content = file.read()
    for old, new in steps:
        content = content.replace(b"ITEM: TIMESTEP\n%d\n" % old, b"ITEM: TIMESTEP\n%d\n" % new)
    with open(PATH, "r+b" if os.path.exists(PATH) else "wb") as file:
        file.write(content)
    os.utime(PATH, (seconds, seconds))


if os.path.exists(PATH):
    os.remove(PATH)
put([], 10**9)
run = granular.open(PATH)
assert run.steps.tolist() == [0, 1000, 2000, 3000, 4000]
# other bytes behind the same size and time: only who looks through the file sees them
put([(3000, 3500)], 10**9)
again = granular.open(PATH)
assert again.steps.tolist() == [0, 1000, 2000, 3000, 4000], again.steps
assert again[4].rows == run[4].rows
try:
    assert not again[3].rows
except granular.Error as error:
    assert "changed since it was indexed" in str(error), error
else:
    raise AssertionError("a frame that is not there")
# a cell of a notebook that runs again: the old run goes after the new one has come
again = granular.open(PATH)
run.close()
assert again.steps.tolist() == [0, 1000, 2000, 3000, 4000]
again.close()
# nobody has it any more
assert granular.open(PATH).steps.tolist() == [0, 1000, 2000, 3500, 4000]
# it changed
run = granular.open(PATH)
put([(3000, 3600)], 10**9 + 10)
assert granular.open(PATH).steps.tolist() == [0, 1000, 2000, 3600, 4000]
assert run.steps.tolist() == [0, 1000, 2000, 3500, 4000]
