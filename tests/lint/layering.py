# SPDX-License-Identifier: BSD-3-Clause
"""Who may include whom.

    core/granular/ROOM     its own folder, the rooms that ROOMS says, the C++ standard library; the
                           system only where SYSTEM_HEADERS says so; no more files than MOST_FILES
    core/granular/mpi      the same, and mpi.h; no other room may include it
    core/c, core/bonds     its own folder, granular/ but for mpi, the C++ standard library; granular.h and granular_bonds.h: C's alone
    core/granular/granular.h  any header of any room but mpi
    plugin/vtk/**.h        the superclass, the export macro, and <std> with the reason behind it
    plugin/vtk/*.cxx, private/   granular/ and VTK, but nothing of Qt or of ParaView; MPI in private/,
                           whose rooms include each other as PRIVATE_ROOMS says
    plugin/servermanager   VTK, our VTK classes, ParaView's server manager, but no core and no Qt
    plugin/views           VTK, ParaView's views, but no core and no Qt
    core/python            Python's own modules; numpy, pandas and VTK in functions, so that who imports it needs none of them;
                           PyVista in the module that it imports itself
    samples                paraview.simple, vtkgranular, numpy and Python's own modules
"""
import ast
import os
import re
import sys

import tree

STANDARD = set("""
    algorithm any array atomic barrier bit bitset charconv chrono codecvt compare complex concepts
    condition_variable coroutine deque exception execution filesystem format forward_list fstream
    functional future initializer_list iomanip ios iosfwd iostream istream iterator latch limits
    list locale map memory memory_resource mutex new numbers numeric optional ostream queue random
    ranges ratio regex scoped_allocator semaphore set shared_mutex source_location span sstream
    stack stdexcept stop_token streambuf string string_view strstream syncstream system_error
    thread tuple type_traits typeindex typeinfo unordered_map unordered_set utility valarray
    variant vector version
    cassert cctype cerrno cfenv cfloat cinttypes climits clocale cmath csetjmp csignal cstdarg
    cstddef cstdint cstdio cstdlib cstring ctime cuchar cwchar cwctype""".split())

# Headers that are neither ours nor of the C++ standard library, and the files that may have them.
SYSTEM_HEADERS = (
    (r"(fcntl|glob|sched|unistd|sys/\w+)\.h", r"core/granular/.*_posix\.cpp"),
    (r"(fcntl|io|malloc|process|windows)\.h", r"core/granular/.*_windows\.cpp"),
    (r"zlib\.h", r"core/granular/bytes/(byte_source_gzip|compression|inflate)\.cpp"),
    (r"isa-l/\w+\.h", r"core/granular/bytes/inflate\.cpp"),
    (r"(zstd|zstd_errors)\.h", r"core/granular/bytes/(byte_source_zstd|compression)\.cpp"),
    (r"immintrin\.h", r"core/granular/(common/(intrinsics\.h|fma_windows\.cpp)|text/line_scan\.cpp)"),
    (r"mpi\.h", r"core/granular/mpi/.*"),
)

# The rooms below core/granular/, and which others each may include: those above it in this list alone.
ROOMS = {room: words.split() for room, words in (
    ("common", ""),
    ("columns", "common"),
    ("numbers", "common"),
    ("memory", "common"),
    ("bytes", "common memory"),
    ("geometry", "common columns"),
    ("parallel", "common bytes"),
    ("text", "common numbers bytes parallel"),
    ("mpi", "common bytes parallel"),
    ("frames", "common columns numbers bytes geometry parallel text"),
    ("particles", "common columns numbers memory geometry parallel frames"),
    ("sorting", "common memory parallel particles"),
    ("writing", "common bytes parallel frames"),
    ("lines", "common columns numbers bytes memory geometry parallel frames particles"),
    ("grid", "common numbers bytes memory geometry parallel frames particles"),
    ("formats/dump/grammar", "common numbers bytes text frames"),
    ("formats/dump/read", "common columns numbers bytes memory geometry parallel text frames particles sorting "
                          "formats/dump/grammar"),
    ("formats/dump/write", "common numbers bytes geometry parallel frames particles sorting writing"),
    ("formats/vtk_files", "common numbers bytes geometry frames"),
    ("formats/local", "common columns numbers bytes memory geometry parallel text frames particles lines "
                      "formats/dump/grammar formats/dump/read"),
    ("formats/data_file", "common columns numbers bytes memory geometry parallel text frames particles sorting lines "
                          "formats/dump/read"),
    ("formats/grid_dump", "common bytes geometry frames particles grid formats/dump/grammar formats/dump/read"),
    ("formats/restart", "common numbers bytes memory geometry parallel frames particles lines"),
    ("formats/euler", "common numbers bytes memory geometry parallel frames particles grid formats/vtk_files"),
    ("formats/decomposition", "common numbers bytes memory geometry parallel frames particles grid formats/vtk_files"),
    ("runs", "common columns bytes memory geometry parallel frames particles lines grid formats/dump/grammar formats/dump/read "
             "formats/local formats/data_file formats/restart formats/euler formats/decomposition formats/grid_dump"),
    ("subdomains", "common numbers memory geometry parallel frames particles grid"),
    ("packing", "common memory geometry parallel particles"),
    ("contacts", "common numbers memory geometry parallel frames particles sorting grid lines"),
    ("averages", "common numbers memory geometry parallel frames particles sorting lines grid contacts"),
    ("paths", "common columns numbers memory geometry parallel frames particles sorting lines grid averages formats/dump/read"),
)}
MOST_FILES = 40

# The rooms below plugin/vtk/private/, and which others each may include.
PRIVATE_ROOMS = {room: words.split() for room, words in (
    ("request", ""),
    ("arrays", ""),
    ("dump", "request arrays"),
    ("local", "request arrays dump"),
    ("decomposition", "request arrays dump"),
    ("paths", "request arrays dump local"),
    ("contacts", "request arrays dump local"),
    ("euler", "request arrays dump contacts"),
    ("writing", "request dump"),
    ("readers", "request arrays dump local"),
)}

C_HEADERS = ("core/c/granular.h", "core/c/granular_filters.h", "core/bonds/granular_bonds.h")
SAMPLE_MODULES = ("paraview.simple", "vtkgranular", "numpy")
LATER_MODULES = ("vtkgranular", "numpy", "pandas", "vtkmodules")
PYVISTA = ("core/python/vtkgranular/_pyvista.py", "pyvista")  # which PyVista alone imports

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]([^\n]*)', re.MULTILINE)


def includes(text):
    """(line, bracket, name, rest of the line) of every include that is not commented out."""
    code = tree.strip(text, strings=False)
    return [(tree.line_of(text, match.start()), match.group(1), match.group(2),
             text[match.end(2) + 1:match.end()])
            for match in _INCLUDE.finditer(code)]


def core_complaint(path, bracket, name):
    if bracket == "<":
        if name in STANDARD:
            return None
        owners = [files for headers, files in SYSTEM_HEADERS if re.fullmatch(headers, name)]
        if any(re.fullmatch(files, path) for files in owners):
            return None
        if owners:
            return f"<{name}> is not for this file (see SYSTEM_HEADERS in tests/lint/layering.py)"
        return f"<{name}> is not a header of the C++ standard library"
    own = room_of(path)
    if path == "core/granular/granular.h":
        rooms = [room for room in ROOMS if room != "mpi"]
    elif own is None:
        return "is in no room of the core (see ROOMS in tests/lint/layering.py)"
    else:
        rooms = ROOMS[own] + [own]
    allowed = [f"granular/{room}/" for room in rooms]
    if name.startswith(tuple(allowed)):
        return None
    return f'"{name}": only {" ".join(allowed)} may be included here, by their whole path'


def room_of(path):
    """The room of a file of the core, or None."""
    folder = path.removeprefix("core/granular/").rpartition("/")[0]
    return folder if folder in ROOMS else None


def check_rooms(root):
    """A room that a newcomer can still look over."""
    rooms = [room_of(path) for path in tree.files(root) if path.startswith("core/granular/")]
    for room in ROOMS:
        if rooms.count(room) > MOST_FILES:
            yield (f"core/granular/{room}", 0,
                   f"expected at most {MOST_FILES} files in a room, got {rooms.count(room)}")


def check_core(root, path):
    for line, bracket, name, _ in includes(tree.read(root, path)):
        text = core_complaint(path, bracket, name)
        if text:
            yield path, line, text


def check_c(root, path):
    """The C interfaces stand on the core."""
    folder = os.path.dirname(path)
    for line, bracket, name, _ in includes(tree.read(root, path)):
        allowed = {"stddef.h", "stdint.h"} if path in C_HEADERS else STANDARD
        own = bracket == '"' and os.path.exists(os.path.join(root, folder, name))
        if not (own or (bracket == "<" and name in allowed) or
                (name.startswith("granular/") and not name.startswith("granular/mpi/"))):
            yield path, line, f"{name}: {folder} stands on its own folder, granular/ and the standard library"


def check_vtk_header(root, path):
    text = tree.read(root, path)
    code = tree.strip(text)
    superclasses = re.findall(r"\bclass\b[^;{]*:\s*public\s+(\w+)", code)
    allowed = {name + ".h" for name in superclasses} | {"vtkGranularModule.h"}
    for line, bracket, name, rest in includes(text):
        if bracket == "<" and name in STANDARD:
            if not re.search(r"//\s*for \w|//\s*\S+ for \w", rest, re.IGNORECASE):
                yield path, line, f"<{name}>: say what for, as in '#include <{name}> // for ...'"
        elif name not in allowed:
            yield path, line, (f"{name}: a public VTK header includes its superclass, "
                               "vtkGranularModule.h and the standard library only")


def check_vtk_source(root, path):
    private = path.startswith("plugin/vtk/private/")
    own = path.split("/")[3] if private else None
    for line, bracket, name, _ in includes(tree.read(root, path)):
        room = name.split("/")[1] if name.startswith("private/") else own
        if private and own not in PRIVATE_ROOMS:
            yield path, line, "is in no room of private/ (see PRIVATE_ROOMS in tests/lint/layering.py)"
            continue
        if private and room not in PRIVATE_ROOMS[own] + [own]:
            yield path, line, (f'"{name}": only {" ".join(PRIVATE_ROOMS[own] + [own])} of private/ may be '
                               "included here")
            continue
        if name.startswith("granular/mpi/") and not private:
            yield path, line, f"{name}: MPI is known in plugin/vtk/private/ only"
        elif name.startswith("granular/") or (bracket == "<" and name in STANDARD):
            continue
        # vtkSMPTools and its kin are of VTK.
        if re.match(r"vtk(PV|SI|SMPV|SM(?!P[A-Z]))[A-Z]", name):
            yield path, line, f"{name} is of ParaView: the VTK layer stands on VTK alone"
        elif re.match(r"(pq[A-Z]|Q[A-Z]|Qt)", name):
            yield path, line, f"{name} is of a user interface: the VTK layer stands on VTK alone"
        elif bracket == "<" and not re.match(r"vtk_", name):
            if not (private and name == "mpi.h"):
                yield path, line, f"<{name}> is neither of VTK nor of the C++ standard library"


def check_paraview(root, path):
    for line, bracket, name, _ in includes(tree.read(root, path)):
        if bracket == "<" and name in STANDARD:
            continue
        if not re.match(r"vtk\w+\.h$", name):
            yield path, line, (f"{name}: ParaView's side stands on VTK's classes, ParaView's and ours, "
                               "and on the standard library")


def imported(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        if node.module == "paraview":
            return ["paraview." + alias.name for alias in node.names]
        return ["." * node.level + (node.module or "")]
    return []


def check_sample(root, path):
    nodes = list(ast.walk(ast.parse(tree.read(root, path), path)))
    for_paraview = any(name.split(".")[0] == "paraview" for node in nodes for name in imported(node))
    for node in nodes:
        for name in imported(node):
            if name in SAMPLE_MODULES or name.split(".")[0] in sys.stdlib_module_names:
                continue
            if name.split(".")[0] == "vtkmodules" and not for_paraview:
                continue  # a sample for those who have VTK alone
            if not name.startswith("vtkgranular."):
                yield path, node.lineno, (f"{name}: a sample imports {' and '.join(SAMPLE_MODULES)} "
                                          "and Python's own modules only")


def check_arrays(root, path):
    """The part of the package that does without VTK."""
    parsed = ast.parse(tree.read(root, path), path)
    at_once = [node for node in parsed.body if isinstance(node, (ast.Import, ast.ImportFrom))]
    for node in ast.walk(parsed):
        for name in imported(node):
            first = name.split(".")[0]
            if first in ("", "__future__", *sys.stdlib_module_names):
                continue
            if (path, first) == PYVISTA:
                continue
            if first not in LATER_MODULES:
                yield path, node.lineno, f"{name}: core/python imports {', '.join(LATER_MODULES)} and Python's own modules only"
            elif node in at_once:
                yield path, node.lineno, f"{name}: imported in the functions that need it, for those who do not have it"


def check(root):
    yield from check_rooms(root)
    for path in tree.files(root):
        if re.match(r"core/(granular|mpi)/.*\.(h|cpp|inc)$", path):
            yield from check_core(root, path)
        elif re.match(r"core/(c|bonds)/.*\.(h|cpp)$", path):
            yield from check_c(root, path)
        elif re.match(r"plugin/vtk/(?!private/).+\.h$", path):
            yield from check_vtk_header(root, path)
        elif re.match(r"plugin/vtk/.*\.(h|cxx|txx)$", path):
            yield from check_vtk_source(root, path)
        elif re.match(r"plugin/(servermanager|views)/.*\.(h|cxx|txx)$", path):
            yield from check_paraview(root, path)
        elif re.match(r"core/python/.*\.py$", path):
            yield from check_arrays(root, path)
        elif re.match(r"samples/[^/]+\.py$", path):
            yield from check_sample(root, path)


if __name__ == "__main__":
    tree.run(check)
