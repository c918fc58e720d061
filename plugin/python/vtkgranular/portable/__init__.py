# SPDX-License-Identifier: BSD-3-Clause
"""Readers, writers, sources and filters for any ParaView, in Python over the C library: what Granular.py beside it shows to ParaView."""
from __future__ import annotations

import gc

from ._averages import AVERAGES
from ._lines import LINES
from ._paths import PATHS
from ._proxies import define
from ._ranks import ranks_of_paraview
from ._readers import READERS
from ._sources import SOURCES
from ._subdomains import SUBDOMAINS
from ._writers import WRITERS

if ranks_of_paraview():
    # At any line of Python the collector may delete proxies of ParaView on the first rank, which waits then for ranks that wait for this one.
    gc.disable()
_classes = {**READERS, **WRITERS, **SOURCES, **LINES, **AVERAGES, **SUBDOMAINS, **PATHS}
definitions = define(_classes)
globals().update({made.__name__: made for made in _classes.values()})  # where the definitions say they are
