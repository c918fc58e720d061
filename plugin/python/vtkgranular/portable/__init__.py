# SPDX-License-Identifier: BSD-3-Clause
"""Readers and writers for any ParaView, in Python over the C library: what plugin/portable/Granular.py shows to ParaView."""
from __future__ import annotations

from ._proxies import define
from ._readers import READERS
from ._writers import WRITERS

_classes = {**READERS, **WRITERS}
definitions = define(_classes)
globals().update({made.__name__: made for made in _classes.values()})  # where the definitions say they are
