# SPDX-License-Identifier: BSD-3-Clause
"""What every file of ours looks like, and which functions the libraries do without."""
import re

import tree

LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
# Sources, scripts, CMake and XML; of the files without one of these names, those with a '#!'.
WITH_LICENCE = re.compile(
    r"\.(h|cpp|cxx|txx|inc|py|sh|cmake|cmake\.in|xml|module|plugin|map)$|(^|/)CMakeLists\.txt$")
# Neither text nor ours to shape.
NOT_TEXT = re.compile(r"\.(png|jpg|gz|zst|bin)$")

_LIBRARIES = r"(core|plugin/(vtk|servermanager|views))/"
# (where, what, why), matched in code without comments and strings.
BANNED = (
    (_LIBRARIES, r"\b(?:std::)?(?:cout|cerr|clog)\b|(?<!\w)(?:std::)?v?f?printf\s*\(|"
     r"(?<!\w)(?:std::)?f?put(?:s|c|char)\s*\(|\bvtkGenericWarningMacro\b|\bperror\s*\(",
     "prints: the core throws or returns a Notice, a VTK class calls its macros"),
    (_LIBRARIES, r"(?<![\w.>])(?:std::)?(?:abort|exit|_Exit|quick_exit)\s*\(",
     "ends the program of others"),
    (r"core/", r"\b(?:ato(?:f|i|l|ll)|strto(?:f|d|ld|l|ll|ul|ull|imax|umax)|v?f?s?scanf|"
     r"sto(?:f|d|ld|i|l|ll|ul|ull))\s*\(",
     "depends on the locale: use granular/numbers/number.h"),
)
# The same in scripts of users: samples, the guide, README.
SCRIPTS = (
    (r"\bApplyPreset\((?!(?:vg|vtkgranular)\.preset\()", "names a preset that another ParaView may call otherwise: use vg.preset"),
    (r"\bLoadPalette\(", "stays in the user's own settings: use OverrideColorPalette of SaveScreenshot"),
)
# A comment of the product says what something does, or names it: "Returns true if ..." and "Bytes that ..." rather than "Whether ..." and
# "What ...".
OPENING = re.compile(r"\s*(?://+|#|/?\*+)\s*((?:What|Whether|Of|How|Where|Who)\b)?")
# Words that mean "not finished"; spelled so that this file does not hold them.
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b")


def check_text(path, text):
    if not text:
        return
    if not text.endswith("\n"):
        yield path, text.count("\n") + 1, "no line feed at the end of the file"
    elif text.endswith("\n\n"):
        yield path, text.count("\n"), "empty line at the end of the file"
    for number, line in enumerate(text.split("\n"), 1):
        if "\r" in line:
            yield path, number, "carriage return"
        if "\t" in line:
            yield path, number, "tab"
        if line.rstrip("\r") != line.rstrip():
            yield path, number, "blank at the end of the line"
        if not line.isascii():
            yield path, number, "not ASCII"
        unfinished = UNFINISHED.search(line)
        if unfinished:
            yield path, number, unfinished.group() + ": finish it, or file it as an issue"


def check_licence(path, text):
    if not WITH_LICENCE.search(path) and not text.startswith("#!"):
        return
    lines = [number for number, line in enumerate(text.split("\n"), 1) if LICENCE in line]
    if not lines or lines[0] > 3:
        yield path, 1, f"no line '{LICENCE}' among the first three"


def check_banned(path, text):
    rules = [(what, why) for where, what, why in BANNED if re.match(where, path)]
    if not rules or not path.endswith((".h", ".cpp", ".cxx", ".txx", ".inc")):
        return
    code = tree.strip(text)
    for what, why in rules:
        for match in re.finditer(what, code):
            name = match.group().rstrip("( \n")
            yield path, tree.line_of(code, match.start()), f"{name} {why}"


def check_script(path, text):
    if not re.match(r"samples/|docs/|README", path):
        return
    for what, why in SCRIPTS:
        for match in re.finditer(what, text):
            yield path, tree.line_of(text, match.start()), f"{match.group()} {why}"


def check_openings(path, text):
    if not re.match(r"(core|plugin|cmake|samples)/", path) or not path.endswith((".h", ".cpp", ".cxx", ".py", ".txt", ".cmake")):
        return
    inside = False
    for number, line in enumerate(text.split("\n"), 1):
        comment = OPENING.match(line)
        if comment and comment.group(1) and not inside:
            yield path, number, f"a comment opens with '{comment.group(1)}': say what the thing does, or name it"
        inside = bool(comment) and line.strip(" /*#") != ""


def check(root):
    for path in tree.files(root):
        if NOT_TEXT.search(path):
            continue
        text = tree.read(root, path)
        yield from check_text(path, text)
        yield from check_licence(path, text)
        yield from check_banned(path, text)
        yield from check_script(path, text)
        yield from check_openings(path, text)


if __name__ == "__main__":
    tree.run(check)
