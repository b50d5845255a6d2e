"""The looks of devices in films: models of a collection that are rendered for them, from facts of the scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from skillc_runtime.world.state.data_sheet import sheet_of, text_of
from skillc_runtime.world.state.terms import SKILLC
from skillc_runtime.world.state.world_state import WorldState

COLLECTION = SKILLC + "Collection"
COLLECTION_NAME, REPOSITORY, COMMIT = SKILLC + "collectionName", SKILLC + "repository", SKILLC + "commit"
HAS_LOOK, IN_COLLECTION, LOOK_MODEL = SKILLC + "hasLook", SKILLC + "inCollection", SKILLC + "lookModel"


class LooksError(ValueError):
    """Devices cannot be rendered with these looks; the message says why, and what to do."""


@dataclass(frozen=True, slots=True)
class Collection:
    """Models that are published as a Git repository, at one commit."""

    name: str
    repository: str
    commit: str


@dataclass(frozen=True, slots=True)
class Look:
    """A device by its name, the prefix of its parts in a scene's model, its own model, its look in a collection."""

    device: str
    prefix: str
    own: Path
    model: str


@dataclass(frozen=True, slots=True)
class Looks:
    """A collection and the looks of devices from it."""

    collection: Collection
    looks: tuple[Look, ...]


def read_looks(state: WorldState, prefixes: Mapping[str, str], name: str) -> Looks:
    """Return the looks of a scene's devices in a collection; `prefixes` of their parts in the model are by IRI.

    Raises LooksError if there is no collection of this name, or it has no model of any device of this scene.
    """
    collections = {text_of(state, iri, COLLECTION_NAME): iri for iri in sorted(state.instances(COLLECTION))}
    if name not in collections:
        raise LooksError(f"there are no looks {name}; there are {', '.join(('primitive', *sorted(collections)))}")
    found = collections[name]
    looks = tuple(look for device in prefixes for look in _looks_of(state, device, prefixes[device], found))
    if not looks:
        raise LooksError(f"{name} has no model of any device in this scene")
    return Looks(Collection(name, text_of(state, found, REPOSITORY), text_of(state, found, COMMIT)), looks)


def _looks_of(state: WorldState, device: str, prefix: str, collection: str) -> list[Look]:
    """Return the look of one device in a collection: one, or none."""
    sheet, name = sheet_of(state, device), state.vocabulary.short(device)
    there = [
        look
        for look in sorted(state.objects(sheet.individual, HAS_LOOK))
        if state.holds(look, IN_COLLECTION, collection)
    ]
    return [Look(name, prefix, sheet.model, text_of(state, look, LOOK_MODEL)) for look in there[:1]]
