"""What calls use exclusively, and in which order: inside of a call that uses one thing others are used."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_model.conditions import Individual, Variable

Used: TypeAlias = Variable | Individual
"""Something that is used exclusively, as a body calls it."""

Order: TypeAlias = tuple[Used, Used]
"""What is used, and what is needed meanwhile."""


def used_by(call: Call) -> frozenset[Used]:
    """Return what a call uses exclusively from its start to its end, as far as the caller has names for it."""
    if call.skill is None:
        return frozenset()
    names = [device.parameter.text for device in call.skill.devices if device.kind == "uses"]
    return frozenset(_as_caller_says(call, (Variable(name) for name in names)))


class ExclusiveUse:
    """What the implementations of a program use exclusively, computed once each; recursion adds nothing."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._used: dict[str, frozenset[Used]] = {}
        self._orders: dict[str, frozenset[Order]] = {}

    def used_inside(self, of: Implementation) -> frozenset[Used]:
        """Return what the body of an implementation uses exclusively at some time, as it calls it."""
        if of.key not in self._used:
            self._used[of.key] = frozenset()
            self._used[of.key] = frozenset(each for call in _calls(of) for each in self._used_within(call))
        return self._used[of.key]

    def orders_inside(self, of: Implementation) -> frozenset[Order]:
        """Return what the calls in the body of an implementation need while they use something else."""
        if of.key not in self._orders:
            self._orders[of.key] = frozenset()
            self._orders[of.key] = frozenset(each for call in _calls(of) for each in self.orders_of(call))
        return self._orders[of.key]

    def orders_of(self, call: Call) -> frozenset[Order]:
        """Return what a call needs while it uses something else, as far as the caller has names for both."""
        used, found = used_by(call), set[Order]()
        for of in self._program.candidates(call) if call.skill is not None else ():
            needed = _as_caller_says(call, self.used_inside(of))
            found |= {(one, other) for other in needed for one in used if one != other}
            for order in self.orders_inside(of):
                both = tuple(_as_caller_says(call, order))
                if len(both) == len(order):
                    found.add((both[0], both[1]))
        return frozenset(found)

    def _used_within(self, call: Call) -> frozenset[Used]:
        candidates = self._program.candidates(call) if call.skill is not None else ()
        inside = (each for of in candidates for each in self.used_inside(of))
        return used_by(call) | frozenset(_as_caller_says(call, inside))


def _calls(of: Implementation) -> Iterator[Call]:
    return calls_in(of.body) if isinstance(of.body, TypedNode) else iter(())


def _as_caller_says(call: Call, used: Iterator[Used] | frozenset[Used] | Order) -> Iterator[Used]:
    """Yield what is used in a called skill as its caller calls it; nothing for what the caller has no name for."""
    passed = {argument.name.text: argument.value.meaning for argument in call.values}
    for each in used:
        said = passed.get(each.name) if isinstance(each, Variable) else each
        if isinstance(said, Variable | Individual):
            yield said
