"""The tree of an operation in ROS 2: its last change is published too, however soon after another one it comes."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from skillc.events import NodeEnded, NodeStarted
from skillc.ros.cell_bridge import PERIOD_S, StartedNodes
from skillc_dsl.position import Position

PLACE = Position("a.skill", 1, 1)


def started(node: int) -> NodeStarted:
    return NodeStarted(time=0.0, node=node, parent=node - 1, kind="skill", name=f"Skill{node}", source=PLACE)


async def publish(late_s: float) -> list[Any]:
    """Return what is published within a time of a node that starts, and others that start and end at once."""
    published: list[Any] = []
    tree = StartedNodes("7", lambda text: published.append(json.loads(text)))
    tree.take(started(1))
    while not published:
        await asyncio.sleep(0.0)
    for node in (2, 3):
        tree.take(started(node))
    tree.take(NodeEnded(time=0.0, node=3, name="Skill3", status="success", source=PLACE))
    if late_s:
        await asyncio.sleep(late_s)
    tree.close()
    await asyncio.sleep(2 * PERIOD_S)
    return published


def test_changes_within_a_period_are_published_together_when_it_is_over() -> None:
    first, last = asyncio.run(publish(2 * PERIOD_S))
    assert (first["operation"], [each["id"] for each in first["nodes"]]) == ("7", [1])
    assert [(each["id"], each["status"]) for each in last["nodes"]] == [(1, "running"), (2, "running"), (3, "success")]


def test_nothing_is_published_after_the_end() -> None:
    assert len(asyncio.run(publish(0.0))) == 1
