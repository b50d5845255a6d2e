"""A task runs on the backend that its user chooses, and the recording says on which."""

from __future__ import annotations

import pytest

from operating.monitors import Monitor
from skillc.services.project.backends import BackendName
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskStarted
from skillc_runtime.recording.run_spec import RunSpec

PICK = "Pick(arm: lab:Iiwa-1, object: lab:Eraser-1)"


@pytest.mark.parametrize(
    ("backend", "verified"), [pytest.param("mujoco", True, marks=pytest.mark.sim), ("kinematic", False)]
)
def test_a_grasp_is_verified_with_physics_only(backend: BackendName, verified: bool) -> None:
    spec, envelopes = RunSpec(scene="iiwa_table", call=PICK, backend=backend), list[Envelope]()
    with load_task(spec, SilentReporter()) as task:
        options = RunOptions(spec, recorders=(envelopes.append,))
        ran = run_task(task, options, Monitor(), SilentReporter())
    assert (ran.result.status, ran.result.verified) == ("succeeded", verified)
    assert isinstance(started := envelopes[0].event, TaskStarted) and started.backend == backend
    assert started.settings == spec
