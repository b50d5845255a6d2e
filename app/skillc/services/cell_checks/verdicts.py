"""Caches what is wrong in cells, because finding it imports the simulator and solves inverse kinematics.

The key of an entry is the digest of the facts about the cell, the goals, the user's models and the installation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import msgspec

from skillc.services.library.cache_entries import describe_models, describe_scene, encode_meaning, find_entry
from skillc_dsl import cache
from skillc_model.conditions import Condition
from skillc_runtime.scene.load import Scene
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.fact_list import list_facts
from skillc_runtime.world.state.world_state import WorldState

_ENCODER = msgspec.msgpack.Encoder(order="deterministic")
_MOST = 500
"""The most entries in the cache; beyond it the older half is deleted."""


def judge_cell(scene: Scene, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return everything that is wrong with the things in a cell, also because of goals, each once."""
    return _judge(scene.state, goals)


def judge_cell_once(scene: Scene, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return what `judge_cell` returns, from the cache if it is there."""
    return _recall(_inputs(scene, goals), lambda: judge_cell(scene, goals))


def judge_state_once(state: WorldState, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return what `judge_cell` returns of a scene with these facts, from the cache if it is there."""
    parts = (encode_meaning(state.vocabulary), *describe_models(), *map(_ENCODER.encode, list_facts(state)))
    return _recall((*parts, encode_meaning(tuple(goals))), lambda: _judge(state, goals))


def _judge(state: WorldState, goals: Sequence[Condition]) -> tuple[SceneViolation, ...]:
    # The simulator and the compiler of numerical code are slow to import.
    from skillc.services.cell_checks.checks import check_cell

    return check_cell(state, goals)


def _recall(
    inputs: Iterable[str | bytes], find: Callable[[], tuple[SceneViolation, ...]]
) -> tuple[SceneViolation, ...]:
    path = find_entry("cells", inputs)
    found = _read(cache.load(path)) if path else None
    if found is None:
        found = find()
        if path:
            cache.store(path, msgspec.json.encode(found))
            cache.delete_oldest(path.parent, _MOST, _MOST // 2)
    return found


def _read(body: bytes | None) -> tuple[SceneViolation, ...] | None:
    if body is None:
        return None
    try:
        return msgspec.json.decode(body, type=tuple[SceneViolation, ...])
    except msgspec.MsgspecError:
        return None


def _inputs(scene: Scene, goals: Sequence[Condition]) -> Iterator[str | bytes]:
    """Yield the scene and the goals that a verdict depends on."""
    yield from describe_scene(scene)
    yield encode_meaning(tuple(goals))
