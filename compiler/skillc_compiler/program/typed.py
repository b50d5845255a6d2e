"""What a library declares, typed: every name is resolved, every value typed, and each part has its place."""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

import msgspec

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.types import Type
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_model.conditions import Operator
from skillc_rdf.vocabulary.types import ValueType


class Parameter(msgspec.Struct, frozen=True):
    """A parameter of a skill, or of an implementation once its refinements are merged in.

    `some` if it is what a `post some` is on; `taken_from` is the skill from which `pre of` has it.
    """

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
    some: bool = False
    taken_from: str = ""

    @property
    def may_be_unset(self) -> bool:
        """Whether the skill may run without a value for it."""
        return self.direction == "opt" and self.default is None


class Requirement(msgspec.Struct, frozen=True):
    """A pre-, hold or postcondition, what is possible afterwards, or an outcome.

    `likely` is the probability that an outcome states, `tolerance` by how much what is sensed may differ.
    `taken_from` is the skill from which `pre of` has it.
    """

    kind: s.RequirementKind
    label: s.Name | None
    sensed: bool
    condition: TypedCondition
    text: str
    span: Span
    likely: s.Number | None = None
    tolerance: s.Number | s.Quantity | None = None
    taken_from: str = ""

    @property
    def says_what_comes(self) -> bool:
        """Whether it says what is so afterwards."""
        return self.kind in ("post", "possible", "outcome")


class Pause(msgspec.Struct, frozen=True):
    """A `pause` line; `keep` is None if it states no time."""

    where: s.PausePlace
    keep: TypedExpression | None
    span: Span


class Skill(msgspec.Struct, frozen=True):
    """The description of a skill."""

    name: str
    doc: str
    parameters: tuple[Parameter, ...]
    requirements: tuple[Requirement, ...]
    senses: tuple[TypedExpression, ...]
    duration: TypedExpression | None
    cost: TypedExpression | None
    devices: tuple[s.DeviceUse, ...]
    pause: Pause | None
    flags: frozenset[str]
    name_span: Span
    span: Span
    taken_over: tuple[TakenOver, ...] = ()

    def parameter(self, name: str) -> Parameter | None:
        """Return the parameter of that name, or None."""
        return next((p for p in self.parameters if p.name == name), None)

    @property
    def outcomes(self) -> tuple[Requirement, ...]:
        """What can come of it, in the order in which it is written; empty if that is always the same."""
        return tuple(each for each in self.requirements if each.kind == "outcome")


class Argument(msgspec.Struct, frozen=True):
    """The value of a parameter in a call."""

    name: s.Name
    value: TypedExpression


class Call(msgspec.Struct, frozen=True):
    """A call of a skill. `skill` is None if the skill is unknown.

    `handed` are values that it gets from the skill around it without passing them.
    """

    skill: Skill | None
    implementation: str | None
    arguments: tuple[Argument, ...]
    out: s.Name | None
    written: s.CallSkill
    handed: tuple[Argument, ...] = ()

    @property
    def values(self) -> tuple[Argument, ...]:
        """All values that it gets."""
        return (*self.arguments, *self.handed)


class TakenOver(msgspec.Struct, frozen=True):
    """A call of which `pre of` takes the preconditions over, and the parameters for what it would infer."""

    call: Call
    names: tuple[str, ...]


class TypedNode(msgspec.Struct, frozen=True):
    """A node of a body: its syntax, with its expressions, conditions and call resolved."""

    written: s.Node
    values: tuple[TypedExpression, ...] = ()
    conditions: tuple[TypedCondition, ...] = ()
    call: Call | None = None
    children: tuple[TypedNode, ...] = ()
    orelse: tuple[TypedNode, ...] = ()


class Refinement(msgspec.Struct, frozen=True):
    """The changes of an implementation to a parameter; `of` is None if the skill has no such parameter."""

    of: Parameter | None
    declared: ValueType
    type: Type
    default: TypedExpression | None
    low: TypedExpression | None
    high: TypedExpression | None
    written: s.Refinement


class Let(msgspec.Struct, frozen=True):
    """A named value."""

    name: s.Name
    value: TypedExpression


class Output(msgspec.Struct, frozen=True):
    """What an implementation computes at its end for an output; `of` is None if the skill has no such output."""

    name: s.Name
    of: Parameter | None
    value: TypedExpression


class ForceLimit(msgspec.Struct, frozen=True):
    """A comparison of the measured contact force with a limit."""

    operator: Operator
    limit: TypedExpression


class VerifyEvent(msgspec.Struct, frozen=True):
    """An event of a `verify` line: one of a skill, a condition and the measured force."""

    span: Span
    skill: str | None = None
    condition: TypedCondition | None = None
    measured: ForceLimit | None = None


class Property(msgspec.Struct, frozen=True):
    """A `verify` line; `text` is the line as written."""

    pattern: OneOf["never", "outside", "before", "eventually"]
    first: VerifyEvent
    second: VerifyEvent | None
    text: str
    span: Span


Body: TypeAlias = TypedNode | s.RunPython | None


class Implementation(msgspec.Struct, frozen=True):
    """A way to execute a skill.

    `parameters` are those of the skill with the refinements merged in; `requirements` are only its own.
    """

    name: str
    doc: str
    skill: Skill
    refinements: tuple[Refinement, ...]
    parameters: tuple[Parameter, ...]
    requirements: tuple[Requirement, ...]
    duration: TypedExpression | None
    prefer: float
    lets: tuple[Let, ...]
    outputs: tuple[Output, ...]
    body: Body
    verify: tuple[Property, ...]
    name_span: Span
    span: Span

    @property
    def key(self) -> str:
        """The name of the implementation in the library, `Skill.name`."""
        return f"{self.skill.name}.{self.name}"


class Task(msgspec.Struct, frozen=True):
    """A task: a scene with a goal or a body, where, how long, how; whoever runs it gives values to its parameters."""

    name: str
    doc: str
    parameters: tuple[Parameter, ...]
    scene: str | None
    goal: TypedCondition | None
    goal_text: str
    body: TypedNode | None
    backend: s.Name | None
    within: TypedExpression | None
    minimise: s.Minimise | None
    always: tuple[TypedCondition, ...]
    name_span: Span
    span: Span

    @property
    def key(self) -> str:
        """The name of the task among those of implementations."""
        return f"task {self.name}"

    @property
    def conditions(self) -> tuple[TypedCondition, ...]:
        """The conditions outside of its body."""
        return (*(() if self.goal is None else (self.goal,)), *self.always)


class Expectation(msgspec.Struct, frozen=True):
    """What is expected at the end of a test: a condition, a failure with a text in its reason, or else no plan."""

    condition: TypedCondition | None
    failure: str | None
    text: str
    span: Span

    @property
    def is_no_plan(self) -> bool:
        """Whether there shall be no plan."""
        return self.condition is None and self.failure is None


class StartOutcome(msgspec.Struct, frozen=True):
    """What comes of a skill in a test; `skill` is None if it is unknown."""

    skill: Skill | None
    outcome: s.Name
    span: Span


class Test(Task, frozen=True):
    """A task that starts with other facts than its scene, and what is expected of it; it has no parameters."""

    starts: tuple[TypedCondition, ...] = ()
    outcomes: tuple[StartOutcome, ...] = ()
    expects: tuple[Expectation, ...] = ()

    @property
    def conditions(self) -> tuple[TypedCondition, ...]:
        """The conditions outside of its body."""
        expected = (each.condition for each in self.expects if each.condition is not None)
        return (*super().conditions, *self.starts, *expected)
