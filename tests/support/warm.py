# SPDX-License-Identifier: BSD-3-Clause
"""Runs scripts in copies (fork) of a pvpython that has started already: a start takes longer than many a script.

pvpython --no-mpi warm.py start SOCKET    makes the process to copy, and ends when it is there
warm.py SOCKET PVPYTHON --dr SCRIPT ...   runs the script with the folder, environment and output of this process; by PVPYTHON if there is no other
warm.py stop SOCKET                       ends it

The process has no MPI, which does not survive a copy.
"""
import contextlib
import json
import os
import select
import signal
import socket
import sys

IDLE = 600  # seconds after which the process ends by itself


def at(path, act):
    """Binds or connects a socket: in the socket's folder, as its path may have 107 bytes."""
    folder = os.getcwd()
    os.chdir(os.path.dirname(path))
    try:
        act(os.path.basename(path))
    finally:
        os.chdir(folder)


def start(path):
    """Waits for scripts, in the background. Returns the arguments of a script in a copy of the process."""
    import paraview.simple

    if os.path.exists(path):
        os.remove(path)
    listener = socket.socket(socket.AF_UNIX)
    at(path, listener.bind)
    listener.listen()
    if os.fork():
        os._exit(0)
    os.setsid()
    nothing = os.open(os.devnull, os.O_RDWR)
    for number in range(3):
        os.dup2(nothing, number)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    listener.settimeout(IDLE)
    server = os.getpid()
    while True:
        stream, _ = listener.accept()
        if os.fork() == 0:
            listener.close()
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            return copied(stream, server)
        stream.close()


def copied(stream, server):
    """Takes a request, and returns its arguments in the script's process. Another one stays to tell how that ended, and ends it if nobody waits."""
    request, files, _, _ = socket.recv_fds(stream, 1 << 20, 3)
    if request == b"stop":
        os.kill(server, signal.SIGKILL)
        os._exit(0)
    arguments, folder, environment = json.loads(request)
    script = os.fork()
    if script:
        for file in files:
            os.close(file)
        if stream in select.select([stream, os.pidfd_open(script)], [], [])[0]:
            os.kill(script, signal.SIGKILL)
        status = os.waitstatus_to_exitcode(os.waitpid(script, 0)[1])
        stream.sendall(json.dumps(status).encode())
        os._exit(0)
    stream.close()
    for number, file in enumerate(files):
        os.dup2(file, number)
        os.close(file)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    return arguments


def execute(arguments):
    """Runs the script as the main module."""
    sys.argv[:], sys.path[0] = arguments, os.path.dirname(arguments[0])
    with open(arguments[0], encoding="utf-8") as file:
        code = compile(file.read(), arguments[0], "exec")
    main = sys.modules["__main__"].__dict__
    kept = {"__name__": "__main__", "__builtins__": main["__builtins__"], "__file__": arguments[0]}
    main.clear()
    main.update(kept)
    exec(code, main)


def ask(path, program, *arguments):
    """Returns the exit status of the script."""
    stream = socket.socket(socket.AF_UNIX)
    try:
        at(path, stream.connect)
    except OSError:
        os.execv(program, [program, *arguments])
    request = json.dumps([arguments[1:], os.getcwd(), dict(os.environ)]).encode()
    socket.send_fds(stream, [request], [0, 1, 2])
    status = json.loads(stream.recv(64) or b"1")
    if status < 0:
        os.kill(os.getpid(), -status)
    return status


def stop(path):
    """Returns when there is no such process; another run in the same folder may have ended it."""
    stream = socket.socket(socket.AF_UNIX)
    with contextlib.suppress(OSError):
        at(path, stream.connect)
        stream.sendall(b"stop")
        stream.recv(1)


if sys.argv[1] == "start":
    execute(start(sys.argv[2]))
elif sys.argv[1] == "stop":
    stop(sys.argv[2])
else:
    sys.exit(ask(*sys.argv[1:]))
