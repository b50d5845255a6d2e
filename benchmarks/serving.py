"""Compares what a server costs: requests with the least one, the loop of a cell with and without clients that watch.

A cell without physics runs the shipped task `clean_table`. CPU times are those of the processes.
"""

from __future__ import annotations

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from pathlib import Path
from statistics import median, quantiles

import httpx
from _processes import cpu_s
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

CELL, TASK = "iiwa_table", "clean_table"
REQUESTS, STOPS, KILLS = 400, 20, 3
CLIENTS, BUSY_S = 16, 3.0
"""How many clients, each with a token of its own, make requests as fast as they are answered, and for how long in s."""
WATCHERS = (0, 1, 8, 64)
SAMPLERS = (0, 1, 8)
TICK_S = 0.01
READY_S = 300.0


@contextmanager
def serving(folder: Path, cell: str = CELL, backend: str = "kinematic") -> Iterator[tuple[httpx.Client, int, float]]:
    """Serve a cell; yield a client, the id of the process of the server, and the time until it was ready, in s."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = (sys.executable, "-m", "skillc", "serve", "wiping", "--cell", f"{cell}.ttl", "--backend", backend)
    process = subprocess.Popen((*command, "--state", folder, "--bind", f"127.0.0.1:{port}"), stderr=subprocess.DEVNULL)
    url = f"http://127.0.0.1:{port}/api/v1"
    try:
        began = time.monotonic()
        wait_for(lambda: is_up(url))
        token = (folder / "admin.token").read_text().strip()
        with httpx.Client(base_url=url, headers={"Authorization": f"Bearer {token}"}, timeout=60.0) as client:
            wait_for(lambda: client.get(f"/cells/{cell}").json()["state"] == "operational")
            yield client, process.pid, time.monotonic() - began
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(60.0)


def is_up(url: str) -> bool:
    """Whether the server answers."""
    try:
        return httpx.get(f"{url}/health").status_code == 200
    except httpx.TransportError:
        return False


def wait_for(condition: Callable[[], bool]) -> None:
    """Wait until a condition holds."""
    end = time.monotonic() + READY_S
    while not condition():
        assert time.monotonic() < end, "the server is not ready"
        time.sleep(0.02)


def measure_requests(client: httpx.Client) -> None:
    """Print the time of requests of an idle server, relative to that of /health, which needs nothing."""
    times = dict[str, list[float]]()
    for _ in range(REQUESTS):
        for path in ("/health", f"/cells/{CELL}", f"/cells/{CELL}/operations"):
            began = time.perf_counter()
            client.get(path)
            times.setdefault(path, []).append(time.perf_counter() - began)
            time.sleep(0.004)
    least = median(times["/health"])
    for path, found in times.items():
        p99 = quantiles(found, n=100)[98]
        print(f"GET {path}: median {median(found) / least:.1f} x /health, p99 {p99 / least:.1f} x ({p99 * 1e3:.1f} ms)")


def measure_stops(client: httpx.Client) -> None:
    """Print how many ticks pass from the request of a stop to the event that it was taken, at real pace."""
    client.put(f"/cells/{CELL}/pace", json={"factor": 1.0})
    ticks = list[float]()
    for _ in range(STOPS):
        operation = submit(client)
        wait_for(lambda operation=operation: state_of(client, operation) == "running")
        requested_ns = time.time_ns()
        client.post(f"/operations/{operation}/stop", json={})
        wait_for(lambda operation=operation: state_of(client, operation) == "stopped")
        events = client.get(f"/operations/{operation}/events").json()
        taken = next(each["wall_time_ns"] for each in events if each["event"]["type"] == "requested")
        ticks.append((taken - requested_ns) * 1e-9 / TICK_S)
    client.put(f"/cells/{CELL}/pace", json={"factor": None})
    print(f"stop: taken after {median(ticks):.2f} ticks of {TICK_S * 1e3:g} ms in the median, {max(ticks):.2f} at most")


def measure_watchers() -> None:
    """Print the CPU time of a whole task with clients that watch it, relative to that of the cell without."""
    alone = None
    for number in WATCHERS:
        with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as (client, server, _):
            cell = find_cell(server)
            before = cpu_s(cell), cpu_s(server)
            latencies = asyncio.run(run_watched(client, number))
            spent = cpu_s(cell) - before[0], cpu_s(server) - before[1]
        alone = alone or spent
        late = f", events {median(latencies) * 1e3:.0f} ms old in the median" if latencies else ""
        ratios = f"cell {spent[0] / alone[0]:.2f} x, server {spent[1] / alone[0]:.2f} x the cell"
        print(f"{number} clients watch: {ratios}{late}")


async def run_watched(client: httpx.Client, number: int) -> list[float]:
    """Run the task, watched by a number of clients; return the ages of the events that they get, in s."""
    token = client.headers["authorization"].partition(" ")[2]
    url = str(client.base_url.join("events")).replace("http", "ws")
    operation = await asyncio.to_thread(submit, client)

    async def watch() -> list[float]:
        ages = list[float]()
        async with connect(url) as stream:
            await stream.send(json.dumps({"token": token, "operation": operation}))
            try:
                while True:
                    for each in json.loads(await stream.recv()):
                        ages.append(time.time() - each["wall_time_ns"] * 1e-9)
            except ConnectionClosed:
                return ages

    found = await asyncio.gather(*(watch() for _ in range(number)))
    await asyncio.to_thread(wait_for, lambda: state_of(client, operation) == "succeeded")
    return [age for ages in found for age in ages]


def measure_samplers() -> None:
    """Print the CPU time of a task while clients get 50 samples a second, relative to that of the cell without."""
    alone = None
    for number in SAMPLERS:
        with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as (client, server, _):
            cell = find_cell(server)
            before = cpu_s(cell), cpu_s(server)
            count = asyncio.run(run_sampled(client, number))
            spent = cpu_s(cell) - before[0], cpu_s(server) - before[1]
        alone = alone or spent
        ratios = f"cell {spent[0] / alone[0]:.2f} x, server {spent[1] / alone[0]:.2f} x the cell"
        print(f"{number} clients get samples: {ratios}, {count} samples each")


async def run_sampled(client: httpx.Client, number: int) -> int:
    """Run the task at four times real time while clients get samples; return how many each got in the mean."""
    token = client.headers["authorization"].partition(" ")[2]
    url = str(client.base_url.join("samples")).replace("http", "ws")
    client.put(f"/cells/{CELL}/pace", json={"factor": 4.0})
    operation = await asyncio.to_thread(submit, client)
    counts = [0] * number

    async def watch(index: int) -> None:
        async with connect(url) as stream:
            await stream.send(json.dumps({"token": token, "cell": CELL, "rate_hz": 50}))
            while True:
                await stream.recv()
                counts[index] += 1

    watching = [asyncio.ensure_future(watch(index)) for index in range(number)]
    await asyncio.to_thread(wait_for, lambda: state_of(client, operation) == "succeeded")
    for each in watching:
        each.cancel()
    return sum(counts) // max(1, number)


def measure_rates(client: httpx.Client) -> None:
    """Print how many requests a second are answered that clients make at the same time, relative to /health."""
    names = [f"client-{number}" for number in range(CLIENTS)]
    tokens = [client.post("/tokens", json={"name": each, "role": "view"}).json()["token"] for each in names]
    paths = ("/health", f"/cells/{CELL}", f"/cells/{CELL}/operations", f"/cells/{CELL}/world")
    rates = [asyncio.run(count_answers(client, each, tokens)) / BUSY_S for each in paths]
    for path, rate in zip(paths, rates, strict=True):
        print(f"{CLIENTS} clients GET {path}: {rate / rates[0]:.2f} x /health ({rate:.0f} requests/s)")


async def count_answers(client: httpx.Client, path: str, tokens: Sequence[str]) -> int:
    """Return how many requests are answered in BUSY_S to clients with these tokens."""
    end = time.monotonic() + BUSY_S

    async def ask(token: str) -> int:
        count = 0
        headers = {"Authorization": f"Bearer {token}"}
        async with httpx.AsyncClient(base_url=client.base_url, headers=headers, timeout=60.0) as asking:
            while time.monotonic() < end:
                count += (await asking.get(path)).status_code == HTTPStatus.OK
        return count

    return sum(await asyncio.gather(*map(ask, tokens)))


def measure_restarts(ready_s: float) -> None:
    """Print the time from a kill of the cell, and of the server, in the middle of an operation until it is ready again.

    The times are relative to that of a first start. The server is started again at once.
    """
    cells, servers = list[float](), list[float]()
    for _ in range(KILLS):
        with tempfile.TemporaryDirectory() as folder:
            with serving(Path(folder)) as (client, server, _):
                run_for_a_while(client)
                cell = find_cell(server)
                began = time.monotonic()
                os.kill(cell, signal.SIGKILL)
                find_cell(server, cell)
                wait_for(lambda: client.get(f"/cells/{CELL}").json()["state"] == "operational")
                cells.append(time.monotonic() - began)
                run_for_a_while(client)
                os.kill(server, signal.SIGKILL)
            with serving(Path(folder)) as (_, _, again_s):
                servers.append(again_s)
    ratios = f"cell {median(cells) / ready_s:.2f} x, server and cell {median(servers) / ready_s:.2f} x"
    print(f"from kill to ready again, of the time from start to ready: {ratios}")


def run_for_a_while(client: httpx.Client) -> None:
    """Start the task at real pace; return when it has been under way for a second."""
    client.put(f"/cells/{CELL}/pace", json={"factor": 1.0})
    operation = submit(client)
    wait_for(lambda: state_of(client, operation) == "running")
    time.sleep(1.0)


def submit(client: httpx.Client, cell: str = CELL, task: str = TASK) -> str:
    """Submit a task; return the id of the operation."""
    answer = client.post(f"/cells/{cell}/operations", json={"task": task})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def state_of(client: httpx.Client, operation: str) -> str:
    """Return the state of an operation."""
    return str(client.get(f"/operations/{operation}").json()["state"])


def find_cell(server: int, former: int | None = None) -> int:
    """Return the id of the process of the cell, which is not the former one; wait for it."""
    end = time.monotonic() + READY_S
    while time.monotonic() < end:
        for each in map(int, Path(f"/proc/{server}/task/{server}/children").read_text().split()):
            if each != former and b"skillc.cells.process" in Path(f"/proc/{each}/cmdline").read_bytes():
                return each
        time.sleep(0.02)
    raise AssertionError("there is no process of the cell")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as (client, _, ready_s):
        print(f"from start to ready: {ready_s:.1f} s")
        measure_requests(client)
        measure_stops(client)
        measure_rates(client)
    measure_restarts(ready_s)
    measure_watchers()
    measure_samplers()


if __name__ == "__main__":
    main()
