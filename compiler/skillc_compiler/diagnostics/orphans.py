"""Finds declarations that nothing uses: one may have lost its name, so that whatever uses it says an unknown one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Skill
from skillc_compiler.program.unknown import LIBRARY, UnknownName
from skillc_compiler.program.walk import conditions_in
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_model.conditions import Given, Invoke
from skillc_rdf.vocabulary.types import local_name


@dataclass
class Orphans:
    """The declarations of a program that nothing uses."""

    program: Program

    def find(self, unknown: UnknownName) -> s.Name | None:
        """Return the only declaration of the kind and the owner of an unknown name that nothing uses, or None.

        Of several, the one in the file of the unknown name is meant.
        """
        found = [*(self._terms if unknown.owner == LIBRARY else self._members)(unknown)]
        here = [name for name in found if name.span.path == unknown.written.span.path]
        return next((each[0] for each in (found, here) if len(each) == 1), None)

    def _terms(self, unknown: UnknownName) -> Iterator[s.Name]:
        """Yield the names of unused skills, functions and terms of the kind that is missing."""
        for declaration in self._declarations():
            match declaration:
                case s.SkillDeclaration(name=name) if unknown.kind == "skill":
                    if name.text not in self._called and not self.program.implementations_of.get(name.text):
                        yield name
                case s.FunctionDeclaration(name=name) if unknown.kind == "function":
                    if name.text not in self._invoked:
                        yield name
                case s.ClassDeclaration(name=name) if unknown.kind in ("class", "type"):
                    yield from self._if_unused(name)
                case s.RelationDeclaration(name=name) if unknown.kind == "relation":
                    yield from self._if_unused(name)
                case s.PropertyDeclaration(name=name) if unknown.kind == "property":
                    yield from self._if_unused(name)
                case _:
                    pass

    def _if_unused(self, term: s.Name) -> Iterator[s.Name]:
        """Yield the name of a declared term if nothing in the library uses one of that name."""
        if term.text.rpartition(":")[2] not in self._named_terms:
            yield term

    def _members(self, unknown: UnknownName) -> Iterator[s.Name]:
        """Yield the names of unused implementations, or parameters and other values, of the skill that lacks a name.

        A skill that runs Python uses all its parameters; what is inferred has to be in a condition, too.
        """
        known = self.program.implementations_of.get(unknown.owner or "", ())
        if any(isinstance(each.body, s.RunPython) for each in known):
            owner = self.program.skills.get(unknown.owner or "")
            inferred = [each for each in owner.parameters if each.direction == "infer"] if owner else []
            yield from (s.Name(each.name, each.span) for each in inferred if each.span not in self._used_places)
            return
        calls = self.program.calls
        chosen = {call.implementation for call in calls if call.skill and call.skill.name == unknown.owner}
        for declaration in self._declarations():
            match declaration:
                case s.ImplementationDeclaration(name=name, skill=s.Name(text=skill), members=members):
                    if skill == unknown.owner and unknown.kind == "implementation":
                        yield from () if name.text in chosen else (name,)
                case s.SkillDeclaration(name=s.Name(text=skill), members=members):
                    pass
                case _:
                    continue
            if skill == unknown.owner and unknown.kind in ("parameter", "argument"):
                names = (member.name for member in members if isinstance(member, s.Parameter | s.Let))
                yield from (name for name in names if name.span not in self._used_places)

    def _declarations(self) -> Iterator[s.Declaration]:
        return (declaration for unit in self.program.files for declaration in unit.file.declarations)

    @cached_property
    def _called(self) -> frozenset[str]:
        return frozenset(call.skill.name for call in self.program.calls if call.skill is not None)

    @cached_property
    def _invoked(self) -> frozenset[str]:
        meanings = (value.meaning for value in self.program.values)
        return frozenset(meaning.function for meaning in meanings if isinstance(meaning, Invoke))

    @cached_property
    def _named_terms(self) -> frozenset[str]:
        return frozenset(map(local_name, self.program.terms))

    @cached_property
    def _used_places(self) -> frozenset[Span]:
        """The declarations of the values that are read, and of the parameters that are passed or named."""
        skills = self.program.skills.values()
        found = {value.declared for value in self.program.values if value.declared is not None}
        named = [(call.skill, argument.name.text) for call in self.program.calls for argument in call.arguments]
        named += [(skill, device.parameter.text) for skill in skills for device in skill.devices]
        named += [(skill, name) for skill in skills for name in _given_names(skill)]
        parameters = (skill.parameter(name) for skill, name in named if skill is not None)
        return frozenset({*found, *(parameter.span for parameter in parameters if parameter is not None)})


def _given_names(skill: Skill) -> Iterator[str]:
    """Yield the parameters that are asked for by `given`."""
    parts = (part for requirement in skill.requirements for part in conditions_in(requirement.condition))
    yield from (part.meaning.parameter for part in parts if isinstance(part.meaning, Given))
