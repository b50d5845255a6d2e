"""`skillc serve --ros2`: a cell is seen in ROS 2, and operated from there; by another node, as a user's would be."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from robots.ros2.running import LOOPBACK
from skillc_runtime.backends.ros2.session import Session, Subscription
from waiting import LONG_S

pytestmark = pytest.mark.slow

KINDS = {
    "joint_states": "sensor_msgs/msg/JointState",
    "Ur5e_1/wrench": "geometry_msgs/msg/WrenchStamped",
    "markers": "visualization_msgs/msg/MarkerArray",
    "library": "std_msgs/msg/String",
    "status": "std_msgs/msg/String",
    "tree": "std_msgs/msg/String",
    "answer": "std_msgs/msg/String",
}
CELL = "/skillc/ur5e_whiteboard/"


class Watcher:
    """A node that sees a cell."""

    def __init__(self) -> None:
        self.session = Session("watcher")
        self._topics: dict[str, Subscription] = {
            name: self.session.subscribe(
                CELL + name, kind, reliable=True, latched=name in ("library", "status", "tree")
            )
            for name, kind in KINDS.items()
        }
        self._orders = self.session.publish(CELL + "order", "std_msgs/msg/String", reliable=True)
        self.last: dict[str, Any] = {}

    def wait_for(self, topic: str, holds: Callable[[Any], bool] = lambda _: True) -> Any:
        """Return the first message of a topic from now on for which something holds; texts are JSON."""
        end = time.monotonic() + LONG_S
        while time.monotonic() < end:
            self.session.wait(0.1)
            for name, each in self._topics.items():
                while (message := each.take()) is not None:
                    found = json.loads(message.data) if hasattr(message, "data") else message
                    self.last[name] = found
                    if name == topic and holds(found):
                        return found
        raise AssertionError(f"{topic} has not come; last: {self.last.get(topic)}")

    def wait_for_state(self, *states: str) -> Any:
        """Wait until the last operation is in one of some states."""
        return self.wait_for("status", lambda it: bool(it["operations"]) and it["operations"][-1]["state"] in states)

    def call(self, word: str) -> str | None:
        """Call a service of the cell; return why it has not succeeded, or None."""
        return self.session.call(CELL + word, LONG_S)

    def order(self, **wanted: Any) -> Any:
        """Publish an order and return its answer."""
        self._orders.publish(self._orders.msg_type(data=json.dumps(wanted)))
        return self.wait_for("answer", lambda it: it["id"] == wanted.get("id", ""))


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watcher]:
    """Return a node that sees a cell without physics."""
    folder = tmp_path_factory.mktemp("served")
    command = [sys.executable, "-m", "skillc", "serve", "wiping", "--cell", "ur5e_whiteboard.ttl"]
    options = ["--backend", "kinematic", "--bind", "127.0.0.1:0", "--state", "served", "--ros2"]
    with (folder / "log").open("w") as log:
        process = subprocess.Popen(
            [*command, *options], cwd=folder, env={**os.environ, **LOOPBACK}, stdout=log, stderr=log
        )
    watcher = Watcher()
    try:
        watcher.wait_for("status", lambda it: it["state"] == "operational")
        yield watcher
    finally:
        watcher.session.close()
        process.terminate()
        process.wait(LONG_S)
        assert "all devices are at rest" in Path(folder / "log").read_text()


def test_joints_have_the_names_of_the_facts_and_things_are_drawn(seen: Watcher) -> None:
    joints = seen.wait_for("joint_states")
    assert joints.name[:2] == ["shoulder_pan_joint", "shoulder_lift_joint"]
    assert len(joints.name) == len(joints.position) == len(joints.velocity) > 6
    assert seen.wait_for("Ur5e_1/wrench").header.frame_id == "Ur5e_1_base"
    drawn = {each.ns for each in seen.wait_for("markers").markers}
    assert {"lab:Eraser-1", "lab:Whiteboard-1"} <= drawn
    assert "clean_whiteboard" in json.dumps(seen.last["library"])


def test_a_goal_is_started_paused_resumed_and_stopped(seen: Watcher) -> None:
    answer = seen.order(command="start", goal="lab:Whiteboard-1.isClean == true", id="7")
    assert (answer["success"], answer["id"]) == (True, "7"), answer
    seen.wait_for_state("running")
    tree = seen.wait_for("tree", lambda it: len(it["nodes"]) > 3)
    assert tree["operation"] == answer["operation"]
    assert "running" in {each["status"] for each in tree["nodes"]}
    assert seen.call("pause") is None
    seen.wait_for_state("paused")
    assert seen.call("resume") is None
    seen.wait_for_state("running")
    assert seen.call("stop") is None
    stopped = seen.wait_for_state("stopped")
    assert stopped["operations"][-1]["reason"]


def test_what_is_refused_is_answered_with_the_reason(seen: Watcher) -> None:
    assert "dance" in seen.order(command="start", task="dance", id="a")["message"]
    assert "this is no order" in seen.order(command="dance")["message"]
    refusal = seen.call("pause")
    assert refusal is not None
    assert "ur5e_whiteboard has no ongoing operation" in refusal
    refusal = seen.call("acknowledge")
    assert refusal is not None
    assert "no fault" in refusal


def test_start_without_more_starts_again_what_was_done_last(seen: Watcher) -> None:
    assert seen.call("start") is None
    seen.wait_for_state("running", "planning")
    assert seen.call("stop") is None
    seen.wait_for_state("stopped")
