"""A server, its cells and its clients start soon: they do not import what only others need."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

HEAVY = {"matplotlib", "mujoco", "numba", "PIL", "scipy"}
CLIENT_FILES = 125
"""How many files of skillc a client of a server may import: the contract, and not the engine."""


@pytest.mark.parametrize(
    ("module", "heavy"), [("skillc.server.serve", HEAVY), ("skillc.cells.program", {"matplotlib", "PIL"})]
)
def test_a_process_imports_only_what_it_needs(module: str, heavy: set[str]) -> None:
    assert not heavy & list_imported(module)


def test_a_client_imports_the_contract_and_not_the_product() -> None:
    found = list_imported("skillc.client.server", "skillc.client.connecting")
    own = {each for each in found if each.partition(".")[0].startswith("skillc")}
    assert {"skillc.client.async_cell", "skillc.contract.operation", "skillc.events"} <= own
    assert len(own) < CLIENT_FILES, sorted(own)
    assert not {*HEAVY, "numpy", "sqlite3", "lark", "starlette"} & found


def list_imported(*modules: str) -> set[str]:
    """Return what a new process has imported after it has imported modules."""
    code = f"import {', '.join(modules)}, sys; print(*sys.modules)"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    ran = subprocess.run((sys.executable, "-c", code), env=environment, capture_output=True, text=True, check=True)
    return set(ran.stdout.split())
