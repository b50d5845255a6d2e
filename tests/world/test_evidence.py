"""How facts are known: by the last write that stated them, or made them true or false, whatever axiom led there."""

import pytest

from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    Literal,
    Not,
    Or,
    PropertyOf,
    Variable,
)
from skillc_runtime.world.eval.grounds import find_grounds
from skillc_runtime.world.state import evidence
from skillc_runtime.world.state.changes import AddIndividual, ClearProperty, RemoveIndividual, RemoveRelation
from skillc_runtime.world.state.facts import ClassFact, Evidence, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.model import WorldModel
from store.memory import MemoryStore
from store.worlds import model_of
from world.lab import SCENE, assign, fact, individual, iri


def related(subject: str, relation: str, object_: str, holds: bool = True) -> RelationFact:
    return RelationFact(iri(subject), iri(relation), iri(object_), holds)


def known(world: WorldModel, about: Fact) -> Evidence | str | None:
    """Return the evidence of a fact, `given` where no write concerns it."""
    found = world.deciding_write(about)
    return "given" if found is None else found.evidence


def test_the_last_write_decides_also_when_it_changes_nothing() -> None:
    world, weight = WorldModel(SCENE), PropertyFact(iri("box"), iri("weight"))
    assert known(world, weight) == "given"
    world.commit([assign("box", "weight", 4.0)])
    assert known(world, weight) == "assumed", "who does not say how it is known has not looked"
    world.commit([assign("box", "weight", 4.0)], evidence="sensed")
    assert known(world, weight) == "sensed"
    world.commit([assign("box", "weight", 4.0)], evidence="reported")
    assert known(world, weight) == "reported"
    world.commit([ClearProperty(iri("box"), iri("weight"))], "Forget")
    assert known(world, weight) == "assumed"
    assert world.deciding_write(weight).origin == "Forget"


def test_a_rule_of_the_cell_decides_what_counts_but_not_what_is_assumed() -> None:
    world, weight = WorldModel(SCENE), PropertyFact(iri("box"), iri("weight"))
    world.weigh_evidence(lambda changes, stated: "idealised" if stated == "sensed" else stated)
    world.commit([assign("box", "weight", 4.0)], evidence="sensed")
    assert known(world, weight) == "idealised"
    with world.transaction("Weigh", "sensed") as transaction:
        transaction.add(assign("box", "weight", 5.0))
    assert known(world, weight) == "idealised"
    world.commit([assign("box", "weight", 4.0)], evidence="assumed")
    assert known(world, weight) == "assumed"


def test_what_a_write_displaces_is_known_by_it() -> None:
    world = WorldModel(SCENE)
    gone = related("shelf", "contain", "eraser", holds=False)
    world.commit([fact("gripper", "contain", "eraser")], "Grasp", "sensed")
    assert known(world, gone) == "sensed"
    assert known(world, related("eraser", "containedIn", "gripper")) == "sensed", "its inverse"
    assert known(world, related("gripper", "near", "eraser")) == "sensed", "what it implies"
    world.commit([fact("table", "contain", "eraser")], "Place", "assumed")
    assert known(world, gone) == "sensed", "that it left the shelf was seen"
    assert known(world, related("gripper", "contain", "eraser", holds=False)) == "assumed"


def test_a_removal_that_was_seen_stays_so_when_it_is_assumed_where_the_thing_went() -> None:
    world = WorldModel(SCENE)
    world.commit([fact("gripper", "contain", "eraser")], "Grasp", "sensed")
    world.commit([RemoveRelation(iri("gripper"), iri("contain"), iri("eraser"))], "Release", "sensed")
    world.commit([fact("shelf", "contain", "eraser")], "Release", "assumed")
    assert known(world, related("gripper", "contain", "eraser", holds=False)) == "sensed"
    assert known(world, related("shelf", "contain", "eraser")) == "assumed"


def test_what_excludes_a_fact_is_evidence_against_it() -> None:
    world = WorldModel(SCENE)
    world.commit([RemoveRelation(iri("robot"), iri("at"), iri("table"))], "leave", "assumed")
    assert known(world, related("robot", "at", "table", holds=False)) == "assumed"
    world.commit([fact("robot", "at", "shelf")], "DriveBase", "reported")
    assert known(world, related("robot", "at", "table", holds=False)) == "reported", "a robot is at one place only"


def test_a_chain_is_as_weak_as_its_weakest_link() -> None:
    world = WorldModel(SCENE)
    world.commit([fact("shelf", "contain", "box")], "Place", "assumed")
    world.commit([individual("lid", "Product"), fact("box", "hasA", "lid")], "Look", "sensed")
    assert SCENE.vocabulary.relations[iri("within-it")].transitive
    assert world.snapshot().holds(iri("shelf"), iri("within-it"), iri("lid"))
    assert known(world, related("shelf", "within-it", "lid")) == "assumed"
    assert known(world, related("box", "within-it", "lid")) == "sensed"


def test_computed_values_are_known_as_what_changed_them() -> None:
    world, load = WorldModel(SCENE), PropertyFact(iri("shelf"), iri("load"))
    assert known(world, load) == "given"
    world.commit([fact("shelf", "contain", "eraser")], evidence="sensed")
    assert known(world, load) == "given", "it was there"
    world.commit([fact("shelf", "contain", "box")], evidence="reported")
    assert known(world, load) == "reported"


def test_individuals_come_and_go_with_their_facts() -> None:
    world = WorldModel(SCENE)
    world.commit([AddIndividual(iri("new"), (iri("Eraser"),))], evidence="sensed")
    assert known(world, ClassFact(iri("new"), iri("Product"))) == "sensed"
    world.commit([assign("new", "weight", 1.0)], evidence="sensed")
    world.commit([RemoveIndividual(iri("new"))], evidence="assumed")
    assert known(world, PropertyFact(iri("new"), iri("weight"))) == "assumed"
    assert known(world, ClassFact(iri("new"), iri("Product"), holds=False)) == "assumed"


def test_what_is_taken_back_is_known_as_before() -> None:
    world, weight = WorldModel(SCENE), PropertyFact(iri("box"), iri("weight"))
    world.commit([assign("box", "weight", 4.0)], evidence="sensed")
    world.commit([assign("box", "weight", 5.0)], evidence="assumed")
    world.undo()
    assert known(world, weight) == "sensed"
    world.undo()
    assert known(world, weight) == "given"


def test_what_others_write_is_no_claim_of_this_run() -> None:
    store = MemoryStore()
    one, other = model_of(store), model_of(store)
    one.commit([assign("box", "weight", 4.0)], evidence="assumed")
    other.commit([assign("box", "weight", 5.0)], evidence="assumed")
    one.follow()
    assert known(one, PropertyFact(iri("box"), iri("weight"))) is None
    assert known(other, PropertyFact(iri("box"), iri("weight"))) == "assumed"


def test_old_writes_are_taken_together_and_the_weakest_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(evidence, "MAX_WRITES", 3)
    world, weight = WorldModel(SCENE), PropertyFact(iri("box"), iri("weight"))
    world.commit([assign("box", "weight", 4.0)], "Weigh", "sensed")
    world.commit([assign("board", "isClean", True)], "Guess", "assumed")
    assert known(world, weight) == "sensed"
    for number in range(3):
        world.commit([assign("eraser", "weight", float(number))], evidence="sensed")
    assert known(world, weight) == "assumed", "rather too weak than too strong"
    assert known(world, PropertyFact(iri("eraser"), iri("weight"))) == "sensed"


BOX_HEAVY = Compare(PropertyOf(Individual(iri("box")), iri("weight")), ">", Literal(1.0))
CLEAN = Compare(PropertyOf(Individual(iri("board")), iri("isClean")), "==", Literal(True))
IN_GRIPPER = Holds(Individual(iri("gripper")), iri("contain"), Individual(iri("eraser")))
NOTHING_HELD = Not(Holds(Individual(iri("gripper")), iri("contain"), Anything()))
SOME_HOLDER = Exists("h", iri("Holder"), Holds(Variable("h"), iri("contain"), Individual(iri("eraser"))))
ALL_FREE = Forall("p", iri("Product"), Not(Holds(Individual(iri("gripper")), iri("contain"), Variable("p"))))
FREED = "not t:gripper contain t:eraser"


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        (BOX_HEAVY, {"t:box.weight == 4 kg": "sensed"}),
        (Not(BOX_HEAVY), {"t:box.weight == 4 kg": "sensed"}),
        (And((BOX_HEAVY, CLEAN)), {"t:box.weight == 4 kg": "sensed", "t:board.isClean == true": "assumed"}),
        (Or((CLEAN, BOX_HEAVY)), {"t:box.weight == 4 kg": "sensed"}),
        (And((CLEAN, IN_GRIPPER)), {FREED: "assumed"}),
        (NOTHING_HELD, {FREED: "assumed"}),
        (ALL_FREE, None),
        (SOME_HOLDER, None),
    ],
)
def test_a_condition_rests_on_the_facts_that_decide_it(condition: Condition, expected: dict[str, str] | None) -> None:
    world = WorldModel(SCENE)
    world.commit([fact("gripper", "contain", "eraser")], "Grasp", "sensed")
    world.commit([assign("box", "weight", 4.0)], "Weigh", "sensed")
    world.commit([assign("board", "isClean", True)], "Wipe", "assumed")
    world.commit([fact("shelf", "contain", "eraser")], "Place", "assumed")
    found = find_grounds(condition, world, {})
    told = {
        format_fact(label_fact(each.fact, world.snapshot())): each.write.evidence
        for each in found
        if each.write is not None
    }
    if expected is not None:
        assert told == expected
    else:
        assert [each for each in found if each.is_assumed], "the last place is only assumed"
