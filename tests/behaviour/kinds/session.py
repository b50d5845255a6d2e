"""A session with a server: its commands as JSON, and the answer to each question that its document lists."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

from behaviour.kinds._serving import CELL, Server, serving
from behaviour.product import Product, file_name, write

SIMULATES = False
COMMANDS = (
    "ps --json",
    f"pace fast {CELL}",
    f"lease take {CELL}",
    f"lease show {CELL}",
    f"plan clean_table --cell {CELL} --json",
    f"start clean_table --cell {CELL} --wait",
    "ps --all --json",
    "logs OPERATION --json",
    f"world --cell {CELL} --json",
    f"world --cell {CELL} --history --json",
    f"rehearse clean_table --cell {CELL} --seed 1 --json",
    f"start no_such_task --cell {CELL}",
    f"start --goal lab:Nothing.isClean --cell {CELL}",
    f"start clean_table --cell {CELL} --at 2099-01-04T07:00:00+00:00 --every 86400",
    f"orders --cell {CELL} --json",
    f"lease release {CELL}",
    "token list --json",
    "acknowledge",
    "stop",
    "state audit",
)
UNSTEADY = ("/metrics", "/health", "/events", "/samples", "/recording")
"""Paths whose answers are other ones each time, or have no end."""


def save(product: Product, folder: Path) -> None:
    """Follow the session, and then ask for all that a server answers without a body."""
    with serving(product) as server:
        for number, words in enumerate(COMMANDS):
            if "OPERATION" in words:
                words = words.replace("OPERATION", _operation(server))
            write(folder / f"{number:02}.txt", server.product.tell(*words.split()))
        for template, path in _questions(server):
            text = json.dumps(server.get(path), indent=1, sort_keys=True)
            write(folder / f"get{file_name(template)}.json", text)


def _questions(server: Server) -> Iterator[tuple[str, str]]:
    """Yield the paths that can be asked for, as in the document and with the names of the cell and its operation."""
    known = {"cell": CELL, "library": "wiping", "operation": _operation(server)}
    for path, methods in server.get("/openapi.json")["paths"].items():
        short = path.removeprefix("/api/v1")
        names = re.findall(r"{(\w+)}", short)
        if "get" in methods and set(names) <= known.keys() and not short.endswith(UNSTEADY):
            yield short, short.format_map(known)


def _operation(server: Server) -> str:
    """Return the id of the only operation that was submitted."""
    answer = json.dumps(server.get(f"/cells/{CELL}/operations"))
    found = re.search(r'"id": "([^"]+)"', answer)
    assert found, answer
    return found[1]
