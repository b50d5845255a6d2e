"""Kills a server, or the process of its cell, again and again at random moments of tasks that change the world."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import astuple, replace
from pathlib import Path
from random import Random
from typing import Any

from killed_servers.auditing import BY_HAND, Faults, Place, audit
from killed_servers.job_watch import JobWatch
from running_cells.yard import write_yard
from server.running import RunningServer, find_cell_process, is_listening, start_server, wait_until
from waiting import LONG_S

TAKES_MS = 60
LONGEST_S = 1.6
"""The longest time from the submission of an operation to a kill: a little more than the operation takes."""
START_KILLS = 0.15
"""Which part of the starts of a server is killed, too."""
GOALS = tuple(f"forall c: Product (lab:{place} contain c)" for place in ("Goal", "Start"))
COUNT = "SELECT ?place ?what { ?place skiros:contain ?what }"


class KillSeries:
    """A server of a yard in a folder that is killed; `counts` says how often what was done and how operations ended."""

    def __init__(self, folder: Path, seed: int) -> None:
        self._folder, self._chance = folder, Random(seed)
        self.counts = Counter[str]()
        self._seen = dict[str, list[dict[str, Any]]]()
        self._jobs = JobWatch(self._chance, self.counts)
        self._operation, self._goals = "", 0
        self._process: subprocess.Popen[bytes] | None = None
        write_yard(folder, TAKES_MS)
        with socket.create_server(("127.0.0.1", 0)) as free:
            self._port = free.getsockname()[1]

    def kill(self, times: int) -> Iterator[Faults]:
        """Kill so often; after each time, yield what the history of the cell has lost or has twice."""
        for _ in range(times):
            server = self._start()
            server.client.put("/cells/yard/pace", json={"factor": 1.0})
            self._operation = self._go_on(server)
            self._jobs.go_on(server)
            self._watch(server, self._chance.uniform(0.0, LONGEST_S))
            self._jobs.look(server)
            self._kill_one(server)
            server_died = self._process is None
            server = self._start()
            lost = self._jobs.count_lost(server, server_died)
            found = audit(server.folder / "served" / "cells" / "yard" / "journal.sqlite", self._seen, _places(server))
            yield replace(found, jobs_lost=lost)

    def end(self) -> None:
        """End the server."""
        if self._process is not None:
            self._process.send_signal(signal.SIGTERM)
            self._process.wait(LONG_S)

    def _start(self) -> RunningServer:
        """Return the server with its cell ready; start it if it was killed, perhaps several times."""
        while self._process is None:
            self._process = start_server(self._folder, self._port)
            if self._chance.random() < START_KILLS:
                time.sleep(self._chance.uniform(0.0, LONGEST_S))
                self._kill_server("server while it starts")
        process = self._process
        wait_until(lambda: is_listening(self._port) or process.poll() is not None, bool)
        assert process.poll() is None, process.communicate()[1]
        server = RunningServer(self._folder, process, self._port, None)
        server.wait_ready()
        return server

    def _go_on(self, server: RunningServer) -> str:
        """Decide about the last operation if it was interrupted, else submit another one; return its id."""
        last = server.client.get(f"/operations/{self._operation}").json() if self._operation else {}
        if last:
            self.counts[f"ended: {last['state']}"] += 1
        if decisions := last.get("decisions"):
            decision = self._chance.choice(decisions)
            self.counts[f"decided: {decision}"] += 1
            why = {"why": BY_HAND} if decision == "skip" else {}
            return str(server.submit(continues=self._operation, decision=decision, **why)["id"])
        self._goals += last.get("state") == "succeeded"
        return str(server.submit(goal=GOALS[self._goals % 2])["id"])

    def _watch(self, server: RunningServer, duration_s: float) -> None:
        """Read the events of the operation for a time."""
        seen = self._seen.setdefault(self._operation, [])
        end = time.monotonic() + duration_s
        while time.monotonic() < end:
            path = f"/operations/{self._operation}/events"
            seen += server.client.get(path, params={"after": len(seen)}).json()
            time.sleep(0.01)

    def _kill_one(self, server: RunningServer) -> None:
        if self._chance.random() < 0.5:
            self._kill_server("server")
            return
        os.kill(cell := find_cell_process(server), signal.SIGKILL)
        self.counts["killed: cell"] += 1
        wait_until(lambda: _is_alive(cell), lambda alive: not alive)
        wait_until(lambda: server.client.get("/cells/yard").json(), lambda it: it["state"] == "off")

    def _kill_server(self, what: str) -> None:
        assert self._process is not None
        self._process.kill()
        self._process.communicate()
        self._process = None
        self.counts[f"killed: {what}"] += 1


def add_up(found: Faults, more: Faults) -> Faults:
    """Return the larger number of each kind: an audit finds what earlier ones found again."""
    return Faults(*map(max, astuple(found), astuple(more)))


def _places(server: RunningServer) -> set[Place]:
    """Return what is where in the world of the cell."""
    answer = server.client.post("/cells/yard/world/query", json={"sparql": COUNT})
    assert answer.status_code == 200, answer.text
    return {(place.removeprefix("lab:"), what.removeprefix("lab:")) for place, what in answer.json()["rows"]}


def _is_alive(process: int) -> bool:
    """Whether a process runs; one that has ended may wait for its parent."""
    with suppress(OSError):
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False
