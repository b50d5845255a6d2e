"""What the process of a cell does: it serves the cell whose settings are in the first frame that it gets.

What it writes to the standard error output is for a log.
"""

from __future__ import annotations

import gc
import signal
import socket
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import partial

from skillc.cells.database import DatabaseError
from skillc.cells.frames import FrameReader, send_frame
from skillc.cells.mailbox import Inbox, Outbox, listen_for_stops
from skillc.cells.opening import open_cell
from skillc.cells.service import CellService
from skillc.cells.settings import CellSettings
from skillc.contract.messages import Preparing, StartFailed
from skillc.errors import DiagnosticsError, ServiceError
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import exempt_from_gc
from skillc_dsl.source import Source
from skillc_runtime.execution.cell_loop import NotDurable
from skillc_runtime.motion.numerics.compiled import LISTENERS
from skillc_runtime.platforms.memory import limit_memory, physical_bytes
from skillc_runtime.platforms.signals import ENDING
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.transactions import StoreError

MEMORY_BYTES = max(4 * 2**30, (physical_bytes() or 0) // 4)
"""The largest address space of a cell: a primitive that wants more fails, before the machine has none left."""
SWITCH_S = 0.0005
"""How long a thread that reads texts may go on while the loop is ready, in s."""
CLOSE_S = 5.0
"""How long the last reports may take to be sent, in s."""


class _Log:
    """A reporter that writes to the standard error output."""

    def say(self, message: str) -> None:
        print(message, file=sys.stderr, flush=True)

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        for each in diagnostics:
            self.say(f"{each.severity}: {each}")


def serve_cell(requests: socket.socket, stops: socket.socket) -> int:
    """Serve a cell until the other end is gone or asks for the end; return the exit code."""
    limit_memory(MEMORY_BYTES)
    sys.setswitchinterval(SWITCH_S)
    settings = FrameReader(requests, CellSettings).read()
    if settings is None:
        return 1
    tell = partial(_tell_compilation, requests)
    LISTENERS.append(tell)
    gc.disable()  # what is made until the cell is open stays
    try:
        with open_cell(settings, _Log()) as host:
            LISTENERS.remove(tell)
            outbox = Outbox(requests)
            listen_for_stops(stops, lambda request: host.stop(request.operation, request.reason))
            service = CellService(host, Inbox(requests, outbox), outbox)
            for number in ENDING:
                signal.signal(number, lambda received, _: service.end(f"by {signal.Signals(received).name}"))
            exempt_from_gc()
            gc.enable()
            service.run()
        outbox.close(CLOSE_S)
    except DiagnosticsError as error:
        return _refuse(requests, "\n".join(map(str, error.diagnostics)))
    except (ServiceError, DatabaseError, NotDurable, StoreError, SheetError, FrameError) as error:
        return _refuse(requests, str(error))
    return 0


def _tell_compilation(requests: socket.socket, change: int) -> None:
    """Tell the server why the cell is not ready yet, when a function begins to be compiled."""
    if change > 0:
        send_frame(requests, Preparing(reason="the control laws are compiled"))


def _refuse(requests: socket.socket, reason: str) -> int:
    with suppress(OSError):
        send_frame(requests, StartFailed(reason=reason))
    return 1
