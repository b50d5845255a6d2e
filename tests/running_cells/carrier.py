"""A process that carries all crates of a yard, at about real pace.

Usage: `python -m running_cells.carrier FOLDER OPERATION [LIMIT]`.
LIMIT is the size in bytes beyond which no file may grow. Prints a line when it has started and one when it ends.
"""

from __future__ import annotations

import resource
import signal
import sys
import time
from pathlib import Path

from running_cells.yard import find_settings
from skillc.cells.opening import open_cell
from skillc.contract.operation import OperationRequest
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.execution.attempt import TICK_S


def main(folder: Path, operation: str, limit: int | None) -> None:
    with open_cell(find_settings(folder), SilentReporter()) as host:
        if limit is not None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        host.submit(operation, OperationRequest(task="carry_all"))
        print("started", flush=True)
        while host.loop.runs:
            if not host.tick():
                host.loop.wait(TICK_S)
            time.sleep(TICK_S / 4)
        (ended,) = host.take_changed()
        print(ended.state, ended.failure.message if ended.failure else "", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]) if sys.argv[3:] else None)
