# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView 5.11 with Python 3.11, as in Debian 12, lacks to load plugins in Python."""
import inspect

inspect.getargspec = getattr(inspect, "getargspec", inspect.getfullargspec)
