"""What is known of the world at one point of a body: conditions known to hold or not to hold, nothing else."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from skillc_model.conditions import Condition, Individual, Variable
from skillc_model.reading import free_variables

Thing: TypeAlias = Variable | Individual
Side: TypeAlias = tuple[str, Thing, bool]
"""A relation, an individual, and whether that is the subject."""


@dataclass(frozen=True, eq=False)
class State:
    """Knowledge; what is not in it is unknown.

    `facts` says of conditions that are no composites whether they hold. `alone` holds, for one side of a relation, the
    only individuals that may be on the other side. `same` maps a name to that of the same individual which is used
    instead. `done` holds the results of `once`, None where it may or may not have run. `assigned` are outputs that
    have a value; `monitor` is the state of the watched property.
    """

    facts: Mapping[Condition, bool] = field(default_factory=dict)
    alone: Mapping[Side, frozenset[Thing]] = field(default_factory=dict)
    same: Mapping[str, Thing] = field(default_factory=dict)
    done: Mapping[int, bool | None] = field(default_factory=dict)
    assigned: frozenset[str] = frozenset()
    monitor: tuple[int, bool] = (0, False)

    @cached_property
    def _key(self) -> tuple[object, ...]:
        tables = (self.facts, self.alone, self.same, self.done)
        return (*(frozenset(table.items()) for table in tables), self.assigned, self.monitor)

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, State) and self._key == other._key

    def having(self, facts: Mapping[Condition, bool]) -> State:
        """Return the state with these facts too."""
        return self.replaced(facts={**self.facts, **facts})

    def replaced(self, **changes: object) -> State:
        """Return the state with other values of these fields."""
        values = {
            "facts": self.facts,
            "alone": self.alone,
            "same": self.same,
            "done": self.done,
            "assigned": self.assigned,
            "monitor": self.monitor,
        }
        return State(**{**values, **changes})  # type: ignore[arg-type]

    def without(self, name: str) -> State:
        """Return the state without anything that speaks of a variable, which gets a new value."""
        facts = {fact: value for fact, value in self.facts.items() if name not in free_variables(fact)}
        variable = Variable(name)
        alone = {side: others for side, others in self.alone.items() if side[1] != variable and variable not in others}
        same = {key: thing for key, thing in self.same.items() if key != name and thing != variable}
        return self.replaced(facts=facts, alone=alone, same=same)


def joined(one: State, other: State) -> State:
    """Return what is known in both states; their monitors must be the same."""
    if one is other:
        return one
    facts = {fact: value for fact, value in one.facts.items() if other.facts.get(fact) is value}
    alone = {side: others | other.alone[side] for side, others in one.alone.items() if side in other.alone}
    same = {name: thing for name, thing in one.same.items() if other.same.get(name) == thing}
    done = {
        key: one.done.get(key) if key in one.done and key in other.done and one.done[key] is other.done[key] else None
        for key in {*one.done, *other.done}
    }
    return State(facts, alone, same, done, one.assigned & other.assigned, one.monitor)
