# SPDX-License-Identifier: BSD-3-Clause
"""The portable plugin has every source, filter and writer of xml, and every property of these, but what its file _missing.py
names and the guide as well."""
import ast
import re

import server_manager
import tree

FOLDER = "plugin/python/vtkgranular/portable/"
LIST, GUIDE, OPTIONS = FOLDER + "_missing.py", "docs/guide/portable.md", "core/granular/runs/options.toml"
SETTINGS = "core/c/filter_"  # which take the properties of filters by their names
GROUPS = ("sources", "filters", "writers", "extract_writers")


def missing(root):
    """The names of the list, with their lines."""
    return {node.value: node.lineno for each in ast.parse(tree.read(root, LIST)).body if isinstance(each, ast.Assign)
            for node in ast.walk(each.value) if isinstance(node, ast.Constant)}


def is_known(prop, code, options):
    """True if the sources speak of a property, or of the method that takes it."""
    name, command = prop.get("name"), prop.get("command")
    return prop.tag == "InputProperty" or name in server_manager.TIMES or name in options or f'"{name}"' in code or \
        f"def {command}(" in code


def check(root):
    listed, used = missing(root), set()
    code = "".join(tree.read(root, path) for path in tree.files(root)
                   if path != LIST and path.startswith((FOLDER, SETTINGS)))
    options = set(re.findall(r'^property = "(\w+)"', tree.read(root, OPTIONS), re.MULTILINE))
    lacks = []
    for proxy in [proxy for group, proxy in server_manager.proxies(root)[0] if group in GROUPS]:
        name = proxy.get("name")
        if f"class {name}(" not in code:
            lacks.append((proxy, name))
            continue
        for prop in proxy.children:
            if (prop.tag.endswith("Property") and not is_known(prop, code, options)) or prop.get("name") in listed:
                lacks.append((prop, prop.get("name")))
    for element, name in lacks:
        used.add(name)
        if name not in listed:
            yield element.path, element.line, f"{name}: the portable plugin does not have it: {LIST} names what it lacks"
    for name in sorted(listed.keys() - used):
        yield LIST, listed[name], f"{name}: the portable plugin has it, or nothing has this name"
    guide = tree.read(root, GUIDE)
    for name in listed:
        if f"`{name}`" not in guide:
            yield LIST, listed[name], f"{name}: {GUIDE} does not say that it is missing"


if __name__ == "__main__":
    tree.run(check)
