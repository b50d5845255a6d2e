"""The local names that an expression can read, and the context in which it is resolved."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Literal, TypeAlias

import msgspec
from msgspec import structs
from msgspec.structs import replace

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.typed import Skill
from skillc_compiler.program.types import UNKNOWN, Type
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.names import Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.query import NameTable
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.types import Vocabulary

Origin: TypeAlias = Literal["parameter", "out", "let", "output", "loop variable", "variable", "failure"]


class LocalName(msgspec.Struct, frozen=True):
    """A local name; `is_assigned` unless it is an output that has no value yet on some path."""

    type: Type
    origin: Origin
    span: Span
    is_assigned: bool = True


class Scope(msgspec.Struct, frozen=True):
    """Local names; `owner` is what they belong to, as shown in messages: "skill `Pick`".

    `skill` is the skill that declares the parameters among them, `task NAME` for a task; None if nothing does.
    `repeats` if a name was taken when it was declared: another one may be meant there.
    """

    owner: str
    variables: Mapping[str, LocalName] = msgspec.field(default_factory=dict)
    skill: str | None = None
    repeats: bool = False

    def with_name(self, name: str, variable: LocalName) -> Scope:
        """Return the scope with one more name."""
        return replace(self, variables={**self.variables, name: variable})


ResolveCondition: TypeAlias = Callable[["FileContext", Scope, s.Condition], TypedCondition]


class FileContext(msgspec.Struct, frozen=True):
    """What is constant within a declaration: the file's names, the vocabulary, the skills.

    `resolve_condition` resolves the conditions that stand in values. `individuals` are those of the scene with the
    class of each, None if it has several; None if no scene is known.
    """

    names: Names
    vocabulary: Vocabulary
    resolve_condition: ResolveCondition
    skills: NameTable[Skill] = msgspec.field(default_factory=dict)
    implementations: NameTable[Sequence[str]] = msgspec.field(default_factory=dict)
    individuals: Mapping[str, str | None] | None = None

    def report(self, name: str, span: Span, message: str, help: str = "", *labels: Label) -> None:
        """Record a problem."""
        self.names.problems.append(Diagnostic(name, span, message, help, labels=labels))

    def report_unknown(self, unknown: UnknownName) -> None:
        """Record that a name is unknown."""
        self.names.unknown.append(unknown)

    def bind(self, scope: Scope, name: s.Name, variable: LocalName) -> Scope:
        """Return the scope with a new name; a name that is taken is reported.

        What is an output of a call, and declared as something else, is probably declared wrongly.
        """
        former = scope.variables.get(name.text)
        if former is not None:
            self.report(
                "duplicate-name",
                name.span,
                f"`{name.text}` is already a {former.origin} here",
                "choose another name",
                Label(former.span, "declared here", is_cause=variable.origin == "output"),
            )
            known = scope.with_name(name.text, structs.replace(former, type=UNKNOWN, is_assigned=True))
            return replace(known, repeats=True)
        return scope.with_name(name.text, variable)
