"""The facts that the success of a task rests on, its goal or what its calls claim, and how they are known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias, assert_never

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.vocabulary import local_name
from skillc_runtime.trace.known import KnownFact
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.grounds import Ground, grounds
from skillc_runtime.world.state.facts import Fact, Related, Typed, Valued, fact_text
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

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
    text, established = fact_text(ground.fact, state), ground.established
    if established is None or established.evidence is None:
        return KnownFact(fact=text, known="given")
    wanted = _wanted(ground.fact, established.origin, state) if ground.assumed else ""
    return KnownFact(fact=text, known=established.evidence, by=established.origin, wanted=wanted)


def _wanted(fact: Fact, origin: str, state: WorldState) -> str:
    """Say what would have to be sensed for a fact to be known."""
    short, after = state.vocabulary.short, f" after {origin}" if origin else ""
    match fact:
        case Related(subject, relation, object_, holds):
            there = "holds" if holds else "does not hold"
            name = local_name(relation)
            return f"a device would have to sense{after} that `{short(subject)} {name} {short(object_)}` {there}"
        case Valued(individual, property_):
            return f"a device would have to measure {short(property_)} of {short(individual)}{after}"
        case Typed(individual, cls, holds):
            what = "a" if holds else "no"
            return f"a device would have to recognise{after} that {short(individual)} is {what} {short(cls)}"
        case _:
            assert_never(fact)
