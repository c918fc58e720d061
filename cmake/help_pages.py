# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pages that '?' opens in ParaView's panels: help_pages.py NAME.qch file.xml...

A page a proxy, from the documentation in the server manager's XML, in one file of Qt's help system. Such a file is an
SQLite database, so that neither Qt's help tools nor an XSLT processor are needed. ParaView looks for the page
qthelp://NAME.org/NAME/GROUP.PROXY.html.
"""
import html
import os
import re
import sqlite3
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

# The input of Qt. The tables of filters stay empty: all pages are always there.
TABLES = """
CREATE TABLE NamespaceTable (Id INTEGER PRIMARY KEY, Name TEXT);
CREATE TABLE FolderTable (Id INTEGER PRIMARY KEY, Name TEXT, NamespaceID INTEGER);
CREATE TABLE FilterAttributeTable (Id INTEGER PRIMARY KEY, Name TEXT);
CREATE TABLE FilterNameTable (Id INTEGER PRIMARY KEY, Name TEXT);
CREATE TABLE FilterTable (NameId INTEGER, FilterAttributeId INTEGER);
CREATE TABLE IndexTable
  (Id INTEGER PRIMARY KEY, Name TEXT, Identifier TEXT, NamespaceId INTEGER, FileId INTEGER, Anchor TEXT);
CREATE TABLE IndexFilterTable (FilterAttributeId INTEGER, IndexId INTEGER);
CREATE TABLE ContentsTable (Id INTEGER PRIMARY KEY, NamespaceId INTEGER, Data BLOB);
CREATE TABLE ContentsFilterTable (FilterAttributeId INTEGER, ContentsId INTEGER);
CREATE TABLE FileAttributeSetTable (Id INTEGER, FilterAttributeId INTEGER);
CREATE TABLE FileDataTable (Id INTEGER PRIMARY KEY, Data BLOB);
CREATE TABLE FileFilterTable (FilterAttributeId INTEGER, FileId INTEGER);
CREATE TABLE FileNameTable (FolderId INTEGER, Name TEXT, FileId INTEGER, Title TEXT);
CREATE TABLE MetaDataTable (Name TEXT, Value BLOB);
"""
PAGE = """<!DOCTYPE html>
<html><head><meta charset="utf-8"><title>{title}</title></head>
<body><h1>{title}</h1>
{body}
</body></html>
"""


def as_html(element):
    """Returns the text of a Documentation element: `names` in backticks become code."""
    text = " ".join((element.text or "").split()) if element is not None else ""
    return re.sub("`([^`]*)`", r"<code>\1</code>", html.escape(text, quote=False))


def values_of(property_):
    """Returns what a property may be, as far as its domains say."""
    entries = [entry.get("text") for entry in property_.iter("Entry")]
    if entries:
        return ", ".join(entries)
    if property_.find("BooleanDomain") is not None:
        return "0, 1"
    for domain in property_:
        if domain.tag.endswith("RangeDomain") and (domain.get("min") or domain.get("max")):
            ends = [f"{word} {domain.get(key)}" for key, word in (("min", "from"), ("max", "to")) if domain.get(key)]
            return " ".join(ends)
    return ""


def default_of(property_):
    """Returns the default of a property, by its name where it has one."""
    default = property_.get("default_values", "")
    names = {entry.get("value"): entry.get("text") for entry in property_.iter("Entry")}
    return names.get(default, "" if default == "none" else default)


def page_of(proxy, properties):
    """Returns the page of a proxy: what it does, and a table of its properties but those that only inform."""
    rows = ["<tr><th>property</th><th width='55%'>meaning</th><th>values</th><th>default</th></tr>"]
    for property_ in sorted(properties, key=lambda one: one.get("panel_visibility") == "advanced"):
        if property_.tag.endswith("Property") and property_.get("information_only") != "1":
            cells = [f"<b>{html.escape(property_.get('name'))}</b>", as_html(property_.find("Documentation")),
                     html.escape(values_of(property_)), html.escape(default_of(property_))]
            rows.append("<tr>" + "".join(f"<td valign='top'>{cell}</td>" for cell in cells) + "</tr>")
    table = "<table border='1' cellspacing='0' cellpadding='4'>\n" + "\n".join(rows) + "\n</table>"
    return f"<p>{as_html(proxy.find('Documentation'))}</p>\n{table}"


def title_of(proxy):
    """Returns the words of the XML name, behind the text of the menu if there is another."""
    menu = proxy.find("Hints/ShowInMenu")
    words = re.sub("(?<=[a-z])(?=[A-Z])", " ", proxy.get("name"))
    return f"{menu.get('text')}: {words}" if menu is not None and menu.get("text") else words


def read_pages(paths):
    """Returns [(file name, title, HTML)] of all proxies in files of XML; the first one is an index of the others."""
    pages = []
    groups = [group for path in paths for group in ElementTree.parse(path).getroot().iter("ProxyGroup")]
    bases = {proxy.get("name"): proxy for group in groups for proxy in group}

    def children(proxy):
        base = bases.get(proxy.get("base_proxyname"))
        return [*(children(base) if base is not None else []), *proxy]

    for group in groups:
        for proxy in group:
            if proxy.tag.endswith("Proxy") and not group.get("name").startswith("internal_"):
                name = f"{group.get('name')}.{proxy.get('name')}.html"
                title = html.escape(title_of(proxy))
                pages.append((name, title, PAGE.format(title=title, body=page_of(proxy, children(proxy)))))
    pages.sort()
    links = "\n".join(f"<li><a href='{name}'>{title}</a></li>" for name, title, _ in pages)
    return [("index.html", "vtk-granular", PAGE.format(title="vtk-granular", body=f"<ul>\n{links}\n</ul>"))] + pages


def qt_string(text):
    """Returns a string as Qt's QDataStream writes it."""
    data = text.encode("utf-16-be")
    return struct.pack(">I", len(data)) + data


def write_help(path, pages):
    """Writes the pages as a file of Qt's help system; that of an earlier call is replaced."""
    name = os.path.splitext(os.path.basename(path))[0]
    if os.path.exists(path):
        os.remove(path)
    file = sqlite3.connect(path)
    file.executescript(TABLES)
    file.execute("INSERT INTO NamespaceTable VALUES (1, ?)", [f"{name}.org"])
    file.execute("INSERT INTO FolderTable VALUES (1, ?, 1)", [name])
    file.execute("INSERT INTO MetaDataTable VALUES ('qchVersion', '1.0')")
    contents = b""
    for number, (page, title, text) in enumerate(pages, 1):
        data = text.encode()
        packed = struct.pack(">I", len(data)) + zlib.compress(data)
        file.execute("INSERT INTO FileDataTable VALUES (?, ?)", [number, packed])
        file.execute("INSERT INTO FileNameTable VALUES (1, ?, ?, ?)", [page, number, html.unescape(title)])
        depth = 0 if number == 1 else 1
        contents += struct.pack(">i", depth) + qt_string(page) + qt_string(html.unescape(title))
    file.execute("INSERT INTO ContentsTable VALUES (1, 1, ?)", [contents])
    file.commit()
    file.close()


if __name__ == "__main__":
    write_help(sys.argv[1], read_pages(sys.argv[2:]))
