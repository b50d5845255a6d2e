"""The facts that the success of a task rests on, each with its evidence, as values and as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, assert_never

import msgspec
from msgspec import structs

from skillc_runtime.world.state.labels.labelled import (
    LabelledClass,
    LabelledFact,
    LabelledIdentity,
    LabelledProperty,
    LabelledRelation,
)
from skillc_runtime.world.state.labels.labelled_text import format_fact

UNVERIFIED = "finished, not verified"
"""The status of a task that succeeded if the facts hold that are only assumed or idealised."""

FALSE_SUCCESS = "false success"
"""The status of a task that succeeded by what the world model claims, of which the simulator contradicts something."""


class KnownFact(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A fact and its evidence: `given` before the run, or established by the skill or device `by`.

    `why` it is known no better, if `by` has said so. `with_physics`: what is idealised comes from a simulation with
    physics, in which it counts as verified.
    """

    fact: LabelledFact
    known: Literal["sensed", "reported", "idealised", "assumed", "given"]
    by: str = ""
    why: str = ""
    with_physics: bool = False

    @property
    def is_verified(self) -> bool:
        """Whether more than an assumption confirms it."""
        return self.known != "assumed" and (self.known != "idealised" or self.with_physics)


def unverified_facts(facts: tuple[KnownFact, ...]) -> tuple[KnownFact, ...]:
    """Return the facts that nothing has confirmed: they are only assumed, or were measured without physics."""
    return tuple(fact for fact in facts if not fact.is_verified)


def format_evidence(fact: KnownFact) -> str:
    """Return the evidence for a fact as text, for example `assumed by Place`."""
    known = f"{fact.known} by {fact.by}" if fact.by else fact.known
    return f"{known}, verified in simulation only" if fact.known == "idealised" and fact.with_physics else known


def format_status(status: str, verified: bool | None, false_claims: Sequence[str] = ()) -> str:
    """Return the status of a task as text; a success that is not verified, or is contradicted, is not called one."""
    if status == "succeeded" and false_claims:
        return FALSE_SUCCESS
    return UNVERIFIED if verified is False else status


def format_false_claim(claim: str) -> str:
    """Return a sentence about what the world model claims that is not so in the simulator."""
    return f"contradicted by the simulator: {claim}"


def format_unverified(known: KnownFact) -> str:
    """Return a sentence that a fact is only assumed or idealised, and what would have to be sensed."""
    return f"{format_fact(known.fact)} is only {known.known}: {describe_missing_sensing(known)}"


def describe_missing_sensing(known: KnownFact) -> str:
    """Describe what would have to be sensed to confirm a fact that is only assumed or idealised, or why it was not."""
    if known.why:
        return known.why
    if known.known == "idealised":
        return f"{known.by or 'a device'} measured it without physics; a cell with physics would have to confirm it"
    after = f" after {known.by}" if known.by else ""
    match known.fact:
        case LabelledProperty(individual, property_):
            return f"a device would have to measure {property_.label} of {individual.label}{after}"
        case LabelledClass(individual, cls, holds):
            what = "a" if holds else "no"
            return f"a device would have to recognise{after} that {individual.label} is {what} {cls.label}"
        case LabelledRelation() | LabelledIdentity() as fact:
            said = format_fact(structs.replace(fact, holds=True))
            return f"a device would have to sense{after} that `{said}` {'holds' if fact.holds else 'does not hold'}"
        case _:
            assert_never(known.fact)
