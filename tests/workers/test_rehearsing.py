"""A twin is the cell as it is known: arms and grippers as they report, all else as the facts say."""

from __future__ import annotations

from pathlib import Path

import pytest

from running_cells.test_reality import TABLE, make_settings, reality
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.cells.snapshot import decode_snapshot
from skillc.contract.operation import OperationRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.server.jobs.kinds.rehearsal import rehearse
from skillc.services.project.backends import BackendName
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.backends.simulation.checkpoint import decode_checkpoint

MAX_TICKS = 20_000


def run_until_held(host: CellHost) -> None:
    """Run the task until its tool is held; the operation then goes on, as far as the cell is ticked."""
    host.submit("first", OperationRequest(task=TABLE[1]))
    gripper = reality(host).gripper(next(iter(reality(host).scene.arms)).gripper.individual)  # type: ignore[union-attr]
    while gripper.counted == "" and host.loop.ticks < MAX_TICKS:
        if not host.tick():
            host.loop.wait(0.1)
    assert gripper.counted


@pytest.mark.slow
@pytest.mark.parametrize(
    ("backend", "filmed"), [("kinematic", False), pytest.param("mujoco", True, marks=pytest.mark.sim)]
)
def test_a_twin_holds_what_the_gripper_reports(tmp_path: Path, backend: BackendName, filmed: bool) -> None:
    with open_cell(make_settings(tmp_path, TABLE, backend), SilentReporter()) as host:
        run_until_held(host)
        known = decode_snapshot(host.take_twin())
        before = host.world.sequence
        folder = tmp_path / "rehearsal"
        done = rehearse(RehearsalRequest(task=TABLE[1], film=filmed), folder, known)
        assert (done.status, [each.skill for each in done.plan]) == ("succeeded", ["Wipe"]), done.failure
        assert host.world.sequence == before and (folder / "film.mp4").exists() == filmed


def test_a_twin_knows_nothing_that_only_the_simulation_knows(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, TABLE, "kinematic"), SilentReporter()) as host:
        run_until_held(host)
        devices = decode_checkpoint(decode_snapshot(host.take_twin()).devices)
        (held,) = (each.counted for each in devices.grippers.values())
        assert set(devices.places) == {held} and not devices.bases and not devices.worked
        prefixes = tuple(reality(host).drawing.prefixes.values())
        assert devices.joints and all(name.startswith(prefixes) for name in devices.joints)
