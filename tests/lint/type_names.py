# SPDX-License-Identifier: BSD-3-Clause
"""Each type has a name of its own: two definitions of one qualified name, in two files, violate the one-definition rule, and a linker
takes the functions of one for both. Types of anonymous namespaces and of functions, and aliases in sources, are their file's own;
specialisations share the name of their template."""
import re

import sizes
import tree

SOURCES = r"(core|plugin)/.*\.(h|cpp|cxx|txx)"

_TYPE = re.compile(r"^\s*(?:typedef\s+)?(?:class|struct|union|enum(?:\s+(?:class|struct))?)\b")
_ALIAS = re.compile(r"^\s*using\s+(\w+)\s*=")
_NAMESPACE = re.compile(r"^\s*(?:inline\s+)?namespace\b\s*([\w:]*)")


def _type_name(head):
    """The name that the definition of a type gives; None of a specialisation, or of a type without one."""
    match = _TYPE.match(head)
    if not match:
        return None
    name = re.split(r"(?<!:):(?!:)", head[match.end():])[0]  # less the bases
    name = re.sub(r"\[\[.*?\]\]|\b(?:alignas|__attribute__)\s*\(+[^()]*\)+|\bfinal\b", " ", name)
    if "<" in name:
        return None
    words = name.split()
    return words[-1] if words else None


def _head(text):
    """A declaration less its template parameters, the labels before it, and what only says who sees it."""
    text = re.sub(r"^\s*(?:(?:public|private|protected)\s*:(?!:)\s*)*", "", text)
    return sizes._without_template(text)


def types(text):
    """(qualified name, line, whether an alias) of each type that a C++ file defines at namespace or class scope, and of each alias at
    namespace scope."""
    code = tree.strip(text)
    code = re.sub(r"^[ \t]*#(?:\\\n|[^\n])*", lambda m: re.sub(r"[^\n]", " ", m.group()), code,
                  flags=re.MULTILINE)
    scopes = []  # (name, whether a namespace); a name of None: of the file alone
    start = offset = 0

    def qualified(name):
        names = [scope[0] for scope in scopes] + [name]
        return None if None in names else "::".join(part for part in names if part)

    while offset < len(code):
        character = code[offset]
        if character == "(":
            offset = tree.closing(code, offset)
        elif character == ";":
            alias = _ALIAS.match(_head(code[start:offset]))
            if alias and all(scope[1] for scope in scopes) and qualified(alias.group(1)):
                yield qualified(alias.group(1)), tree.line_of(code, offset), True
            start = offset + 1
        elif character == "}":
            if scopes:
                scopes.pop()
            start = offset + 1
        elif character == "{":
            raw = code[start:offset]
            head = _head(raw)
            kind = sizes.kind_of(raw)
            if kind == "scope":
                namespace = _NAMESPACE.match(head)
                if namespace:
                    scopes.append((namespace.group(1) or None, True))
                elif _TYPE.match(head):
                    name = _type_name(head)
                    if name and qualified(name):
                        yield qualified(name), tree.line_of(code, offset - len(head.lstrip())), False
                    scopes.append((name, False))
                else:
                    scopes.append(("", True))  # extern "C"
                start = offset + 1
            else:
                offset = tree.closing(code, offset)
                start = offset + 1 if kind == "function" else start
        offset += 1


def check(root):
    known = {}
    for path in tree.files(root):
        if re.fullmatch(SOURCES, path):
            for name, line, alias in types(tree.read(root, path)):
                if alias and not path.endswith(".h"):
                    continue
                first = known.setdefault(name, (path, line))
                if first != (path, line):
                    yield path, line, (f"{name}: a type of this name is defined at {first[0]}:{first[1]}, "
                                       "too: rename one of them")


if __name__ == "__main__":
    tree.run(check)
