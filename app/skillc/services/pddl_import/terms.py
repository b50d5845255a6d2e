"""How predicates and functions are said: by properties of one thing, relations of two, things of their own for more."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from skillc.services.pddl_import.declarations import OBJECT, Action, Domain, Symbol
from skillc.services.pddl_import.expressions import Node
from skillc.services.pddl_import.names import Names, to_class, to_term

ROOT = "sumo:Object"
"""The class above all others."""
PREFIX = "lab"
"""The prefix of the individuals."""


@dataclass(frozen=True, slots=True)
class Property:
    """A property of the only argument; without arguments, of the one individual that stands for the world."""

    name: str
    symbol: Symbol
    is_number: bool


@dataclass(frozen=True, slots=True)
class Relation:
    """A relation of the first to the second argument."""

    name: str
    symbol: Symbol


@dataclass(frozen=True, slots=True)
class Entry:
    """A class whose individuals stand for the tuples of arguments, to which `sides` relate them.

    `value` is the property of the number, or whether it is so. A predicate that never changes has none: it has an
    individual for each tuple of which it is true.
    """

    cls: str
    sides: tuple[str, ...]
    value: str
    symbol: Symbol
    is_number: bool


@dataclass(frozen=True, slots=True)
class Defined:
    """A relation that follows from a condition; for arguments that lack stands the world."""

    name: str
    symbol: Symbol


Form: TypeAlias = Property | Relation | Entry | Defined


@dataclass(slots=True)
class Terms:
    """The terms of the library: its classes by the types of the domain, and the forms of predicates and functions.

    `individuals` are the names of objects, with their prefix.
    """

    domain: Domain
    changed: frozenset[str]
    names: Names = field(default_factory=Names)
    individual_names: Names = field(default_factory=Names)
    classes: dict[tuple[str, ...], str] = field(default_factory=dict)
    forms: dict[str, Form] = field(default_factory=dict)
    functions: dict[str, Form] = field(default_factory=dict)
    individuals: dict[str, str] = field(default_factory=dict)
    _world: str = ""
    _world_class: str = ""

    def class_of(self, types: tuple[str, ...]) -> str:
        """Return the class of what is of one of the types."""
        below = self.domain.is_a
        key = tuple(sorted({each for each in types if not any(below(each, one) for one in types if one != each)}))
        if key not in self.classes:
            name = "Item" if key == (OBJECT,) else "Or".join(to_class(self.domain.written[each]) for each in key)
            self.classes[key] = self.names.give(name, f"{name}Type")
        return self.classes[key]

    def declare_all(self) -> None:
        """Give a class to each type, and a form to each predicate and function."""
        for name in self.domain.types:
            if name != OBJECT:
                self.class_of((name,))
        derived = {each.head.name for each in self.domain.derived}
        for symbol in self.domain.predicates.values():
            if symbol.name not in derived:
                self.forms[symbol.name] = self._form(symbol, False)
            elif len(symbol.parameters) <= 2:
                self.forms[symbol.name] = Defined(self._name(symbol), symbol)
        for symbol in self.domain.functions.values():
            if symbol.name != self.domain.cost:
                self.functions[symbol.name] = self._form(symbol, True)

    def name_individual(self, name: str) -> str:
        """Return a name that no other individual has, with its prefix."""
        return f"{PREFIX}:{self.individual_names.give(name)}"

    def _name(self, symbol: Symbol) -> str:
        name = to_term(symbol.node.written)
        return self.names.give(name, f"is{name[0].upper()}{name[1:]}")

    def _form(self, symbol: Symbol, is_number: bool) -> Form:
        for each in symbol.parameters:
            self.class_of(each.types)
        if len(symbol.parameters) < 2:
            return Property(self._name(symbol), symbol, is_number)
        if len(symbol.parameters) == 2 and not is_number:
            return Relation(self._name(symbol), symbol)
        term = to_term(symbol.node.written)
        sides = tuple(self.names.give(f"{term}{to_class(each.written)}") for each in symbol.parameters)
        has_value = is_number or symbol.name in self.changed
        value = self.names.give(f"{term}{'Value' if is_number else 'Holds'}") if has_value else ""
        name = to_class(symbol.node.written)
        return Entry(self.names.give(name, f"{name}Entry"), sides, value, symbol, is_number)

    def world(self) -> str:
        """Return the individual that has what is said of no thing, with its prefix."""
        if not self._world:
            self._world_class = self.names.give("World")
            self._world = self.name_individual(f"{self._world_class}-1")
        return self._world

    @property
    def world_class(self) -> str:
        """The class of the individual that stands for the world; empty if nothing needs it."""
        return self._world_class

    def class_declarations(self) -> Iterator[tuple[str, tuple[str, ...], str]]:
        """Yield each class with those above it, the latter first, and the type where that is called otherwise."""
        root = (self.classes[(OBJECT,)],) if (OBJECT,) in self.classes else (ROOT,)
        if root != (ROOT,):
            yield root[0], (ROOT,), OBJECT
        if self._world_class:
            yield self._world_class, (ROOT,), ""
        unions = sorted(key for key in self.classes if len(key) > 1)
        for key in unions:
            yield self.classes[key], self._above_all(key) or root, f"(either {' '.join(key)})"
        for name in self._by_depth():
            above = [self.classes[(each,)] for each in self.domain.types[name] if each != OBJECT]
            above += [self.classes[key] for key in unions if name in key]
            own = self.classes[(name,)]
            written = self.domain.written[name]
            yield own, tuple(above) or root, "" if own.casefold() == written.casefold() else written
        for form in (*self.forms.values(), *self.functions.values()):
            if isinstance(form, Entry):
                yield form.cls, (ROOT,), signature(form.symbol)

    def _above_all(self, types: tuple[str, ...]) -> tuple[str, ...]:
        """Return the classes of the lowest types above all of these."""
        below = self.domain.is_a
        common = [each for each in self.domain.types if each != OBJECT and all(below(one, each) for one in types)]
        lowest = (each for each in common if not any(below(one, each) for one in common if one != each))
        return tuple(self.classes[(each,)] for each in lowest)

    def _by_depth(self) -> list[str]:
        """Return the types, each after those above it."""
        done: list[str] = []
        todo = [each for each in self.domain.types if each != OBJECT]
        while todo:
            ready = [each for each in todo if not any(above in todo for above in self.domain.types[each])]
            done += ready
            todo = [each for each in todo if each not in ready]
        return done


def signature(symbol: Symbol) -> str:
    """Return a predicate or a function as PDDL declares it, without types."""
    return f"({' '.join((symbol.node.written, *(each.node.written for each in symbol.parameters)))})"


def find_changed(actions: Iterable[Action]) -> frozenset[str]:
    """Return the predicates and functions that the effects of actions name."""
    todo = [each.effect for each in actions if each.effect is not None]
    found = set[str]()
    while todo:
        node: Node = todo.pop()
        if node.is_list:
            found.add(node.head)
            todo += node.items
    return frozenset(found)
