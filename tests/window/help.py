# SPDX-License-Identifier: BSD-3-Clause
"""Each panel has a page of help where ParaView looks for it, and each documented property is on it."""
import glob
import html
import os
import sqlite3
import sys
import xml.etree.ElementTree as ElementTree
import zlib

pages, folder = sys.argv[1:]
file = sqlite3.connect(f"file:{pages}?mode=ro", uri=True)
# qthelp://Granular.org/Granular/GROUP.PROXY.html
assert file.execute("SELECT Name FROM NamespaceTable").fetchall() == [("Granular.org",)]
assert file.execute("SELECT Name FROM FolderTable").fetchall() == [("Granular",)]

found = 0
for path in glob.glob(os.path.join(folder, "*.xml")):
    for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
        for proxy in group:
            if group.get("name") not in ("sources", "filters", "writers", "extract_writers"):
                continue
            name = f"{group.get('name')}.{proxy.get('name')}.html"
            row = file.execute("SELECT Data FROM FileNameTable, FileDataTable WHERE Name = ? AND FileId = Id",
                               [name]).fetchone()
            assert row, f"no page {name}"
            text = html.unescape(zlib.decompress(row[0][4:]).decode()).replace("<code>", "`").replace("</code>", "`")
            assert int.from_bytes(row[0][:4], "big") == len(zlib.decompress(row[0][4:])), name
            for documentation in [proxy.find("Documentation")] + [
                    property_.find("Documentation") for property_ in proxy
                    if property_.tag.endswith("Property") and property_.get("information_only") != "1"]:
                assert " ".join(documentation.text.split()) in text, (name, documentation.text)
            found += 1
assert found >= 15, found
