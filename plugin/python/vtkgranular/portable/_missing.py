# SPDX-License-Identifier: BSD-3-Clause
"""What only the compiled plugin has, by the names in xml. docs/guide/portable.md says what to do instead; tests/lint/portable.py compares
all three."""

#: Readers, sources, filters and extractors.
PROXIES = ("GranularDump", "GranularMeshReader", "GranularVTKParticleReader")

#: Properties that are not there.
PROPERTIES = ("RefreshOnUpdate", "CheckOverlap", "CheckGaps")

#: Properties that are there for scripts and state files, and change nothing.
IDLE = ("ParallelMode",)
