"""The facts that the success of a task rests on, its goal or what its calls claim, and how they are known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from skillc_compiler.library.conditions import Condition
from skillc_runtime.recording.known import KnownFact
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.grounds import Ground, grounds
from skillc_runtime.world.labelled import label_fact
from skillc_runtime.world.model import WorldModel
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value

Claim: TypeAlias = tuple[Condition, Mapping[str, Value]]
"""A condition with what the names in it stand for."""


def known_facts(claims: Iterable[Claim], world: WorldModel) -> tuple[KnownFact, ...]:
    """Return the facts that the claims rest on, each once; a claim that does not hold any more has none."""
    state = world.snapshot()
    found = {
        ground.fact: ground
        for condition, bindings in claims
        if evaluate(condition, state, bindings)
        for ground in grounds(condition, world, bindings)
    }
    return tuple(_known(ground, state) for ground in found.values())


def _known(ground: Ground, state: WorldState) -> KnownFact:
    fact, established = label_fact(ground.fact, state), ground.established
    if established is None or established.evidence is None:
        return KnownFact(fact=fact, known="given")
    return KnownFact(fact=fact, known=established.evidence, by=established.origin)
