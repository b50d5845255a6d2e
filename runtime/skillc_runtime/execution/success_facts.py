"""The facts that the success of a task rests on, and how each is known."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, TypeAlias

import msgspec
from msgspec import structs

from skillc_model.conditions import Condition
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.grounds import Ground, find_grounds
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.evidence import DecidingWrite, weakest
from skillc_runtime.world.state.labels.labelled import LabelledFact
from skillc_runtime.world.state.labels.labelling import label_fact, label_property
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import PUSH_FORCE
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Claim: TypeAlias = tuple[Condition, Mapping[str, Value]]
"""A condition that is claimed to hold, with the values of its variables."""


class BrokenCall(msgspec.Struct, frozen=True):
    """A run of an implementation that ended without success, during the writes after number `after` up to `last`.

    `individuals` are those that its parameters and values name: others may have written beside it.
    """

    status: Literal["failed", "halted"]
    after: int
    last: int
    individuals: frozenset[str]

    def has_written(self, number: int, individual: str) -> bool:
        """Whether a write, by its number, of an individual was made by this call."""
        return self.after < number <= self.last and individual in self.individuals


def collect_success_facts(claims: Iterable[Claim], world: WorldModel, with_physics: bool) -> tuple[KnownFact, ...]:
    """Return the facts that the claims rest on, each once; none for a claim that no longer holds.

    `with_physics` is whether the cell is a simulation with physics.
    """
    state = world.snapshot()
    found = {
        ground.fact: ground
        for condition, bindings in claims
        if evaluate(condition, state, bindings)
        for ground in find_grounds(condition, world, bindings)
    }
    return tuple(_make_known_fact(ground, state, with_physics) for ground in found.values())


def collect_forces(
    world: WorldModel,
    writes_before: int,
    broken: Sequence[BrokenCall],
    arms: frozenset[str] | None,
    with_physics: bool,
) -> tuple[KnownFact, ...]:
    """Return with which force each of the arms, all if None, has pushed since write number `writes_before`.

    Of several pushes the one that is known worst counts. Those of `broken` calls do not: no success rests on them.
    """
    pushes: dict[str, list[tuple[SetProperty, DecidingWrite]]] = {}
    for write in world.ledger.writes:
        for change in write.changes if write.decides.number > writes_before else ():
            if not isinstance(change, SetProperty) or change.property != PUSH_FORCE:
                continue
            if not any(call.has_written(write.decides.number, change.individual) for call in broken):
                pushes.setdefault(change.individual, []).append((change, write.decides))
    worst = {arm: _worst(made) for arm, made in pushes.items()}
    words = world.snapshot().vocabulary
    return tuple(
        _explain(_know(label_property(arm, PUSH_FORCE, change.value, words), known, with_physics))
        for arm, (change, known) in sorted(worst.items())
        if arms is None or arm in arms
    )


def _worst(pushes: Sequence[tuple[SetProperty, DecidingWrite]]) -> tuple[SetProperty, DecidingWrite]:
    known = weakest(each for _, each in pushes)
    return next(each for each in pushes if each[1] == known)


def _explain(force: KnownFact) -> KnownFact:
    """Return what is known of a force, with the doubt that `Push` has written beside its name."""
    by, _, why = force.by.partition(": ")
    return structs.replace(force, by=by, why=why)


def _make_known_fact(ground: Ground, state: WorldState, with_physics: bool) -> KnownFact:
    return _know(label_fact(ground.fact, state), ground.write, with_physics)


def _know(fact: LabelledFact, established: DecidingWrite | None, with_physics: bool) -> KnownFact:
    if established is None or established.evidence is None:
        return KnownFact(fact=fact, known="given")
    return KnownFact(fact=fact, known=established.evidence, by=established.origin, with_physics=with_physics)
