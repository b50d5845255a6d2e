"""What a domain and a problem declare, as data."""

from __future__ import annotations

from dataclasses import dataclass, field

from skillc.services.pddl_import.expressions import Node

OBJECT = "object"
"""The type of all things."""
TOTAL_COST = "total-cost"
"""The function that says what actions cost, where a metric names no other."""


@dataclass(frozen=True, slots=True)
class Typed:
    """A variable, constant or object, and the types of which it may be; a variable is without its question mark."""

    node: Node
    types: tuple[str, ...]

    @property
    def name(self) -> str:
        """The name in lower case."""
        return self.node.word.removeprefix("?")

    @property
    def written(self) -> str:
        """The name as it is written."""
        return self.node.written.removeprefix("?")


@dataclass(frozen=True, slots=True)
class Symbol:
    """A predicate or a function with its parameters."""

    node: Node
    parameters: tuple[Typed, ...]

    @property
    def name(self) -> str:
        """The name in lower case."""
        return self.node.word


@dataclass(frozen=True, slots=True)
class Action:
    """An action, of which a durative one has a `duration`. Its parts are not read yet."""

    name: Node
    parameters: tuple[Typed, ...]
    condition: Node | None
    effect: Node | None
    duration: Node | None
    durative: bool
    place: Node


@dataclass(frozen=True, slots=True)
class Derived:
    """A derived predicate, with the condition on its parameters."""

    head: Symbol
    condition: Node


@dataclass(slots=True)
class Domain:
    """A domain; `types` has the types above each type, `object_functions` those functions whose values are objects.

    `cost` is the function that only says what actions cost.
    """

    name: Node
    types: dict[str, tuple[str, ...]] = field(default_factory=dict)
    written: dict[str, str] = field(default_factory=dict)
    constants: list[Typed] = field(default_factory=list)
    predicates: dict[str, Symbol] = field(default_factory=dict)
    functions: dict[str, Symbol] = field(default_factory=dict)
    object_functions: set[str] = field(default_factory=set)
    actions: list[Action] = field(default_factory=list)
    derived: list[Derived] = field(default_factory=list)
    cost: str = TOTAL_COST

    def is_a(self, name: str, above: str) -> bool:
        """Whether each object of a type is also one of the type `above`."""
        todo, seen = [name], {name}
        while todo:
            now = todo.pop()
            if above in (now, OBJECT):
                return True
            todo += [each for each in self.types.get(now, ()) if each not in seen]
            seen.update(self.types.get(now, ()))
        return False


@dataclass(slots=True)
class Problem:
    """A problem: objects, what is so at first, a goal, and what a plan minimises or maximises."""

    name: Node
    objects: list[Typed] = field(default_factory=list)
    init: tuple[Node, ...] = ()
    goal: Node | None = None
    metric: Node | None = None
