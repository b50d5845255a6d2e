"""A call as the caller sees it: the values of the called skill's parameters, and what the skill promises for them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Parameter, Requirement, Skill
from skillc_model.conditions import (
    And,
    Condition,
    Effect,
    Expression,
    Given,
    Holds,
    Individual,
    Literal,
    Not,
    Or,
    Term,
    Variable,
)
from skillc_model.rewriting import ALWAYS, NEVER, map_children, substitute
from skillc_model.traversal import conjuncts
from skillc_rdf.vocabulary.types import THING, ClassType


class Binding(msgspec.Struct, frozen=True):
    """The values of a called skill's parameters at its start and after it.

    `open_` are the fresh names for what the skill infers at run time. `given` maps each parameter to whether it is
    passed, or to the caller's optional parameter that decides it.
    """

    skill: Skill
    start: Mapping[str, Expression]
    after: Mapping[str, Expression]
    open_: frozenset[str]
    given: Mapping[str, bool | str]

    def at_start(self, condition: Condition) -> Condition:
        """Return a pre- or hold condition of the skill in the caller's terms."""
        return substitute(resolve_given(condition, self.given), self.start)

    def at_end(self, condition: Condition) -> Condition:
        """Return a postcondition of the skill in the caller's terms."""
        return substitute(resolve_given(condition, self.given), self.after)

    def effect(self, effect: Effect) -> Effect:
        """Return an effect of the skill in the caller's terms."""
        return substitute(effect, self.after)


def call_requirements(program: Program, call: Call, kind: str) -> tuple[Requirement, ...]:
    """Return the conditions of the description, and those of the implementation if only one can be selected."""
    if call.skill is None:
        return ()
    chosen = program.candidates(call)
    own = chosen[0].requirements if len(chosen) == 1 else ()
    return tuple(each for each in (*call.skill.requirements, *own) if each.kind == kind)


def definite_effects(requirements: Sequence[Requirement]) -> Iterator[tuple[Requirement, Effect]]:
    """Yield the definite effects of postconditions."""
    for post in requirements:
        for effect in effects_of(post.condition):
            if not isinstance(effect, NoEffect):
                yield post, effect


def bind_call(types: AliasTypes, state: State, call: Call, requirements: Sequence[Requirement]) -> Binding:
    """Return the values of the called skill's parameters.

    `requirements` are its preconditions. An inferred parameter is known if they leave only one individual.
    """
    assert call.skill is not None, "a call of an unknown skill has no parameters"
    passed = dict(_passed_arguments(call.skill, call))
    start: dict[str, Expression] = {}
    after: dict[str, Expression] = {}
    open_: dict[str, Parameter] = {}
    for parameter in call.skill.parameters:
        value = passed.get(parameter.name, parameter.default.meaning if parameter.default else None)
        name = fresh_variable(call, parameter)
        if parameter.direction == "out":
            start[parameter.name] = name
            after[parameter.name] = Variable(call.out.text) if call.out else name
            continue
        if value is None:
            open_[parameter.name] = parameter
            types.classes[name.name] = class_of(parameter)
        start[parameter.name] = name if value is None else value
        after[parameter.name] = value if isinstance(value, Variable | Individual | Literal) else name
    for found, thing in _infer(types, state, open_, start, requirements).items():
        start[found] = after[found] = thing
        open_.pop(found)
    made = frozenset(value.name for each in open_ if isinstance(value := start[each], Variable))
    return Binding(call.skill, start, after, made, {p.name: _given_answer(p, passed) for p in call.skill.parameters})


def _passed_arguments(skill: Skill, call: Call) -> Iterator[tuple[str, Expression]]:
    """Yield the arguments of a call.

    A value that is no individual where one is required is reported elsewhere; it is left open here.
    """
    for argument in call.values:
        parameter, value = skill.parameter(argument.name.text), argument.value.meaning
        takes_individual = parameter is not None and isinstance(parameter.declared, ClassType)
        if not takes_individual or isinstance(value, Variable | Individual):
            yield argument.name.text, value


def fresh_variable(call: Call, parameter: Parameter) -> Variable:
    """Return a fresh name for the value that a called skill finds for a parameter at run time."""
    assert call.skill is not None, "a call of an unknown skill has no parameters"
    return Variable(f"{call.skill.name}.{parameter.name}@{call.written.span.line}:{call.written.span.column}")


def class_of(parameter: Parameter) -> str:
    """Return the IRI of the class of a parameter; for other types that of `owl:Thing`."""
    return parameter.declared.iri if isinstance(parameter.declared, ClassType) else THING


def resolve_given(condition: Condition, given: Mapping[str, bool | str]) -> Condition:
    """Return the condition with each `given` replaced by its answer, or by a `given` of the caller's parameter."""
    match condition:
        case Given(parameter=name):
            answer = given.get(name, name)
            return Given(answer) if isinstance(answer, str) else ALWAYS if answer else NEVER
        case Not() | And() | Or():
            return map_children(condition, lambda part: resolve_given(part, given))
    return condition


def _given_answer(parameter: Parameter, passed: Mapping[str, Expression]) -> bool | str:
    value = passed.get(parameter.name)
    if isinstance(value, Variable) and parameter.direction == "opt":
        return value.name
    return value is not None or parameter.default is not None or parameter.direction != "opt"


def _infer(
    types: AliasTypes,
    state: State,
    open_: Mapping[str, Parameter],
    start: Mapping[str, Expression],
    requirements: Sequence[Requirement],
) -> dict[str, IndividualTerm]:
    """Return the inferred parameters that are determined by the preconditions through single-valued relations."""
    found: dict[str, IndividualTerm] = {}
    wanted = {start[name]: name for name, parameter in open_.items() if parameter.direction == "infer"}
    facts = [fact for r in requirements for fact in conjuncts(r.condition.meaning) if isinstance(fact, Holds)]
    for fact in facts * len(wanted):
        seen = canonical_condition(types, state, substitute(fact, {**start, **found}))
        if not isinstance(seen, Holds):
            continue  # a defined relation that stands for another condition
        for unknown, known, single, at_subject in (
            (seen.subject, seen.object, types.axioms.single_subject, True),
            (seen.object, seen.subject, types.axioms.single_object, False),
        ):
            if isinstance(unknown, Variable) and unknown in wanted:
                known_ones = _known_values(state, seen.relation, known, at_subject) if seen.relation in single else ()
                for thing in (*known_ones, *_only_value(state, seen.relation, known, at_subject)):
                    found.setdefault(wanted[unknown], thing)
    return found


def _known_values(state: State, relation: str, other: Term, at_subject: bool) -> Iterator[IndividualTerm]:
    """Yield the individuals known to be related to the other side."""
    for fact, true in state.facts.items():
        if true and isinstance(fact, Holds) and fact.relation == relation:
            here, there = (fact.subject, fact.object) if at_subject else (fact.object, fact.subject)
            if there == other and isinstance(here, Variable | Individual):
                yield here


def _only_value(state: State, relation: str, other: Term, at_subject: bool) -> frozenset[IndividualTerm]:
    """Return the individual that may be related to the other side, if there is only one."""
    rest = state.possible.get((relation, other, not at_subject)) if isinstance(other, Variable | Individual) else None
    return rest if rest is not None and len(rest) == 1 else frozenset()
