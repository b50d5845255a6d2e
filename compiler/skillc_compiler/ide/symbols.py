"""Symbols, which the names in source text refer to, and their occurrences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_compiler.resolve.names import Kind
from skillc_dsl.source import Span


@dataclass(frozen=True, slots=True)
class TermSymbol:
    """A class, relation or property, by IRI."""

    kind: Kind
    iri: str


@dataclass(frozen=True, slots=True)
class TypeSymbol:
    """A type that is not a class: a dimension, `Bool`, `Pose`, .."""

    name: str


@dataclass(frozen=True, slots=True)
class FunctionSymbol:
    """A declared function."""

    name: str


@dataclass(frozen=True, slots=True)
class SkillSymbol:
    """A skill."""

    name: str


@dataclass(frozen=True, slots=True)
class ImplementationSymbol:
    """An implementation of a skill."""

    skill: str
    name: str


@dataclass(frozen=True, slots=True)
class TaskSymbol:
    """A task."""

    name: str


@dataclass(frozen=True, slots=True)
class ParameterSymbol:
    """A parameter of a skill, the same in its implementations and in every call."""

    skill: str
    name: str


@dataclass(frozen=True, slots=True)
class LocalSymbol:
    """A let, loop variable, output, quantified variable or parameter of a head; `owner` is the place of its scope."""

    origin: Literal["let", "loop variable", "output", "variable", "function parameter", "task parameter"]
    owner: Span
    name: str


@dataclass(frozen=True, slots=True)
class LabelSymbol:
    """The label of a condition; `owner` is its skill, or `skill.implementation`."""

    owner: str
    name: str


@dataclass(frozen=True, slots=True)
class PrefixSymbol:
    """A vocabulary in a `use` line, or a declared prefix."""

    name: str


@dataclass(frozen=True, slots=True)
class IndividualSymbol:
    """An individual of a scene."""

    iri: str


@dataclass(frozen=True, slots=True)
class ChoiceSymbol:
    """One of the allowed values of a text property."""

    text: str


@dataclass(frozen=True, slots=True)
class QuantitySymbol:
    """A number with a unit."""

    value: float
    unit: str


@dataclass(frozen=True, slots=True)
class FileSymbol:
    """An imported file, by path."""

    path: str


@dataclass(frozen=True, slots=True)
class SceneSymbol:
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
    | QuantitySymbol
    | FileSymbol
    | SceneSymbol
)


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A place where a symbol is named.

    An argument `speed`, which is short for `speed: speed`, has two occurrences at the same place, both marked
    `shorthand`: that of the called skill's parameter and that of the local name.
    """

    span: Span
    symbol: Symbol
    declares: bool = False
    shorthand: bool = False
