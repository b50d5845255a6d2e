"""What a proof finds, as data; the checks tell it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.analysis.trail import Way
from skillc_compiler.program.typed import Call, Implementation, Parameter, Property, Requirement, TypedNode
from skillc_dsl.source import Span


@dataclass(frozen=True, slots=True)
class Unproved:
    """A postcondition that is not known to hold in a successful end; `false` if it is known not to.

    `beyond` tells that it says more than can be followed here.
    """

    implementation: Implementation
    post: Requirement
    false: bool
    beyond: bool
    way: Way


@dataclass(frozen=True, slots=True)
class Unguaranteed:
    """A precondition (or hold) of a called skill that is not known to hold when it starts; `false` if known not to."""

    call: Call
    requirement: Requirement
    false: bool
    way: Way


@dataclass(frozen=True, slots=True)
class BrokenHold:
    """A hold of the implementation's own that a node breaks, for certain or perhaps, before something else begins."""

    hold: Requirement
    span: Span
    certain: bool
    way: Way


@dataclass(frozen=True, slots=True)
class Undeclared:
    """An effect of a called skill that is there in the end, and of which the calling one says nothing."""

    implementation: Implementation
    call: Call
    post: Requirement
    way: Way


@dataclass(frozen=True, slots=True)
class Unreachable:
    """A node that never starts."""

    step: TypedNode


@dataclass(frozen=True, slots=True)
class Unassigned:
    """An output that is read where it may have no value."""

    name: str
    span: Span
    way: Way


@dataclass(frozen=True, slots=True)
class NeverAssigned:
    """An output of the skill that has no value in a successful end."""

    implementation: Implementation
    parameter: Parameter
    way: Way


@dataclass(frozen=True, slots=True)
class Clash:
    """Two calls beside each other that write a fact differently, or have the same device for themselves."""

    first: Call
    second: Call
    what: str


@dataclass(frozen=True, slots=True)
class Unreleased:
    """Something that is set up or changed, put back in every success, and left so by a failure in between."""

    call: Call
    post: Requirement | None
    way: Way


@dataclass(frozen=True, slots=True)
class Violated:
    """A `verify` property that some execution breaks."""

    property: Property
    way: Way


@dataclass(frozen=True, slots=True)
class Unverified:
    """A `verify` property that is neither proved nor refuted."""

    property: Property


@dataclass(frozen=True, slots=True)
class Undecided:
    """There were more states after a node than can be told apart, so that less is known than could be."""

    span: Span


Finding: TypeAlias = (
    Unproved
    | Unguaranteed
    | BrokenHold
    | Undeclared
    | Unreachable
    | Unassigned
    | NeverAssigned
    | Clash
    | Unreleased
    | Violated
    | Unverified
    | Undecided
)
