"""Symbols, which the names in source text refer to, and their occurrences."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_compiler.program.typed import Parameter
from skillc_compiler.resolve.names import Kind
from skillc_dsl.source import Span


class TermSymbol(msgspec.Struct, frozen=True):
    """A class, relation or property, by IRI."""

    kind: Kind
    iri: str


class TypeSymbol(msgspec.Struct, frozen=True):
    """A type that is not a class: a dimension, `Bool`, `Pose`, .."""

    name: str


class FunctionSymbol(msgspec.Struct, frozen=True):
    """A declared function."""

    name: str


class SkillSymbol(msgspec.Struct, frozen=True):
    """A skill."""

    name: str


class ImplementationSymbol(msgspec.Struct, frozen=True):
    """An implementation of a skill."""

    skill: str
    name: str


class TaskSymbol(msgspec.Struct, frozen=True):
    """A task."""

    name: str


class ParameterSymbol(msgspec.Struct, frozen=True):
    """A parameter of a skill, the same in its implementations and in every call.

    One that is taken over by `pre of` is that of the skill which declares it.
    """

    skill: str
    name: str

    @staticmethod
    def of(skill: str, parameter: Parameter) -> ParameterSymbol:
        """Return the symbol of a parameter that a skill has."""
        return ParameterSymbol(parameter.taken_from or skill, parameter.name)


class LocalSymbol(msgspec.Struct, frozen=True):
    """A let, loop variable, output, quantified variable or parameter of a head; `owner` is the place of its scope."""

    origin: Literal["let", "loop variable", "output", "variable", "function parameter", "task parameter", "failure"]
    owner: Span
    name: str


class LabelSymbol(msgspec.Struct, frozen=True):
    """The label of a condition; `owner` is its skill, or `skill.implementation`."""

    owner: str
    name: str


class PrefixSymbol(msgspec.Struct, frozen=True):
    """A vocabulary in a `use` line, or a declared prefix."""

    name: str


class IndividualSymbol(msgspec.Struct, frozen=True):
    """An individual of a scene."""

    iri: str


class ChoiceSymbol(msgspec.Struct, frozen=True):
    """A value of an enumeration, by its IRI, or a value of a text property, which has none."""

    text: str
    iri: str = ""


class FailurePartSymbol(msgspec.Struct, frozen=True):
    """What is told of a failure, such as `why.kind`."""

    name: str


class AggregateSymbol(msgspec.Struct, frozen=True):
    """A function of the individuals of a class, such as `count(x: Class where C)`."""

    name: str


class QuantitySymbol(msgspec.Struct, frozen=True):
    """A number with a unit."""

    value: float
    unit: str


class FileSymbol(msgspec.Struct, frozen=True):
    """An imported file, by path."""

    path: str


class SceneSymbol(msgspec.Struct, frozen=True):
    """The scene of a task, as written."""

    name: str


Symbol: TypeAlias = (
    TermSymbol
    | TypeSymbol
    | FunctionSymbol
    | SkillSymbol
    | ImplementationSymbol
    | TaskSymbol
    | ParameterSymbol
    | LocalSymbol
    | LabelSymbol
    | PrefixSymbol
    | IndividualSymbol
    | ChoiceSymbol
    | FailurePartSymbol
    | AggregateSymbol
    | QuantitySymbol
    | FileSymbol
    | SceneSymbol
)


class Occurrence(msgspec.Struct, frozen=True):
    """A place where a symbol is named.

    An argument `speed`, which is short for `speed: speed`, has two occurrences at the same place, both marked
    `shorthand`: that of the called skill's parameter and that of the local name.
    """

    span: Span
    symbol: Symbol
    declares: bool = False
    shorthand: bool = False
