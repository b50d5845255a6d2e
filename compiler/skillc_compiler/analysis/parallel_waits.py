"""Calls that run in parallel and wait in vain: for what is used until the block ends, or for each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from skillc_compiler.analysis.exclusive_use import ExclusiveUse, Used, used_by
from skillc_compiler.analysis.findings import ParallelConflict
from skillc_compiler.program.typed import Call, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Variable
from skillc_rdf.vocabulary.types import local_name


class _Demand(NamedTuple):
    """A call that needs something while it uses something else."""

    call: Call
    used: Used
    needed: Used

    def describe(self) -> str:
        needed, used = _short_name(self.needed), _short_name(self.used)
        return f"`{self.call.written.skill.text}` needs `{needed}` while it uses `{used}`"


def find_endless_waits(uses: ExclusiveUse, node: TypedNode, kind: str) -> Iterator[ParallelConflict]:
    """Yield the calls in a `par` that never start, and the first circle of waits that is possible."""
    ending = {"par lead": node.children[:1], "par race": node.children}.get(kind, ())
    for number, one in enumerate(ending):
        if one.call is not None and isinstance(one.written, s.CallSkill):
            yield from _find_never_started(one.call, node.children[number + 1 :])
    circle = _find_circle(uses, node.children)
    if circle:
        told = ", and ".join(each.describe() for each in circle)
        yield ParallelConflict(circle[0].call, circle[1].call, f"a circle of waits is possible: {told}")


def _find_never_started(one: Call, others: Sequence[TypedNode]) -> Iterator[ParallelConflict]:
    """Yield the first call in each of others that waits for what a call uses until its end, which ends the block."""
    for other in others:
        for call in calls_in(other):
            if shared := used_by(one) & used_by(call):
                used = min(map(_short_name, shared))
                yield ParallelConflict(one, call, f"never starts: that one uses `{used}` until the block ends")
                break


def _find_circle(uses: ExclusiveUse, children: Sequence[TypedNode]) -> Sequence[_Demand]:
    """Return calls, each in another child, each of which may need what the next one uses; empty if there are none."""
    demands = [
        [_Demand(call, *order) for call in calls_in(child) for order in sorted(uses.orders_of(call), key=repr)]
        for child in children
    ]
    starts = ([each] for own in demands for each in own)
    return next((circle for start in starts if (circle := _close_circle(start, demands))), ())


def _close_circle(circle: list[_Demand], demands: list[list[_Demand]]) -> list[_Demand]:
    """Return a circle that begins so, with at most one call of each child; empty if there is none."""
    left = [own for own in demands if not any(each.call is one.call for one in circle for each in own)]
    for each in (each for own in left for each in own if each.used == circle[-1].needed):
        longer = [*circle, each]
        closed = longer if each.needed == circle[0].used else _close_circle(longer, left)
        if closed:
            return closed
    return []


def _short_name(thing: Used) -> str:
    return thing.name if isinstance(thing, Variable) else local_name(thing.iri)
