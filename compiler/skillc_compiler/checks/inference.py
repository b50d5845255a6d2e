"""An inferred parameter that no precondition links to anything.

The value of an `infer` parameter is looked up through the preconditions. Without one, any individual of its class
would do, which is rarely meant.

Bad:

    use rparts
    skill Open {
        in    arm:     ArmDevice
        infer gripper: GripperEffector
        noplan
    }
    impl waiting of Open { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    skill Open {
        in    arm:     ArmDevice
        infer gripper: GripperEffector
        pre   arm skiros:hasA gripper
        noplan
    }
    impl waiting of Open { run python "skillc_runtime.primitives.stand_in:StandIn" }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.library.conditions import And, Compare, Holds, Same, Variable
from skillc_compiler.program import Clause, Program, Skill
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("unlinked-inference",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each inferred parameter that stands in no positive precondition."""
    for skill in program.skills.values():
        linked = {name for r in skill.requirements if r.kind == "pre" for name in _linked(r.clause)}
        for parameter in skill.parameters:
            if parameter.direction == "infer" and parameter.name not in linked:
                yield _problem(skill, parameter.name, linked)


def _problem(skill: Skill, name: str, linked: set[str]) -> Diagnostic:
    parameter = next(p for p in skill.parameters if p.name == name)
    known = next((p.name for p in skill.parameters if p.direction == "in" or p.name in linked), "..")
    return Diagnostic(
        "unlinked-inference",
        parameter.span,
        f"no precondition says which `{name}` is meant, so it cannot be inferred",
        help=f"relate it to something: `pre {known} RELATION {name}`, or make it an `in` parameter",
    )


def _linked(clause: Clause) -> Iterator[str]:
    """Yield the variables that a condition, when it holds, relates to something."""
    match clause.meaning:
        case And():
            for part in clause.parts:
                yield from _linked(part)
        case Holds() | Same() | Compare(operator="=="):
            yield from (v.meaning.name for v in clause.values if isinstance(v.meaning, Variable))
        case _:
            pass
