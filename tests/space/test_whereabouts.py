"""A thing that is not where it was believed to be is nowhere but in the area around; its pose is its last known one."""

from __future__ import annotations

import pytest

from skillc_runtime.primitives.contradiction import contradict_place
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT, CONTAIN, FURNITURE, HAS_A, LOCATED, ON, WORKSTATION
from space.rooms import at, lab, linked, same, skillc, thing, world

CUP, TRAY, CELL = lab("Cup"), lab("Tray"), lab("Cell")
SPATIAL = [skillc(each) for each in ("isAbove", "restsOn", "isInside")]
GONE = "the cup is gone"


def room(*links: AddRelation) -> WorldModel:
    """Return a cell with a robot, its hand, and a tray, with which a cup moves that stands on it."""
    return WorldModel(
        world(
            thing("Cell", at(0, 0, 0), cls=WORKSTATION),
            thing("Robot", at(0, 0, 0), cls=skillc("FixedRobot")),
            thing("Arm", cls=skillc("Panda")),
            thing("Hand", at(0, 0, 0.5), cls=skillc("PandaHand")),
            thing("Tray", at(0.5, 0, 0.7), size=(0.4, 0.4, 0.2), cls=FURNITURE),
            thing("Cup", at(0, 0, 0.05), frame="Tray", size=(0.1, 0.1, 0.1)),
            [linked("Robot", AT, "Cell"), linked("Robot", HAS_A, "Arm"), linked("Arm", HAS_A, "Hand")],
            [linked("Cell", CONTAIN, "Tray"), *links],
        )
    )


def miss(model: WorldModel, place: str | None = None) -> SkillFailure:
    return contradict_place(model, "Look", CUP, SkillFailure(GONE), place)


def test_what_contained_it_is_withdrawn_by_what_was_measured_and_the_area_around_is_assumed() -> None:
    model = room(linked("Tray", CONTAIN, "Cup"))
    assert miss(model).withdrawn == (f"`{TRAY} contain {CUP}` (given)",)
    lost = model.deciding_write(RelationFact(TRAY, CONTAIN, CUP, holds=False))
    assert lost is not None and (lost.evidence, lost.origin) == ("sensed", f"Look: {GONE}")
    assert model.snapshot().subjects(CONTAIN, CUP) == {CELL}
    assumed = model.deciding_write(RelationFact(CELL, CONTAIN, CUP))
    assert assumed is not None and assumed.evidence == "assumed"
    known = model.deciding_write(PropertyFact(CUP, LOCATED))
    assert model.snapshot().value(CUP, LOCATED) is False and known is not None and known.evidence == "sensed"


def test_it_does_not_move_with_what_contained_it_any_more() -> None:
    model = room(linked("Tray", CONTAIN, "Cup"))
    before = pose(model.snapshot(), CUP)
    miss(model)
    model.commit(placement_changes(TRAY, at(3, 0, 0.7)))
    assert same(pose(model.snapshot(), CUP), before)


@pytest.mark.parametrize(("holder", "place"), [("Hand", None), ("Tray", None), ("Tray", TRAY), ("Cell", None)])
def test_it_is_in_the_area_around_whatever_contained_it(holder: str, place: str | None) -> None:
    model = room(linked(holder, CONTAIN, "Cup"))
    miss(model, place)
    assert model.snapshot().subjects(CONTAIN, CUP) == {CELL}


def test_an_area_in_which_it_was_looked_for_as_a_place_does_not_contain_it() -> None:
    model = room(linked("Cell", CONTAIN, "Cup"))
    assert miss(model, CELL).withdrawn == (f"`{CELL} contain {CUP}` (given)",)
    assert model.snapshot().subjects(CONTAIN, CUP) == set()


def test_without_an_area_it_is_nowhere() -> None:
    model = WorldModel(
        world(thing("Tray", at(0, 0, 0)), thing("Cup", at(0, 0, 0), frame="Tray"), [linked("Tray", CONTAIN, "Cup")])
    )
    miss(model)
    assert model.snapshot().subjects(CONTAIN, CUP) == set()


def test_it_lies_on_in_and_over_nothing_until_it_is_seen_again() -> None:
    model = room(linked("Cell", CONTAIN, "Cup"))
    model.commit(placement_changes(CUP, at(0.5, 0, 0.75)))
    held = [each for each in SPATIAL if model.snapshot().holds(CUP, each, TRAY)]
    miss(model)
    state = model.snapshot()
    assert held and not any(state.holds(CUP, each, TRAY) for each in SPATIAL)
    assert state.axioms.computed[held[0]].obstacle(state, CUP, TRAY) == f"it is not known where {CUP} is"
    assert not state.holds(TRAY, SPATIAL[0], CUP)


def test_what_it_was_stated_to_be_on_is_withdrawn() -> None:
    model = room(linked("Cell", CONTAIN, "Cup"))
    model.commit([linked("Cup", ON, "Tray")])
    before = pose(model.snapshot(), CUP)
    assert miss(model).withdrawn == (f"`{CUP} on {TRAY}` (assumed)",)
    assert same(pose(model.snapshot(), CUP), before)
    lost = model.deciding_write(RelationFact(CUP, ON, TRAY, holds=False))
    assert lost is not None and lost.evidence == "sensed"
