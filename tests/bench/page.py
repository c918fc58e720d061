# SPDX-License-Identifier: BSD-3-Clause
"""docs/speed_and_error.md: its words stand there; tables between marks and pictures are made anew."""
import os
import re
import shutil

import summary
from tables import cores_missing

PAGE = "speed_and_error.md"
PICTURES = "speed_and_error"


def blocks(results, machine):
    yield "machine", [machine + ".", ""]
    for part, figures in results:
        if part.name == "store":
            yield "decide", summary.decide_table(figures)
            opening = next((each.get("opening: index of 20 frames", "read:ns/particle") for other, each in results
                            if other.name == "choose"), None)
            yield "example", summary.example(figures, opening)
        lines = [part.about, "", *cores_missing(part, figures)]
        for table in part.page_tables:
            lines += table(part, figures, False)
        lines += part.words(figures) if part.words else []
        yield part.name, lines


def write(docs, report, results, machine, drawn):
    """Replaces what stands between <!-- NAME --> and <!-- end of NAME --> for each part that was measured."""
    path = os.path.join(docs, PAGE)
    with open(path, encoding="utf-8") as stream:
        text = stream.read()
    for name, lines in blocks(results, machine):
        mark = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)", re.S)
        if mark.search(text):
            text = mark.sub(lambda match, lines=lines: match.group(1) + "\n".join(lines) + "\n" + match.group(2), text)
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(text)
    os.makedirs(os.path.join(docs, PICTURES), exist_ok=True)
    for name in drawn:
        if f"{PICTURES}/{name}.png" in text:
            shutil.copy(os.path.join(report, name + ".png"), os.path.join(docs, PICTURES, name + ".png"))
