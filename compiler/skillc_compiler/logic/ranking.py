"""The order in which implementations are tried."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.program.typed import Implementation
from skillc_compiler.program.types import fits
from skillc_rdf.vocabulary.types import Vocabulary


def ranked(vocabulary: Vocabulary, declared: Sequence[Implementation]) -> tuple[Implementation, ...]:
    """Return implementations of one skill in rank order.

    Repeatedly, among those not ranked yet: those than which no other is more specific, of these the highest `prefer`,
    then the earliest declared.
    """
    left = list(declared)
    order = []
    while left:
        front = [one for one in left if not any(more_specific(vocabulary, other, one) for other in left)]
        best = max(front, key=lambda one: one.prefer)
        order.append(best)
        left.remove(best)
    return tuple(order)


def more_specific(vocabulary: Vocabulary, one: Implementation, other: Implementation) -> bool:
    """Whether each parameter's type in `one` is at least as narrow as in `other`, and one of them narrower."""
    pairs = [(p.type, q.type) for p, q in zip(one.parameters, other.parameters, strict=True)]
    return all(fits(vocabulary, p, q) for p, q in pairs) and not all(fits(vocabulary, q, p) for p, q in pairs)
