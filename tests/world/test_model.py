"""Writes: each axiom with one that breaks it and is refused whole, and one that does not."""

import math
from itertools import pairwise

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_model.conditions import Anything, Assert, Assign, Individual, Literal, Retract, Variable
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveRelation
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.terms import CONTAIN
from skillc_runtime.world.state.transactions import ChangeEvent
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, VOCABULARY, assign, fact, individual, iri

REFUSED = [
    (fact("box", "at", "robot"), "t:at takes (Thing, t:Location)"),
    (fact("box", "hasGripper", "gripper"), "t:hasGripper takes (t:Arm, t:Gripper); t:box is a t:Product"),
    (fact("shelf", "contain", "shelf"), "irreflexive"),
    (fact("table", "contain", "nobody"), "there is no individual t:nobody"),
    (assign("nobody", "weight", 1.0), "there is no individual t:nobody"),
    (individual("table", "Robot"), "t:table cannot be both a t:Location and a t:Robot: the classes are disjoint"),
    (individual("new", "Spaceship"), "there is no such class"),
    (assign("arm", "state", "Broken"), "it is one of Idle, Fault"),
    (assign("box", "weight", "heavy"), "it takes a number"),
    (assign("box", "weight", True), "it takes a number"),
    (assign("box", "weight", math.nan), "NaN"),
    (assign("board", "isClean", 1.0), "it takes true or false"),
    (assign("board", "weight", 1.0), "it belongs to t:Product; t:board is a t:Board"),
    (assign("box", "weight", (1.0, 2.0)), "it takes a number"),
    (assign("table", "load", 3), "computed"),
    (AddRelation(iri("box"), iri("unheard"), iri("box")), "there is no relation or property t:unheard"),
]


@pytest.mark.parametrize(("change", "words"), REFUSED)
def test_a_write_that_breaks_an_axiom_is_refused_whole(change: Change, words: str) -> None:
    model = WorldModel(SCENE)
    events: list[ChangeEvent] = []
    model.subscribe(events.append)
    with pytest.raises(WorldError) as caught:
        model.commit([assign("box", "weight", 4.0), change])
    assert words in str(caught.value)
    assert model.snapshot() is SCENE and not events


def test_asymmetry_is_kept() -> None:
    state = SCENE.with_changes(
        [individual("crate", "Holder"), individual("bin", "Holder"), fact("bin", "contain", "crate")]
    )
    with pytest.raises(WorldError, match="asymmetric, and `t:bin t:contain t:crate` holds"):
        WorldModel(state).commit([fact("crate", "contain", "bin")])


def test_nothing_comes_to_lie_in_itself_over_any_number_of_facts() -> None:
    vocabulary = load_vocabulary()
    boxes = [iri(f"Box-{number}") for number in range(4)]
    added = [AddIndividual(each, (vocabulary.expand("skiros:Container"),)) for each in boxes]
    chain = [AddRelation(outer, CONTAIN, inner) for outer, inner in pairwise(boxes)]
    model = WorldModel(WorldState.empty(vocabulary).with_changes([*added, *chain]))
    circle = AddRelation(boxes[3], CONTAIN, boxes[0])
    with pytest.raises(WorldError, match=r"acyclic, and `.*Box-0.* skillc:holdsDeep .*Box-3` holds"):
        model.commit([circle])
    model.commit([RemoveRelation(boxes[0], CONTAIN, boxes[1]), circle])


def test_one_write_cannot_give_a_functional_relation_two_values() -> None:
    both = [fact("robot", "at", "shelf"), fact("robot", "at", "table")]
    with pytest.raises(WorldError, match="functional"):
        WorldModel(SCENE).commit(both)
    moved = WorldModel(SCENE).commit([both[0], RemoveRelation(iri("robot"), iri("at"), iri("shelf")), both[1]])
    assert moved.after.objects(iri("robot"), iri("at")) == {iri("table")}


def test_a_write_is_told_with_before_and_after_until_nobody_listens() -> None:
    model, events = WorldModel(SCENE), list[ChangeEvent]()
    stop = model.subscribe(events.append)
    event = model.commit([fact("gripper", "contain", "eraser")], origin="Pick")
    stop()
    model.commit([fact("shelf", "contain", "eraser")])
    assert events == [event] and event.origin == "Pick"
    assert event.before is SCENE and event.after.holds(iri("gripper"), iri("contain"), iri("eraser"))
    assert not event.before.holds(iri("gripper"), iri("contain"), iri("eraser"))


def test_effects_become_changes_with_removals_first() -> None:
    bindings = {"gripper": iri("gripper"), "object": iri("eraser")}
    effects = (
        Assert(Variable("gripper"), iri("contain"), Variable("object")),
        Assign(Individual(iri("board")), iri("isClean"), Literal(True)),
        Retract(Anything(), iri("contain"), Variable("object")),
    )
    changes = changes_of(effects, SCENE, bindings)
    assert changes == (
        RemoveRelation(iri("shelf"), iri("contain"), iri("eraser")),
        fact("gripper", "contain", "eraser"),
        assign("board", "isClean", True),
    )
    state = WorldModel(SCENE).commit(changes).after
    assert state.subjects(iri("contain"), iri("eraser")) == {iri("gripper")}
    assert state.value(iri("board"), iri("isClean")) is True
    assert state.individuals_with(iri("isClean"), True) == (iri("board"),)


def test_retracting_a_relation_retracts_what_it_follows_from() -> None:
    effect = Retract(Individual(iri("arm")), iri("hasA"), Anything())
    state = WorldModel(SCENE).commit(changes_of((effect,), SCENE, {})).after
    assert not state.objects(iri("arm"), iri("hasGripper")) and VOCABULARY is state.vocabulary
