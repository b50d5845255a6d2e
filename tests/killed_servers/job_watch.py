"""Begins jobs of a server that is killed, and counts those that it has lost, or of which it has lost a part."""

from __future__ import annotations

from collections import Counter
from random import Random
from typing import Any

from server.running import RunningServer

REQUESTS: tuple[dict[str, Any], ...] = (
    {"kind": "plan", "goal": "lab:Goal contain lab:crate-0"},
    {"kind": "rehearsal", "goal": "lab:Goal contain lab:crate-1"},
    {"kind": "trials", "task": "carry_all", "number": 20},
)
GOES_ON = ("waiting", "running")
REMEMBERED = 40
"""How many jobs of a kind are looked at: fewer than a server keeps of those that go on no more."""


class JobWatch:
    """The jobs of a server as they were seen last; `counts` says how often what was done and how they are found."""

    def __init__(self, chance: Random, counts: Counter[str]) -> None:
        self._chance, self._counts = chance, counts
        self._seen = dict[str, dict[str, Any]]()
        self._logs = dict[str, list[dict[str, Any]]]()

    def go_on(self, server: RunningServer) -> None:
        """Restart a job that was interrupted, or begin another one, which a server with many refuses."""
        interrupted = [name for name, each in self._seen.items() if each["state"] == "interrupted"]
        if interrupted and self._chance.random() < 0.5:
            name = self._chance.choice(interrupted)
            if server.client.post(f"/jobs/{name}/restart").status_code == 200:
                self._counts["jobs restarted"] += 1
            return
        answer = server.client.post("/jobs", json=self._chance.choice(REQUESTS))
        if answer.status_code == 201:
            job = answer.json()
            self._counts[f"jobs begun: {job['request']['kind']}"] += 1
            self._seen[job["id"]], self._logs[job["id"]] = job, []
            of_kind = [name for name, each in self._seen.items() if each["request"]["kind"] == job["request"]["kind"]]
            for name in of_kind[:-REMEMBERED]:
                del self._seen[name], self._logs[name]

    def look(self, server: RunningServer) -> None:
        """Read how the jobs are, and their logs."""
        for name in self._seen:
            self._logs[name] += server.client.get(
                f"/jobs/{name}/events", params={"after": len(self._logs[name])}
            ).json()
            self._seen[name] = server.client.get(f"/jobs/{name}").json()

    def count_lost(self, server: RunningServer, server_died: bool) -> int:
        """Return how many jobs are gone, were begun otherwise, have fewer parts done, another log, or no end."""
        found = {each["id"]: each for each in server.client.get("/jobs").json()}
        lost = 0
        for name, before in self._seen.items():
            now = found.get(name, {"state": "gone", "request": None, "done": 0})
            self._counts[f"jobs found: {now['state']}"] += 1
            log = server.client.get(f"/jobs/{name}/events").json() if name in found else []
            lost += not (
                now["request"] == before["request"]
                and now["done"] >= before["done"]
                and (before["state"] in GOES_ON or now["state"] == before["state"])
                and not (server_died and before["state"] in GOES_ON and now["state"] in GOES_ON)
                and log[: len(self._logs[name])] == self._logs[name]
                and [each["sequence"] for each in log] == [*range(1, len(log) + 1)]
            )
            self._logs[name] = log
        self._seen = {name: found.get(name, before) for name, before in self._seen.items()}
        return lost
