"""What is wrong in cells, and what that depends on: finding it imports the simulator and solves inverse kinematics."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import describe_models, describe_scene, encode_meaning
from skillc_dsl.query import Memo
from skillc_model.conditions import Condition
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.fact_list import list_facts
from skillc_runtime.world.state.world_state import WorldState

_ENCODER = msgspec.msgpack.Encoder(order="deterministic")


def judge_cell(scene: LoadedScene, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return everything that is wrong with the things in a cell, also because of goals, each once."""
    return _judge(scene.state, goals)


def judge_state_once(state: WorldState, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return what `judge_cell` returns of a scene with these facts, from the cache if it is there."""
    parts = (encode_meaning(state.vocabulary), *describe_models(), *map(_ENCODER.encode, list_facts(state)))
    store = AnswerStore()
    found = Memo(store).recall("cell", (*parts, encode_meaning(tuple(goals))), lambda: _judge(state, goals))
    store.flush()
    return found


def _judge(state: WorldState, goals: Sequence[Condition]) -> tuple[SceneViolation, ...]:
    # The simulator and the compiler of numerical code are slow to import.
    from skillc.services.cell_checks.checks import check_cell

    return check_cell(state, goals)


def describe_judgement(scene: LoadedScene, goals: Sequence[Condition]) -> Iterator[str | bytes]:
    """Yield the scene and the goals that a verdict depends on."""
    yield from describe_scene(scene)
    yield encode_meaning(tuple(goals))
