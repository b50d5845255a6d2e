"""What a call gets without passing it: what the skill around it has found and says the same of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

from msgspec import structs

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.typed import Argument, Call, Parameter, Skill
from skillc_compiler.program.types import fits
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl import syntax as s
from skillc_model.conditions import Condition, Expression, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, free_variables


def hand_over(context: FileContext, scope: Scope, call: Call) -> tuple[Argument, ...]:
    """Return the values of parameters that a call in the body of a skill would else infer."""
    home = context.skills.get(scope.skill) if scope.skill else None
    if home is None or call.skill is None:
        return ()
    taken = tuple(_taken_over(home, call, call.skill))
    done = {each.name.text for each in taken}
    return (*taken, *(each for each in _some(context, home, call, call.skill) if each.name.text not in done))


def _taken_over(home: Skill, call: Call, skill: Skill) -> Iterator[Argument]:
    """Yield what the skill around a call has found by a `pre of` that names the same skill and arguments."""
    left, span = {each.name for each in _left_open(call, skill)}, call.written.skill.span
    same = (each for each in home.taken_over if each.call.written.skill.text == skill.name)
    taken = next((each for each in same if _passes_the_same(call, each.call, left)), None)
    if taken is None:
        return
    named = {each.name.text: each.value for each in taken.call.arguments}
    for name in sorted(left):
        own = home.parameter(name) if name in taken.names else None
        if own is not None:
            yield handed(call, name, own)
        elif name in named:
            yield Argument(s.Name(name, span), structs.replace(named[name], span=span, declared=None))


def _passes_the_same(call: Call, taken: Call, left: Set[str]) -> bool:
    """Whether a call passes what the call of a `pre of` passes, but for parameters that it leaves open."""
    passed = {each.name.text: each.value.meaning for each in call.arguments}
    named = {each.name.text: each.value.meaning for each in taken.arguments}
    return all(passed.get(name) == value for name, value in named.items() if name not in left)


def _some(context: FileContext, home: Skill, call: Call, skill: Skill) -> Iterator[Argument]:
    """Yield what a `post some` is on for the parameter of the call that has this effect, if it fits no other one."""
    mine = [each for each in home.parameters if each.some]
    left = _left_open(call, skill) if mine else ()
    for parameter in left:
        fitting = [each for each in mine if fits(context.vocabulary, each.type, parameter.type)]
        found = [each for each in fitting if _said_of(home, each) & set(_effects(call, skill, parameter, each))]
        if len(found) == 1:
            yield handed(call, parameter.name, found[0])


def handed(call: Call, parameter: str, own: Parameter) -> Argument:
    """Return the value that a parameter of a call gets from a parameter around it."""
    span = call.written.skill.span
    return Argument(s.Name(parameter, span), TypedExpression(Variable(own.name), own.type, span))


def _left_open(call: Call, skill: Skill) -> list[Parameter]:
    passed = {each.name.text for each in call.arguments}
    return [each for each in skill.parameters if each.direction == "infer" and each.name not in passed]


def _said_of(home: Skill, own: Parameter) -> set[Condition | Expression]:
    """Return the effects of a skill on what a parameter of it stands for."""
    return {each for each in _effects_of(home, {}) if own.name in free_variables(each)}


def _effects(call: Call, skill: Skill, parameter: Parameter, own: Parameter) -> Iterator[Condition | Expression]:
    """Yield the effects of a call if a parameter of it stands for the same as one around it."""
    values: dict[str, Expression] = {each.name: Variable(f"{each.name}@") for each in skill.parameters}
    values |= {each.name.text: each.value.meaning for each in call.arguments}
    values[parameter.name] = Variable(own.name)
    return _effects_of(skill, values)


def _effects_of(skill: Skill, values: Mapping[str, Expression]) -> Iterator[Condition | Expression]:
    """Yield what becomes true after a skill, and the numbers that it changes."""
    for post in (each for each in skill.requirements if each.kind == "post"):
        for part in _parts(post.condition):
            if part.change is not None:
                yield substitute(part.change.of.meaning, values)
            yield from conjuncts(substitute(part.meaning, values))


def _parts(condition: TypedCondition) -> Iterator[TypedCondition]:
    yield condition
    for part in condition.parts if condition.conditional is None else ():
        yield from _parts(part)
