"""The looks of devices in films: models of a collection that are rendered for them, from facts of the scene."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillc_runtime.backends.simulation.scene_spec import ArmSpec, GripperSpec, SceneSpec
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
    """A device by its name in the simulation, its own model, and the path of its look in a collection."""

    device: str
    own: Path
    model: str


@dataclass(frozen=True, slots=True)
class Looks:
    """A collection and the looks of devices from it."""

    collection: Collection
    looks: tuple[Look, ...]


def read_looks(state: WorldState, scene: SceneSpec, name: str) -> Looks:
    """Return the looks of a scene's devices in a collection.

    Raises LooksError if there is no collection of this name, or it has no model of any device of this scene.
    """
    collections = {text_of(state, iri, COLLECTION_NAME): iri for iri in sorted(state.instances(COLLECTION))}
    if name not in collections:
        raise LooksError(f"there are no looks {name}; there are {', '.join(('primitive', *sorted(collections)))}")
    found = collections[name]
    looks = tuple(look for device in _devices(scene) for look in _looks_of(state, scene, device, found))
    if not looks:
        raise LooksError(f"{name} has no model of any device in this scene")
    return Looks(Collection(name, text_of(state, found, REPOSITORY), text_of(state, found, COMMIT)), looks)


def _devices(scene: SceneSpec) -> list[ArmSpec | GripperSpec]:
    return [*scene.arms, *(arm.gripper for arm in scene.arms if arm.gripper is not None)]


def _looks_of(state: WorldState, scene: SceneSpec, device: ArmSpec | GripperSpec, collection: str) -> list[Look]:
    """Return the look of one device in a collection: one, or none."""
    there = [
        look
        for look in sorted(state.objects(sheet_of(state, device.individual).individual, HAS_LOOK))
        if state.holds(look, IN_COLLECTION, collection)
    ]
    name = scene.names[device.individual]
    return [Look(name, device.model, text_of(state, look, LOOK_MODEL)) for look in there[:1]]
