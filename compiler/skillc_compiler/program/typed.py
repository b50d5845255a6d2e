"""A program: every name resolved, every value typed, and beside each meaning the place where it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal as OneOf
from typing import TypeAlias

from skillc_compiler.program.types import Type
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_model.conditions import Condition, Expression, Operator
from skillc_rdf.vocabulary.types import Position, ValueType, Vocabulary


@dataclass(frozen=True, slots=True)
class TypedExpression:
    """A value: what it means, its type, its place and the values it is made of. `_` is a variable of that name."""

    meaning: Expression
    type: Type
    span: Span
    parts: tuple[TypedExpression, ...] = ()


@dataclass(frozen=True, slots=True)
class TypedCondition:
    """A condition: what it means, where it stands, the values it speaks of and the conditions it is made of."""

    meaning: Condition
    span: Span
    values: tuple[TypedExpression, ...] = ()
    parts: tuple[TypedCondition, ...] = ()


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a skill, or of an implementation once its refinements are merged in."""

    name: str
    direction: s.Direction
    any_: bool
    declared: ValueType
    type: Type
    default: TypedExpression | None
    low: TypedExpression | None
    high: TypedExpression | None
    doc: str
    span: Span

    @property
    def may_be_unset(self) -> bool:
        """Whether the skill may run without a value for it."""
        return self.direction == "opt" and self.default is None


@dataclass(frozen=True, slots=True)
class Requirement:
    """A pre-, hold or postcondition."""

    kind: OneOf["pre", "hold", "post"]
    label: s.Name | None
    sensed: bool
    clause: TypedCondition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Skill:
    """A description."""

    name: str
    doc: str
    parameters: tuple[Parameter, ...]
    requirements: tuple[Requirement, ...]
    duration: TypedExpression | None
    devices: tuple[s.DeviceUse, ...]
    flags: frozenset[str]
    name_span: Span
    span: Span

    def parameter(self, name: str) -> Parameter | None:
        """Return the parameter of that name."""
        return next((p for p in self.parameters if p.name == name), None)


@dataclass(frozen=True, slots=True)
class Argument:
    """A value for a parameter of a called skill or function."""

    name: s.Name
    value: TypedExpression


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a skill. `skill` is None when no such skill is known."""

    skill: Skill | None
    implementation: str | None
    arguments: tuple[Argument, ...]
    out: s.Name | None
    written: s.CallSkill


@dataclass(frozen=True, slots=True)
class TypedNode:
    """A node of a body: as written, with its values, conditions and call understood."""

    written: s.Node
    values: tuple[TypedExpression, ...] = ()
    clauses: tuple[TypedCondition, ...] = ()
    call: Call | None = None
    children: tuple[TypedNode, ...] = ()
    orelse: tuple[TypedNode, ...] = ()


@dataclass(frozen=True, slots=True)
class Refinement:
    """What an implementation says anew about a parameter; `of` is None when the skill has no such parameter."""

    of: Parameter | None
    declared: ValueType
    type: Type
    default: TypedExpression | None
    low: TypedExpression | None
    high: TypedExpression | None
    written: s.Refinement


@dataclass(frozen=True, slots=True)
class Let:
    """A named value."""

    name: s.Name
    value: TypedExpression


@dataclass(frozen=True, slots=True)
class Measured:
    """The measured contact force, compared with a limit."""

    operator: Operator
    limit: TypedExpression


@dataclass(frozen=True, slots=True)
class Event:
    """What a `verify` line speaks of: one of a skill, a condition and the measured force."""

    span: Span
    skill: str | None = None
    clause: TypedCondition | None = None
    measured: Measured | None = None


@dataclass(frozen=True, slots=True)
class Property:
    """A `verify` line; `text` is the line as written."""

    pattern: OneOf["never", "outside", "before", "eventually"]
    first: Event
    second: Event | None
    text: str
    span: Span


Body: TypeAlias = TypedNode | s.RunPython | None


@dataclass(frozen=True, slots=True)
class Implementation:
    """A way to do a skill. `parameters` are the skill's with the refinements merged in, `requirements` only its own."""

    name: str
    doc: str
    skill: Skill
    refinements: tuple[Refinement, ...]
    parameters: tuple[Parameter, ...]
    requirements: tuple[Requirement, ...]
    duration: TypedExpression | None
    prefer: float
    lets: tuple[Let, ...]
    body: Body
    verify: tuple[Property, ...]
    name_span: Span
    span: Span

    @property
    def key(self) -> str:
        """The name by which the library knows it."""
        return f"{self.skill.name}.{self.name}"


@dataclass(frozen=True, slots=True)
class Task:
    """A scene with a goal or a body."""

    name: str
    doc: str
    scene: str | None
    goal: TypedCondition | None
    goal_text: str
    body: TypedNode | None
    name_span: Span
    span: Span


@dataclass(frozen=True, slots=True)
class ReadFile:
    """A parsed file, the library it belongs to, the files it imports, and the names looked up while resolving it.

    `imports` pairs each import that was found with the path of its file.
    """

    file: s.File
    library: str
    text: str
    imports: tuple[tuple[s.Import, str], ...] = ()


@dataclass(frozen=True, eq=False)
class Program:
    """A library understood. `used` holds, by file, the bare and qualified names that were looked up in it."""

    name: str
    vocabulary: Vocabulary
    files: tuple[ReadFile, ...]
    skills: Mapping[str, Skill]
    implementations: tuple[Implementation, ...]
    tasks: tuple[Task, ...]
    used: Mapping[str, frozenset[str]]

    @cached_property
    def implementations_of(self) -> Mapping[str, tuple[Implementation, ...]]:
        """Each skill's implementations in order of declaration."""
        found: dict[str, tuple[Implementation, ...]] = dict.fromkeys(self.skills, ())
        for implementation in self.implementations:
            found[implementation.skill.name] += (implementation,)
        return found


def position(span: Span) -> Position:
    """Return where a span begins."""
    return Position(span.path, span.line, span.column)
