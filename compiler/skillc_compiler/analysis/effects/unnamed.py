"""Effects on something that a called skill picks, any one of several: the `post some` that declares them."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import structs

from skillc_compiler.analysis.binding import call_requirements, class_of, fresh_variable
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import Remedy, Taken, UndeclaredEffect
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import Argument, Call, Implementation, TypedNode
from skillc_compiler.program.types import Thing
from skillc_dsl import syntax as s
from skillc_dsl.token_table import SINCE
from skillc_model.conditions import And, Condition, Expression, ForEach, Variable, single_effect, wanted_by
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, free_variables


def find_taken(run: Exploration, implementation: Implementation, one: UndeclaredEffect) -> Remedy | None:
    """Return the `post some` of what a call picks and of all that it does to it; None if no such line can say it."""
    own = {each.name for each in implementation.parameters}
    if not has_since(run, implementation, "some") or one.call.skill is None:
        return None
    effects = [each.effect for each in run.effects.values() if each.call is one.call and not each.post.sensed]
    done = [wanted_by(single_effect(each)) for each in effects if not isinstance(each, ForEach)]
    for parameter in (each for each in one.call.skill.parameters if each.any_ and each.name not in own):
        made = fresh_variable(one.call, parameter).name
        named = {made: Variable(parameter.name)}
        said = [substitute(each, named) for each in done if made in free_variables(each)]
        where = [each for each in _needed(run, one.call) if parameter.name in free_variables(each)]
        names = own | {parameter.name}
        if said and where and all(free_variables(each) <= names for each in (*said, *where)):
            taken = Taken(one.call, parameter.name, class_of(parameter), _all_of(said), _all_of(where))
            return Remedy(some=taken)
    return None


def with_taken(body: TypedNode, taken: Taken) -> TypedNode:
    """Return a body in which each call like that of `taken` gets what a `post some` would be on."""
    call = body.call
    if call is not None and call.skill is taken.call.skill and _passed(call) == _passed(taken.call):
        span = call.written.skill.span
        value = TypedExpression(Variable(taken.name), Thing(taken.cls), span)
        call = structs.replace(call, handed=(*call.handed, Argument(s.Name(taken.name, span), value)))
    children, orelse = (tuple(with_taken(each, taken) for each in nodes) for nodes in (body.children, body.orelse))
    return structs.replace(body, call=call, children=children, orelse=orelse)


def with_passed(body: TypedNode, call: Call, names: Mapping[str, str]) -> TypedNode:
    """Return a body in which a call gets parameters around it by their names, each with the IRI of its class."""
    changed = body.call
    if changed is call:
        span = call.written.skill.span
        given = (
            Argument(s.Name(name, span), TypedExpression(Variable(name), Thing(cls), span))
            for name, cls in names.items()
        )
        changed = structs.replace(call, handed=(*call.handed, *given))
    children, orelse = (tuple(with_passed(each, call, names) for each in part) for part in (body.children, body.orelse))
    return structs.replace(body, call=changed, children=children, orelse=orelse)


def has_since(run: Exploration, implementation: Implementation, word: str) -> bool:
    """Whether the edition in which a skill is written has a word that came later than others."""
    editions = {unit.file.path: unit.edition for unit in run.program.files}
    return editions.get(implementation.skill.span.path, 0) >= SINCE[word]


def _needed(run: Exploration, call: Call) -> list[Condition]:
    """Return the preconditions of a call, with the names of its own parameters for what it infers."""
    asked = (part for each in call_requirements(run.program, call, "pre") for part in conjuncts(each.condition.meaning))
    return [substitute(each, _passed(call)) for each in asked]


def _passed(call: Call) -> Mapping[str, Expression]:
    return {each.name.text: each.value.meaning for each in call.values}


def _all_of(conditions: list[Condition]) -> Condition:
    parts = tuple(dict.fromkeys(conditions))
    return parts[0] if len(parts) == 1 else And(parts)
