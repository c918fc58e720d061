# SPDX-License-Identifier: BSD-3-Clause
"""What algorithms say."""


def said_by(algorithm):
    """A list that gets the text of each warning and error of an algorithm from now on."""
    said = []

    def keep(caller, kind, text):
        said.append(text)

    keep.CallDataType = "string0"
    for event in ("WarningEvent", "ErrorEvent"):
        algorithm.AddObserver(event, keep)
    algorithm.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    return said
