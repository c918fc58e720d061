# SPDX-License-Identifier: BSD-3-Clause
"""Links in Markdown that lead to files and headings of the tree lead to some that are there."""
import os
import re

import tree


def anchor(heading):
    """How a heading is spelled in a link."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def without_code(text):
    """Blocks and spans of code hold no links."""
    text = re.sub(r"^```.*?^```$", lambda match: re.sub(r"[^\n]", " ", match.group()), text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", lambda match: " " * len(match.group()), text)


def check(root):
    texts = {path: tree.read(root, path) for path in tree.files(root) if path.endswith(".md")}
    headings = {path: {anchor(line) for line in re.findall(r"^#+ (.*)$", text, re.MULTILINE)} for path, text in texts.items()}
    for path, text in texts.items():
        code = without_code(text)
        for match in re.finditer(r"\]\(([^)\s]+)\)", code):
            link, _, part = match.group(1).partition("#")
            if re.match(r"[a-z]+:", link):
                continue
            target = os.path.normpath(os.path.join(os.path.dirname(path), link)) if link else path
            line = tree.line_of(code, match.start())
            if not os.path.exists(os.path.join(root, target)):
                yield path, line, f"no such file: {link}"
            elif part and part not in headings.get(target, ()):
                yield path, line, f"{target} has no heading {part}"


if __name__ == "__main__":
    tree.run(check)
