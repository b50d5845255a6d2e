"""While a path is searched for, the arm holds: where time goes on, for as long as it takes, and a stop ends it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from msgspec import structs

from collision.around import aside, pillar, posture
from execution.actors import SCENE, known_world
from execution.loops import LatePlanner, Watched, submit
from simulation.cells import ARM
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.real_time.cell import RealTimeCell
from skillc_runtime.collision import motion_search, path_planning
from skillc_runtime.collision.path_planning import plan_joint_path
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.primitives.move import TakePosture
from skillc_runtime.recording import commands
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel
from tree.library import Library, act

TICKS, POLL_S = 30, 0.01


class GoAside(TakePosture):
    """Takes the posture `aside`."""

    def __init__(self, cell: Cell, *, name: str) -> None:
        super().__init__(cell, arm=ARM[SCENE], posture="aside", pace=1.0)


@pytest.fixture(autouse=True)
def released(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Let searches go on until a file exists, which is returned."""
    file = tmp_path / "released"

    def search(*arguments: object) -> object:
        while not file.exists():
            time.sleep(POLL_S)
        return plan_joint_path(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(motion_search, "plan_joint_path", search)
    monkeypatch.setattr(path_planning, "SEARCHES", ())
    return file


def begin(*changes: Change) -> tuple[KinematicCell, CellLoop, Watched]:
    """Return a cell with a run that was submitted, and the cell by the wall clock that its loop moves."""
    changed = known_world().with_changes([*posture(SCENE, "aside", aside(SCENE).tolist()), *changes])
    inside = KinematicCell(WorldModel(changed))
    cell = RealTimeCell(inside)
    library = Library("execution.test_held_arms:GoAside").build()
    library = structs.replace(library, vocabulary=changed.vocabulary)
    loop = CellLoop(cell, library, LatePlanner(library))
    return inside, loop, submit(loop, Assignment("act", changed, ExecuteBody(act("aside"))))


@pytest.fixture
def free() -> Iterator[tuple[KinematicCell, CellLoop, Watched]]:
    inside, loop, watched = begin()
    with closing(loop.backend):
        yield inside, loop, watched


@pytest.fixture
def blocked() -> Iterator[tuple[KinematicCell, CellLoop, Watched]]:
    inside, loop, watched = begin(*pillar(SCENE))
    with closing(loop.backend):
        yield inside, loop, watched


def hold(inside: KinematicCell, loop: CellLoop, watched: Watched, released: Path) -> None:
    """Tick while a path is searched for, and the arm holds; then let the search end."""
    watched.until("running")
    before, began = inside.arm(ARM[SCENE]).measured.q, loop.backend.clock.now
    for _ in range(TICKS):
        assert loop.tick() and watched.run.computing
        assert np.abs(inside.arm(ARM[SCENE]).measured.q - before).max() < 1e-3
    assert loop.backend.clock.now - began > 0.9 * TICKS * TICK_S
    released.touch()


@pytest.mark.slow
def test_time_goes_on_while_the_arm_holds_and_then_it_moves(
    free: tuple[KinematicCell, CellLoop, Watched], released: Path
) -> None:
    inside, _, watched = free
    hold(*free, released)
    assert watched.until_end() == "succeeded"
    assert inside.arm(ARM[SCENE]).measured.at_joints(aside(SCENE))


def test_without_a_path_it_fails_and_has_not_moved(
    blocked: tuple[KinematicCell, CellLoop, Watched], released: Path
) -> None:
    inside, _, watched = blocked
    q = inside.arm(ARM[SCENE]).measured.q
    hold(*blocked, released)
    assert watched.until_end() == "failed"
    assert watched.run.failure is not None and "lab:Pillar; no way around was found" in watched.run.failure.message
    assert inside.arm(ARM[SCENE]).measured.at_joints(q)


def test_a_stop_takes_effect_in_its_tick(blocked: tuple[KinematicCell, CellLoop, Watched]) -> None:
    _, loop, watched = blocked
    watched.until("running")
    loop.tick()
    assert watched.run.computing
    watched.request(commands.Stop("enough"))
    assert not watched.run.computing and watched.until_end() == "stopped"
