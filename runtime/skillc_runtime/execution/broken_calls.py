"""Calls that failed or were halted, which may have been made up for since: no success rests on what they wrote."""

from __future__ import annotations

from typing import Literal

import msgspec


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
