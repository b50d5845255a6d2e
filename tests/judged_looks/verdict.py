"""Whether what a look in space says of a task is so, and tables of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Final, Literal, TypeAlias

import msgspec

Said: TypeAlias = Literal["yes", "no", "unknown"]
"""What is said before anything moves: that it goes, that it does not, or nothing."""

JUDGED: Final[tuple[Said, ...]] = ("yes", "no")
"""What can be judged."""


class Verdict(msgspec.Struct, frozen=True):
    """What was said of the task of a seed and a kind, whether it is so, and why not; None where nothing can show it."""

    seed: int
    kind: str
    said: Said
    is_so: bool | None
    why: str


def share_that_is_so(verdicts: Iterable[Verdict], said: Said) -> float:
    """Return the share of what was said that is so; 1 if it was never said."""
    judged = [each.is_so for each in verdicts if each.said == said]
    return sum(map(bool, judged)) / len(judged) if judged else 1.0


def share_solved(verdicts: Iterable[Verdict]) -> float:
    """Return of how many tasks that can be done it was said that they can; 1 if none can."""
    can = [each.said != "no" for each in verdicts if each.said in JUDGED and (each.said != "no" or not each.is_so)]
    return sum(can) / len(can) if can else 1.0


def format_table(verdicts: Iterable[Verdict]) -> str:
    """Return how often what was said of each kind, and how often it is so."""
    found = Counter((each.kind, each.said, each.is_so) for each in verdicts)
    rows = [f"{'kind':10} {'said':22} {'times':>6} {'is so':>6}"]
    for kind, said in sorted({(kind, said) for kind, said, _ in found}):
        times = sum(count for (k, s, _), count in found.items() if (k, s) == (kind, said))
        rows.append(f"{kind:10} {said:22} {times:6} {found[kind, said, True] if said in JUDGED else '-':>6}")
    return "\n".join(rows)
