# SPDX-License-Identifier: BSD-3-Clause
"""docs/reference: one page a class, made from the XML of the server manager and the header of the class, and one page of the
functions of the Python package, made from their docstrings. The rule says which pages are not what these say;
`python3 tests/lint/reference.py ROOT write` writes them."""
import ast
import os
import re
import sys

import server_manager
import tree

FOLDER = "docs/reference/"
GROUPS = {"sources": "source or reader", "filters": "filter", "writers": "writer", "representations": "representation"}
HEADERS = ("plugin/vtk/", "plugin/views/")
MADE = "<!-- SPDX-License-Identifier: BSD-3-Clause; made by tests/lint/reference.py -->"
PACKAGE = ("core/python/vtkgranular/", "plugin/python/vtkgranular/")
INIT = PACKAGE[0] + "__init__.py"
MADE_BY_USERS = ("Box", "Writer")  # the other classes are what functions return


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


def exposed_names(proxies):
    """The names by which users of a display know the properties of a representation."""
    return {prop.get("name"): prop.get("exposed_name") for proxy in proxies for group in proxy.all("PropertyGroup")
            for prop in group.all("Property") if prop.get("exposed_name")}


def signature(node, skipped=0):
    """The parameters of a function as a script's reader likes to see them, without hints and without self."""
    given = node.args
    ordinary = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    words = [arg.arg + (f"={ast.unparse(default)}" if default else "") for arg, default in zip(given.args, ordinary)][skipped:]
    words += [f"*{given.vararg.arg}"] if given.vararg else ["*"] if given.kwonlyargs else []
    words += [arg.arg + (f"={ast.unparse(default)}" if default else "") for arg, default in zip(given.kwonlyargs, given.kw_defaults)]
    words += [f"**{given.kwarg.arg}"] if given.kwarg else []
    return ", ".join(words)


def text_block(node):
    return ["```text", *ast.get_docstring(node).split("\n"), "```", ""]


def members(node, found):
    """What users call of a class: its methods and properties with a docstring, and those of its private bases."""
    bases = [base.id for base in node.bases if isinstance(base, ast.Name) and base.id.startswith("_")]
    own = [each for each in node.body if isinstance(each, ast.FunctionDef)]
    for each in [*own, *(each for base in bases for each in members(found[base], found))]:
        if not each.name.startswith("_") and ast.get_docstring(each):
            yield each


def class_lines(node, found):
    init = next((each for each in node.body if isinstance(each, ast.FunctionDef) and each.name == "__init__"), None)
    lines = [f"## {node.name}", "", *text_block(node)]
    if init and node.name in MADE_BY_USERS:
        lines[2:2] = ["```python", f"vtkgranular.{node.name}({signature(init, 1)})", "```", ""]
    for each in sorted(members(node, found), key=lambda member: member.name):
        is_property = any(isinstance(each_decorator, ast.Name) and each_decorator.id == "property" for each_decorator in each.decorator_list)
        call = each.name if is_property else f"{each.name}({signature(each, 1)})"
        lines += [f"### {node.name}.{each.name}", "", "```python", f"{node.name.lower()}.{call}", "```", "", *text_block(each)]
    return lines


def functions_page(root, files):
    """The page of the functions in __all__, and of the classes that __init__ imports, in the order of their names."""
    names, classes, found = [], [], {}
    for path in files:
        if not path.startswith(PACKAGE) or not path.endswith(".py"):
            continue
        for node in ast.parse(tree.read(root, path)).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                found.setdefault(node.name, node)
            elif path == INIT and isinstance(node, ast.Assign) and node.targets[0].id == "__all__":
                names = [name for name in ast.literal_eval(node.value) if not name.startswith("__")]
            elif path == INIT and isinstance(node, ast.ImportFrom) and node.level:
                classes += [each.name for each in node.names if each.name[0].isupper()]
    lines = [MADE, "# The Python package vtkgranular", "",
             "The functions and classes that scripts use. In Python, `help(vtkgranular.reader)` shows the same text.", ""]
    for name in sorted(names):
        node = found[name]
        lines += [f"## {name}", "", "```python", f"vtkgranular.{name}({signature(node)})", "```", "", *text_block(node)]
    for name in sorted(name for name in classes if isinstance(found.get(name), ast.ClassDef)):
        lines += class_lines(found[name], found)
    return "\n".join(lines[:-1]) + "\n"


def in_menus(proxy):
    """The text of a proxy in menus, if it has one of its own."""
    texts = [hint.get("text") for hint in proxy.all("ShowInMenu") if hint.get("text")]
    return f", in menus *{texts[0]}*" if texts else ""


def page(group, proxy, header, exposed):
    name = proxy.get("name")
    lines = [MADE, f"# {name}", "",
             f"ParaView {GROUPS[group]}{in_menus(proxy)}; VTK class `{proxy.get('class')}`. {brief(header)}", "", words(proxy), ""]
    ports = [port.get("name") for port in proxy.children if port.tag == "OutputPort"]
    if ports:
        lines += ["Outputs: " + ", ".join(f"{number} `{port}`" for number, port in enumerate(ports)) + ".", ""]
    properties = sorted((prop for prop in proxy.children if prop.tag.endswith("Property")),
                        key=lambda prop: prop.get("panel_visibility") == "advanced")
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
    if INIT in files:
        yield f"{FOLDER}vtkgranular.md", functions_page(root, files)
    found, _ = server_manager.proxies(root)
    exposed = exposed_names(proxy for _, proxy in found)
    for group, proxy in found:
        headers = [path for path in tree.files(root) if path.startswith(HEADERS) and path.endswith(f"/{proxy.get('class')}.h")]
        header = next((one for one in headers if os.path.exists(os.path.join(root, one))), None)
        if header and group in GROUPS:
            yield f"{FOLDER}{proxy.get('name')}.md", page(group, proxy, tree.read(root, header), exposed)


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
