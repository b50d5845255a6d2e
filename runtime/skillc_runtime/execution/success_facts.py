"""The facts that the success of a task rests on, and how each is known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from skillc_model.conditions import Condition
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.grounds import Ground, find_grounds
from skillc_runtime.world.state.labelled import label_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Claim: TypeAlias = tuple[Condition, Mapping[str, Value]]
"""A condition that is claimed to hold, with the values of its variables."""


def collect_success_facts(claims: Iterable[Claim], world: WorldModel) -> tuple[KnownFact, ...]:
    """Return the facts that the claims rest on, each once; none for a claim that no longer holds."""
    state = world.snapshot()
    found = {
        ground.fact: ground
        for condition, bindings in claims
        if evaluate(condition, state, bindings)
        for ground in find_grounds(condition, world, bindings)
    }
    return tuple(_make_known_fact(ground, state) for ground in found.values())


def _make_known_fact(ground: Ground, state: WorldState) -> KnownFact:
    fact, established = label_fact(ground.fact, state), ground.write
    if established is None or established.evidence is None:
        return KnownFact(fact=fact, known="given")
    return KnownFact(fact=fact, known=established.evidence, by=established.origin)
