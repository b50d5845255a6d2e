"""A server with one cell of ideal motion, in the folder of a product."""

from __future__ import annotations

import json
import signal
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import Request, urlopen

from behaviour.product import Product
from waiting import LONG_S

CELL = "iiwa_table"
LOOK_S = 0.2


@dataclass(frozen=True, slots=True)
class Server:
    """A server that runs, and the product whose commands use it."""

    url: str
    product: Product

    def get(self, path: str) -> Any:
        """Return what the server answers, with the status if it refuses."""
        token = (self.product.work / ".skillc" / "admin.token").read_text("utf-8").strip()
        request = Request(f"{self.url}/api/v1{path}", headers={"Authorization": f"Bearer {token}"})
        try:
            with urlopen(request, timeout=LONG_S) as answer:
                return _read(answer.read())
        except HTTPError as error:
            return {"status": error.code, "body": _read(error.read())}


@contextmanager
def serving(product: Product) -> Iterator[Server]:
    """Serve the cell until the block ends."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        address = f"127.0.0.1:{free.getsockname()[1]}"
    process = product.start("serve", "wiping", "--cell", f"{CELL}.ttl", "--backend", "kinematic", "--bind", address)
    server = Server(f"http://{address}", replace(product, environment={"SKILLC_SERVER": f"http://{address}"}))
    try:
        _wait_ready(server)
        yield server
    finally:
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=LONG_S)


def _wait_ready(server: Server) -> None:
    end = time.monotonic() + LONG_S
    while time.monotonic() < end:
        try:
            if server.get(f"/cells/{CELL}").get("state") == "operational":
                return
        except (URLError, OSError):
            pass
        time.sleep(LOOK_S)
    raise TimeoutError("the server is not ready")


def _read(body: bytes) -> Any:
    try:
        return json.loads(body)
    except ValueError:
        return body.decode("utf-8", "replace")
