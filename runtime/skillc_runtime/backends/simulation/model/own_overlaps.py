"""Leaves out the contacts that an arm always has with itself, which are due to the simple shapes of its model."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import mujoco

from skillc_runtime.backends.simulation.model.contact_bits import LINK
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec


def exclude_own_overlaps(spec: Any, scene: SceneSpec) -> None:
    """Exclude contacts of the parts of each hand, of an arm's first link with its base, and of what overlaps at home.

    spec: a `mujoco.MjSpec` with all arms of the scene.
    """
    model = spec.compile()
    overlaps = _overlaps_at_home(model, scene)
    for arm in scene.arms:
        links, hand = _links(model, scene.names, arm), _hand(model, scene.names, arm)
        own = {frozenset(pair) for pair in combinations(hand, 2)} | {frozenset(pair) for pair in _feet(model, links)}
        own |= {pair for pair in overlaps if pair <= {*links, *hand}}
        for one, other in sorted(map(sorted, own)):
            spec.add_exclude(bodyname1=model.body(one).name, bodyname2=model.body(other).name)


def _overlaps_at_home(model: Any, scene: SceneSpec) -> set[frozenset[int]]:
    """Return the pairs of bodies whose links overlap when all arms are in their home postures."""
    data = mujoco.MjData(model)
    for arm in scene.arms:
        joints = [j for link in _links(model, scene.names, arm) for j in _joints(model, link)]
        data.qpos[model.jnt_qposadr[joints]] = arm.home
    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)
    touching = [pair for pair in data.contact.geom.tolist() if (model.geom_contype[pair] == LINK).all()]
    return {frozenset(model.geom_bodyid[pair].tolist()) for pair in touching}


def _feet(model: Any, links: list[int]) -> Iterator[tuple[int, int]]:
    """Yield the pairs of the parts of an arm's base with its first link."""
    first = next(link for link in links if model.body_jntnum[link])
    for foot in links[: links.index(first)]:
        yield foot, first


def _links(model: Any, names: dict[str, str], arm: ArmSpec) -> list[int]:
    return _bodies(model, names[arm.individual])


def _hand(model: Any, names: dict[str, str], arm: ArmSpec) -> list[int]:
    return [] if arm.gripper is None else _bodies(model, names[arm.gripper.individual])


def _bodies(model: Any, device: str) -> list[int]:
    """Return the bodies of a device, the outermost first."""
    prefix = part_name(device, "")
    return [body for body in range(model.nbody) if model.body(body).name.startswith(prefix)]


def _joints(model: Any, link: int) -> range:
    first = int(model.body_jntadr[link])
    return range(first, first + int(model.body_jntnum[link]))
