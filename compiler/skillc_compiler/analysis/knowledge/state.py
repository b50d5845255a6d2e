"""What is known of the world at one point of a body: conditions known to hold or not to hold."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from skillc_compiler.analysis.knowledge.readers import Readers, find_readers
from skillc_model.conditions import Condition, Exists, ForEach, Holds, Individual, IsA, Term, Variable
from skillc_model.traversal import free_variables, free_variables_in_order

IndividualTerm: TypeAlias = Variable | Individual
Side: TypeAlias = tuple[str, IndividualTerm, bool]
"""A relation, an individual, and whether the individual is the subject."""


@dataclass(frozen=True, eq=False)
class State:
    """Partial knowledge; everything else is unknown.

    `facts` maps conditions to whether they hold. `possible` holds, for one side of a relation, the only individuals
    that may be on the other side. `aliases` maps a name to the one that is used for the same individual. `once_results`
    holds the results of `once` nodes, None if they may or may not have run. `assigned` are the outputs that have a
    value; `monitor` is the memory of the monitored property. `done` are the effects on all individuals of a class that
    a call had, and of which nothing was undone since; `unchanged` those that the skill promises and that would still be
    on the same individuals as at its start. `had` are all effects on many that there may have been.
    """

    facts: Mapping[Condition, bool] = field(default_factory=dict)
    possible: Mapping[Side, frozenset[IndividualTerm]] = field(default_factory=dict)
    aliases: Mapping[str, IndividualTerm] = field(default_factory=dict)
    once_results: Mapping[int, bool | None] = field(default_factory=dict)
    assigned: frozenset[str] = frozenset()
    monitor: tuple[int, bool] = (0, False)
    done: frozenset[ForEach] = frozenset()
    unchanged: frozenset[ForEach] = frozenset()
    had: frozenset[ForEach] = frozenset()

    @cached_property
    def _key(self) -> tuple[object, ...]:
        tables = (self.facts, self.possible, self.aliases, self.once_results)
        effects = self.done, self.unchanged, self.had
        return (*(frozenset(table.items()) for table in tables), self.assigned, self.monitor, *effects)

    @cached_property
    def classes(self) -> Mapping[Term, Sequence[str]]:
        """The classes that individuals are known to be of."""
        found: dict[Term, list[str]] = defaultdict(list)
        for fact, true in self.facts.items():
            if true and isinstance(fact, IsA):
                found[fact.subject].append(fact.cls)
        return dict(found)

    @cached_property
    def excluded_classes(self) -> Mapping[Term, Sequence[str]]:
        """The classes that individuals are known not to be of."""
        found: dict[Term, list[str]] = defaultdict(list)
        for fact, true in self.facts.items():
            if not true and isinstance(fact, IsA):
                found[fact.subject].append(fact.cls)
        return dict(found)

    @cached_property
    def relations(self) -> Mapping[str, Sequence[Holds]]:
        """The facts that are known to hold, by their relations."""
        found: dict[str, list[Holds]] = defaultdict(list)
        for fact, true in self.facts.items():
            if true and isinstance(fact, Holds):
                found[fact.relation].append(fact)
        return dict(found)

    @cached_property
    def readers(self) -> Readers:
        """The facts by what they read."""
        return find_readers(self.facts)

    @cached_property
    def denied(self) -> Sequence[Exists]:
        """What no individual is known to fulfil."""
        return [fact for fact, true in self.facts.items() if not true and isinstance(fact, Exists)]

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, State) and self._key == other._key

    def with_facts(self, facts: Mapping[Condition, bool]) -> State:
        """Return the state with these facts added."""
        return self.replace(facts={**self.facts, **facts})

    def with_effects(self, effects: Set[ForEach]) -> State:
        """Return the state after effects on many that there may have been."""
        return self if effects <= self.had else self.replace(had=self.had | effects)

    def replace(self, **changes: object) -> State:
        """Return the state with other values of these fields."""
        values = {
            "facts": self.facts,
            "possible": self.possible,
            "aliases": self.aliases,
            "once_results": self.once_results,
            "assigned": self.assigned,
            "monitor": self.monitor,
            "done": self.done,
            "unchanged": self.unchanged,
            "had": self.had,
        }
        return State(**{**values, **changes})  # type: ignore[arg-type]

    def without_name(self, name: str) -> State:
        """Return the state without any knowledge about a variable, which gets a new value."""
        facts = {fact: value for fact, value in self.facts.items() if name not in free_variables(fact)}
        variable = Variable(name)
        alone = {
            side: others for side, others in self.possible.items() if side[1] != variable and variable not in others
        }
        same = {key: thing for key, thing in self.aliases.items() if key != name and thing != variable}
        done, had = (
            frozenset(each for each in effects if name not in free_variables_in_order(each))
            for effects in (self.done, self.had)
        )
        return self.replace(facts=facts, possible=alone, aliases=same, done=done, had=had)


def join(one: State, other: State) -> State:
    """Return what is known in both states; their monitors must be equal."""
    if one is other:
        return one
    facts = {fact: value for fact, value in one.facts.items() if other.facts.get(fact) is value}
    alone = {side: others | other.possible[side] for side, others in one.possible.items() if side in other.possible}
    same = {name: thing for name, thing in one.aliases.items() if other.aliases.get(name) == thing}
    results = {
        key: one.once_results.get(key)
        if key in one.once_results and key in other.once_results and one.once_results[key] is other.once_results[key]
        else None
        for key in {*one.once_results, *other.once_results}
    }
    done, unchanged, had = one.done & other.done, one.unchanged & other.unchanged, one.had | other.had
    return State(facts, alone, same, results, one.assigned & other.assigned, one.monitor, done, unchanged, had)
