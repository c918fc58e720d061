# SPDX-License-Identifier: BSD-3-Clause
"""How long a function and a file may be. A function is counted from the first line of its
declaration to the line of its closing brace."""
import re

import tree

# files, lines of a function, lines of a file
BUDGETS = (
    (r"core/c/granular\.h", 80, 500),  # the whole interface, for programs that include one file
    (r"core/.*\.h", 80, 200),
    (r"core/.*\.(cpp|inc)", 80, 400),
    (r"plugin/(vtk|servermanager|views)/.*\.h", 100, 200),
    (r"plugin/(vtk|servermanager|views)/.*\.(cxx|txx)", 100, 600),
)

_SCOPE = re.compile(r"\b(namespace|class|struct|union|enum)\b")


def _depth_zero(head):
    """The declaration with the inside of its brackets left out."""
    out, depth = [], 0
    for character in head:
        if character in "([{":
            depth += 1
            if depth == 1:
                out.append(character)
        elif character in ")]}":
            depth -= 1
            if depth == 0:
                out.append(character)
        elif depth == 0:
            out.append(character)
    return "".join(out)


def _without_template(head):
    """The declaration without the template parameters in front of it, whose defaults hold '='."""
    match = re.match(r"\s*template\s*<", head)
    if not match:
        return head
    depth = 1
    for offset in range(match.end(), len(head)):
        depth += {"<": 1, ">": -1}.get(head[offset], 0)
        if depth == 0:
            return _without_template(head[offset + 1:])
    return head


def kind_of(head):
    """What the brace behind this text opens: 'scope', 'function', 'member' (an initialiser in the
    list of a constructor) or 'value'. A lambda that a variable starts with is a function."""
    flat = _depth_zero(_without_template(head))
    flat = re.sub(r"\boperator\s*(\(\)|\[\]|[^\s\w(]+)", "operator_", flat)
    keywords = re.sub(r"\b(alignas|__attribute__)\s*\(\)", "", flat)
    if re.search(r'\bextern\s*"[^"]*"\s*$', flat) or (
            _SCOPE.search(keywords) and "(" not in keywords):
        return "scope"
    assignment = re.search(r"(?<![=!<>])=(?!=)", flat)
    if assignment:
        return "function" if flat[assignment.end():].lstrip().startswith("[") else "value"
    if ")" not in flat:
        return "value"
    if re.search(r"(?<!:):(?!:)", flat[flat.index(")"):]):
        return "function" if re.search(r"[)}]\s*$", flat) else "member"
    return "function"


def name_of(head):
    """The name in a declaration, for the complaint."""
    flat = _depth_zero(_without_template(head))
    match = (re.search(r"(\w+)\s*=(?!=)\s*\[", flat)
             or re.search(r"([\w:~]*operator\s*(?:\(\)|[^\s(]*)|[\w:~]+)\s*\(", flat))
    return match.group(1) if match else "?"


def functions(text):
    """(name, first line, last line) of every function body of a C++ file that is not within another
    function. Preprocessor lines are left out: braces must match without them."""
    code = tree.strip(text)
    code = re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", lambda m: re.sub(r"[^\n]", " ", m.group()), code,
                  flags=re.MULTILINE)
    found = []
    start = 0
    offset = 0
    while offset < len(code):
        character = code[offset]
        if character == "(":
            offset = tree.closing(code, offset)
        elif character in ";}":
            start = offset + 1
        elif character == "{":
            head = code[start:offset]
            kind = kind_of(head)
            if kind == "scope":
                start = offset + 1
            else:
                end = tree.closing(code, offset)
                if kind == "function":
                    head = re.sub(r"^\s*(?:(?:public|private|protected)\s*:\s*)*", "", head)
                    first = tree.line_of(code, offset - len(head))
                    found.append((name_of(head), first, tree.line_of(code, end)))
                    start = end + 1
                offset = end
        offset += 1
    return found


def check(root):
    for path in tree.files(root):
        budget = next((one for one in BUDGETS if re.fullmatch(one[0], path)), None)
        if not budget:
            continue
        text = tree.read(root, path)
        lines = text.count("\n")
        if lines > budget[2]:
            yield path, budget[2] + 1, f"file of {lines} lines, {budget[2]} are allowed"
        for name, first, last in functions(text):
            if last - first + 1 > budget[1]:
                yield path, first, (f"{name}: function of {last - first + 1} lines, {budget[1]} are "
                                    "allowed")


if __name__ == "__main__":
    tree.run(check)
