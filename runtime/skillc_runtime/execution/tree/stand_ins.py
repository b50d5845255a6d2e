"""Values that stand for what nobody measures or computes in a symbolic cell."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from random import Random
from typing import assert_never

from skillc_model.conditions import Compare, Condition, Expression, HasProperty, Individual, PropertyOf, Term, Variable
from skillc_model.read_write import terms_read
from skillc_model.skills import Implementation, Outcome, Parameter, Post
from skillc_model.traversal import conjuncts, free_variables
from skillc_rdf.vocabulary.types import ClassType, DirectionType, ListType, NumberType, PlainType, ValueType, VectorType
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import compile_expression, value_of
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def find_outputs(
    implementation: Implementation, state: WorldState, bound: Mapping[str, Value]
) -> dict[str, Value | None]:
    """Return a value for each output that is not computed at the end, None if the world has no individual for it.

    An output that a postcondition equates with a property has the value of that property, if it has one. Of the
    individuals of its class, it is the first for which what they say of it holds already, else the first, in the order
    of their IRIs. Any other output is 0, false, an empty text or list, or a pose without displacement.
    """
    values = dict(bound)
    found: dict[str, Value | None] = {}
    computed = {each.name for each in implementation.outputs}
    for parameter in implementation.parameters:
        if parameter.direction == "out" and parameter.name not in computed:
            value = _find_output(parameter, implementation.post, state, values)
            found[parameter.name] = value
            if value is not None:
                values[parameter.name] = value
    return found


def _find_output(
    parameter: Parameter, posts: Iterable[Post], state: WorldState, bound: Mapping[str, Value]
) -> Value | None:
    stated = (each for post in posts for each in conjuncts(post.condition))
    literals = [each for each in stated if parameter.name in free_variables(each)]
    for expression in _equated(parameter.name, literals):
        if (value := compile_expression(expression)(state, bound)) is not None:
            return value
    if not isinstance(parameter.type, ClassType):
        value = find_stand_in(parameter.type)
        return parameter.low if parameter.low is not None and value == 0.0 else value
    members = sorted(state.instances(parameter.type.iri))
    fitting = (each for each in members if _fits(each, parameter.name, literals, state, bound))
    return next(fitting, members[0] if members else None)


def _equated(name: str, literals: Iterable[Condition]) -> Iterator[Expression]:
    """Yield what the literals say an output is equal to."""
    for literal in literals:
        match literal:
            case Compare(left=Variable(name=left), operator="==", right=right) if left == name:
                yield right
            case Compare(left=left, operator="==", right=Variable(name=right)) if right == name:
                yield left
            case _:
                pass


def _fits(
    individual: str, name: str, literals: Iterable[Condition], state: WorldState, bound: Mapping[str, Value]
) -> bool:
    return all(evaluate(each, state, {**bound, name: individual}) for each in literals)


def find_true_outcome(outcomes: Iterable[Outcome], state: WorldState, bound: Mapping[str, Value]) -> str:
    """Return the label of the one outcome that is true, though not known; empty if the world does not say it."""
    about = state.hidden.about
    decided = [each for each in outcomes if not about.isdisjoint(terms_read(each.condition))] if about else []
    readable = [each for each in decided if free_variables(each.condition) <= bound.keys()]
    if not readable:
        return ""
    world = state.reveal()
    true = [each.label for each in readable if evaluate(each.condition, world, bound)]
    return true[0] if len(true) == 1 else ""


def choose_outcome(outcomes: Iterable[Outcome], may_come: Collection[str], chance: str, true: str = "") -> str:
    """Return the label of what comes; empty if nothing of it may.

    That is, among what `may_come`, what is certain, or what is `true`, or else it is drawn by how likely each is. The
    same text `chance` draws the same.
    """
    possible = [each for each in outcomes if each.label in may_come]
    if not possible:
        return ""
    certain = next((each.label for each in possible if each.likely == 1.0), true)
    if certain in may_come:
        return certain
    weights = [each.likely for each in possible]
    return Random(chance).choices(possible, weights if sum(weights) > 0.0 else None)[0].label


def find_stand_in(type_: ValueType) -> Value | None:
    """Return a value of a type that says nothing; None for an individual."""
    match type_:
        case ClassType():
            return None
        case NumberType():
            return 0.0
        case VectorType():
            return np.zeros(3)
        case DirectionType():
            return np.array((0.0, 0.0, 1.0))
        case PlainType(name=name):
            pose = Pose.of((0.0, 0.0, 0.0))
            plain: dict[str, Value] = {"Bool": False, "Int": 0, "Text": "", "Message": "", "Pose": pose}
            return plain[name]
        case ListType():
            return ()
        case _:
            assert_never(type_)


def find_measured(posts: Iterable[Post], state: WorldState, bound: Mapping[str, Value]) -> Iterator[Change]:
    """Yield changes after which sensed postconditions hold that leave open what is measured: `a has p`, `a.p >= v`."""
    for literal in (each for post in posts if post.sensed for each in conjuncts(post.condition)):
        match literal:
            case HasProperty(subject=subject, property=name):
                individual = _individual(subject, bound)
                known = state.value(individual, name) if individual else None
                value = known if known is not None else find_stand_in(state.vocabulary.properties[name].type)
            case Compare(left=PropertyOf(of=of, property=name), operator=">=" | "<=", right=right):
                individual, value = _individual(of, bound), value_of(right, state, bound)
            case _:
                continue
        if individual and value is not None and state.vocabulary.properties[name].computed_by is None:
            yield SetProperty(individual, name, value)


def _individual(term: Term | Expression, bound: Mapping[str, Value]) -> str | None:
    match term:
        case Individual(iri=iri):
            return iri
        case Variable(name=name):
            value = bound.get(name)
            return value if isinstance(value, str) else None
        case _:
            return None
