"""Compares the CPU time and the memory of a server and its cell after many operations with those after a few.

Crates are carried to and fro, in the cell of the tests; each operation is planned and recorded.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from _processes import cpu_s, rss_mb

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from server.running import RunningServer, find_cell_process, serving

OPERATIONS, PART = 2_000, 200
"""How many operations there are, and after how many the figures are taken."""


def main() -> None:
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder), takes_ms=10) as server:
        server.client.put("/cells/yard/pace", json={"factor": None})
        processes = {"server": server.process.pid, "cell": find_cell_process(server)}
        first = dict.fromkeys(processes, (1.0, 1.0))
        for done in range(PART, OPERATIONS + 1, PART):
            before = {name: cpu_s(process) for name, process in processes.items()}
            carry(server, PART)
            now = {name: (cpu_s(process) - before[name], rss_mb(process)) for name, process in processes.items()}
            first = now if done == PART else first
            print(f"{done} operations: ", end="")
            print("; ".join(compare(name, now[name], first[name]) for name in processes), flush=True)


def carry(server: RunningServer, number: int) -> None:
    """Carry a crate to and fro."""
    for each in range(number):
        where = {"crate": "lab:crate-1", "to": ("lab:Goal", "lab:Start")[each % 2]}
        server.wait_for(server.submit(task="carry", arguments=where)["id"], "succeeded")


def compare(name: str, now: tuple[float, float], first: tuple[float, float]) -> str:
    """Return what the last operations took of a process, and its memory, relative to the first ones."""
    return f"{name} {now[0] / first[0]:.2f} x the CPU time of the first {PART}, {now[1] / first[1]:.3f} x the memory"


if __name__ == "__main__":
    main()
