"""A call seen from the caller: which value each parameter of the called skill has, and what the skill then promises."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State, Thing
from skillc_compiler.analysis.truth import canonical
from skillc_compiler.logic.effects import NoEffect, effects
from skillc_compiler.program.typed import Call, Implementation, Parameter, Program, Requirement, Skill
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
from skillc_model.reading import conjuncts
from skillc_model.rewriting import ALWAYS, NEVER, map_children, substitute
from skillc_rdf.vocabulary.types import THING, ClassType


@dataclass(frozen=True)
class Binding:
    """The values of a called skill's parameters, when it starts and after it.

    `open_` are the names made up for what the skill finds by itself. `given` says of optional parameters whether they
    are passed, None where that is so if one of the caller's is.
    """

    skill: Skill
    start: Mapping[str, Expression]
    after: Mapping[str, Expression]
    open_: frozenset[str]
    given: Mapping[str, bool | str]

    def at_start(self, condition: Condition) -> Condition:
        """Return what a pre- or hold condition says to the caller."""
        return substitute(answered(condition, self.given), self.start)

    def at_end(self, condition: Condition) -> Condition:
        """Return what a postcondition says to the caller."""
        return substitute(answered(condition, self.given), self.after)

    def effect(self, effect: Effect) -> Effect:
        """Return what an effect changes, as the caller sees it."""
        return substitute(effect, self.after)


def candidates(program: Program, call: Call) -> tuple[Implementation, ...]:
    """Return the implementations that may be chosen."""
    if call.skill is None:
        return ()
    known = program.implementations_of.get(call.skill.name, ())
    return tuple(one for one in known if call.implementation in (None, one.name))


def required(program: Program, call: Call, kind: str) -> tuple[Requirement, ...]:
    """Return the conditions of the description, and of the implementation where only one can be chosen."""
    if call.skill is None:
        return ()
    chosen = candidates(program, call)
    own = chosen[0].requirements if len(chosen) == 1 else ()
    return tuple(each for each in (*call.skill.requirements, *own) if each.kind == kind)


def changes(requirements: Sequence[Requirement]) -> Iterator[tuple[Requirement, Effect]]:
    """Yield the definite effects of postconditions."""
    for post in requirements:
        for effect in effects(post.clause):
            if not isinstance(effect, NoEffect):
                yield post, effect


def bound(sorts: Sorts, state: State, call: Call, requirements: Sequence[Requirement]) -> Binding:
    """Return the values of the called skill's parameters.

    `requirements` are its preconditions. What it infers is known where they leave one individual only.
    """
    assert call.skill is not None, "a call of an unknown skill has no parameters"
    passed = dict(_passed(call.skill, call))
    start: dict[str, Expression] = {}
    after: dict[str, Expression] = {}
    open_: dict[str, Parameter] = {}
    for parameter in call.skill.parameters:
        value = passed.get(parameter.name, parameter.default.meaning if parameter.default else None)
        name = made_up(call, parameter)
        if parameter.direction == "out":
            start[parameter.name] = name
            after[parameter.name] = Variable(call.out.text) if call.out else name
            continue
        if value is None:
            open_[parameter.name] = parameter
            sorts.classes[name.name] = class_of(parameter)
        start[parameter.name] = name if value is None else value
        after[parameter.name] = value if isinstance(value, Variable | Individual | Literal) else name
    for found, thing in _inferred(sorts, state, open_, start, requirements).items():
        start[found] = after[found] = thing
        open_.pop(found)
    made = frozenset(value.name for each in open_ if isinstance(value := start[each], Variable))
    return Binding(call.skill, start, after, made, {p.name: _given(p, passed) for p in call.skill.parameters})


def _passed(skill: Skill, call: Call) -> Iterator[tuple[str, Expression]]:
    """Yield the arguments; one that is no individual where one belongs is reported elsewhere and left open here."""
    for argument in call.arguments:
        parameter, value = skill.parameter(argument.name.text), argument.value.meaning
        takes_individual = parameter is not None and isinstance(parameter.declared, ClassType)
        if not takes_individual or isinstance(value, Variable | Individual):
            yield argument.name.text, value


def made_up(call: Call, parameter: Parameter) -> Variable:
    """Return the name of what a called skill finds by itself."""
    assert call.skill is not None, "a call of an unknown skill has no parameters"
    return Variable(f"{call.skill.name}.{parameter.name}@{call.written.span.line}:{call.written.span.column}")


def class_of(parameter: Parameter) -> str:
    """Return the class of a parameter; of a value, that of everything."""
    return parameter.declared.iri if isinstance(parameter.declared, ClassType) else THING


def answered(condition: Condition, given: Mapping[str, bool | str]) -> Condition:
    """Return the condition with every `given` answered, or asked of the caller's parameter."""
    match condition:
        case Given(parameter=name):
            answer = given.get(name, name)
            return Given(answer) if isinstance(answer, str) else ALWAYS if answer else NEVER
        case Not() | And() | Or():
            return map_children(condition, lambda part: answered(part, given))
    return condition


def _given(parameter: Parameter, passed: Mapping[str, Expression]) -> bool | str:
    value = passed.get(parameter.name)
    if isinstance(value, Variable) and parameter.direction == "opt":
        return value.name
    return value is not None or parameter.default is not None or parameter.direction != "opt"


def _inferred(
    sorts: Sorts,
    state: State,
    open_: Mapping[str, Parameter],
    start: Mapping[str, Expression],
    requirements: Sequence[Requirement],
) -> dict[str, Thing]:
    """Return the parameters for which the preconditions leave one individual, by relations that have one only."""
    found: dict[str, Thing] = {}
    wanted = {start[name]: name for name, parameter in open_.items() if parameter.direction == "infer"}
    facts = [fact for r in requirements for fact in conjuncts(r.clause.meaning) if isinstance(fact, Holds)]
    for fact in facts * len(wanted):
        seen = canonical(sorts, state, substitute(fact, {**start, **found}))
        assert isinstance(seen, Holds), "a relation is one in any form"
        for unknown, known, single, at_subject in (
            (seen.subject, seen.object, sorts.axioms.single_subject, True),
            (seen.object, seen.subject, sorts.axioms.single_object, False),
        ):
            if isinstance(unknown, Variable) and unknown in wanted:
                known_ones = _known(state, seen.relation, known, at_subject) if seen.relation in single else ()
                for thing in (*known_ones, *_only(state, seen.relation, known, at_subject)):
                    found.setdefault(wanted[unknown], thing)
    return found


def _known(state: State, relation: str, other: Term, at_subject: bool) -> Iterator[Thing]:
    """Yield who is known to have the relation with the other."""
    for fact, true in state.facts.items():
        if true and isinstance(fact, Holds) and fact.relation == relation:
            here, there = (fact.subject, fact.object) if at_subject else (fact.object, fact.subject)
            if there == other and isinstance(here, Variable | Individual):
                yield here


def _only(state: State, relation: str, other: Term, at_subject: bool) -> frozenset[Thing]:
    """Return who may have the relation with the other where that is one only."""
    rest = state.alone.get((relation, other, not at_subject)) if isinstance(other, Variable | Individual) else None
    return rest if rest is not None and len(rest) == 1 else frozenset()
