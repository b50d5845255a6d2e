"""The same tasks in all bodies: each succeeds, is done well, and commands nothing beyond the limits of a maker."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from robots.bodies import BODIES, TaskName, find_bodies, run

pytestmark = [pytest.mark.robot, pytest.mark.long]


@pytest.mark.parametrize("task_name", get_args(TaskName))
@pytest.mark.parametrize("name", sorted(BODIES))
def test_it_does_its_task(name: str, task_name: TaskName, tmp_path: Path) -> None:
    found = dict(find_bodies([name]))
    if name not in found:
        pytest.skip(f"what drives {name} is not installed")
    task = found[name].task(task_name, tmp_path)
    if task is None:
        pytest.skip(f"{name} has nothing to {task_name} with")
    figures = run(found[name], task, tmp_path)
    print(figures)
    assert figures.outcome == "succeeded"
    assert figures.violations == 0
    if task_name == "wipe":
        assert figures.coverage == pytest.approx(1.0, abs=0.01)
        assert figures.rmse is not None
        assert figures.rmse < 0.25
        assert figures.tilt_rms_deg is not None
        assert figures.tilt_rms_deg < 1.0
    elif task_name == "pick and place":
        assert figures.missed_mm is None or figures.missed_mm < 20.0
    else:
        assert figures.pressed_n is not None
