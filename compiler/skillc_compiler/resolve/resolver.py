"""Resolves declarations one by one, and not again while nothing has changed of what was read for them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar

import msgspec
from msgspec import structs

from skillc_compiler.program.typed import Implementation, Skill, Task
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.individuals import Individuals, most_specific_classes
from skillc_compiler.resolve.names import Names
from skillc_compiler.resolve.scope import FileContext
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo
from skillc_dsl.source import Span

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


@dataclass
class Resolver:
    """Resolves the declarations of a program; `found` has what was found, by file."""

    memo: Memo
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

        def compute() -> tuple[Typed, Findings]:
            names = replace(context.names, problems=[], unknown=[], used=set(), terms={})
            value = resolve(structs.replace(context, names=names))
            return self.memo.same("typed", declaration.span, value), Findings.of(names)

        value, found = self.memo.ask("declaration", (context.names, *inputs), compute)
        self.found[declaration.span.path].append(found)
        return self.memo.same("typed", declaration.span, value)

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
        return self.memo.same("individuals", task, most_specific_classes(context.vocabulary, there))
