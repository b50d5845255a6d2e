"""A resolved library: its files, what they declare, and which names are unknown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import msgspec

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.typed import Call, Implementation, Requirement, Skill, Task
from skillc_compiler.program.unknown import LostNames, UnknownName
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

    def list_requirements(self) -> Iterator[tuple[Sequence[Requirement], Sequence[Requirement]]]:
        """Yield the requirements of each skill, then those of each implementation; with each those that it is given."""
        yield from ((skill.requirements, ()) for skill in self.skills.values())
        yield from ((each.requirements, each.skill.requirements) for each in self.implementations)

    def candidates(self, call: Call) -> tuple[Implementation, ...]:
        """Return the implementations that may be selected for a call."""
        known = self.implementations_of.get(call.skill.name, ()) if call.skill else ()
        return tuple(one for one in known if call.implementation in (None, one.name))
