"""What a first wiping leaves is seen by a camera, wiped again and seen to be clean; the simulator agrees."""

from __future__ import annotations

import pytest

from sim.test_tasks import LAB, library, start
from skillc_runtime.backends.simulation.cameras.image_camera import ImageCamera
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.recording.events import Event, ImplementationChosen

LEFT = 0.25
"""How much dirt a place may have that a camera takes to be clean, of all that a place can have."""


@pytest.mark.sim
@pytest.mark.parametrize("task", ["clean_watched", "clean_by_wrist_camera"])
def test_what_is_left_is_seen_and_wiped_again(task: str) -> None:
    prepared, cell = start(task, 6)
    ways: list[str] = []

    def listen(event: Event) -> None:
        if isinstance(event, ImplementationChosen) and event.skill == "Wipe":
            ways.append(event.implementation.rpartition(".")[2])

    ended = execute_task(prepared, library(), cell, [listen])
    assert (ended.status, ended.verified, ended.false_claims) == ("succeeded", True, ())
    assert ways == ["wipe_watched", "wipe_dirt", "wipe_patches"]
    camera = cell.camera()
    assert isinstance(camera, ImageCamera)
    assert (camera.true_amounts(LAB + "Table-1") < LEFT).mean() > 0.97
