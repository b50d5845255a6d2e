"""Declarations and the file that holds them."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span
from skillc_dsl.syntax.conditions import Condition, Text, Value
from skillc_dsl.syntax.members import (
    Body,
    Cost,
    DeviceUse,
    Duration,
    Flag,
    Let,
    Output,
    Parameter,
    Pause,
    Prefer,
    Range,
    Refinement,
    Requirement,
    RunPython,
    Senses,
    TakenOver,
    Verify,
)
from skillc_dsl.syntax.names import Name, TypeName

SkillMember: TypeAlias = Parameter | Requirement | TakenOver | Senses | Duration | Cost | DeviceUse | Pause | Flag
ImplementationMember: TypeAlias = (
    Refinement | Requirement | Duration | Let | Output | Prefer | Body | RunPython | Verify
)


class Use(msgspec.Struct, frozen=True):
    """`use skiros, rparts`"""

    vocabularies: tuple[Name, ...]
    span: Span


class Prefix(msgspec.Struct, frozen=True):
    """`prefix lab: <iri>`"""

    name: Name
    iri: str
    span: Span


class Import(msgspec.Struct, frozen=True):
    """`import "file.skill"`"""

    path: Text
    span: Span


class ClassDeclaration(msgspec.Struct, frozen=True):
    """`class Name < Parent, .. disjoint Other, ..`, or `enum Name { Value, .. }`: then `values` are all of it."""

    name: Name
    parents: tuple[Name, ...]
    disjoint: tuple[Name, ...]
    doc: str
    span: Span
    values: tuple[Name, ...] = ()


class Trait(msgspec.Struct, frozen=True):
    """`functional`, `symmetric`, `transitive`, `inverse NAME` or `sub RELATION`."""

    kind: Literal["functional", "symmetric", "transitive", "inverse", "sub"]
    name: Name | None
    span: Span


class Definition(msgspec.Struct, frozen=True):
    """`(subject: Class, object: Class) = condition`; `text` is the condition as written, in one line."""

    subject: Name
    object: Name
    condition: Condition
    text: str
    span: Span


class RelationDeclaration(msgspec.Struct, frozen=True):
    """`relation name(Domain, Range) traits`, repeated a further signature; or with a definition instead of traits."""

    name: Name
    domain: Name
    range: Name
    traits: tuple[Trait, ...]
    doc: str
    span: Span
    definition: Definition | None = None


class PropertyDeclaration(msgspec.Struct, frozen=True):
    """`property name(Domain): Type range a .. b`"""

    name: Name
    domain: Name
    type: TypeName
    doc: str
    span: Span
    range: Range | None = None


class HeadParameter(msgspec.Struct, frozen=True):
    """`name: Type` in the head of a function or a task."""

    name: Name
    type: TypeName
    span: Span


class FunctionDeclaration(msgspec.Struct, frozen=True):
    """`function name(parameter, ..) -> Type = python "module:function"`"""

    name: Name
    parameters: tuple[HeadParameter, ...]
    result: TypeName
    python: Text
    doc: str
    span: Span


class SkillDeclaration(msgspec.Struct, frozen=True):
    """`skill Name { members }`"""

    name: Name
    members: tuple[SkillMember, ...]
    doc: str
    span: Span


class ImplementationDeclaration(msgspec.Struct, frozen=True):
    """`impl name of Skill { members }`"""

    name: Name
    skill: Name
    members: tuple[ImplementationMember, ...]
    doc: str
    span: Span


class Always(msgspec.Struct, frozen=True):
    """`always condition`: what neither the plan of a task nor its run may break."""

    condition: Condition
    span: Span


Measure: TypeAlias = Literal["makespan", "work", "cost"]


class Minimise(msgspec.Struct, frozen=True):
    """`minimise makespan|work|cost`: of what the plan of a task has little."""

    measure: Measure
    span: Span


class TaskDeclaration(msgspec.Struct, frozen=True):
    """`task name(parameter, ..) { scene, backend, goal or do, always .., within, minimise }`"""

    name: Name
    parameters: tuple[HeadParameter, ...]
    scene: Text | None
    goal: Condition | None
    goal_text: str
    body: Body | None
    backend: Name | None
    within: Value | None
    minimise: Minimise | None
    always: tuple[Always, ...]
    doc: str
    span: Span


class Start(msgspec.Struct, frozen=True):
    """`start condition`: what is so at the start of a test."""

    condition: Condition
    span: Span


class StartOutcome(msgspec.Struct, frozen=True):
    """`start skill -> outcome`: what comes of a skill in a test."""

    skill: Name
    outcome: Name
    span: Span


class Expect(msgspec.Struct, frozen=True):
    """`expect condition`, `expect failure "text"` or `expect no plan`; `text` is the condition as written.

    With neither a condition nor a failure it is `no plan`.
    """

    condition: Condition | None
    failure: Text | None
    text: str
    span: Span


class TestDeclaration(TaskDeclaration, frozen=True):
    """`test name { scene, start .., goal or do, always .., expect .. }`: a task without parameters and its result."""

    starts: tuple[Start, ...] = ()
    outcomes: tuple[StartOutcome, ...] = ()
    expects: tuple[Expect, ...] = ()


Declaration: TypeAlias = (
    ClassDeclaration
    | RelationDeclaration
    | PropertyDeclaration
    | FunctionDeclaration
    | SkillDeclaration
    | ImplementationDeclaration
    | TaskDeclaration
)


class ErrorNode(msgspec.Struct, frozen=True):
    """A place with a syntax error, and the names in what was dropped there: whatever declares them may be missing.

    `keyword` is None at a syntax error. Where something was dropped, it is the keyword of that declaration, or empty if
    that is not clear, and `name` is the word after it.
    """

    span: Span
    names: frozenset[str] = frozenset()
    keyword: str | None = None
    name: str = ""


class File(msgspec.Struct, frozen=True):
    """One parsed file. Comments that allow a diagnostic stay in the text; `errors` are where something was dropped."""

    path: str
    header: tuple[Use | Prefix | Import, ...]
    declarations: tuple[Declaration, ...]
    errors: tuple[ErrorNode, ...] = ()
