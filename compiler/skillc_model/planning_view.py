"""What planners, and checks of a whole library, read of a skill and its implementations, besides calls in bodies."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Expression, Given, Individual, Variable
from skillc_model.skills import Implementation, Let, Outcome, Parameter, Post, Requirement, Skill
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.types import ClassType

Description: TypeAlias = Skill | Implementation
_NOWHERE = Position("", 0, 0)


class _Conditions(msgspec.Struct, frozen=True):
    """What is read of a description or an implementation."""

    parameters: tuple[Parameter, ...]
    pre: tuple[Requirement, ...]
    hold: tuple[Requirement, ...]
    post: tuple[Post, ...]
    duration: Expression | None
    lets: tuple[Let, ...] = ()
    prefer: float = 0.0


class _View(msgspec.Struct, frozen=True):
    """What is read of a skill; `places` are only read if it names individuals, which messages then locate."""

    name: str
    uses: tuple[str, ...]
    shares: tuple[str, ...]
    flags: tuple[bool, ...]
    implementations: tuple[str, ...]
    conditions: tuple[_Conditions, ...]
    possible: tuple[Requirement, ...]
    senses: tuple[Condition, ...]
    outcomes: tuple[Outcome, ...]
    places: tuple[Position, ...]


def encode_view(skill: Skill, implementations: Sequence[Implementation]) -> bytes:
    """Return what is read of a skill, the same bytes for skills that nobody but their callers can tell apart.

    `implementations` are all of its implementations in rank order. Bodies are left out, and documentation, `verify`
    lines and pauses. Of optional values that no condition, effect or duration reads, only the ranges are left if there
    are several implementations to select from, and nothing if there is one.
    """
    described: tuple[Description, ...] = (skill, *implementations)
    read = _names_read(described)
    view = _View(
        name=skill.name,
        uses=skill.uses,
        shares=skill.shares,
        flags=(skill.scoped, skill.planned, skill.fallback),
        implementations=skill.implementations,
        conditions=tuple(_conditions_of(each, read, len(implementations) > 1) for each in described),
        possible=tuple(msgspec.structs.replace(each, source=_NOWHERE) for each in skill.possible),
        senses=skill.senses,
        outcomes=tuple(msgspec.structs.replace(each, source=_NOWHERE) for each in skill.outcomes),
        places=tuple(_places(described)) if any(map(_names_individual, _items(described))) else (),
    )
    return msgspec.msgpack.encode(view)


def _conditions_of(described: Description, read: Collection[str], several: bool) -> _Conditions:
    parameters = (_shown(each, read, several) for each in described.parameters)
    return _Conditions(
        parameters=tuple(each for each in parameters if each is not None),
        pre=tuple(msgspec.structs.replace(each, source=_NOWHERE) for each in described.pre),
        hold=tuple(msgspec.structs.replace(each, source=_NOWHERE) for each in described.hold),
        post=tuple(msgspec.structs.replace(each, source=_NOWHERE) for each in described.post),
        duration=described.duration,
        lets=tuple(each for each in _lets(described) if each.name in read),
        prefer=described.prefer if isinstance(described, Implementation) else 0.0,
    )


def _lets(described: Description) -> tuple[Let, ...]:
    return described.lets if isinstance(described, Implementation) else ()


def _shown(parameter: Parameter, read: Collection[str], several: bool) -> Parameter | None:
    """Return what is read of a parameter."""
    plain = msgspec.structs.replace(parameter, doc="", source=_NOWHERE)
    if parameter.direction != "opt" or isinstance(parameter.type, ClassType) or parameter.name in read:
        return plain
    return msgspec.structs.replace(plain, default=None) if several else None


def _names_read(described: Iterable[Description]) -> set[str]:
    """Return the names that conditions, effects and durations read, directly or by means of named values."""
    described = tuple(described)
    values: dict[str, list[Expression]] = {}
    for each in described:
        defaults = ((one.name, one.default) for one in each.parameters)
        for name, value in (*defaults, *((let.name, let.value) for let in _lets(each))):
            values.setdefault(name, []).extend(() if value is None else (value,))
    start = {name for item in _items(described) for name in _names_in(item)}
    return reachable(start, lambda name: (found for value in values.get(name, ()) for found in _names_in(value)))


def _items(described: Iterable[Description]) -> Iterator[msgspec.Struct]:
    """Yield the conditions, effects, durations and individuals by default of descriptions."""
    for each in described:
        yield from (requirement.condition for requirement in (*each.pre, *each.hold))
        results = each.results if isinstance(each, Skill) else each.post
        yield from (result.condition for result in results)
        yield from (effect for result in results for effect in result.effects)
        yield from () if each.duration is None else (each.duration,)
        yield from (one.default for one in each.parameters if isinstance(one.default, Individual))


def _names_in(item: msgspec.Struct) -> Iterator[str]:
    for part in walk(item):
        match part:
            case Variable(name=name) | Given(parameter=name):
                yield name
            case _:
                pass


def _names_individual(item: msgspec.Struct) -> bool:
    return any(isinstance(each, Individual) for each in walk(item))


def _places(described: Iterable[Description]) -> Iterator[Position]:
    for each in described:
        yield each.source
        yield from (parameter.source for parameter in each.parameters)
        yield from (requirement.source for requirement in (*each.pre, *each.hold))
        yield from (result.source for result in (each.results if isinstance(each, Skill) else each.post))
