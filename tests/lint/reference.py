# SPDX-License-Identifier: BSD-3-Clause
"""docs/reference: one page a class, made from the XML of the server manager and the header of the class, and one page of the
functions of the Python package, made from their docstrings. The rule says which pages are not what these say;
`python3 tests/lint/reference.py ROOT write` writes them."""
import ast
import os
import re
import sys
from xml.parsers import expat

import server_manager
import tree

FOLDER = "docs/reference/"
GROUPS = {"sources": "source or reader", "filters": "filter", "writers": "writer", "representations": "representation"}
HEADERS = ("plugin/vtk/", "plugin/views/")
MADE = "<!-- SPDX-License-Identifier: BSD-3-Clause; made by tests/lint/reference.py -->"
PACKAGE = "plugin/python/granular/"


def words(element):
    """The text of an element's Documentation as one line of Markdown, with paragraphs kept."""
    text = "".join(child.text for child in element.children if child.tag == "Documentation")
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")


def brief(header):
    """The text behind @brief of a class."""
    match = re.search(r"@brief\s+(.*?)\n\s*\*\s*\n", header, re.DOTALL)
    return " ".join(re.sub(r"\n\s*\*\s?", " ", match.group(1)).split()) if match else ""


def values(prop):
    """What a property may be: the entries of an enumeration, on and off, a range, or a number of elements."""
    entries = [entry.get("text") for entry in prop.all("Entry")]
    if entries:
        return ", ".join(entries)
    if any(prop.all("BooleanDomain")):
        return "off, on"
    for domain in [*prop.all("IntRangeDomain"), *prop.all("DoubleRangeDomain")]:
        if domain.get("min") and not domain.get("max"):
            return f"from {domain.get('min')} on"
        if domain.get("min"):
            return f"{domain.get('min')} to {domain.get('max')}"
    count = prop.get("number_of_elements")
    kind = {"StringVectorProperty": "text", "IntVectorProperty": "integer", "IdTypeVectorProperty": "integer",
            "DoubleVectorProperty": "number", "InputProperty": "input"}.get(prop.tag, "")
    if prop.get("repeat_command") == "1" or prop.get("repeatable") == "1":
        return f"any number of {kind}s"
    return f"{count} {kind}s" if count.isdigit() and int(count) > 1 else kind


def default(prop):
    """The default as scripts spell it."""
    given = prop.get("default_values")
    for entry in prop.all("Entry"):
        if entry.get("value") == given:
            return entry.get("text")
    if any(prop.all("BooleanDomain")):
        return {"0": "off", "1": "on"}.get(given, given)
    return "" if given == "none" else given


def exposed_names(top):
    """The names by which users of a display know the properties of a representation."""
    return {prop.get("name"): prop.get("exposed_name") for group in top.all("PropertyGroup") for prop in group.all("Property")
            if prop.get("exposed_name")}


def signature(node):
    """The parameters of a function as a script's reader likes to see them, without hints."""
    given = node.args
    ordinary = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    words = [arg.arg + (f"={ast.unparse(default)}" if default else "") for arg, default in zip(given.args, ordinary)]
    words += [f"*{given.vararg.arg}"] if given.vararg else ["*"] if given.kwonlyargs else []
    words += [arg.arg + (f"={ast.unparse(default)}" if default else "") for arg, default in zip(given.kwonlyargs, given.kw_defaults)]
    words += [f"**{given.kwarg.arg}"] if given.kwarg else []
    return ", ".join(words)


def functions_page(root, files):
    """The page of the functions in __all__, in the order of their names."""
    names, found = [], {}
    for path in files:
        if not path.startswith(PACKAGE) or not path.endswith(".py"):
            continue
        for node in ast.parse(tree.read(root, path)).body:
            if isinstance(node, ast.FunctionDef):
                found[node.name] = node
            elif isinstance(node, ast.Assign) and path.endswith("__init__.py") and node.targets[0].id == "__all__":
                names = [name for name in ast.literal_eval(node.value) if not name.startswith("__")]
    lines = [MADE, "# The Python package granular", "",
             "The functions that scripts use. In Python, `help(granular.reader)` shows the same text.", ""]
    for name in sorted(names):
        node = found[name]
        lines += [f"## {name}", "", "```python", f"granular.{name}({signature(node)})", "```", "", "```text",
                  *ast.get_docstring(node).split("\n"), "```", ""]
    return "\n".join(lines[:-1]) + "\n"


def page(group, proxy, header, exposed):
    name = proxy.get("name")
    lines = [MADE, f"# {name}", "",
             f"ParaView {GROUPS[group]}; VTK class `{proxy.get('class')}`. {brief(header)}", "", words(proxy), ""]
    ports = [port.get("name") for port in proxy.children if port.tag == "OutputPort"]
    if ports:
        lines += ["Outputs: " + ", ".join(f"{number} `{port}`" for number, port in enumerate(ports)) + ".", ""]
    properties = [prop for prop in proxy.children if prop.tag.endswith("Property")]
    for title, chosen in (("Properties", [prop for prop in properties if prop.get("information_only") != "1"]),
                          ("Information", [prop for prop in properties if prop.get("information_only") == "1"])):
        if not chosen:
            continue
        lines += [f"## {title}", ""]
        for prop in chosen:
            command = prop.get("command")
            about = [f"C++ `{command}`"] if command else []
            if title == "Properties":
                about = [text for text in (values(prop), f"default `{default(prop)}`" if default(prop) else "") if text] + about
            lines += [f"### {exposed.get(prop.get('name'), prop.get('name'))}", "", "*" + "; ".join(about) + "*", "", words(prop), ""]
    while lines[-1] == "":
        lines.pop()
    return "\n".join(lines) + "\n"


def pages(root):
    """Path and text of each page."""
    files = tree.files(root)
    if f"{PACKAGE}__init__.py" in files:
        yield f"{FOLDER}granular.md", functions_page(root, files)
    for path in files:
        if not re.match(r"xml/[^/]+\.xml$", path):
            continue
        try:
            top = server_manager.parse(tree.read(root, path))
        except expat.ExpatError:
            continue  # server_manager says so
        exposed = exposed_names(top)
        for group in top.all("ProxyGroup"):
            for proxy in group.children:
                headers = [f"{folder}{proxy.get('class')}.h" for folder in HEADERS]
                header = next((one for one in headers if os.path.exists(os.path.join(root, one))), None)
                if header and group.get("name") in GROUPS:
                    yield f"{FOLDER}{proxy.get('name')}.md", page(group.get("name"), proxy, tree.read(root, header), exposed)


def check(root):
    made = dict(pages(root))
    there = [path for path in tree.files(root) if path.startswith(FOLDER)]
    for path in sorted({*made, *there}):
        if path not in made:
            yield path, 1, "nothing has this page: delete it"
        elif path not in there or tree.read(root, path) != made[path]:
            yield path, 1, "not what the sources say: python3 tests/lint/reference.py . write"


if __name__ == "__main__":
    if sys.argv[2:] == ["write"]:
        for path, text in pages(sys.argv[1]):
            with open(os.path.join(sys.argv[1], path), "w", encoding="utf-8") as stream:
                stream.write(text)
    else:
        tree.run(check)
