"""Which parameters decide what skills do to the world model: the others matter only to what has a body."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import TypeAlias

import msgspec

from skillc_model.conditions import Aggregate, Expression, Invoke, PropertyOf, Variable
from skillc_model.skills import Compound, Implementation, Parameter, SkillLibrary
from skillc_model.traversal import children, free_variables, walk
from skillc_model.tree import Call, Node
from skillc_rdf.vocabulary.types import ClassType

Names: TypeAlias = frozenset[str]


def find_live_parameters(library: SkillLibrary) -> dict[str, Names]:
    """Return the parameters of each skill on whose values conditions, effects, times, loops or selection depend.

    Those of a class always count: implementations are chosen, and devices locked, by them.
    """
    skills = {name: library.implementations_of(name) for name in library.skills}
    live = {
        name: frozenset(_of_classes(each for one in found for each in one.parameters)).union(
            *(free_variables(each.condition) for each in library.skills[name].outcomes)
        )
        for name, found in skills.items()
    }
    while True:
        more = {
            name: live[name].union(*(find_live_names(each, live) for each in found)) for name, found in skills.items()
        }
        if more == live:
            return live
        live = more


def find_live_names(implementation: Implementation, live: Mapping[str, Names]) -> Names:
    """Return the names that an implementation reads where it matters, given the live parameters of what it calls."""
    read = set[str]()
    for item in _declared(implementation):
        read |= free_variables(item)
    if isinstance(implementation.body, Compound):
        read |= _read_in(implementation.body.node, live)
    return frozenset(_with_sources(implementation, read))


def _of_classes(parameters: Iterable[Parameter]) -> Iterator[str]:
    yield from (each.name for each in parameters if isinstance(each.type, ClassType))


def _declared(implementation: Implementation) -> Iterator[msgspec.Struct]:
    """Yield the conditions, effects and times of an implementation."""
    yield from (each.condition for each in (*implementation.pre, *implementation.hold))
    for post in implementation.post:
        yield post.condition
        yield from post.effects
    if implementation.duration is not None:
        yield implementation.duration
    yield from (each.value for each in implementation.outputs)
    for line in implementation.verify:
        yield from (event for event in (line.first, line.second) if event is not None)


def _read_in(node: Node, live: Mapping[str, Names]) -> set[str]:
    """Return the names that a body reads, but for arguments that do not matter to what is called."""
    read, todo = set[str](), list[msgspec.Struct]([node])
    while todo:
        here = todo.pop()
        match here:
            case Variable(name=name):
                read.add(name)
            case Call(skill=skill, arguments=arguments):
                todo += (value for name, value in arguments.items() if name in live[skill])
            case _:
                todo += children(here)
    return read


def _with_sources(implementation: Implementation, read: Set[str]) -> set[str]:
    """Return names with those that their values are computed from: of lets, and of defaults."""
    values: dict[str, Expression] = {each.name: each.value for each in implementation.lets}
    values |= {each.name: each.default for each in implementation.parameters if each.default is not None}
    found, todo = set[str](), list(read)
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += free_variables(values[name]) if name in values else ()
    return found


def is_plain(expression: Expression, parameters: Set[str]) -> bool:
    """Whether an expression has a value whatever is known of the world: it reads constants and parameters alone."""
    return not any(
        isinstance(each, PropertyOf | Invoke | Aggregate)
        or (isinstance(each, Variable) and each.name not in parameters)
        for each in walk(expression)
    )
