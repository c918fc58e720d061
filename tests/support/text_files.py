# SPDX-License-Identifier: BSD-3-Clause
"""Files of logs and tables, made and read."""
import warnings


def told(function, path, *expected, **options):
    """What a function reads from a file; it warns its caller once for each of the texts."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = function(path, **options)
    said = [str(warning.message) for warning in caught]
    assert len(said) == len(expected) and all(part in text for part, text in zip(expected, said)), said
    assert all(warning.filename == __file__ for warning in caught), caught
    return found


def written(text, name="made.txt"):
    with open(name, "wb") as stream:
        stream.write(text if isinstance(text, bytes) else text.encode())
    return name
