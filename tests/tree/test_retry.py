"""What lacked space is not retried unless something stands elsewhere by then."""

from __future__ import annotations

import pytest

from skillc_model import tree
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, Note
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.model import WorldModel
from space.rooms import at, lab, thing, world
from tree.library import Library, act, here
from tree.stage import PERIOD_S, Script, Stage

CUP = lab("Cup")


def retried(ending: str, moved_m: float) -> tuple[int, list[str]]:
    """Retry up to three times what ends so; the cup is moved in each round. Return the number of starts, and notes."""
    room = WorldModel(world(thing("Cup", at(0.5, 0.0, 0.7), size=(0.1, 0.1, 0.1))))
    stage, events = Stage(room, {"a": [Script(ending, 2)]}), list[Event]()  # type: ignore[arg-type]
    run = TreeRun(tree.Retry(count=3, child=act("a"), source=here()), Library().build(), stage, [events.append])
    while run.tick() is Status.RUNNING:
        stage.now += PERIOD_S
        x, y, z = pose(room.snapshot(), CUP).position.tolist()
        room.commit(placement_changes(CUP, at(x + moved_m, y, z)), "test")
    assert run.status is Status.FAILURE
    return stage.starts["a"], [each.message for each in events if isinstance(each, Note)]


@pytest.mark.parametrize(
    ("ending", "moved_m", "starts"), [("cramped", 0.001, 1), ("cramped", 0.02, 3), ("fail", 0.001, 3)]
)
def test_what_lacked_space_is_retried_only_if_something_stands_elsewhere(
    ending: str, moved_m: float, starts: int
) -> None:
    started, notes = retried(ending, moved_m)
    assert started == starts
    assert [each.startswith("not again: it would lack the same space") for each in notes] == [True] * (starts == 1)
