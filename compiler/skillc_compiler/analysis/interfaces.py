"""What callers can observe of the body of an implementation; while that stays the same, so do their proofs."""

from __future__ import annotations

import msgspec

from skillc_compiler.analysis.exclusive_use import Order, Used
from skillc_compiler.analysis.knowledge.writes import Write
from skillc_compiler.analysis.summaries import HoldInside, WriteSummaries
from skillc_compiler.program.typed import Implementation, Requirement


class Interface(msgspec.Struct, frozen=True):
    """What the proofs of its callers read of an implementation with a body.

    `leaks` are its changes that its description does not declare; `writes`, `writes_on_failure` and `scoped_writes` are
    those of its summary, in its own terms; `early_writes` those while a part of it has still to run, `holds_inside`
    what has to hold meanwhile. `used` is what it uses exclusively, `orders` what it needs while it uses something else.
    """

    key: str
    requirements: tuple[Requirement, ...]
    leaks: frozenset[Write]
    writes: frozenset[Write]
    writes_on_failure: frozenset[Write]
    scoped_writes: frozenset[Write]
    may_break_hold: bool
    early_writes: frozenset[Write]
    holds_inside: frozenset[HoldInside]
    used: frozenset[Used]
    orders: frozenset[Order]


def summarise(summaries: WriteSummaries, of: Implementation, leaks: frozenset[Write]) -> Interface:
    """Return the interface of an implementation that leaks these writes."""
    return Interface(
        key=of.key,
        requirements=of.requirements,
        leaks=leaks,
        writes=summaries.all_writes(of),
        writes_on_failure=summaries.writes_on_failure(of),
        scoped_writes=summaries.scoped_writes_inside(of),
        may_break_hold=summaries.may_break_hold(of.skill),
        early_writes=summaries.early_writes(of),
        holds_inside=summaries.holds_inside(of),
        used=summaries.uses.used_inside(of),
        orders=summaries.uses.orders_inside(of),
    )
