# SPDX-License-Identifier: BSD-3-Clause
"""Each rule on small trees: what must be found, with file and line, and what must not."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import hard_cases
import layering
import links
import messages
import options
import portable
import reader_options
import reference
import server_manager
import sizes
import style
import tree
import type_names

SPDX = "// SPDX-License-Identifier: BSD-3-Clause\n"


def found(check, **files):
    """'path:line' of every complaint about a tree of these files; __ in a name stands for /."""
    return sorted({f"{path}:{line}" for path, line, _ in complaints(check, files)})


def complaints(check, files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = os.path.join(root, *([name] if "/" in name else name.replace("_dot_", ".").split("__")))
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8", newline="") as stream:
                stream.write(text)
        return list(check(root))


class Stripping(unittest.TestCase):
    def test_comments_and_strings_are_blanked_in_place(self):
        code = 'a("x//y", \'"\'); // "no\n/* { */ b(1\'000, u8"z", R"q({)")q");'
        stripped = tree.strip(code)
        self.assertEqual(len(stripped), len(code))
        self.assertEqual(stripped.count("\n"), 1)
        self.assertNotIn("{", stripped)
        self.assertNotIn("no", stripped)
        self.assertIn("1'000", stripped)
        self.assertIn('"x//y"', tree.strip(code, strings=False))

    def test_bracket_is_closed(self):
        code = "f({1, (2)}, [3]) g"
        self.assertEqual(tree.closing(code, 1), code.index(") g"))


class Links(unittest.TestCase):
    def test_files_and_headings(self):
        self.assertEqual(found(
            links.check,
            README_dot_md="# One two\n[a](docs/a.md) [b](docs/b.md)\n[c](#one-two) [d](#three)\n`[e](none.md)`\n"
            "```\n[f](none.md)\n```\n[g](https://example.org/none.md) [h](docs/a.md#there) [i](docs/a.md#not-there)\n",
            docs__a_dot_md="## There\n![p](../p.png)\n"), ["README.md:2", "README.md:3", "README.md:8", "docs/a.md:2"])


class Reference(unittest.TestCase):
    xml = ('<ServerManagerConfiguration><ProxyGroup name="sources"><SourceProxy name="GranularX" class="vtkGranularX">'
           '<Documentation>Reads x.</Documentation><IntVectorProperty name="Threads" command="SetThreads" number_of_elements="1"'
           ' default_values="0"><IntRangeDomain name="range" min="0"/><Documentation>How many.</Documentation>'
           '</IntVectorProperty></SourceProxy></ProxyGroup></ServerManagerConfiguration>')
    header = "/**\n * @class vtkGranularX\n * @brief Reads x of a file.\n *\n */\n"
    page = ("<!-- SPDX-License-Identifier: BSD-3-Clause; made by tests/lint/reference.py -->\n# GranularX\n\n"
            "ParaView source or reader; VTK class `vtkGranularX`. Reads x of a file.\n\nReads x.\n\n## Properties\n\n### Threads\n\n"
            "*from 0 on; default `0`; C++ `SetThreads`*\n\nHow many.\n")

    def pages(self, **files):
        return found(reference.check, xml__x_dot_xml=self.xml, plugin__vtk__vtkGranularX_dot_h=self.header, **files)

    def test_pages_are_what_xml_and_header_say(self):
        self.assertEqual(self.pages(docs__reference__GranularX_dot_md=self.page), [])

    def test_pages_have_the_properties_of_bases(self):
        begin, end = self.xml.index("<IntVectorProperty"), self.xml.index("</SourceProxy>")
        base = self.xml.replace('"sources"><SourceProxy name="GranularX" class="vtkGranularX"', '"internal"><SourceProxy name="B"').replace(
            "<Documentation>Reads x.</Documentation>", "")
        own = (self.xml[:begin] + self.xml[end:]).replace(" class=", ' base_proxyname="B" class=')
        self.assertEqual(found(reference.check, xml__b_dot_xml=base, xml__x_dot_xml=own, docs__reference__GranularX_dot_md=self.page,
                               plugin__vtk__vtkGranularX_dot_h=self.header), [])
        self.assertEqual(self.pages(docs__reference__GranularX_dot_md=self.page + "\n"), ["docs/reference/GranularX.md:1"])
        self.assertEqual(self.pages(), ["docs/reference/GranularX.md:1"])
        self.assertEqual(self.pages(docs__reference__GranularX_dot_md=self.page, docs__reference__GranularY_dot_md="old\n"),
                         ["docs/reference/GranularY.md:1"])


    def test_functions_of_the_package(self):
        package = {"core/python/vtkgranular/__init__.py": 'from ._c import C, x\n__all__ = ["__version__", "b", "a"]\n',
                   "plugin/python/vtkgranular/_ab.py":
                   'def a(*x: int, y: int, z: int = 3) -> None:\n    """Does a.\n\n    x  numbers\n    """\n\n\n'
                   'def b(x: int, y: str = "c", **more: int) -> None:\n    """Does b."""\n\n\ndef _c() -> None:\n    """Hidden."""\n',
                   "core/python/vtkgranular/_c.py":
                   'class _B:\n    @property\n    def p(self) -> int:\n        """A number."""\n\n    def _q(self) -> None:\n        """Hidden."""\n\n\n'
                   'class C(_B):\n    """A c."""\n\n    def m(self, x: int = 1) -> None:\n        """Does m."""\n'}
        page = ("<!-- SPDX-License-Identifier: BSD-3-Clause; made by tests/lint/reference.py -->\n# The Python package vtkgranular\n\n"
                "The functions and classes that scripts use. In Python, `help(vtkgranular.reader)` shows the same text.\n\n## a\n\n```python\n"
                "vtkgranular.a(*x, y, z=3)\n```\n\n```text\nDoes a.\n\nx  numbers\n```\n\n## b\n\n```python\n"
                "vtkgranular.b(x, y='c', **more)\n```\n\n```text\nDoes b.\n```\n\n## C\n\n```text\nA c.\n```\n\n### C.m\n\n```python\n"
                "c.m(x=1)\n```\n\n```text\nDoes m.\n```\n\n### C.p\n\n```python\nc.p\n```\n\n```text\nA number.\n```\n")
        pages = {"docs__reference__vtkgranular_dot_md": page, "docs__reference__GranularX_dot_md": self.page}
        self.assertEqual(self.pages(**package, **pages), [])
        package["plugin/python/vtkgranular/_ab.py"] += "\n"
        self.assertEqual(self.pages(**package, **pages), [])
        package["plugin/python/vtkgranular/_ab.py"] = package["plugin/python/vtkgranular/_ab.py"].replace("numbers", "words")
        self.assertEqual(self.pages(**package, **pages), ["docs/reference/vtkgranular.md:1"])


class HardCases(unittest.TestCase):
    SOURCE = ('TEST(Sums, Cancel)\n{\n  HardCase hard(\n    "sums", "terms that "\n    "cancel", "ulp", 0.5);\n}\n')
    ROW = "| sums | terms that cancel | ulp | 0.5 | 0.25 | 10 | `tests/a.cpp: Sums.Cancel` |\n"

    def check(self, row, source=SOURCE):
        page = f"{hard_cases.BEGIN}{hard_cases.HEAD}\n|---|\n{row}{hard_cases.END}"
        files = {"docs__measurements__hard_cases_dot_md": page, "tests__a_dot_cpp": source}
        return [text for _, _, text in complaints(hard_cases.check, files) if "no hard case of" not in text]

    def test_rows_are_what_tests_hold(self):
        self.assertEqual(self.check(self.ROW), [])
        self.assertEqual(len(self.check("")), 1)  # a test without a row
        self.assertEqual(len(self.check(self.ROW, "")), 1)  # a row without a test
        self.assertEqual(len(self.check(self.ROW.replace("0.5", "0.1"))), 3)  # another bound: both, and worse than it
        self.assertEqual(len(self.check(self.ROW.replace("0.25", "0.75"))), 1)  # worse than promised
        self.assertEqual(len(self.check(self.ROW.replace("10", "0"))), 1)  # nothing was tried

    def test_subjects_are_complete(self):
        page = hard_cases.BEGIN + hard_cases.HEAD + "\n|---|\n" + hard_cases.END
        told = complaints(hard_cases.check, {"docs__measurements__hard_cases_dot_md": page})
        self.assertEqual(len(told), len(hard_cases.SUBJECTS))


class Layering(unittest.TestCase):
    def test_core(self):
        self.assertEqual(found(
            layering.check,
            core__granular__bytes__a_dot_h=
            '#include <vector>\n#include "granular/bytes/b.h"\n#include "granular/text/d.h"\n'
            '// #include "vtkObject.h"\n#include "vtkObject.h"\n#include <unistd.h>\n',
            core__granular__bytes__byte_source_dot_cpp="#include <unistd.h>\n",
            core__granular__bytes__calls_posix_dot_cpp="#include <unistd.h>\n#include <sys/file.h>\n#include <windows.h>\n",
            core__granular__bytes__calls_windows_dot_cpp="#include <windows.h>\n#include <unistd.h>\n",
            core__granular__bytes__byte_source_zstd_dot_cpp="#include <zstd.h>\n#include <zlib.h>\n",
            core__granular__bytes__byte_source_zstd_dot_h="#include <zstd.h>\n",
            core__granular__bytes__inflate_dot_cpp="#include <zlib.h>\n#include <zstd.h>\n#include <isa-l/crc.h>\n",
            core__granular__bytes__compression_dot_cpp="#include <zlib.h>\n#include <fcntl.h>\n",
            core__granular__parallel__executor_dot_cpp="#include <sched.h>\n",
            core__granular__formats__dump__read__r_dot_cpp='#include "granular/formats/dump/grammar/f.h"\n'
            '#include "granular/formats/dump/write/w.h"\n#include "r.h"\n',
            core__granular__dump__d_dot_cpp='#include "granular/common/c.h"\n',
            core__granular__formats__euler__e_dot_cpp='#include "granular/frames/f.h"\n#include <mpi.h>\n',
            core__granular__formats__restart__r_dot_cpp='#include "granular/formats/local/b.h"\n',
            core__bonds__b_dot_cpp='#include "granular/formats/restart/r.h"\n#include "granular/mpi/m.h"\n',
            core__bonds__granular_bonds_dot_h="#include <stdint.h>\n#include <vector>\n",
            core__granular__mpi__m_dot_cpp='#include <mpi.h>\n#include "granular/bytes/b.h"\n'
            '#include "granular/frames/d.h"\n'), [
                "core/bonds/b.cpp:2", "core/bonds/granular_bonds.h:2",
                "core/granular/bytes/a.h:3", "core/granular/bytes/a.h:5", "core/granular/bytes/a.h:6",
                "core/granular/bytes/byte_source.cpp:1", "core/granular/bytes/byte_source_zstd.cpp:2",
                "core/granular/bytes/byte_source_zstd.h:1", "core/granular/bytes/calls_posix.cpp:3",
                "core/granular/bytes/calls_windows.cpp:2", "core/granular/bytes/compression.cpp:2",
                "core/granular/bytes/inflate.cpp:2", "core/granular/dump/d.cpp:1",
                "core/granular/formats/dump/read/r.cpp:2", "core/granular/formats/dump/read/r.cpp:3",
                "core/granular/formats/euler/e.cpp:2",
                "core/granular/formats/restart/r.cpp:1", "core/granular/mpi/m.cpp:3",
                "core/granular/parallel/executor.cpp:1"])

    def test_rooms(self):
        files = {f"core__granular__text__a{i}_dot_h": "" for i in range(layering.MOST_FILES)}
        self.assertEqual(found(layering.check, **files), [])
        self.assertEqual(found(layering.check, **files, core__granular__text__b_dot_h=""),
                         ["core/granular/text:0"])
        above = []
        for room, may_use in layering.ROOMS.items():
            self.assertLessEqual(set(may_use), set(above), room)  # so there is no cycle
            above.append(room)

    def test_vtk_header(self):
        self.assertEqual(found(
            layering.check,
            plugin__vtk__vtkGranularA_dot_h=
            '#include "vtkGranularModule.h" // for the export macro\n'
            '#include "vtkPolyDataAlgorithm.h"\n'
            '#include <string> // for std::string\n#include <vector>\n'
            '#include "granular/common/a.h"\n#include <mpi.h>\n#include "vtkNew.h" // for vtkNew\n'
            'class VTKGRANULAR_EXPORT vtkGranularA : public vtkPolyDataAlgorithm\n{\n};\n'), [
                f"plugin/vtk/vtkGranularA.h:{line}" for line in (4, 5, 6, 7)])

    def test_vtk_source(self):
        self.assertEqual(found(
            layering.check,
            plugin__vtk__a_dot_cxx='#include "granular/common/a.h"\n#include "vtkNew.h"\n'
            '#include "private/request/guard.h"\n#include <string>\n#include "vtkSMProxy.h"\n'
            '#include "vtkPVSession.h"\n#include <QWidget>\n#include "pqApplicationCore.h"\n'
            '#include <mpi.h>\n#include "vtkSMPTools.h"\n#include "granular/mpi/m.h"\n',
            plugin__vtk__private__request__mpi_glue_dot_h='#include <mpi.h>\n#include "granular/mpi/m.h"\n',
            plugin__vtk__private__dump__d_dot_h='#include "private/request/r.h"\n#include "private/dump/e.h"\n'
            '#include "private/euler/e.h"\n',
            plugin__vtk__private__p_dot_h='#include <vector>\n'), [
                f"plugin/vtk/a.cxx:{line}" for line in (11, 5, 6, 7, 8, 9)] + [
                    "plugin/vtk/private/dump/d.h:3", "plugin/vtk/private/p.h:1"])

    def test_paraview(self):
        self.assertEqual(found(
            layering.check,
            plugin__views__vtkGranularA_dot_cxx='#include "granular/common/a.h"\n'
            '#include "vtkPVView.h"\n',
            plugin__servermanager__vtkSMA_dot_h='#include "vtkSMSourceProxy.h"\n#include <string>\n'
            '#include "granular/common/a.h"\n#include "vtkGranularA.h"\n#include <QWidget>\n'
            '#include "pqCore.h"\n#include <mpi.h>\n'), [
                f"plugin/servermanager/vtkSMA.h:{line}" for line in (3, 5, 6, 7)] + [
                    "plugin/views/vtkGranularA.cxx:1"])

    def test_arrays(self):
        self.assertEqual(found(
            layering.check,
            core__python__vtkgranular___a_dot_py="import os\nimport numpy\nfrom . import b\n\ndef f():\n    import numpy\n"
            "    from vtkmodules.x import y\n    from paraview import simple\n    import scipy\n"), [
                f"core/python/vtkgranular/_a.py:{line}" for line in (2, 8, 9)])

    def test_sample(self):
        self.assertEqual(found(
            layering.check,
            samples__01_a_dot_py="import os\nfrom paraview.simple import *\nimport vtkgranular as vg\n"
            "from paraview import servermanager\nimport support\nfrom . import x\n"
            "from paraview import simple\n"), [
                f"samples/01_a.py:{line}" for line in (4, 5, 6)])


class Messages(unittest.TestCase):
    def test_texts(self):
        self.assertEqual(found(
            messages.check,
            core__granular__common__a_dot_cpp=
            'void f()\n{\n'
            '  throw FormatError("expected a number, got " + x, where);\n'
            '  throw FormatError("Expected a number", where);\n'
            '  throw granular::IoError("cannot read.", { "Path." });\n'
            '  throw LimitError("ITEM: ATOMS expected");\n'
            '  throw LimitError(std::string("Too many ") + n + " rows");\n'
            '  throw Error(text + " ends.");\n'
            '  throw Error("path \'" + path + "\' is not...");\n'
            '  // throw Error("Not code.");\n'
            '  throw UnsupportedError(\n    "a"\n    "b.");\n'
            '}\n'), [
                f"core/granular/common/a.cpp:{line}" for line in (13, 4, 5, 7, 8)])


class Sizes(unittest.TestCase):
    CODE = """
#define BRACE {
namespace a::b
{
struct S { int x{ 3 }; int y() const { return x; } };
enum class E : int { One };
const int table[] = { 1, 2 };
template <class T>
auto f(T t) -> std::vector<int>
{
  auto g = [&](int i) { return i; };
  if (t) { return { 1 }; }
}
class C : public S
{
public:
  C(int n) noexcept
    : S{ n }
    , x_(n), y_{ 1, 2 }
  {
    run();
  }
  ~C() override {}
  bool operator()(int i) const { return true; }
  C& operator=(const C&) = default;
  int later(int = 3);
private:
  std::function<int(int)> callback_ = [](int i) { return i; };
};
const auto lambda = [](int i)
{
  return i;
};
extern "C" { int c(void) { return 1'0; } }
template <class T = int, class U = std::vector<int>>
inline T g() { return 0; }
int h(int n = 1, C c = {})
{
}
}
"""

    def test_functions_are_found(self):
        self.assertEqual(
            [(name, last - first + 1) for name, first, last in sizes.functions(self.CODE)],
            [("y", 1), ("f", 6), ("C", 6), ("~C", 1), ("operator()", 1), ("callback_", 1),
             ("lambda", 4), ("c", 1), ("g", 2), ("h", 3)])

    def test_budgets(self):
        def function(lines):
            return "void f()\n{\n" + "  g();\n" * (lines - 3) + "}\n"
        self.assertEqual(found(
            sizes.check,
            core__granular__a_dot_cpp=SPDX + function(80) + function(81),
            core__granular__b_dot_cpp="\n" * 401,
            core__granular__c_dot_h="\n" * 201,
            plugin__vtk__a_dot_cxx=function(100) + function(101),
            plugin__vtk__b_dot_cxx="\n" * 601,
            tests__base__a_dot_cpp="\n" * 2000), [
                "core/granular/a.cpp:82", "core/granular/b.cpp:401", "core/granular/c.h:201",
                "plugin/vtk/a.cxx:101", "plugin/vtk/b.cxx:601"])


class Style(unittest.TestCase):
    def test_text(self):
        self.assertEqual(found(
            style.check,
            core__a_dot_h=SPDX + "int a; \n\tint b;\n// caf\u00e9\nint c;\r\n// TO" "DO\nint d;",
            tests__data__bad_dot_dump="x \r\n",
            README_dot_md="no licence needed\n",
            build__x_dot_h="\t"), [f"core/a.h:{line}" for line in (2, 3, 4, 5, 6, 7)])

    def test_licence(self):
        self.assertEqual(found(
            style.check, core__a_dot_h="int a;\n", run="#!/bin/bash\n", CMakeLists_dot_txt="x()\n",
            xml__a_dot_xml="<a/>\n", LICENSE="text\n", core__b_dot_cpp=SPDX),
            ["CMakeLists.txt:1", "core/a.h:1", "run:1", "xml/a.xml:1"])

    def test_banned(self):
        self.assertEqual(found(
            style.check,
            core__a_dot_cpp=SPDX + 'void f()\n{\n  std::cout << 1;\n  printf("x");\n'
            '  std::snprintf(b, 1, "x");\n  // std::cerr\n  x = atof("1");\n  y = std::stod(s);\n'
            '  log("printf(");\n  std::abort();\n  self.exit();\n}\n',
            plugin__vtk__a_dot_cxx=SPDX + "int f()\n{\n  std::fprintf(stderr, s);\n}\n",
            tests__a_dot_cpp=SPDX + "int f() { printf(s); }\n"), [
                "core/a.cpp:11", "core/a.cpp:4", "core/a.cpp:5", "core/a.cpp:8", "core/a.cpp:9",
                "plugin/vtk/a.cxx:4"])

    def test_scripts(self):
        text = '# SPDX-License-Identifier: BSD-3-Clause\nc.ApplyPreset("Plasma")\nc.ApplyPreset(vg.preset("Plasma"))\nLoadPalette("White")\n'
        self.assertEqual(found(style.check, samples__a_dot_py=text, tests__a_dot_py=text), ["samples/a.py:2", "samples/a.py:4"])

    def test_openings(self):
        text = SPDX + "\n/// Whether it is.\nint a;\n\n/// Returns it.\n/// Where it is not, 0.\nint b;\n\n/**\n * What it does.\n */\nint c;\n"
        self.assertEqual(found(style.check, core__a_dot_h=text, tests__a_dot_h=text), ["core/a.h:11", "core/a.h:3"])


class TypeNames(unittest.TestCase):
    def test_two_of_a_name(self):
        self.assertEqual(found(
            type_names.check,
            core__granular__common__a_dot_h=
            "namespace granular\n{\nstruct Rows\n{\n  struct Part { int a; };\n};\nclass Ahead;\n"
            "template <class T>\nclass Box final : public Base<T> { };\nusing Names = int;\n}\n",
            core__granular__dump__b_dot_h=
            "// struct Rows { };\nnamespace granular\n{\nstruct Part { };\nclass Ahead { };\n"
            "enum class Names : int { One };\ntemplate <>\nclass Box<int> { };\n}\n",
            core__granular__dump__c_dot_cpp=
            "namespace granular\n{\nnamespace\n{\nstruct Rows { };\n}\nusing Part = int;\n"
            "int f()\n{\n  struct Rows { };\n}\nstruct\nRows { };\nstruct alignas(8) Rows::Part { };\n}\n",
            plugin__vtk__d_dot_cxx="namespace granular { template <class T> struct Box { }; }\n"
            "namespace other { struct Rows { }; }\nstruct Rows { };\n",
            tests__e_dot_cpp="namespace granular { struct Rows { }; }\n"), [
                "core/granular/dump/b.h:6", "core/granular/dump/c.cpp:12",
                "core/granular/dump/c.cpp:14", "plugin/vtk/d.cxx:1"])


class ServerManager(unittest.TestCase):
    HEADER = """
class vtkGranularA : public vtkPolyDataAlgorithm
{
  void AddFileName(const char* name);
  // void Commented();
  vtkSetMacro(Size, int);
  vtkBooleanMacro(Sort, bool);
};
"""
    DOCUMENTATION = "<Documentation>Twenty letters or more.</Documentation>"

    def xml(self, body, hint="", class_name="vtkGranularA"):
        return ('<ServerManagerConfiguration><ProxyGroup name="sources">\n'
                f'<SourceProxy name="A" class="{class_name}">{self.DOCUMENTATION}\n{body}\n'
                f'<Hints>{hint}</Hints>\n</SourceProxy></ProxyGroup></ServerManagerConfiguration>\n')

    def property(self, attributes, inside=None):
        inside = self.DOCUMENTATION if inside is None else inside
        return f"<IntVectorProperty {attributes}>{inside}</IntVectorProperty>"

    def check(self, **files):
        return found(server_manager.check, plugin__vtk__vtkGranularA_dot_h=self.HEADER, **files)

    def test_commands(self):
        body = "\n".join(self.property(attributes) for attributes in (
            'name="a" command="AddFileName"', 'name="b" command="SetSize"',
            'name="c" command="SortOn"', 'name="d" command="SetInputConnection"',
            'name="e" command="Commented"', 'name="f" command="AddFileName" clean_command="Clear"',
            'name="g" information_property="h"', 'name="i" information_property="a"',
            'name="j" command="OfTheBase" override="1"'))
        self.assertEqual(self.check(xml__a_dot_xml=self.xml(body)),
                         ["xml/a.xml:7", "xml/a.xml:8", "xml/a.xml:9"])

    def test_attributes_left_out(self):
        body = "\n".join(self.property(attributes) for attributes in (
            'name="Size" default_values="1"', 'name="None" default_values="1"', 'name="None" default_values="1" command="SetSize"',
            'name="None" default_values="1" number_of_elements="1"'))
        self.assertEqual(self.check(xml__a_dot_xml=self.xml(body)), ["xml/a.xml:4"])
        made = reader_options.complete('<ProxyGroup name="sources"><DoubleVectorProperty name="A" default_values="1 -1"/></ProxyGroup>'
                                       '<ProxyGroup name="writers"><StringVectorProperty name="B" default_values=""/></ProxyGroup>')
        self.assertIn('name="A" number_of_elements="2" command="SetA" animateable="0" default_values="1 -1"/>', made)
        self.assertIn('name="B" number_of_elements="1" command="SetB" default_values=""/>', made)

    def test_documentation_and_label(self):
        body = "\n".join((self.property('name="a"', "<Documentation>  short  </Documentation>"),
                          self.property('name="b"', ""), self.property('name="c" label="C"'),
                          self.property('name="d"')))
        self.assertEqual(self.check(xml__a_dot_xml=self.xml(body)),
                         ["xml/a.xml:3", "xml/a.xml:4", "xml/a.xml:5"])

    def test_names_of_times(self):
        body = "\n".join(self.property(f'name="{name}"') for name in (
            'TimeRange', 'TimestepValues" information_only="1', 'TimeWindow', 'TimestepValues'))
        self.assertEqual(self.check(xml__a_dot_xml=self.xml(body)), ["xml/a.xml:3", "xml/a.xml:6"])

    def test_times(self):
        size, other = (self.property(f'name="{name}"') for name in ("TimestepSize", "b"))
        group = '<PropertyGroup label="{}"><Property name="TimestepSize"/></PropertyGroup>'
        for body, wanted in ((f"{size}\n{group.format('a timestep')}\n{other}", []), (other, []), (size, ["xml/a.xml:2"]),
                             (f"{size}\n{group.format('a')}", ["xml/a.xml:2"]),
                             (f"{other}\n{size}\n{group.format('a timestep')}", ["xml/a.xml:2"])):
            self.assertEqual(self.check(xml__a_dot_xml=self.xml(body)), wanted)

    def test_bases(self):
        base = ('<ServerManagerConfiguration><ProxyGroup name="internal_sources"><Proxy name="B">\n' +
                self.property('name="TimestepSize" command="SetSize"') + "\n" + self.property('name="b" command="SetNone"') +
                '\n<PropertyGroup label="a timestep"><Property name="TimestepSize"/></PropertyGroup>'
                "</Proxy></ProxyGroup></ServerManagerConfiguration>\n")
        own = self.xml(self.property('name="c" information_property="b"')).replace(' class=', ' base_proxyname="B" class=')
        self.assertEqual(self.check(xml__z_dot_xml=base, xml__a_dot_xml=own), ["xml/z.xml:3"])

    def test_shared_parts(self):
        part = self.property('name="@Of@s" command="Set@of@"') + "\n" + self.property('name="b" command="SetSize"', "@inside@")
        own = self.xml(f'<Shared name="P" of="Size">\n{self.DOCUMENTATION}\n</Shared>\n' + self.property('name="c" command="SetNone"'))
        self.assertEqual(self.check(xml__a_dot_xml=own, xml__shared__P_dot_xml=part), ["xml/a.xml:3", "xml/a.xml:6"])

    def test_names_of_state_files(self):
        own = self.xml(self.property('name="Size" command="SetSize"'))
        self.assertEqual(self.check(xml__a_dot_xml=own, tests__lint__property_names_dot_txt="A: Size\nA: Size Gone\nB:\n"),
                         ["tests/lint/property_names.txt:2", "tests/lint/property_names.txt:3"])

    def test_element(self):
        text = self.xml("").replace("SourceProxy", "GranularAProxy")
        self.assertEqual(self.check(xml__a_dot_xml=text), ["xml/a.xml:2"])
        self.assertEqual(self.check(xml__a_dot_xml=text,
                                    plugin__servermanager__vtkSMGranularAProxy_dot_h=""), [])

    def test_extensions_and_class(self):
        reader = '<ReaderFactory extensions="dump lammpstrj"/>'
        other = self.xml("", '<ReaderFactory extensions="x DUMP"/><WriterFactory extensions="dump"/>')
        self.assertEqual(self.check(xml__a_dot_xml=self.xml("", reader),
                                    xml__b_dot_xml=other.replace('name="A"', 'name="B"'),
                                    xml__c_dot_xml=self.xml("", class_name="vtkGranularB"),
                                    xml__d_dot_xml="<a>\n<b></a>"),
                         ["xml/b.xml:4", "xml/c.xml:2", "xml/d.xml:2"])

    def test_readers_that_look_into_files_share_extensions(self):
        reader = self.xml("", '<ReaderFactory extensions="vtk"/>')
        shared = {"xml__a_dot_xml": reader, "xml__b_dot_xml": reader.replace('name="A"', 'name="B"')}
        self.assertEqual(self.check(**shared), ["xml/b.xml:4"])
        looks = self.HEADER.replace("};", "  static int CanReadFile(const char* name);\n};")
        self.assertEqual(found(server_manager.check, plugin__vtk__vtkGranularA_dot_h=looks, **shared), [])


class Portable(unittest.TestCase):
    def test_what_it_lacks_is_named_in_the_list_and_in_the_guide(self):
        xml = ('<ServerManagerConfiguration><ProxyGroup name="filters">\n<SourceProxy name="A">\n'
               '<IntVectorProperty name="Known" command="SetKnown"/>\n<IntVectorProperty name="New" command="SetNew"/>\n'
               '<IntVectorProperty name="Said"/></SourceProxy>\n<SourceProxy name="B"/></ProxyGroup></ServerManagerConfiguration>')
        self.assertEqual(found(portable.check, **{
            "xml/a.xml": xml, portable.OPTIONS: tree.read(Options.ROOT, portable.OPTIONS), portable.GUIDE: "`Said` is missing.",
            portable.LIST: 'PROPERTIES = (\n"Said",\n"Known", "Gone")\nPROXIES = ("Unsaid",)\n',
            portable.FOLDER + "a.py": "class A(Filter):\n    x = \"Known\"\n"}), [
                portable.LIST + ":3", portable.LIST + ":4", "xml/a.xml:4", "xml/a.xml:6"])


class Options(unittest.TestCase):
    ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
    PRETEND = """
[[option]]
name = "pretend_size"
property = "PretendSize"
of = "files"
type = "count"
minimum = 3
default = 7
text = "a size that there is not"
page = "A size that there is not. At least 3; default 7."
"""

    def test_a_pretend_option_in_one_place_is_everywhere(self):
        with tempfile.TemporaryDirectory() as root:
            for folder in ("core", "xml", "cmake"):
                shutil.copytree(os.path.join(self.ROOT, folder), os.path.join(root, folder))
            self.assertEqual(list(options.check(root)), [])
            with open(os.path.join(root, reader_options.TABLE), "a", encoding="utf-8") as table:
                table.write(self.PRETEND)
            self.assertEqual(len(list(options.check(root))), 4)
            made = reader_options.made(root)
            for name, text in made.items():
                with open(os.path.join(root, name), "w", encoding="utf-8") as stream:
                    stream.write(text)
            shared = reader_options.expand(root, '<Shared name="PretendSize"/>')
            self.assertIn('<IntRangeDomain name="range" min="3"/>', shared)
            self.assertIn("A size that there is not. At least 3; default 7.", shared)
            for path, expected in (
                    ("core/c/granular.h", "/* a size that there is not */\n  int64_t pretend_size;"),
                    ("core/c/granular_c.cpp", "options->pretend_size = 7;"),
                    ("core/c/run.cpp", 'made.pretend_size = at_least(3, given.pretend_size, "pretend_size");'),
                    ("core/python/vtkgranular/_run.py", "pretend_size: int = 7"),
                    ("core/python/vtkgranular/_run.py", "    pretend_size    a size that there is not\n")):
                self.assertIn(expected, made[path])
            package = os.path.join(root, "core", "python")
            shutil.copy(os.path.join(package, "vtkgranular", "_folders.py.in"), os.path.join(package, "vtkgranular", "_folders.py"))
            reader_options.main(root, "python", os.path.join(package, "vtkgranular", "_options.py"))
            tell = ("import argparse, inspect, vtkgranular; from vtkgranular.command import add_reading; parser = argparse.ArgumentParser(); "
                    "add_reading(parser); print(inspect.signature(vtkgranular.open)); print(vtkgranular.open.__doc__); print(parser.format_help())")
            said = subprocess.run([sys.executable, "-c", tell], env={**os.environ, "PYTHONPATH": package}, capture_output=True, text=True)
            self.assertEqual(said.stderr, "")
            self.assertIn("pretend_size: 'int' = 7", said.stdout)
            self.assertRegex(said.stdout, r"--pretend-size N\s+a size that there is not")


if __name__ == "__main__":
    unittest.main()
