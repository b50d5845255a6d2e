"""Once a cell is ready, no tick waits until a control law is compiled."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys

from skillc.cells.opening import open_cell
from skillc.contract.operation import OperationRequest
from skillc.cells.settings import CellSettings
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.motion.numerics.compiled import list_imported


def count_compiled():
    return sum(each.code is not None for each in list_imported())


scene, task, backend, folder = sys.argv[1:]
settings = CellSettings(name="cell", scene=scene, library="wiping", folder=folder, backend=backend)
with open_cell(settings, SilentReporter()) as host:
    ready = count_compiled()
    host.submit("first", OperationRequest(task=task))
    while host.loop.runs:
        if not host.tick():
            host.loop.wait(0.1)
    (ended,) = host.take_changed()
print(ready, count_compiled() - ready, ended.state)
"""


@pytest.mark.sim
@pytest.mark.parametrize(
    ("scene", "task", "backend"),
    [("iiwa_table.ttl", "clean_table", "kinematic"), ("ur5e_whiteboard.ttl", "clean_whiteboard", "mujoco")],
)
def test_nothing_is_compiled_in_a_tick(tmp_path: Path, scene: str, task: str, backend: str) -> None:
    command = (sys.executable, "-c", PROGRAM, scene, task, backend, str(tmp_path / "cell"))
    ran = subprocess.run(command, capture_output=True, text=True, timeout=500.0, check=False)
    assert ran.returncode == 0, ran.stderr
    compiled_before, compiled_in_ticks, state = ran.stdout.split()
    assert int(compiled_before) > 0 and (compiled_in_ticks, state) == ("0", "succeeded")
