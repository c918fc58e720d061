# SPDX-License-Identifier: BSD-3-Clause
"""Writes table.md and missed.txt of tests/fuzz/run. Arguments: the folder of the core, and the folder
of the inputs with `log` (a line for each process: target, processor seconds, runs, new paths, those in the last
tenth of the time) and `lines` (what llvm-cov counted, in the format of lcov)."""
import collections
import os
import re
import sys

# The code that reads what others wrote, by room, and the files there that make something else of it.
READING = (
    ("bytes", r"granular/bytes/", "byte_sink|locked_file"),
    ("text", r"granular/text/", None),
    ("numbers", r"granular/numbers/", None),
    ("frames", r"granular/frames/", None),
    ("dump/grammar", r"granular/formats/dump/grammar/", None),
    ("dump/read", r"granular/formats/dump/read/", None),
    ("lines", r"granular/lines/", "fetch_particles|id_finder|join"),
    ("local", r"granular/formats/local/", None),
    ("euler", r"granular/formats/euler/", "cell_blocks"),
    ("decomposition", r"granular/formats/decomposition/", None),
    ("restart", r"granular/formats/restart/", None),
    ("data_file", r"granular/formats/data_file/", None),
    ("vtk_files", r"granular/formats/vtk_files/", None),
    ("bonds", r"bonds/", "particles"),
    ("c", r"c/", "writer|granular_c_writing"),
)


def read_lines(path, core):
    """Returns {file below the core: {line: times}}."""
    counts = collections.defaultdict(dict)
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            key, _, rest = line.rstrip("\n").partition(":")
            if key == "SF":
                name = os.path.relpath(rest, core)
            elif key == "DA":
                number, times = rest.split(",")[:2]
                counts[name][int(number)] = counts[name].get(int(number), 0) + int(times)
    return counts


def ranges(numbers):
    """[3, 4, 5, 9] as '3-5 9'."""
    parts = []
    for number in numbers:
        if parts and parts[-1][1] == number - 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    return " ".join(f"{a}-{b}" if a < b else str(a) for a, b in parts)


def room_rows(counts, missed):
    """Yields a row a room; adds the lines that are not reached to `missed`."""
    for room, pattern, others in READING:
        reached = total = 0
        for name, lines in sorted(counts.items()):
            stem = os.path.splitext(os.path.basename(name))[0]
            if not re.match(pattern, name) or (others and re.fullmatch(others, stem)):
                continue
            none = sorted(line for line, times in lines.items() if times == 0)
            total += len(lines)
            reached += len(lines) - len(none)
            if none:
                missed.append(f"{name}: {ranges(none)}")
        yield room, total, reached


def target_rows(folder):
    """Yields a row a target: the sum of all processes so far."""
    processes = collections.defaultdict(list)
    if os.path.exists(os.path.join(folder, "log")):
        with open(os.path.join(folder, "log"), encoding="utf-8") as stream:
            for line in stream:
                name, *numbers = line.split()
                processes[name].append([int(number) for number in numbers])
    for name in sorted(os.listdir(os.path.join(folder, "seeds"))):
        def files(kind):
            path = os.path.join(folder, kind, name)
            return len(os.listdir(path)) if os.path.isdir(path) else 0
        rows = processes[name]
        seconds, runs, paths = (sum(row[i] for row in rows) for i in range(3))
        yield (name, f"{seconds / 60:.0f}", f"{runs:,}", f"{paths:,}", rows[-1][3] if rows else "",
               files("found"), files("findings"))


def table(head, rows):
    lines = [head, ("---",) * len(head), *rows]
    return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)


def main():
    core, folder = sys.argv[1:]
    missed = []
    rooms = list(room_rows(read_lines(os.path.join(folder, "lines"), core), missed))
    rooms.append(("all", sum(room[1] for room in rooms), sum(room[2] for room in rooms)))
    text = table(
        ("target", "minutes of processor time", "runs", "new paths", "in the last tenth of the last process", "inputs", "findings"),
        target_rows(folder))
    text += "\n" + table(
        ("room", "lines", "reached", "%"),
        [(*room, f"{100 * room[2] / max(1, room[1]):.1f}") for room in rooms])
    with open(os.path.join(folder, "table.md"), "w", encoding="utf-8") as stream:
        stream.write(text)
    with open(os.path.join(folder, "missed.txt"), "w", encoding="utf-8") as stream:
        stream.write("".join(line + "\n" for line in missed))
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
