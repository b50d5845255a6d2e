"""The findings of a proof, as data; the checks turn them into diagnostics."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_compiler.analysis.knowledge.possible import FactWrite
from skillc_compiler.analysis.paths import Path
from skillc_compiler.program.typed import Call, Implementation, Parameter, Property, Requirement, TypedNode
from skillc_dsl.source import Span
from skillc_model.conditions import Adjust, Condition, Effect, ForEach, Not, Same, Variable
from skillc_rdf.vocabulary.types import ValueType


class Taken(msgspec.Struct, frozen=True):
    """What a `post some` says of that which a call picks: its name, the IRI of its class, what is done to which one."""

    call: Call
    name: str
    cls: str
    effect: Condition
    where: Condition


class Remedy(msgspec.Struct, frozen=True):
    """What a skill would have to say so that a finding goes away.

    `parameters` are to be inferred, each with the IRI of its class, through the preconditions `before`; `apart` are
    pairs of parameters that have to differ; `after` are postconditions. `passed` are parameters that the `call` has to
    be given, as it may find something else by itself. `outputs` are given by calls, and would be by the skill. `some`
    is what a call picks itself, any one of several, `possible` what only some successes have.
    """

    parameters: tuple[tuple[str, str], ...] = ()
    before: tuple[Condition, ...] = ()
    apart: tuple[tuple[str, str], ...] = ()
    after: tuple[Condition | ForEach | Adjust, ...] = ()
    passed: tuple[str, ...] = ()
    call: Call | None = None
    outputs: tuple[tuple[str, ValueType], ...] = ()
    some: Taken | None = None
    possible: FactWrite | None = None

    @property
    def required(self) -> tuple[Condition, ...]:
        """All preconditions."""
        return (*self.before, *(Not(Same(Variable(left), Variable(right))) for left, right in self.apart))


class UnprovedPost(msgspec.Struct, frozen=True):
    """A postcondition that is not known to hold in a successful end; `false` if it is known not to hold.

    `beyond` if the condition cannot be decided by this analysis; `instead` is what becomes of a number.
    """

    implementation: Implementation
    post: Requirement
    false: bool
    beyond: bool
    path: Path
    remedy: Remedy | None = None
    instead: Adjust | None = None


class UnprovedPrecondition(msgspec.Struct, frozen=True):
    """A precondition or hold of a called skill that is not known to hold at its start; `false` if known not to hold.

    `always` if it is false whenever the call begins and nothing catches that, so that what comes after it never runs.
    `condition` is what is needed in the terms of the caller; `incurable` if no precondition of the caller is enough.
    """

    call: Call
    requirement: Requirement
    false: bool
    path: Path
    always: bool = False
    condition: Condition | None = None
    remedy: Remedy | None = None
    incurable: bool = False


class BrokenHold(msgspec.Struct, frozen=True):
    """A hold of the implementation that a node breaks, certainly or possibly, before another node begins."""

    hold: Requirement
    span: Span
    certain: bool
    path: Path


class UndeclaredEffect(msgspec.Struct, frozen=True):
    """An effect of a called skill that lasts to the end and that the calling skill does not declare.

    `effect` is in the terms of the caller, None if the called skill says that it is possible; `possible` is what a
    `post possible` would include; `remedy` declares it.
    """

    implementation: Implementation
    call: Call
    post: Requirement
    effect: Effect | None
    path: Path
    possible: FactWrite | None = None
    remedy: Remedy | None = None


class UnreachableNode(msgspec.Struct, frozen=True):
    """A node that never starts."""

    node: TypedNode


class UnassignedRead(msgspec.Struct, frozen=True):
    """An output that is read where it may have no value; `declared` is its place, or that of its first call."""

    name: str
    span: Span
    declared: Span
    path: Path


class UnassignedOutput(msgspec.Struct, frozen=True):
    """An output of the skill that has no value in a successful end."""

    implementation: Implementation
    parameter: Parameter
    path: Path


class ParallelConflict(msgspec.Struct, frozen=True):
    """Two calls in parallel that write a fact differently, or of which one waits in vain.

    `certain` if this does not depend on which individuals names denote.
    """

    first: Call
    second: Call
    what: str
    certain: bool = True


class EarlyApply(msgspec.Struct, frozen=True):
    """An `apply` that claims what has not been done: nothing has run, the block has failed, or `call` has yet to do it.

    `at_the_end` if it is in a `finally`.
    """

    node: TypedNode
    post: Requirement
    at_the_end: bool = False
    call: Call | None = None
    path: Path = None


class LeakedChange(msgspec.Struct, frozen=True):
    """A change or set-up that every success undoes, and that a failure in between leaves behind."""

    call: Call
    post: Requirement | None
    path: Path


class ViolatedProperty(msgspec.Struct, frozen=True):
    """A `verify` property that some execution violates."""

    property: Property
    path: Path


class UndecidedProperty(msgspec.Struct, frozen=True):
    """A `verify` property that is neither proved nor refuted."""

    property: Property


class TooManyStates(msgspec.Struct, frozen=True):
    """A node with more states than are kept apart, so that knowledge was lost."""

    span: Span


Finding: TypeAlias = (
    UnprovedPost
    | UnprovedPrecondition
    | BrokenHold
    | UndeclaredEffect
    | UnreachableNode
    | UnassignedRead
    | UnassignedOutput
    | ParallelConflict
    | EarlyApply
    | LeakedChange
    | ViolatedProperty
    | UndecidedProperty
    | TooManyStates
)
