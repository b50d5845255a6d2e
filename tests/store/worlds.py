"""Worlds and random writes that the tests of stores share."""

from collections.abc import Iterator
from random import Random

from skillc_runtime.store.store import Store
from skillc_runtime.store.triples import all_triples
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
)
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, VOCABULARY, assign, fact, iri

PLACES = ("shelf", "table")
THINGS = ("eraser", "box", "robot", "gripper", "arm")


def facts_of(state: WorldState) -> frozenset[str]:
    """Return what a version says, comparable over processes."""
    return frozenset(map(str, all_triples(state)))


def filling(state: WorldState = SCENE) -> ChangeEvent:
    """Return the write that fills an empty store."""
    return ChangeEvent((), "scene lab.ttl 0123456789ab", WorldState.empty(VOCABULARY), state)


def model_of(store: Store) -> WorldModel:
    """Return the world in a store, which is filled if it is empty."""
    kept = store.read()
    if not kept.triples:
        if store.append(filling(), kept.sequence):
            return WorldModel(SCENE, store, kept.sequence + 1)
        kept = store.read()
    return WorldModel(build_world(kept.triples, VOCABULARY, "the store"), store, kept.sequence)


def random_write(chance: Random) -> tuple[Change, ...]:
    """Return one to four changes, which the axioms may refuse."""
    return tuple(_change(chance) for _ in range(chance.randint(1, 4)))


def commits(model: WorldModel, chance: Random, count: int) -> Iterator[ChangeEvent]:
    """Commit so many random writes that the axioms allow."""
    made = 0
    while made < count:
        try:
            event = model.commit(random_write(chance), f"write {made}")
        except WorldError:
            continue
        made += 1
        yield event


def _change(chance: Random) -> Change:
    thing, place = chance.choice(THINGS), chance.choice(PLACES)
    new = f"new-{chance.randint(0, 5)}"
    match chance.randint(0, 9):
        case 0:
            return fact("robot", "at", place)
        case 1:
            return fact(chance.choice((*PLACES, "gripper")), "contain", thing)
        case 2:
            return fact(thing, "containedIn", place)
        case 3:
            return RemoveRelation(iri(place), iri(chance.choice(("contain", "within-it", "near"))), iri(thing))
        case 4:
            return assign("box", "weight", chance.choice((chance.random(), chance.randint(0, 9))))
        case 5:
            return assign("box", "label", tuple(chance.sample(('"q"', "é\n\\", "", "red"), chance.randint(1, 3))))
        case 6:
            return ClearProperty(iri("box"), iri(chance.choice(("weight", "label"))))
        case 7:
            return AddIndividual(iri(new), (iri(chance.choice(("Product", "Eraser", "Holder"))),))
        case 8:
            return RemoveIndividual(iri(new))
        case _:
            return AddRelation(
                iri(place), iri(chance.choice(("contain", "beside", "near"))), iri(chance.choice((new, place)))
            )
