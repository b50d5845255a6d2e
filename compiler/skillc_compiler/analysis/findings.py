"""The findings of a proof, as data; the checks turn them into diagnostics."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.analysis.paths import Path
from skillc_compiler.program.typed import Call, Implementation, Parameter, Property, Requirement, TypedNode
from skillc_dsl.source import Span


@dataclass(frozen=True, slots=True)
class UnprovedPost:
    """A postcondition that is not known to hold in a successful end; `false` if it is known not to hold.

    `beyond` if the condition cannot be decided by this analysis.
    """

    implementation: Implementation
    post: Requirement
    false: bool
    beyond: bool
    path: Path


@dataclass(frozen=True, slots=True)
class UnprovedPrecondition:
    """A precondition or hold of a called skill that is not known to hold at its start; `false` if known not to hold."""

    call: Call
    requirement: Requirement
    false: bool
    path: Path


@dataclass(frozen=True, slots=True)
class BrokenHold:
    """A hold of the implementation that a node breaks, certainly or possibly, before another node begins."""

    hold: Requirement
    span: Span
    certain: bool
    path: Path


@dataclass(frozen=True, slots=True)
class UndeclaredEffect:
    """An effect of a called skill that lasts to the end and that the calling skill does not declare.

    `missing` is the postcondition that would declare it; empty if the parameters of the calling skill cannot say it.
    """

    implementation: Implementation
    call: Call
    post: Requirement
    missing: str
    path: Path


@dataclass(frozen=True, slots=True)
class UnreachableNode:
    """A node that never starts."""

    node: TypedNode


@dataclass(frozen=True, slots=True)
class UnassignedRead:
    """An output that is read where it may have no value."""

    name: str
    span: Span
    path: Path


@dataclass(frozen=True, slots=True)
class UnassignedOutput:
    """An output of the skill that has no value in a successful end."""

    implementation: Implementation
    parameter: Parameter
    path: Path


@dataclass(frozen=True, slots=True)
class ParallelConflict:
    """Two calls in parallel that write a fact differently, or use the same device exclusively."""

    first: Call
    second: Call
    what: str


@dataclass(frozen=True, slots=True)
class LeakedChange:
    """A change or set-up that every success undoes, and that a failure in between leaves behind."""

    call: Call
    post: Requirement | None
    path: Path


@dataclass(frozen=True, slots=True)
class ViolatedProperty:
    """A `verify` property that some execution violates."""

    property: Property
    path: Path


@dataclass(frozen=True, slots=True)
class UndecidedProperty:
    """A `verify` property that is neither proved nor refuted."""

    property: Property


@dataclass(frozen=True, slots=True)
class TooManyStates:
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
    | LeakedChange
    | ViolatedProperty
    | UndecidedProperty
    | TooManyStates
)
