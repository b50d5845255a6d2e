"""A condition that is always true or always false."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from skillc_compiler.logic.bounds import Bound, are_disjoint, compare_constants, constant_bound
from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import facts_in
from skillc_compiler.logic.related import RelatedFacts
from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Parameter, Skill, TypedNode
from skillc_compiler.program.types import Thing, describe_type
from skillc_compiler.program.walk import nodes_in
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.conditions import Compare, Given, Holds, IsA, Literal, Not, Or, Same, Variable
from skillc_model.rewriting import constant_number, fold
from skillc_model.traversal import free_variables

NAMES = ("always-true", "always-false")
NEEDS = Need.TYPES
READS = Reads.DECLARATION
_Parameters = Mapping[str, Parameter]


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each condition that is always true, a problem for each that is always false."""
    conflicts = Conflicts(program.vocabulary)
    owners: tuple[Skill | Implementation, ...] = (*program.skills.values(), *program.implementations)
    telling = {id(each) for owner in owners for each in _telling_which(owner)}
    for condition, parameters in _conditions(program):
        if id(condition) in telling:
            continue
        for part, denied in _parts(condition):
            yield from _check_condition(conflicts, part, parameters, denied)


def _parts(condition: TypedCondition, denied: bool = False) -> Iterator[tuple[TypedCondition, bool]]:
    """Yield a condition and its parts, each with whether the whole asks that it does not hold."""
    yield condition, denied
    for part in condition.parts:
        yield from _parts(part, denied ^ isinstance(condition.meaning, Not))


def _conditions(program: Program) -> Iterator[tuple[TypedCondition, _Parameters]]:
    """Yield every condition with the parameters that it can read."""
    owners: tuple[Skill | Implementation, ...] = (*program.skills.values(), *program.implementations)
    for owner in owners:
        parameters = {parameter.name: parameter for parameter in owner.parameters}
        yield from ((condition, parameters) for condition in _written_in(owner))
    for task in program.tasks:
        yield from ((condition, {}) for condition in (*((task.goal,) if task.goal else ()), *task.always))
        for node in nodes_in(task.body) if task.body else ():
            yield from ((condition, {}) for condition in node.conditions)


def _telling_which(owner: Skill | Implementation) -> Iterator[TypedCondition]:
    """Yield the preconditions that an inferred parameter is of a class, where no other says which one is meant."""
    asked = [each.condition for each in owner.requirements if each.kind == "pre"]
    inferred = {each.name for each in owner.parameters if each.direction == "infer"}
    for condition in asked:
        match condition.meaning:
            case IsA(subject=Variable(name=name)) if name in inferred:
                if not any(name in free_variables(each.meaning) for each in asked if each is not condition):
                    yield condition


def _written_in(owner: Skill | Implementation) -> Iterator[TypedCondition]:
    yield from (requirement.condition for requirement in owner.requirements if not requirement.says_what_comes)
    if isinstance(owner, Implementation) and isinstance(owner.body, TypedNode):
        for node in nodes_in(owner.body):
            yield from node.conditions


def _check_condition(
    conflicts: Conflicts, condition: TypedCondition, parameters: _Parameters, denied: bool
) -> Iterator[Diagnostic]:
    found = _evaluate(conflicts, condition, parameters)
    if found is not None:
        answer, reason = found
        trivial = answer or denied
        what = "this always holds" if answer else "this never holds, as is asked" if denied else "this never holds"
        yield Diagnostic(
            "always-true" if trivial else "always-false",
            condition.span,
            f"{what}: {reason}",
            help="remove the condition, or ask for something else",
            severity="warning" if trivial else "error",
        )


def _evaluate(conflicts: Conflicts, condition: TypedCondition, parameters: _Parameters) -> tuple[bool, str] | None:
    """Return whether a condition is always true or always false, and why; None if it depends."""
    match condition.meaning:
        case Holds() as fact if conflicts.is_impossible(fact):
            return False, "nothing has this relation to itself"
        case Same(left=left, right=right) if left == right:
            return True, "both sides are the same name"
        case IsA(cls=cls):
            of = condition.values[0].type
            if isinstance(of, Thing) and of.cls is not None and conflicts.vocabulary.is_a(of.cls, cls):
                return True, f"it is declared to be {describe_type(of)}"
        case Given(parameter=name) if name in parameters and parameters[name].direction == "in":
            return True, f"`{name}` has to be passed"
        case Or():
            return _evaluate_or(conflicts, condition)
        case Compare() as comparison:
            return _evaluate_comparison(comparison, parameters)
    return None


def _evaluate_or(conflicts: Conflicts, condition: TypedCondition) -> tuple[bool, str] | None:
    """Find two parts of an `or` of which one holds whenever the other does not."""
    denied = RelatedFacts(conflicts)
    for fact in (each for part in condition.parts for each in facts_in(part, holds=False)):
        if denied.first_excluding(fact) is not None:
            return True, "if one part does not hold, another does"
        denied.add(fact)
    return None


def _evaluate_comparison(comparison: Compare, parameters: _Parameters) -> tuple[bool, str] | None:
    match fold(comparison.left), comparison.operator, fold(comparison.right):
        case Literal(value=left), operator, Literal(value=right):
            return compare_constants(operator, left, right), "both sides are constants"
        case left, "!=" | "<" | ">" as operator, right if left == right:
            return False, f"nothing is `{operator}` itself"
    limit = constant_bound(comparison)
    if limit is None or not isinstance(limit.of, Variable) or limit.of.name not in parameters:
        return None
    name, range_ = limit.of.name, tuple(_range(parameters[limit.of.name]))
    if any(are_disjoint(limit, end) for end in range_):
        return False, f"no value in the range of `{name}` satisfies it"
    if any(are_disjoint(limit.opposite(), end) for end in range_):
        return True, f"every value in the range of `{name}` satisfies it"
    return None


def _range(parameter: Parameter) -> Iterator[Bound]:
    low, high = (constant_number(end.meaning) if end else None for end in (parameter.low, parameter.high))
    if low is not None:
        yield Bound(Variable(parameter.name), ">=", low)
    if high is not None:
        yield Bound(Variable(parameter.name), "<=", high)
