"""A server and its cells start soon: they do not import what only others need."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

HEAVY = {"matplotlib", "mujoco", "numba", "PIL", "scipy"}


@pytest.mark.parametrize(
    ("module", "heavy"), [("skillc.server.serve", HEAVY), ("skillc.cells.process", {"matplotlib", "PIL"})]
)
def test_a_process_imports_only_what_it_needs(module: str, heavy: set[str]) -> None:
    code = f"import {module}, sys; print(*({heavy!r} & sys.modules.keys()))"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    ran = subprocess.run((sys.executable, "-c", code), env=environment, capture_output=True, text=True, check=True)
    assert ran.stdout.split() == []
