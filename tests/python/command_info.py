# SPDX-License-Identifier: BSD-3-Clause
"""granular info, the help, the manual page and the completion."""
import json
import os
import subprocess
import sys
import venv

import plain_dump
from command import GOOD, SAMPLES, content, granular

# in words and as JSON, of real runs
source = os.path.join(SAMPLES, "grains.dump")
frames = plain_dump.read(source)
said, _ = granular("info", source, "--dt", "2e-5")
for line in ("kind     dump, LIGGGHTS", "frames   5", "steps    0 to 4000, every 1000", "times    0 to 0.08", "rows     0 to 1200",
             "box      -0.05 to 0.05, -0.05 to 0.05, 0 to 0.15, pp pp ff", "v       float64 x 3  velocity [m/s]",
             "odd      1 of 5 frames are empty; the first: step 0"):
    assert line in said, (line, said)
told = json.loads(granular("info", "--json", source)[0])
assert told["steps"] == [frame.timestep for frame in frames] and told["rows"] == [frame.rows for frame in frames]
assert told["bytes"] == os.path.getsize(source) and told["files"] == 1 and told["file_columns"] == list(frames[-1].columns)
assert [column["name"] for column in told["columns"]] == ["id", "type", "image", "v", "f", "omega", "radius", "mass"]
told = json.loads(granular("info", "--json", os.path.join(SAMPLES, "pieces", "pieces_*.%.dump"))[0])
assert told["files"] == 20 and told["frames"] == 5 and told["rows"] == [frame.rows for frame in frames]
for path, kind in ((os.path.join(SAMPLES, "euler_*.vtk"), "euler"), (os.path.join(SAMPLES, "restart", "fibres.20000.restart"), "restart"),
                   (os.path.join(SAMPLES, "bonds", "chain_bonds.dump"), "local"), (os.path.join(SAMPLES, "bonds", "chain.data"), "data"),
                   (os.path.join(GOOD, "decomposition_1000.vtk"), "decomposition")):
    assert json.loads(granular("info", "--json", path)[0])["kind"] == kind, path
said, _ = granular("info", os.path.join(GOOD, "data_file", "hybrid_labels.data"))
assert "types    1 grain, 2 shell\n  of bonds 1 weak, 2 strong\n" in said and "hybrid sphere bond, id type x y z" in said, said
said, _ = granular("info", os.path.join(GOOD, "tri_image.dump"))
assert "tilts" in said and "[m/s]" not in said, said  # of LAMMPS without ITEM: UNITS nobody knows the unit

# what is odd: a frame that ends early, timesteps at uneven distances, timesteps that come again
text = content(source)
with open("odd.dump", "wb") as out:
    out.write(text[: text.index(b"ITEM: TIMESTEP\n3000")] + text[text.index(b"ITEM: TIMESTEP\n4000"):] + text[:-5])
odd = "\n".join(json.loads(granular("info", "--json", "odd.dump")[0])["odd"])
assert "expected 1200 rows, got 1199" in odd and "have the timestep of an earlier one" in odd, odd
for name, why in (("nowhere.dump", "no such file or folder"), ("nowhere_*.dump", "no file fits the pattern")):
    assert granular("info", name, status=1)[1] == f"granular: {os.path.abspath(name)}: {why}\n", name
    assert json.loads(granular("info", "--json", name, status=1)[0])["error"]["path"] == os.path.abspath(name), name
granular("info", status=2)
granular("nonsense", status=2)
assert "usage" in granular("--help")[0]
for command in ("info", "check", "convert", "stats", "show"):
    assert command in granular("--help")[0] and "exit status" in granular(command, "--help")[0]

# a Python without numpy finds another one, or says which it is; files of the current folder are not run
venv.create("bare", with_pip=False)
with open("numpy.py", "w", encoding="ascii") as module:
    module.write("raise SystemExit('a file of the user was run')\n")
bare = {**os.environ, "PATH": f"bare/bin:{os.path.dirname(sys.executable)}:{os.environ['PATH']}"}
done = subprocess.run(["bare/bin/python3", os.environ["GRANULAR_COMMAND"], "info", source], capture_output=True, text=True, env=bare)
assert done.returncode == 0 and "frames   5" in done.stdout and not done.stderr, done
os.remove("numpy.py")
script = "import sys; sys.modules['numpy'] = None; from vtkgranular.command import main; sys.exit(main(sys.argv[1:]))"
done = subprocess.run([sys.executable, "-c", script, "info", source], capture_output=True, text=True)
assert done.returncode == 1 and f"expected a Python with numpy, got {sys.executable}, which has none" in done.stderr, done

# an error is a document, too
for arguments, status, expected in (
        (("info", "odd.dump", "--kind", "euler"), 1, {"path": os.path.abspath("odd.dump"), "line": 1}),
        (("info", "nowhere.dump"), 1, {"line": None}), (("stats", source, "--frames", "9"), 2, {"path": None, "byte": None}),
        (("show", source, "--nonsense"), 2, {"message": "unrecognized arguments: --nonsense"}), (("check",), 2, {"column": None})):
    said = json.loads(granular(*arguments, "--json", status=status)[0])
    assert list(said) == ["error"] and list(said["error"]) == ["message", "path", "line", "byte", "column"], said
    assert {name: said["error"][name] for name in expected} == expected, said

# head leaves before all is told, or before anything is; a full disk is an error
buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
for _ in range(10):
    shell = subprocess.run(f"{sys.executable} {os.environ['GRANULAR_COMMAND']} stats {source} | head -1", shell=True, capture_output=True,
                           text=True, env=buffered)
    assert shell.returncode == 0 and not shell.stderr and shell.stdout.startswith("step 0"), shell
for arguments in (("info", source), ("stats", source), ("stats", "--csv", "--quiet", source), ("check", source), ("check", "odd.dump"),
                  ("--help",), ("info", "--help")):
    reader, writer = os.pipe()
    os.close(reader)
    for out, expected in ((writer, (int("odd.dump" in arguments), "")),  # the status tells of faults that nobody reads
                          (os.open("/dev/full", os.O_WRONLY), (1, "granular: [Errno 28] No space left on device\n"))):
        done = subprocess.run([sys.executable, os.environ["GRANULAR_COMMAND"], *arguments], stdout=out, stderr=subprocess.PIPE, text=True,
                              env=buffered)
        os.close(out)
        assert (done.returncode, done.stderr) == expected, (arguments, done)

# the manual page is made of the options, and troff understands it; bash completes commands, options and choices
for kind in ("man", "bash"):
    subprocess.run([sys.executable, "-m", "vtkgranular.command.manual", kind, kind], check=True)
page = content("man").decode()
assert page.startswith(".TH GRANULAR 1") and all(f".SH {name}" in page for name in ("NAME", "SYNOPSIS", "INFO", "CONVERT", "EXIT STATUS"))
assert "\\-\\-frames" in page and "\\-\\-region" in page
script = """source ./bash
complete_words() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _granular; echo "${COMPREPLY[@]}"; }
complete_words granular c
complete_words granular info --js
complete_words granular convert a.dump --style e
"""
done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
assert done.stdout.split("\n") == ["check convert", "--json", "euler", ""], (done.stdout, done.stderr)

# a user who types: names of files with blanks are one word
terminal, keyboard = os.openpty()
with open("a file of mine.dump", "w"), subprocess.Popen(["bash", "--norc", "--noprofile", "-i"], stdin=keyboard, stdout=keyboard, stderr=keyboard,
                                                       start_new_session=True, env={**os.environ, "TERM": "dumb"}):
    os.close(keyboard)
    os.write(terminal, b"source ./bash; granular() { printf '<%s>' \"$@\"; }\ngranular info a\\ fi\t\nexit\n")
    seen = b""
    while b"<a file of mine.dump>" not in seen:
        seen += os.read(terminal, 1000)  # an error when the shell has gone
print("info")
