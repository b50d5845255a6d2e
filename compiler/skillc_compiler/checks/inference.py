"""An inferred parameter that no precondition relates to anything."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Skill
from skillc_compiler.program.types import Thing
from skillc_compiler.program.walk import conditions_in, values_in
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.conditions import And, Compare, Exists, HasProperty, Holds, IsA, Or, Same, Variable
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import local_name

NAMES = ("unlinked-inference",)
NEEDS = Need.DECLARATION
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each inferred parameter that no precondition determines."""
    for skill in program.skills.values():
        linked = {name for r in skill.requirements if r.kind == "pre" for name in _constrained_variables(r.condition)}
        pre = [r.condition for r in skill.requirements if r.kind == "pre"]
        written = {name for whole in pre for part in conditions_in(whole) for name in _names_in(part)}
        asked = written.union(*(free_variables(condition.meaning) for condition in pre))
        for parameter in skill.parameters:
            if parameter.direction == "infer" and parameter.name not in (asked if parameter.any_ else linked):
                yield _problem(skill, parameter.name, linked)


def _problem(skill: Skill, name: str, linked: set[str]) -> Diagnostic:
    parameter = next(p for p in skill.parameters if p.name == name)
    known = next((p.name for p in skill.parameters if p.direction == "in" or p.name in linked), "..")
    cls = parameter.type.cls if isinstance(parameter.type, Thing) else None
    only = f"write `pre {name} is {local_name(cls)}` if there is only one; " if cls else ""
    return Diagnostic(
        "unlinked-inference",
        parameter.span,
        f"no precondition says which `{name}` is meant, so it cannot be inferred",
        help=f"relate it to something: `pre {known} RELATION {name}`; {only}or make it an `in` parameter",
        labels=tuple(Label(r.span, "add it beside this one") for r in skill.requirements if r.kind == "pre")[-1:],
    )


def _names_in(condition: TypedCondition) -> set[str]:
    """Return the names in a condition as it is written, also where they have no meaning because of an error."""
    read = (part.meaning for value in condition.values for part in values_in(value))
    return {meaning.name for meaning in read if isinstance(meaning, Variable)}


def _constrained_variables(condition: TypedCondition) -> set[str]:
    """Return the variables that a condition, if it holds, constrains."""
    match condition.meaning:
        case And() | Exists():
            return set().union(*(_constrained_variables(part) for part in condition.parts))
        case Or():
            return set.intersection(*(_constrained_variables(part) for part in condition.parts))
        case Holds() | Same() | Compare() | HasProperty() | IsA():
            return set(free_variables(condition.meaning)) | _names_in(condition)
        case _:
            return set()
