"""An optional parameter without a default that is read where it may be unset."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Parameter, Skill, TypedNode
from skillc_compiler.program.walk import implementation_values, node_values, skill_values, values_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.spelling import close_names
from skillc_model.conditions import And, Given, Not, Or, Variable

NAMES = ("unset-optional",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION
Guards = frozenset[str]
NONE: Guards = frozenset()


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each such read."""
    for skill in program.skills.values():
        yield from _report(skill.parameters, _in_skill(skill))
    for implementation in program.implementations:
        yield from _report(implementation.parameters, _in_implementation(implementation))


def _report(parameters: Sequence[Parameter], read: Iterator[tuple[TypedExpression, Guards]]) -> Iterator[Diagnostic]:
    unset = {p.name: p for p in parameters if p.may_be_unset}
    if not unset:
        return
    for value, guards in read:
        name = value.meaning.name if isinstance(value.meaning, Variable) else ""
        if name in unset and name not in guards and not _is_misspelt(name, guards, unset):
            yield Diagnostic(
                "unset-optional",
                value.span,
                f"`{name}` may be unset here",
                help=f"give it a default, or read it only under `given {name}`",
                labels=(Label(unset[name].span, "declared without a default", is_cause=True),),
            )


def _is_misspelt(name: str, guards: Guards, unset: Collection[str]) -> bool:
    """Whether a guard is no parameter, and probably means one of this name."""
    return any(name in close_names(guard, unset) for guard in guards if guard not in unset)


def _in_skill(skill: Skill) -> Iterator[tuple[TypedExpression, Guards]]:
    yield from _all(skill_values(skill), NONE)
    for requirement in skill.requirements:
        yield from _in_clause(requirement.condition, NONE)


def _in_implementation(implementation: Implementation) -> Iterator[tuple[TypedExpression, Guards]]:
    yield from _all(implementation_values(implementation), NONE)
    for requirement in implementation.requirements:
        yield from _in_clause(requirement.condition, NONE)
    if isinstance(implementation.body, TypedNode):
        yield from _in_step(implementation.body, NONE)


def _in_clause(condition: TypedCondition, guards: Guards) -> Iterator[tuple[TypedExpression, Guards]]:
    """Yield what a condition reads; in `and` and `or` the parts before guard those after."""
    yield from _all(iter(condition.values), guards)
    for part in condition.parts:
        yield from _in_clause(part, guards)
        if isinstance(condition.meaning, And):
            guards |= _given(part, True)
        elif isinstance(condition.meaning, Or):
            guards |= _given(part, False)


def _given(condition: TypedCondition, holds: bool) -> Guards:
    """Return the parameters that are certainly set if the condition holds, or if it does not."""
    match condition.meaning:
        case Given(parameter=name):
            return frozenset({name}) if holds else NONE
        case Not():
            return _given(condition.parts[0], not holds)
        case And() if holds:
            return frozenset().union(*(_given(part, True) for part in condition.parts))
        case Or() if not holds:
            return frozenset().union(*(_given(part, False) for part in condition.parts))
    return NONE


def _in_step(node: TypedNode, guards: Guards) -> Iterator[tuple[TypedExpression, Guards]]:
    yield from _all(node_values(node), guards)
    for condition in node.conditions:
        yield from _in_clause(condition, guards)
    inside, otherwise = guards, guards
    if isinstance(node.written, s.If | s.While):
        inside = guards | _given(node.conditions[0], True)
        otherwise = guards | _given(node.conditions[0], False)
    for child in node.children:
        yield from _in_step(child, inside)
    for child in node.orelse:
        yield from _in_step(child, otherwise)


def _all(read: Iterator[TypedExpression], guards: Guards) -> Iterator[tuple[TypedExpression, Guards]]:
    for value in read:
        for part in values_in(value):
            yield part, guards
            for condition in part.conditions:
                yield from _in_clause(condition, guards)
