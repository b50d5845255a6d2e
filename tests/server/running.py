"""A server of a yard in a process of its own, and a client of it."""

from __future__ import annotations

import os
import signal
import socket
import ssl
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Any

import httpx
import uvicorn

from running_cells.yard import write_yard
from skillc.services.library.files import SHIPPED
from waiting import LONG_S

LOOK_S = 0.05
"""How often something is looked at that is waited for: each look at a server costs both sides, in s."""
NOTHING: Mapping[str, str] = MappingProxyType({})


class RunningServer:
    """A server; `client` has the token of the command line."""

    def __init__(self, folder: Path, process: subprocess.Popen[bytes], port: int, authority: Path | None) -> None:
        self.folder, self.process, self.port, self._authority = folder, process, port, authority
        self.url = f"http{'s' if authority else ''}://127.0.0.1:{port}/api/v1"
        self.token = (folder / "served" / "admin.token").read_text().strip()
        self.client = self.client_of(self.token)

    def client_of(self, token: str, address: str | None = None) -> httpx.Client:
        """Return a client with a token, at an address of this machine's own network: limits count for each address."""
        verify = ssl.create_default_context(cafile=self._authority) if self._authority else False
        return httpx.Client(
            base_url=self.url,
            headers={"Authorization": f"Bearer {token}"},
            timeout=LONG_S,
            transport=httpx.HTTPTransport(verify=verify, local_address=address),
        )

    def submit(self, **request: Any) -> dict[str, Any]:
        """Submit an operation, and return it."""
        answer = self.client.post("/cells/yard/operations", json=request)
        assert answer.status_code == 201, answer.text
        return dict(answer.json())

    def begin(self, kind: str, **request: Any) -> Any:
        """Begin a job of a kind, and return it."""
        answer = self.client.post("/jobs", json={"kind": kind, **request})
        assert answer.status_code == 201, answer.text
        return answer.json()

    def wait_for_job(self, job: str, *states: str) -> Any:
        """Wait until a job is in one of the states, by default one in which it goes on no more, and return it."""
        ends = states or ("ended", "failed", "cancelled", "interrupted")
        return wait_until(lambda: self.client.get(f"/jobs/{job}").json(), lambda it: it.get("state") in ends)

    def find_outcome(self, job: str) -> Any:
        """Return the outcome of a job."""
        answer = self.client.get(f"/jobs/{job}/result")
        assert answer.status_code == 200, answer.text
        return answer.json()["outcome"]

    def put_back(self, pace: float = 1.0) -> None:
        """Bring all crates to where they were at first, so that there is something to carry; `pace` is that afterwards.

        At the real one carrying all takes 2.4 s, which a busy machine may let pass between two requests.
        """
        self.client.put("/cells/yard/pace", json={"factor": None})
        self.wait_for(self.submit(goal="forall c: Product (lab:Start contain c)")["id"], "succeeded")
        self.client.put("/cells/yard/pace", json={"factor": pace})

    def wait_for(self, operation: str, *states: str) -> dict[str, Any]:
        """Wait until an operation is in one of the states, and return it."""
        return wait_until(
            lambda: self.client.get(f"/operations/{operation}").json(), lambda it: it.get("state") in states
        )

    def wait_ready(self, state: str = "operational") -> dict[str, Any]:
        """Wait until the cell takes operations, or is in another state."""
        return wait_until(lambda: self.client.get("/cells/yard").json(), lambda it: it["state"] == state)


def wait_until(look: Any, condition: Any) -> Any:
    """Look again and again until a condition holds; return what was seen last."""
    end = time.monotonic() + LONG_S
    while not condition(found := look()):
        assert time.monotonic() < end, found
        time.sleep(LOOK_S)
    return found


def find_cell_process(server: RunningServer) -> int:
    """Return the process of a cell of a server, once there is one."""
    children = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children")

    def find() -> list[int]:
        found = [int(each) for each in children.read_text().split()]
        return [each for each in found if b"skillc.cells.process" in Path(f"/proc/{each}/cmdline").read_bytes()]

    return int(wait_until(find, bool)[0])


@contextmanager
def serving(
    folder: Path,
    takes_ms: int = 100,
    options: Sequence[str | Path] = (),
    authority: Path | None = None,
    environment: Mapping[str, str] = NOTHING,
    state: str = "operational",
    libraries: Sequence[str] = (".",),
    write: Callable[[Path, int], object] = write_yard,
) -> Iterator[RunningServer]:
    """Serve a yard in a folder, in which it may have been served before; with a certificate of `authority`, if any.

    Its cell is in a `state` then. `libraries` has folders beside it, if they are served as well; `write` writes it.
    """
    write(folder, takes_ms)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    process = start_server(folder, port, options, libraries, environment=environment)
    try:
        wait_until(lambda: is_listening(port) or process.poll() is not None, bool)
        assert process.poll() is None, process.communicate()[1].decode()
        server = RunningServer(folder, process, port, authority)
        server.wait_ready(state)
        yield server
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(LONG_S)


@contextmanager
def serving_bench(folder: Path) -> Iterator[RunningServer]:
    """Serve a yard, and the cell `bench` with an arm and parts."""
    scene = (SHIPPED / "sorting" / "panda.ttl").read_text(encoding="utf-8")
    scene = scene.replace("sorting:WorkPart", "skiros:Product").replace("sorting:Box", "skiros:Container")
    (folder / "bench.ttl").write_text(scene, encoding="utf-8")
    with serving(folder, options=("--cell", "bench.ttl")) as running:
        wait_until(lambda: running.client.get("/cells/bench").json(), lambda it: it["state"] == "operational")
        yield running


def start_server(
    folder: Path,
    port: int,
    options: Sequence[str | Path] = (),
    libraries: Sequence[str] = (".",),
    cells: Sequence[str] = ("--cell", "yard.ttl"),
    environment: Mapping[str, str] = NOTHING,
) -> subprocess.Popen[bytes]:
    """Start the process of a server in a folder."""
    always = ("--state", "served", "--bind", f"127.0.0.1:{port}", "--backend", "kinematic")
    command = (sys.executable, "-m", "skillc", "serve", *libraries, *cells, *always, *map(str, options))
    paths = os.pathsep.join(filter(None, sys.path))
    environment = {**os.environ, "PYTHONPATH": paths, **environment}
    return subprocess.Popen(command, cwd=folder, env=environment, stderr=subprocess.PIPE)


def is_listening(port: int) -> bool:
    """Whether something listens to a port of this machine."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


@contextmanager
def serving_app(config: uvicorn.Config) -> Iterator[int]:
    """Serve an application in a thread of this process; yield the port."""
    app = uvicorn.Server(config)
    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=app.run, args=([listener],))
        thread.start()
        wait_until(lambda: app.started, bool)
        try:
            yield listener.getsockname()[1]
        finally:
            app.should_exit = True
            thread.join(LONG_S)
