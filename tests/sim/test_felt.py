"""Without a camera that gives images, an arm feels what a wipe has left on a table, and wipes that again."""

from __future__ import annotations

import numpy as np
import pytest

from sim.test_spots import SPOT, TABLE
from sim.test_tasks import library
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.dirt_map import DIRTY, parse_dirt_map
from skillc_runtime.primitives.feel_dirt import FeelDirt
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.recording.events import Event, ImplementationChosen, WorldChanged
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import ClearProperty, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DIRT_FRICTION, DIRT_MAP, DIRT_REMOVAL

pytestmark = pytest.mark.sim

REMOVAL_S = 2.0
"""Dirt that takes so long to fall to 1/e is not gone when it has been felt."""

LEFT_ROWS, LEFT_COLUMNS = slice(14, 30), slice(6, 20)
"""Cells of 5 mm that are dirty although the map says otherwise."""


@pytest.fixture
def no_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no GL library be found."""
    monkeypatch.setenv("PYOPENGL_PLATFORM", "none")


@pytest.mark.usefixtures("no_images")
def test_what_is_left_is_felt_and_wiped_again() -> None:
    task = library().tasks["clean_watched"]
    assert task.scene is not None
    assert task.goal is not None
    world = WorldModel(load_scene(catalogue.scene_path(task.scene), library().vocabulary))
    world.commit([SetProperty(TABLE, DIRT_MAP, SPOT), SetProperty(TABLE, DIRT_REMOVAL, REMOVAL_S)], "test", "stated")
    prepared = prepare_task(Assignment("clean_watched", world.snapshot(), AchieveGoal(task.goal)), library())
    assert isinstance(prepared, PreparedTask), prepared
    cell = SimulatedCell(WorldModel(world.snapshot()), 3)
    covered = cell.coverage[TABLE]
    covered.clean[LEFT_ROWS, LEFT_COLUMNS] = False
    maps: list[str] = []
    dirty: list[np.ndarray[tuple[int, int], np.dtype[np.bool_]]] = []
    ways: list[str] = []

    def listen(event: Event) -> None:
        if isinstance(event, ImplementationChosen) and event.skill == "InspectByArm":
            ways.append(event.implementation.rpartition(".")[2])
        if isinstance(event, WorldChanged) and event.origin == "FeelDirt":
            assert event.known == "sensed"
            maps.append(str(cell.world.snapshot().value(TABLE, DIRT_MAP)))
            dirty.append(covered.find_dirt(REMOVAL_S) > 0.25)

    ended = execute_task(prepared, library(), cell, [listen])
    assert (ended.status, ended.verified, ended.false_claims) == ("succeeded", True, ())
    assert ways == ["by_touch"] * 2
    felt = [np.frombuffer(parse_dirt_map(each).state, dtype=np.uint8).reshape(80, 60) == DIRTY for each in maps]
    assert dirty[0].mean() > 0.03
    assert felt[0][dirty[0]].mean() > 0.9
    assert felt[0].mean() < 0.2
    assert not felt[1].any()
    assert not dirty[1].any()


@pytest.mark.usefixtures("no_images")
def test_dirt_that_rubs_as_the_surface_does_cannot_be_felt() -> None:
    world = WorldModel(load_scene(catalogue.scene_path("iiwa_watched"), library().vocabulary))
    world.commit([ClearProperty(TABLE, DIRT_FRICTION)], "test", "stated")
    cell = SimulatedCell(world)
    feel = FeelDirt(
        cell, arm=TABLE.replace("Table", "Iiwa"), surface=TABLE, tool=TABLE.replace("Table", "Eraser"), rub=10.0
    )
    with pytest.raises(SkillFailure, match="skillc:dirtFriction"):
        feel.start()
