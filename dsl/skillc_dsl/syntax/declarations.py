"""Declarations and the file that holds them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition
from skillc_dsl.syntax.members import (
    Body,
    DeviceUse,
    Duration,
    Flag,
    Let,
    Parameter,
    Pause,
    Prefer,
    Refinement,
    Requirement,
    RunPython,
    Verify,
)
from skillc_dsl.syntax.values import Name, Text, TypeName

SkillMember: TypeAlias = Parameter | Requirement | Duration | DeviceUse | Pause | Flag
ImplementationMember: TypeAlias = Refinement | Requirement | Duration | Let | Prefer | Body | RunPython | Verify


@dataclass(frozen=True, slots=True)
class Use:
    """`use skiros, rparts`"""

    vocabularies: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Prefix:
    """`prefix lab: <iri>`"""

    name: Name
    iri: str
    span: Span


@dataclass(frozen=True, slots=True)
class Import:
    """`import "file.skill"`"""

    path: Text
    span: Span


@dataclass(frozen=True, slots=True)
class ClassDeclaration:
    """`class Name < Parent, .. disjoint Other, ..`"""

    name: Name
    parents: tuple[Name, ...]
    disjoint: tuple[Name, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class Trait:
    """`functional`, `symmetric`, `transitive`, `inverse NAME` or `sub RELATION`."""

    kind: Literal["functional", "symmetric", "transitive", "inverse", "sub"]
    name: Name | None
    span: Span


@dataclass(frozen=True, slots=True)
class RelationDeclaration:
    """`relation name(Domain, Range) traits`; repeated, a further signature."""

    name: Name
    domain: Name
    range: Name
    traits: tuple[Trait, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class PropertyDeclaration:
    """`property name(Domain): Type`"""

    name: Name
    domain: Name
    type: TypeName
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class HeadParameter:
    """`name: Type` in the head of a function or a task."""

    name: Name
    type: TypeName
    span: Span


@dataclass(frozen=True, slots=True)
class FunctionDeclaration:
    """`function name(parameter, ..) -> Type = python "module:function"`"""

    name: Name
    parameters: tuple[HeadParameter, ...]
    result: TypeName
    python: Text
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class SkillDeclaration:
    """`skill Name { members }`"""

    name: Name
    members: tuple[SkillMember, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class ImplementationDeclaration:
    """`impl name of Skill { members }`"""

    name: Name
    skill: Name
    members: tuple[ImplementationMember, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class TaskDeclaration:
    """`task name(parameter, ..) { scene, goal or do }`"""

    name: Name
    parameters: tuple[HeadParameter, ...]
    scene: Text | None
    goal: Condition | None
    goal_text: str
    body: Body | None
    doc: str
    span: Span


Declaration: TypeAlias = (
    ClassDeclaration
    | RelationDeclaration
    | PropertyDeclaration
    | FunctionDeclaration
    | SkillDeclaration
    | ImplementationDeclaration
    | TaskDeclaration
)


@dataclass(frozen=True, slots=True)
class ErrorNode:
    """A place with a syntax error, and the names in what was dropped there: whatever declares them may be missing."""

    span: Span
    names: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class File:
    """One parsed file. Comments that allow a diagnostic stay in the text; `errors` are where something was dropped."""

    path: str
    header: tuple[Use | Prefix | Import, ...]
    declarations: tuple[Declaration, ...]
    errors: tuple[ErrorNode, ...] = ()
