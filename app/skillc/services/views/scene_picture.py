"""Makes the picture of a scene: nested boxes show what holds what, their lines the other relations."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from skillc_compiler.emit.picture.boxes import Look, PictureBox
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    CONTAINER_STATE,
    DEVICE_STATE,
    END_EFFECTOR,
    HOLDS_DEEP,
    IS_CLEAN,
    LOCATION,
    MANIPULATABLE,
    ROBOT,
    SCENE,
    SENSOR,
    SURFACE,
    TRANSFORMATION_POSE,
)
from skillc_runtime.world.state.values import show
from skillc_runtime.world.state.world_state import WorldState

LOOKS: tuple[tuple[str, Look, str], ...] = (
    (SCENE, "heading", "◆"),
    (ROBOT, "call", "R"),
    (ARM_DEVICE, "call", "A"),
    (END_EFFECTOR, "call", "G"),
    (SENSOR, "call", "S"),
    (TRANSFORMATION_POSE, "time", "+"),
    (LOCATION, "flow", "▢"),
    (SURFACE, "code", "▤"),
    (MANIPULATABLE, "guard", "●"),
)
"""The look and symbol of individuals by class; the first matching row applies."""
OTHER: tuple[Look, str] = ("heading", "·")
PROPERTIES = (DEVICE_STATE, IS_CLEAN, CONTAINER_STATE)
"""The properties that describe the state of an individual."""


@dataclass(frozen=True, slots=True)
class _Scene:
    state: WorldState
    own: frozenset[str]
    labels: dict[str, str]
    holding: tuple[str, ...]


def draw_boxes(state: WorldState, own: frozenset[str], labels: dict[str, str], title: str) -> PictureBox:
    """Return the picture of a scene's own individuals, with a title."""
    above = state.vocabulary.super_relations
    scene = _Scene(
        state, own, labels, tuple(sorted(iri for iri in above if HOLDS_DEEP in above[iri] and iri != HOLDS_DEEP))
    )
    held: dict[str, list[str]] = {}
    for one in sorted(own):
        holder = _holder(scene, one)
        if holder is not None:
            held.setdefault(holder, []).append(one)
    inside = {one for members in held.values() for one in members}
    seen: set[str] = set()
    boxes = [_box(scene, one, held, seen) for one in sorted(own - inside)]
    boxes += [_box(scene, one, held, seen) for one in sorted(own) if one not in seen]
    return PictureBox("heading", "◇", title, (f"{len(own)} individuals",), tuple(boxes))


def _holder(scene: _Scene, one: str) -> str | None:
    """Return the holder of an individual, the first by IRI; None without one."""
    holders = {h for relation in scene.holding for h in scene.state.subjects(relation, one)} & scene.own - {one}
    return min(holders, default=None)


def _box(scene: _Scene, one: str, held: dict[str, list[str]], seen: set[str]) -> PictureBox:
    seen.add(one)
    look, symbol = _look(scene.state, one)
    short = scene.state.vocabulary.short
    types = ", ".join(map(short, sorted(scene.state.types(one))))
    lines = [f"{scene.labels[one]}, {types}" if one in scene.labels else types, *_relations(scene, one, held)]
    children = tuple(_box(scene, each, held, seen) for each in held.get(one, ()) if each not in seen)
    return PictureBox(look, symbol, short(one), tuple(lines), children)


def _relations(scene: _Scene, one: str, held: dict[str, list[str]]) -> Iterable[str]:
    """Yield the relations that the nested boxes do not show, and the state of the individual."""
    state, short = scene.state, scene.state.vocabulary.short
    below = held.get(one, ())
    for relation, links in sorted(state.asserted.items()):
        others = sorted(links.forward.get(one))
        shown = [short(other) for other in others if relation not in scene.holding or other not in below]
        if shown:
            yield f"{short(relation)} {', '.join(shown)}"
    for property_ in PROPERTIES:
        value = state.value(one, property_) if property_ in state.stored else None
        if value is not None:
            yield f"{short(property_)} {show(value)}"


def _look(state: WorldState, one: str) -> tuple[Look, str]:
    fitting = ((look, symbol) for cls, look, symbol in LOOKS if state.is_a(one, cls))
    return next(fitting, OTHER)
