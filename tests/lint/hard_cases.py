# SPDX-License-Identifier: BSD-3-Clause
"""The table of hard cases in docs/measurements/hard_cases.md: each row is a HardCase of a test, and each HardCase a row.

    hard_cases.py FOLDER          compares the table with the sources: subject, quantity, unit, bound and test
    hard_cases.py FOLDER write    runs those tests (a build must be there) and makes the table anew

The bounds in the table are those that the tests hold; the worst errors and the numbers of trials are what they told when
the table was made."""
import json
import os
import re
import subprocess
import sys
import tempfile

import tree

PAGE = "docs/measurements/hard_cases.md"
BEGIN, END = "<!-- hard cases, made by tests/lint/hard_cases.py -->\n", "<!-- end of hard cases -->\n"
HEAD = "| subject | quantity | unit | promised at most | worst found | trials | test |"
# Without a case of each of these the table is not complete.
SUBJECTS = ("numbers, read", "numbers, written", "ids", "times", "positions, read", "positions, written", "radii", "volumes",
            "sums", "stresses", "averages in time", "lengths", "strains", "minimum image", "counts on faces", "packings", "messages", "voxels")

CASE = re.compile(r'HardCase\s+\w+\(\s*((?:"[^"\n]*"[\s,]*){3,})([^;]*?)\);', re.S)
TEST = re.compile(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", re.M)


def cases_of(path, text):
    """(subject, quantity, unit, bound, test) of each HardCase in a source."""
    tests = [(match.start(), ".".join(match.groups())) for match in TEST.finditer(text)]
    for match in CASE.finditer(text):
        # literals that stand beside each other are one
        words = [word.strip() for word in re.sub(r'"\s*"', "", match.group(1)).split('"')[1::2]]
        name = [name for start, name in tests if start < match.start()]
        if len(words) == 3 and name:
            yield (*words, match.group(2).strip(), f"{path}: {name[-1]}")


def cases(root):
    found = []
    for path in tree.files(root):
        if path.startswith("tests/") and path.endswith((".cpp", ".cxx")):
            found += cases_of(path, tree.read(root, path))
    return sorted(found, key=lambda case: (SUBJECTS.index(case[0]) if case[0] in SUBJECTS else len(SUBJECTS), case))


def rows_of(page):
    """The cells of the rows of the table."""
    table = page.split(BEGIN)[1].split(END)[0]
    return [[cell.strip() for cell in line.strip("|\n").split("|")] for line in table.splitlines()[2:] if line.strip()]


def check(root):
    """Yields (path, line, text)."""
    page = tree.read(root, PAGE)
    if BEGIN not in page:
        yield PAGE, 1, "no table of hard cases: tests/lint/hard_cases.py . write"
        return
    wanted = [tuple(case) for case in cases(root)]
    rows = rows_of(page)
    there = [(subject, quantity, unit, bound, test.strip("`")) for subject, quantity, unit, bound, _, _, test in rows]
    for case in wanted:
        if case not in there:
            yield PAGE, 1, f"no row of {case[4]}: {case[0]}, {case[1]} <= {case[3]}: tests/lint/hard_cases.py . write"
    for case in there:
        if case not in wanted:
            yield PAGE, 1, f"no test holds '{case[0]}, {case[1]} <= {case[3]}' ({case[4]})"
    for subject, quantity, unit, bound, worst, trials, _ in rows:
        if float(worst) > float(bound) or int(trials) < 1:
            yield PAGE, 1, f"{subject}, {quantity}: {worst} of {trials} trials is above {bound} {unit}"
    for subject in SUBJECTS:
        if subject not in [case[0] for case in wanted]:
            yield PAGE, 1, f"no hard case of {subject}"


def figures(root, wanted):
    """What the tests tell: {(subject, quantity): (worst, trials)}; several instances of a test together."""
    build, told = os.path.join(root, "build", "release"), {}
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as stream:
        program = {os.path.relpath(entry["file"], os.path.abspath(root)): re.search(r"/test_(\w+)\.dir/", entry["command"])
                   for entry in json.load(stream)}
    names = "|".join(sorted({program[case[4].split(": ")[0]].group(1) for case in wanted}))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["ctest", "--test-dir", build, "--no-tests=error", "-R", rf"^({names})(\.[0-9]+)?$", "--output-on-failure"],
                       check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "GRANULAR_NUMBERS": "2000000", "GRANULAR_HARD_CASES": folder})
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), encoding="utf-8") as stream:
                for line in stream:
                    subject, quantity, _, _, worst, trials = line.rstrip("\n").split("\t")
                    before = told.get((subject, quantity), (0.0, 0))
                    told[subject, quantity] = (max(before[0], float(worst)), before[1] + int(trials))
    return told


def write(root):
    wanted = cases(root)
    told = figures(root, wanted)
    lines = [HEAD, "|---|---|---|--:|--:|--:|---|"]
    for subject, quantity, unit, bound, test in wanted:
        worst, trials = told[subject, quantity]
        lines.append(f"| {subject} | {quantity} | {unit} | {bound} | {worst:.2g} | {trials} | `{test}` |")
    path = os.path.join(root, PAGE)
    with open(path, encoding="utf-8") as stream:
        page = stream.read()
    before, after = page.split(BEGIN)[0], page.split(END)[1]
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(before + BEGIN + "\n".join(lines) + "\n" + END + after)


if __name__ == "__main__":
    if sys.argv[2:] == ["write"]:
        write(sys.argv[1])
    else:
        tree.run(check)
