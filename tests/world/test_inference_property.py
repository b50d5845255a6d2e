"""Inference agrees with trying everything, on random scenes and conditions: answers, ambiguity, the nearest misses."""

from __future__ import annotations

import os
from collections.abc import Sequence
from itertools import product

from hypothesis import event, given, settings
from hypothesis import strategies as st

from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Exists,
    Forall,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.skills import Parameter, Requirement
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import THING
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.inference import Ambiguous, Inferred, NoneFound, infer
from skillc_runtime.world.eval.near_misses import MAX_NEAR_MISSES, NearMiss
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, assign, fact, individual, iri, parameter, requirement

EXAMPLES = int(os.environ.get("SKILLC_INFERENCES", "40"))
"""How many random inferences are checked; thousands on occasion."""

PLACES, PRODUCTS, GRIPPERS = ("table", "shelf", "place-1"), ("box", "eraser", "part-1"), ("gripper", "gripper-1")
CLASSES = ("Location", "Product", "Eraser", "Gripper", "WsgGripper", "CompliantArm", "Holder", "Tool")
NAMES = ("p", "q", "r")
BOUND = {"given": iri("shelf")}

names = st.sampled_from((*NAMES, "given"))
terms = st.one_of(names.map(Variable), names.map(Variable), st.just(Anything()), st.just(Individual(iri("table"))))
relations = st.sampled_from(("contain", "containedIn", "within-it", "hasA", "beside", "at")).map(iri)
variables = names.map(Variable)
classes = st.sampled_from(CLASSES).map(iri)
weights = st.builds(
    Compare,
    variables.map(lambda name: PropertyOf(name, iri("weight"))),
    st.sampled_from(("<", ">=")),
    st.sampled_from((1.0, 2.0)).map(Literal),
)
simple = st.one_of(
    st.builds(Holds, terms, relations, terms),
    st.builds(Holds, variables, relations, variables),
    weights,
    st.builds(Same, variables, variables),
    st.builds(IsA, variables, classes),
    st.builds(HasProperty, variables, st.just(iri("weight"))),
)
some = st.builds(Holds, st.just(Variable("some")), relations, variables)
conditions = st.recursive(
    st.one_of(simple, st.builds(Exists, st.just("some"), classes, some)),
    lambda inner: st.one_of(
        inner.map(Not),
        st.lists(inner, min_size=2, max_size=2).map(tuple).map(Or),
        st.lists(inner, min_size=2, max_size=2).map(tuple).map(And),
        st.builds(Forall, st.just("some"), classes, some),
    ),
    max_leaves=3,
)
facts = st.one_of(
    st.builds(fact, st.sampled_from((*PLACES, *GRIPPERS)), st.just("contain"), st.sampled_from(PRODUCTS)),
    st.builds(fact, st.sampled_from(PLACES), st.just("beside"), st.sampled_from(PLACES)),
    st.builds(assign, st.sampled_from(PRODUCTS), st.just("weight"), st.sampled_from((0.5, 1.0, 2.0))),
)
added = (individual("place-1", "Location"), individual("part-1", "Product"), individual("gripper-1", "Gripper"))
scenes = st.lists(facts, max_size=6).map(lambda changes: SCENE.with_changes((*added, *changes)))
wanted = st.lists(
    st.builds(parameter, st.sampled_from(NAMES), st.sampled_from(CLASSES), st.just("infer"), st.booleans()),
    min_size=1,
    max_size=3,
    unique_by=lambda each: each.name,
)
requirements = st.lists(conditions, max_size=4).map(lambda each: tuple(map(requirement, "abcd", each)))


@given(scenes, wanted, requirements)
@settings(max_examples=EXAMPLES)
def test_the_answer_is_that_of_trying_everything(
    state: WorldState, looked_for: list[Parameter], asked: tuple[Requirement, ...]
) -> None:
    known = {*(each.name for each in looked_for), *BOUND}
    asked = tuple(each for each in asked if free_variables(each.condition) <= known)
    classes_of = {each.name: _class_of(each) for each in looked_for}
    tried = attempts(classes_of, asked, state)
    answer = infer(looked_for, asked, BOUND, state)
    event(type(answer).__name__)
    match answer:
        case Inferred(bindings=first, others=others):
            assert [first, *others] == tried
            assert all(each.any_ or len({one[each.name] for one in tried}) == 1 for each in looked_for)
        case Ambiguous(candidates=several):
            assert list(several) == tried
            assert any(not each.any_ and len({one[each.name] for one in tried}) > 1 for each in looked_for)
        case NoneFound():
            assert not tried
            _is_explained(answer, classes_of, asked, state)


def _is_explained(
    answer: NoneFound, classes_of: dict[str, str], asked: tuple[Requirement, ...], state: WorldState
) -> None:
    if answer.requirement is None:
        assert not all(state.instances(cls) for cls in classes_of.values())
    else:
        place = next(count for count in range(1, len(asked) + 1) if not attempts(classes_of, asked[:count], state))
        assert answer.requirement is asked[place - 1]
    assert answer.reason and all(miss.reason for miss in answer.nearest)
    assert [_near(miss) for miss in answer.nearest] == list(near_misses(classes_of, asked, state))
    event(f"{len(answer.nearest)} near misses")


def attempts(classes_of: dict[str, str], asked: Sequence[Requirement], state: WorldState) -> list[dict[str, str]]:
    """Return all answers, by trying all individuals for all parameters."""
    about = [each.condition for each in asked if free_variables(each.condition) & classes_of.keys()]
    every = [sorted(state.instances(cls)) for cls in classes_of.values()]
    tried = (dict(zip(classes_of, each, strict=True)) for each in product(*every))
    return [one for one in tried if all(evaluate(condition, state, {**BOUND, **one}) for condition in about)]


Near = tuple[Requirement | None, tuple[str, ...], tuple[str, ...]]


def _near(miss: NearMiss) -> Near:
    return miss.requirement, miss.about, tuple(miss.bindings[name] for name in miss.about)


def near_misses(classes_of: dict[str, str], asked: tuple[Requirement, ...], state: WorldState) -> list[Near]:
    """Return what would do without one requirement, or as another class, where that are few."""
    found: list[Near] = []
    for place, dropped in enumerate(asked):
        about = tuple(name for name in classes_of if name in free_variables(dropped.condition))
        rest = (*asked[:place], *asked[place + 1 :])
        found += _few(dropped, about, attempts(classes_of, rest, state))
    for name in classes_of:
        if any(name in free_variables(each.condition) for each in asked):
            found += _few(None, (name,), attempts({**classes_of, name: THING}, asked, state))
    return found


def _few(dropped: Requirement | None, about: tuple[str, ...], answers: list[dict[str, str]]) -> list[Near]:
    different = sorted({tuple(one[name] for name in about) for one in answers}) if about else []
    return [(dropped, about, each) for each in different] if len(different) <= MAX_NEAR_MISSES else []


def _class_of(each: Parameter) -> str:
    assert hasattr(each.type, "iri")
    return str(each.type.iri)
