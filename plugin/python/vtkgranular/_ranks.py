# SPDX-License-Identifier: BSD-3-Clause
"""Scripts on several ranks of ParaView."""
from __future__ import annotations

import os
import shutil
import subprocess

# The user's own settings of Open MPI, in its versions 4 to 6; other variables of these names are what a program under
# MPI leaves for its threads, and would confuse a new mpirun.
_OURS = ("OMPI_ALLOW", "OMPI_MCA_rmaps", "OMPI_MCA_btl", "OMPI_MCA_mpi", "OMPI_MCA_pml", "PRTE_ALLOW", "PRTE_MCA_rmaps")
_THEIRS = ("OMPI_", "ORTE_", "PMIX_", "PRTE_", "PMI_")
# For root, and for a machine with fewer cores than ranks.
_MANY_RANKS = {"OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_hwloc_base_binding_policy": "none",
               "PRTE_ALLOW_RUN_AS_ROOT": "1",
               "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
               "PRTE_MCA_hwloc_default_binding_policy": "none"}


def mpirun_environment() -> dict[str, str]:
    """Returns the variables with which mpirun works from within a process of MPI."""
    kept = {name: value for name, value in os.environ.items()
            if name.startswith(_OURS) or not name.startswith(_THEIRS)}
    return {**_MANY_RANKS, **kept}


def pvbatch(script: str | os.PathLike[str], *arguments: str, ranks: int) -> str:
    """Runs a script in pvbatch on several ranks and returns what it printed.

    script     the file of a Python script
    arguments  what it finds in sys.argv[1:]
    ranks      the number of processes, at least 1; there may be more than the machine has cores.

    mpirun and pvbatch are those in PATH. With PV_PLUGIN_PATH and PYTHONPATH set as for this process they know the plugin and this
    package as well. Raises FileNotFoundError if one is missing, and RuntimeError, with all that was said, if the script fails.
    """
    programs = [shutil.which(name) for name in ("mpirun", "pvbatch")]
    if None in programs:
        raise FileNotFoundError(f"no {'mpirun' if programs[0] is None else 'pvbatch'} in PATH")
    done = subprocess.run([programs[0], "-n", str(ranks), programs[1], os.fspath(script), *arguments],
                          capture_output=True, text=True, env=mpirun_environment())
    if done.returncode != 0 or "ERR|" in done.stderr:
        raise RuntimeError(f"{script} failed on {ranks} ranks:\n{done.stdout}{done.stderr}")
    return done.stdout
