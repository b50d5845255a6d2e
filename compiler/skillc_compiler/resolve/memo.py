"""Resolves declarations one by one, and not again while nothing has changed of what was read for them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import msgspec
from msgspec import structs

from skillc_compiler.program.memo import Latest, LookUps, Memo, Memos
from skillc_compiler.program.typed import Implementation, ParsedFile, Skill, Task
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.declarations import Bare
from skillc_compiler.resolve.individuals import Individuals, most_specific_classes
from skillc_compiler.resolve.names import Kind, Names
from skillc_compiler.resolve.scope import FileContext
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary

Typed = TypeVar("Typed", Skill, Implementation, Task)


class Findings(msgspec.Struct, frozen=True):
    """What resolving a part of a file has found besides its meaning: problems, unknown names, the names looked up.

    `terms` are the terms among them, with the first place of each.
    """

    problems: tuple[Diagnostic, ...]
    unknown: tuple[UnknownName, ...]
    used: frozenset[str]
    terms: Mapping[str, Span]

    @staticmethod
    def of(names: Names) -> Findings:
        """Return what was found with these names."""
        return Findings(tuple(names.problems), tuple(names.unknown), frozenset(names.used), dict(names.terms))


NOTHING = Findings((), (), frozenset(), {})


class Resolved(msgspec.Struct, frozen=True):
    """A resolved declaration, with the skills and the implementations' names that were looked up for it."""

    value: object
    found: Findings
    skills: Mapping[str, Skill | None]
    implementations: Mapping[str, Sequence[str] | None]


@dataclass
class ResolveMemo(Memos):
    """The declarations of the last analysis, their names and what they were resolved to."""

    declarations: Latest[tuple[s.Declaration, list[str]]] = field(default_factory=Latest)
    bare: Memo[Bare] = field(default_factory=Memo)
    known: Latest[Mapping[Kind, set[str]]] = field(default_factory=Latest)
    homes: Latest[Mapping[str, str]] = field(default_factory=Latest)
    names: Latest[Names] = field(default_factory=Latest)
    individuals: Latest[Mapping[str, str | None]] = field(default_factory=Latest)
    declared_terms: Latest[tuple[object, ...]] = field(default_factory=Latest)
    vocabulary: Latest[Vocabulary] = field(default_factory=Latest)
    terms: Memo[tuple[Vocabulary, Mapping[str, Findings]]] = field(default_factory=Memo)
    typed: Latest[object] = field(default_factory=Latest)
    resolved: Memo[Resolved] = field(default_factory=Memo)

    def keep_declarations(self, files: Sequence[ParsedFile]) -> tuple[ParsedFile, ...]:
        """Return the files; declarations that have not changed are those of the analysis before."""
        return tuple(structs.replace(unit, file=self._keep(unit)) for unit in files)

    def _keep(self, unit: ParsedFile) -> s.File:
        lines = unit.text.split("\n")
        kept = (
            self.declarations.same((d.span, number), (d, lines[d.span.line - 1 : d.span.end_line]))[0]
            for number, d in enumerate(unit.file.declarations)
        )
        return structs.replace(unit.file, declarations=tuple(kept))


@dataclass
class Resolver:
    """Resolves the declarations of a program; `found` has what was found, by file."""

    memo: ResolveMemo
    found: dict[str, list[Findings]]

    def resolve(
        self, context: FileContext, inputs: tuple[object, ...], resolve: Callable[[FileContext], Typed]
    ) -> Typed:
        """Return what `resolve` returns for the context.

        It is called if one of the inputs is another object than in the analysis before, the file has other names, or a
        skill that was looked up has changed. The first input is the declaration.
        """
        declaration = inputs[0]
        assert isinstance(declaration, s.SkillDeclaration | s.ImplementationDeclaration | s.TaskDeclaration)

        def compute() -> Resolved:
            names = replace(context.names, problems=[], unknown=[], used=set(), terms={})
            skills, implementations = LookUps(context.skills), LookUps(context.implementations)
            value = resolve(structs.replace(context, names=names, skills=skills, implementations=implementations))
            kept = self.memo.typed.same(declaration.span, value)
            return Resolved(kept, Findings.of(names), skills.asked, implementations.asked)

        def is_valid(known: Resolved) -> bool:
            return all(context.skills.get(name) is skill for name, skill in known.skills.items()) and all(
                context.implementations.get(name) == names for name, names in known.implementations.items()
            )

        result = self.memo.resolved.recall((context.names, *inputs), compute, is_valid)
        self.memo.typed.same(declaration.span, result.value)
        self.found[declaration.span.path].append(result.found)
        return result.value  # type: ignore[return-value]

    def look_up_skill(self, context: FileContext, name: s.Name) -> str | None:
        """Return the name if it is a visible skill's; else it is unknown in the file of the context."""
        if name.text in context.names.skills:
            self.found[name.span.path].append(Findings((), (), frozenset((name.text,)), {}))
            return name.text
        names = replace(context.names, problems=[], unknown=[], used=set(), terms={})
        found = names.look_up_skill(name)
        self.found[name.span.path].append(Findings.of(names))
        return found

    def individuals(self, task: str, context: FileContext, there: Individuals) -> Mapping[str, str | None]:
        """Return the individuals of a task's scene, with the most specific class of each."""
        return self.memo.individuals.same(task, most_specific_classes(context.vocabulary, there))
