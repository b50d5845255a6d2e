"""The process of a cell: `python -m skillc.cells.process REQUESTS STOPS`, the file descriptors of two sockets."""

from __future__ import annotations

import socket
import sys

from skillc_dsl.importing import importing
from skillc_runtime.platforms.python_modules import defer_import

if __name__ == "__main__":
    # MuJoCo, which a cell imports, imports what opens windows, which no cell does.
    defer_import("glfw")
    with importing():
        from skillc.cells.program import serve_cell
    sys.exit(serve_cell(socket.socket(fileno=int(sys.argv[1])), socket.socket(fileno=int(sys.argv[2]))))
