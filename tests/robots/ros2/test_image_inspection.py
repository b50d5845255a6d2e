"""A surface is inspected by the images of a camera of ROS 2 in another process."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

pytest.importorskip("cv2")

from robots.ros2.nodes import receiving, wait_until
from robots.ros2.running import LOOPBACK, TESTS
from simulation.cells import LAB, world
from skillc_runtime.backends.ros2.image_inspection import Ros2ImageInspection, read_image_topics
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.awaited_image import WAIT_S
from skillc_runtime.primitives.inspect import Inspect
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.vision.inspected_surface import InspectedSurface, Markers, SurfaceLook
from skillc_runtime.vision.picture import write_image
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COVERAGE, IS_CLEAN, ROS2
from vision import pictures
from waiting import LONG_S

pytestmark = pytest.mark.slow
TABLE, EYE = LAB + "Table-1", LAB + "Eye-1"


@contextmanager
def publishing(file: Path, encoding: str) -> Iterator[subprocess.Popen[str]]:
    """Run a camera in a process of its own."""
    lens = [str(each) for each in (pictures.LENS.fx, pictures.LENS.fy, pictures.LENS.cx, pictures.LENS.cy)]
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-m", "robots.ros2.publish_image", str(file), encoding, *lens],
        stdout=subprocess.PIPE, text=True, env={**os.environ, **LOOPBACK, "PYTHONPATH": path},
    )  # fmt: skip
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "publishing\n"
        yield process
    finally:
        process.kill()
        process.wait(LONG_S)


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8"])
def test_what_is_dirty_is_sensed_by_the_images_of_a_topic(encoding: str, tmp_path: Path) -> None:
    table = InspectedSurface(np.array([0.3, 0.4]), SurfaceLook(), Markers(0.036))
    dirt = np.zeros((800, 600))
    dirt[:200] = 1.0
    taken = pictures.take_photo(table, dirt)
    write_image(taken.image, tmp_path / "table.png")
    state = world("iiwa_watched")
    at = pose(state, TABLE) @ taken.believed.inverse()
    topic = SetProperty(EYE, ROS2 + "imageTopic", "/eye/image_raw")
    model = WorldModel(state.with_changes([*relocation_changes(state, EYE, at), topic]))
    topics = read_image_topics(model.snapshot())
    assert topics is not None
    assert (topics.image, topics.info) == ("/eye/image_raw", "/eye/camera_info")
    with receiving(lambda receiver: Ros2ImageInspection(topics, model, {}, receiver)) as camera:
        cell = cast(Cell, SimpleNamespace(now=0.0, world=model, camera=lambda: camera))
        with publishing(tmp_path / "table.png", encoding):
            look = Inspect(cell, surface=TABLE)
            look.start()
            wait_until(lambda: look.tick() is Status.SUCCESS)
        judge(model)
        forget_images(camera, cell)


def judge(model: WorldModel) -> None:
    state = model.snapshot()
    assert state.value(TABLE, IS_CLEAN) is False
    assert state.value(TABLE, COVERAGE) == pytest.approx(0.75, abs=0.03)
    write = model.deciding_write(PropertyFact(TABLE, IS_CLEAN))
    assert write is not None
    assert write.evidence == "sensed"


def forget_images(camera: Any, cell: Any) -> None:
    """A camera that is silent tells nothing, however lately it was heard."""
    late = Inspect(cell, surface=TABLE)
    late.start()
    assert late.tick() is Status.RUNNING
    with pytest.raises(NoSuchDevice, match="no new image of /eye/image_raw has come"):
        camera.look(TABLE)
    cell.now = WAIT_S + 1.0
    with pytest.raises(SkillFailure, match="no new image of /eye/image_raw has come for 5 s"):
        late.tick()
