"""What the success of a task rests on: facts, each with how it is known."""

from __future__ import annotations

from typing import Literal

import msgspec

UNVERIFIED = "finished, not verified"
"""How a task ended that did all it was to do, where something that this rests on is only assumed."""


class KnownFact(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A fact in the words of the language, and how it is known: `given` before the run, or by what `by` names.

    `wanted` says of one that is only assumed what would have to be sensed.
    """

    fact: str
    known: Literal["sensed", "reported", "assumed", "given"]
    by: str = ""
    wanted: str = ""


def assumed(facts: tuple[KnownFact, ...]) -> tuple[KnownFact, ...]:
    """Return those that nothing looked at."""
    return tuple(fact for fact in facts if fact.known == "assumed")


def known_words(fact: KnownFact) -> str:
    """Return how a fact is known, as `assumed by Place`."""
    return f"{fact.known} by {fact.by}" if fact.by else fact.known


def status_words(status: str, verified: bool | None) -> str:
    """Return how a task ended, in words: a success that rests on an assumption is not called one."""
    return UNVERIFIED if verified is False else status
