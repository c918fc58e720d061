# SPDX-License-Identifier: BSD-3-Clause
"""The XML of the server manager against the classes it speaks of: every command is a method of the
class, names that state files hold stay, an element of our own has its proxy class, every property says what it is, no property has a
label (a label would become its name in Python) or a name that ParaView takes for the times of the
data, no two proxies of a kind claim one file extension, but readers that look into files, and the
panel of a reader with times begins with them."""
import os
import re
import sys
from xml.parsers import expat

import tree

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "cmake"))
from reader_options import expand  # noqa: E402

# Methods that every algorithm or writer inherits and that XML may name.
INHERITED = {
    "AddInputConnection", "AddInputData", "Modified", "RemoveAllInputs", "SetInputConnection",
    "SetInputData", "Update", "Write",
}
# ParaView's time keeper asks each source for these, so a setting of such a name would change the animation.
TIMES = {"TimestepValues", "TimeRange", "TimeLabelAnnotation"}
COMMANDS = ("command", "clean_command", "set_number_command")
SHORTEST_DOCUMENTATION = 20
NAMES = "tests/lint/property_names.txt"


class Element:
    def __init__(self, tag, attributes, path, line):
        self.tag, self.attributes, self.path, self.line = tag, attributes, path, line
        self.children, self.text = [], ""

    def get(self, name, default=""):
        return self.attributes.get(name, default)

    def all(self, tag):
        """Elements of this tag, at any depth."""
        for child in self.children:
            if child.tag == tag:
                yield child
            yield from child.all(tag)


def parse(path, text):
    """The tree of elements; expat.ExpatError where it is not XML."""
    top = Element("", {}, path, 0)
    stack = [top]
    parser = expat.ParserCreate()

    def start(tag, attributes):
        element = Element(tag, attributes, path, parser.CurrentLineNumber)
        stack[-1].children.append(element)
        stack.append(element)

    def characters(data):
        stack[-1].text += data

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop()
    parser.CharacterDataHandler = characters
    parser.Parse(text.encode("utf-8", "surrogateescape"), True)
    return top


def proxies(root):
    """Group and proxy of each element of the files, and complaints. As ParaView has it, the children of a proxy begin with
    those of its bases."""
    found, complaints = [], []
    for path in tree.files(root):
        if re.match(r"xml/[^/]+\.xml$", path):
            try:
                top = parse(path, expand(root, tree.read(root, path)))
                found += [(group.get("name"), proxy) for group in top.all("ProxyGroup") for proxy in group.children]
            except expat.ExpatError as error:
                complaints.append((path, error.lineno, f"not XML: {expat.errors.messages[error.code]}"))
    by_name = {proxy.get("name"): proxy for _, proxy in found}

    def children(proxy):
        base = by_name.get(proxy.get("base_proxyname"))
        return (children(base) if base else []) + proxy.children

    for proxy, inherited in [(proxy, children(proxy)) for _, proxy in found]:
        proxy.children = inherited
    return found, complaints


def methods(header):
    """Names of the methods a VTK header declares, those made by its macros included."""
    code = tree.strip(header)
    names = set(re.findall(r"\b([A-Za-z_]\w*)\s*\(", code)) | set(re.findall(r"\busing\s+\w+::(\w+);", code))
    for macro, name in re.findall(r"\bvtk(?:Granular)?(Set|Get|Boolean)\w*Macro\s*\(\s*(\w+)", code):
        names |= {name + "On", name + "Off"} if macro == "Boolean" else {macro + name}
    return names


def header_of(root, class_name):
    """The path of a class's header, or None."""
    return next((path for path in tree.files(root) if path.startswith("plugin/") and path.endswith(f"/{class_name}.h")), None)


def known_methods(root, class_name):
    """Methods of a class of ours and of its superclasses of ours; None if there is no header."""
    header = header_of(root, class_name)
    if header is None:
        return None
    text = tree.read(root, header)
    base = re.search(rf"\bclass\s+(?:\w+\s+)?{class_name}\s*:\s*public\s+(vtkGranular\w+)",
                     tree.strip(text))
    return methods(text) | ((known_methods(root, base.group(1)) or set()) if base else set())


def check_property(prop, known, proxies_class):
    name, path = prop.get("name"), prop.path
    for attribute in COMMANDS:
        command = prop.get(attribute)
        # what overrides a property of ParaView's may keep its command, of a class of ParaView's
        if command and known is not None and command not in known and not prop.get("override"):
            yield path, prop.line, f"{name}: {attribute} {command} is not a method of {proxies_class}"
    if "label" in prop.attributes:
        yield path, prop.line, f"{name}: a label becomes the property's name in Python: leave it out"
    if name in TIMES and not prop.get("information_only"):
        yield path, prop.line, f"{name}: ParaView takes it for the times of the data: choose another name, or information_only"
    text = " ".join(" ".join(child.text for child in prop.children
                             if child.tag == "Documentation").split())
    if len(text) < SHORTEST_DOCUMENTATION:
        yield path, prop.line, (f"{name}: Documentation of {len(text)} characters, at least "
                                f"{SHORTEST_DOCUMENTATION} are needed")


def check_proxy(root, proxy):
    name, path, proxies_class = proxy.get("name"), proxy.path, proxy.get("class")
    known = known_methods(root, proxies_class)
    if known is not None:
        known |= INHERITED
    elif proxies_class.startswith("vtkGranular"):
        yield path, proxy.line, f"{name}: there is no {proxies_class}.h below plugin/"
    # ParaView makes a vtkSMX of an element X; one it does not find leaves no proxy and no error
    header = f"plugin/servermanager/vtkSM{proxy.tag}.h"
    if proxy.tag.startswith("Granular") and not os.path.exists(os.path.join(root, header)):
        yield path, proxy.line, f"{name}: there is no {header}"
    if not any(len(" ".join(child.text.split())) >= SHORTEST_DOCUMENTATION
               for child in proxy.children if child.tag == "Documentation"):
        yield path, proxy.line, f"{name}: no Documentation"
    properties = [child for child in proxy.children if child.tag.endswith("Property")]
    names = {prop.get("name") for prop in properties}
    for prop in properties:
        yield from check_property(prop, known, proxies_class)
        information = prop.get("information_property")
        if information and information not in names:
            yield prop.path, prop.line, f"{prop.get('name')}: there is no property {information}"


def check_times(proxy):
    """The first line of the panel tells that times are timesteps: the label of a group of TimestepSize alone."""
    shown = [child.get("name") for child in proxy.children if child.tag.endswith("VectorProperty") and
             child.get("panel_visibility") != "never" and not child.get("information_only")]
    if "TimestepSize" in shown:
        groups = [[each.get("name") for each in child.all("Property")] for child in proxy.children
                  if child.tag == "PropertyGroup" and "timestep" in child.get("label")]
        if shown[0] != "TimestepSize" or ["TimestepSize"] not in groups:
            yield proxy.path, proxy.line, f"{proxy.get('name')}: TimestepSize is not first, in a group whose label tells what times are"


def settings(proxy):
    """The names that a state file may hold."""
    return {child.get("name") for child in proxy.children if child.tag.endswith("Property") and child.get("name") and
            not child.get("information_only")}


def check_names(root, found):
    """State files of users hold the names of proxies and properties: those of NAMES must stay."""
    if not os.path.exists(os.path.join(root, NAMES)):
        return
    known = {proxy.get("name"): settings(proxy) for _, proxy in found if proxy.get("class")}
    for number, line in enumerate(tree.read(root, NAMES).splitlines(), 1):
        name, _, properties = line.partition(":")
        lost = set(properties.split()) - known.get(name, set())
        if lost or name not in known:
            yield NAMES, number, f"{name}: lacks {', '.join(sorted(lost))}, which state files name: if it must go, CHANGELOG says so"


def check_extensions(root, found):
    """found: (kind, extension, path, line, proxy, class) of every claim. Readers that look into a file may share its
    extension."""
    first = {}
    for kind, extension, path, line, proxy, name in found:
        header = header_of(root, name)
        looks = header is not None and "CanReadFile" in tree.read(root, header)
        other, other_looks = first.setdefault((kind, extension.lower()), (proxy, looks))
        if other != proxy and not (looks and other_looks):
            yield path, line, f"{proxy}: the extension {extension} is claimed by {other} already"


def check(root):
    claims = []
    found, complaints = proxies(root)
    yield from complaints
    for _, proxy in found:
        if not proxy.get("class"):
            continue
        yield from check_proxy(root, proxy)
        yield from check_times(proxy)
        for kind in ("ReaderFactory", "WriterFactory"):
            for hint in proxy.all(kind):
                claims += [(kind, extension, proxy.path, hint.line, proxy.get("name"), proxy.get("class"))
                           for extension in hint.get("extensions").split()]
    yield from check_extensions(root, claims)
    yield from check_names(root, found)


if __name__ == "__main__":
    tree.run(check)
