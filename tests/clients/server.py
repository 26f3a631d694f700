"""A fork server for clients in Python: starts one in milliseconds, without the start of Python and NumPy.

    python3 tests/clients/server.py SOCKET    # ends when its standard input is closed

Each connection of `stub.c` gives arguments, SCRIPT ARGUMENT ..., and three files. A forked process runs the script with
these files as standard input, output and error, as `python3 SCRIPT ARGUMENT ...` would, and its exit status is sent.
"""

from __future__ import annotations

import functools
import gc
import os
import selectors
import signal
import socket
import sys
import traceback
from pathlib import Path

sys.dont_write_bytecode = True
CLIENTS = Path(__file__).resolve().parent
sys.path[1:1] = [str(CLIENTS.parents[1] / "examples/solvers")]
import numpy  # noqa: F401, imported once for all clients
import mpm_verify  # noqa: F401
import variant


@functools.cache
def compiled(script):
    return compile(Path(script).read_text(), script, "exec")


def prepare(words):
    """Compiles a client in the server, for this process and later ones. A client reports its own errors."""
    try:
        variant.prepare(words[1:]) if Path(words[0]).name == "variant.py" else compiled(words[0])
    except (Exception, SystemExit):
        pass


def run(words):
    """Runs a script as the main program. Returns its exit status."""
    sys.argv = words
    try:
        if Path(words[0]).name == "variant.py":
            variant.main()
        else:
            sys.path[0] = str(Path(words[0]).resolve().parent)
            sys.modules["__main__"].__file__ = words[0]
            exec(compiled(words[0]), sys.modules["__main__"].__dict__)
        return 0
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return 1


class Server:
    def __init__(self, path):
        self.children = {}  # process id -> connection
        self.selector = selectors.DefaultSelector()
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(path)
        self.listener.listen(64)
        # A signal writes a byte, which ends the wait for connections.
        self.ended, self.writer = socket.socketpair()
        for end in (self.ended, self.writer):
            end.setblocking(False)
        signal.set_wakeup_fd(self.writer.fileno(), warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        for source in (self.listener, self.ended, 0):
            self.selector.register(source, selectors.EVENT_READ)

    def serve(self):
        while True:
            for key, _ in self.selector.select():
                if key.fileobj == 0:
                    for process in self.children:
                        os.kill(process, signal.SIGKILL)
                    return
                if key.fileobj is self.listener:
                    self.start(self.listener.accept()[0])
                elif key.fileobj is self.ended:
                    self.ended.recv(4096)
                    self.reap()
                elif key.data in self.children:  # the stub was killed
                    os.kill(key.data, signal.SIGKILL)
                    self.selector.unregister(key.fileobj)

    def start(self, connection):
        text, files, *_ = socket.recv_fds(connection, 1 << 15, 3)
        if len(files) < 3:
            connection.close()
            return
        words = text.decode().rstrip("\0").split("\0")
        prepare(words)
        process = os.fork()
        if process == 0:
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            for number, file in enumerate(files):
                os.dup2(file, number)
                os.close(file)
            status = run(words)
            for stream in (sys.stdout, sys.stderr):
                stream.flush()
            os._exit(status & 255)
        for file in files:
            os.close(file)
        self.children[process] = connection
        self.selector.register(connection, selectors.EVENT_READ, process)

    def reap(self):
        while self.children:
            process, status = os.waitpid(-1, os.WNOHANG)
            if process == 0:
                return
            connection = self.children.pop(process)
            code = os.waitstatus_to_exitcode(status)
            try:
                self.selector.unregister(connection)
            except KeyError:
                pass
            try:
                connection.send(bytes([code if code >= 0 else 128 - code]))
            except OSError:
                pass
            connection.close()


if __name__ == "__main__":
    server = Server(sys.argv[1])
    gc.freeze()
    print("ready", flush=True)
    server.serve()
