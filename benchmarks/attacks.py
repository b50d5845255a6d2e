"""Compares the ticks of a cell, and how soon a stop takes effect, during attacks on its server with those without.

The attacks are those of the tests, each made again and again by a client of its own while a task runs at real pace.
"""

from __future__ import annotations

import math
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import httpx
from prometheus_client.parser import text_string_to_metric_families

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from server.attacking import ATTACKS, make_attacker
from server.running import RunningServer, serving

STOPS = 10
RUN_S = 0.5
"""How long the task runs before it is stopped, in s."""
TICK_S = 0.01
TAKES_MS = 5_000
"""How long a step of the task takes, in ms of the cell's time."""
Counts = dict[float, float]
"""How many intervals between ticks were at most as long, by their length in s."""


def measure(server: RunningServer, attack: Callable[[RunningServer], object]) -> tuple[float, float, float]:
    """Return the p99 of the interval between ticks, the median and the longest time until a stop was taken, in s."""
    attacker, before, ended = make_attacker(server), read_intervals(server), threading.Event()

    def attack_on() -> None:
        while not ended.is_set():
            with suppress(OSError, httpx.HTTPError):  # the connections of an attacker may be cut
                attack(attacker)

    with ThreadPoolExecutor() as pool:
        attacking = pool.submit(attack_on)
        try:
            stops = sorted(measure_stop(server) for _ in range(STOPS))
        finally:
            ended.set()
        attacking.result()
    after = read_intervals(server)
    counts = {bound: after[bound] - before[bound] for bound in after}
    p99 = min(bound for bound, count in counts.items() if count >= 0.99 * counts[math.inf])
    return p99, stops[len(stops) // 2], stops[-1]


def measure_stop(server: RunningServer) -> float:
    """Run the task for RUN_S and stop it; return the time from the request to the event that it was taken, in s."""
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    time.sleep(RUN_S)
    requested_ns = time.time_ns()
    with httpx.Client(base_url=server.url, headers=server.client.headers, timeout=60.0) as operator:
        assert operator.post(f"/operations/{operation}/stop", json={}).status_code == 200
    server.wait_for(operation, "stopped")
    events = server.client.get(f"/operations/{operation}/events").json()
    taken_ns = next(each["wall_time_ns"] for each in events if each["event"]["type"] == "requested")
    return float(taken_ns - requested_ns) * 1e-9


def read_intervals(server: RunningServer) -> Counts:
    """Return the intervals between the ticks of the cell until now, once it has reported them."""
    time.sleep(0.6)
    text = server.client.get("/metrics").text
    found = next(each for each in text_string_to_metric_families(text) if each.name == "skillc_tick_interval_seconds")
    return {float(each.labels["le"]): each.value for each in found.samples if "le" in each.labels}


def wait(_: RunningServer) -> None:
    """Attack nothing."""
    time.sleep(0.05)


def describe(name: str, found: tuple[float, float, float], without: tuple[float, float, float]) -> None:
    p99, median, most = found
    ticks = f"99 % of ticks follow within {p99 / TICK_S:.2f} periods"
    stops = f"stops are taken after {median / TICK_S:.2f} periods in the median, {most / TICK_S:.2f} at most"
    print(
        f"{name}: {ticks}, {stops}; {p99 / without[0]:.1f} and {median / without[1]:.1f} x without attack", flush=True
    )


def main() -> None:
    chosen = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder), TAKES_MS) as server:
        server.client.put("/cells/yard/pace", json={"factor": 1.0})
        measure(server, wait)
        without = measure(server, wait)
        describe("no attack", without, without)
        for attack in ATTACKS:
            if not chosen or attack.__name__ in chosen:
                describe(attack.__name__.replace("_", " "), measure(server, attack), without)


if __name__ == "__main__":
    main()
