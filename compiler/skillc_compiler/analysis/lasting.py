"""Scoped skills that are called without `with`: what they set up stays."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import Unreleased
from skillc_compiler.program.typed import Implementation, Task, TypedNode
from skillc_dsl import syntax as s


def lasting(of: Implementation | Task, body: TypedNode) -> Iterator[Unreleased]:
    """Yield the calls of scoped skills that no `with` around them ends; a skill that is scoped itself may set up."""
    if not isinstance(of, Implementation) or "scoped" not in of.skill.flags:
        yield from _outside(body)


def _outside(step: TypedNode) -> Iterator[Unreleased]:
    if isinstance(step.written, s.CallSkill) and step.call and step.call.skill and "scoped" in step.call.skill.flags:
        yield Unreleased(step.call, None, None)
    if not isinstance(step.written, s.With):
        for child in (*step.children, *step.orelse):
            yield from _outside(child)
