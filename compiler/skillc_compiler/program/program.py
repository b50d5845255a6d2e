"""A resolved library: its files, what they declare, and which names are unknown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain

import msgspec

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.typed import Call, Implementation, Requirement, Skill, Task, TypedNode, VerifyEvent
from skillc_compiler.program.unknown import LostNames, UnknownName
from skillc_compiler.program.walk import (
    conditions_in,
    conditions_of,
    implementation_values,
    node_values,
    nodes_in,
    skill_values,
    values_in,
)
from skillc_dsl import syntax as s
from skillc_dsl.editions import NEWEST
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary


class DefinedRelation(msgspec.Struct, frozen=True):
    """A relation that is defined by a condition on its sides; `text` is the condition as written."""

    iri: str
    subject: s.Name
    object: s.Name
    condition: TypedCondition
    text: str
    name_span: Span
    span: Span


class ParsedFile(msgspec.Struct, frozen=True):
    """A parsed file, the library it belongs to with the namespace of its terms, and the files it imports.

    `imports` pairs each import that was found with the path of its file. `edition` is that of the library.
    """

    file: s.File
    library: str
    namespace: str
    text: str
    imports: tuple[tuple[s.Import, str], ...] = ()
    edition: int = NEWEST


@dataclass(frozen=True, eq=False)
class Program:
    """A resolved library. `used` holds for each file the bare and qualified names that were looked up in it.

    `terms` are the terms that the library names, with the first place of each.

    `unknown` are the names that could not be resolved, `lost` is what may be missing because of other errors. In a part
    of a library, `neighbours` are implementations outside of it that its calls may select.
    """

    name: str
    vocabulary: Vocabulary
    files: tuple[ParsedFile, ...]
    skills: Mapping[str, Skill]
    implementations: tuple[Implementation, ...]
    tasks: tuple[Task, ...]
    used: Mapping[str, frozenset[str]]
    unknown: tuple[UnknownName, ...] = ()
    lost: LostNames = field(default_factory=LostNames)
    neighbours: tuple[Implementation, ...] = ()
    terms: Mapping[str, Span] = field(default_factory=dict)
    defined: tuple[DefinedRelation, ...] = ()

    @cached_property
    def implementations_of(self) -> Mapping[str, tuple[Implementation, ...]]:
        """Each skill's implementations in order of declaration."""
        found: dict[str, tuple[Implementation, ...]] = dict.fromkeys(self.skills, ())
        for implementation in (*self.implementations, *self.neighbours):
            name = implementation.skill.name
            found[name] = (*found.get(name, ()), implementation)
        return found

    @cached_property
    def called(self) -> dict[str, tuple[Implementation, ...]]:
        """The implementations of the skills that a body calls, by its key, as far as they have been looked up."""
        return {}

    @cached_property
    def nodes(self) -> tuple[TypedNode, ...]:
        """Every node of every body."""
        bodies = (*(each.body for each in self.implementations), *(each.body for each in self.tasks))
        return tuple(node for body in bodies if isinstance(body, TypedNode) for node in nodes_in(body))

    @cached_property
    def calls(self) -> tuple[Call, ...]:
        """Every call, those after `pre of` included."""
        taken_over = (each.call for skill in self.skills.values() for each in skill.taken_over)
        return (*taken_over, *(node.call for node in self.nodes if node.call))

    @cached_property
    def requirements(self) -> tuple[Requirement, ...]:
        """Every pre-, hold and postcondition, and every outcome."""
        owners: Iterable[Skill | Implementation] = (*self.skills.values(), *self.implementations)
        return tuple(each for owner in owners for each in owner.requirements)

    @cached_property
    def conditions(self) -> tuple[TypedCondition, ...]:
        """Every condition and its parts."""
        whole = chain(
            (relation.condition for relation in self.defined),
            (requirement.condition for requirement in self.requirements),
            (event.condition for event in self._events() if event.condition),
            (condition for task in self.tasks for condition in task.conditions),
            (condition for node in self.nodes for condition in node.conditions),
        )
        inside = [part for condition in whole for part in conditions_in(condition)]
        return (*inside, *(part for value in self._values_outside for part in conditions_of(value)))

    @cached_property
    def values(self) -> tuple[TypedExpression, ...]:
        """Every expression and its operands."""
        inside = [value for condition in self.conditions for value in condition.values]
        return tuple(part for value in (*inside, *self._values_outside) for part in values_in(value))

    @cached_property
    def _values_outside(self) -> tuple[TypedExpression, ...]:
        """The whole expressions that are not in conditions."""
        return (
            *(value for skill in self.skills.values() for value in skill_values(skill)),
            *(value for each in self.implementations for value in implementation_values(each)),
            *(event.measured.limit for event in self._events() if event.measured),
            *(task.within for task in self.tasks if task.within),
            *(value for node in self.nodes for value in node_values(node)),
        )

    def _events(self) -> Iterator[VerifyEvent]:
        """Yield the events of all `verify` lines."""
        for implementation in self.implementations:
            for line in implementation.verify:
                yield from (event for event in (line.first, line.second) if event)

    def list_requirements(self) -> Iterator[tuple[Sequence[Requirement], Sequence[Requirement]]]:
        """Yield the requirements of each skill, then those of each implementation; with each those that it is given."""
        yield from ((skill.requirements, ()) for skill in self.skills.values())
        yield from ((each.requirements, each.skill.requirements) for each in self.implementations)

    def candidates(self, call: Call) -> tuple[Implementation, ...]:
        """Return the implementations that may be selected for a call."""
        known = self.implementations_of.get(call.skill.name, ()) if call.skill else ()
        return tuple(one for one in known if call.implementation in (None, one.name))
