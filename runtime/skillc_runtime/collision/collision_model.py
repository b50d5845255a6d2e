"""The MuJoCo model for collision checks: an arm, its hand, the objects that it holds, and the scenery."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import combinations, product
from typing import Any

import msgspec
import mujoco
import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly, Hand
from skillc_runtime.collision.scenery import Scenery
from skillc_runtime.collision.solid_geoms import add_solid
from skillc_runtime.motion.pose import Array, Pose

MOVES, STANDS = 1, 2
"""Contact bits of moving parts, which also collide with each other, and of the scenery."""

ARM, HAND, HELD = "arm/", "hand/", "held/"
"""Prefixes of the names of an arm's links, of its gripper's parts and of held objects."""


SEEN_BEYOND_M = 0.04
"""How much farther than its clearance distances are computed: an arm that is far from everything needs fewer looks."""

ORIGIN = Pose.of((0.0, 0.0, 0.0))


class CollisionModel(msgspec.Struct, frozen=True):
    """A compiled model in the arm's base frame; the first `joints` positions are the arm's, `fingers` the others.

    names: of each geom, for messages; links, palm: geoms of the arm, and of the gripper without its fingers and what
    it holds; levers (nv,): m, the greatest distance of any part of the arm from each joint;
    margin: m, the clearance that the arm keeps.
    """

    compiled: Any
    names: tuple[str, ...]
    links: frozenset[int]
    palm: frozenset[int]
    joints: int
    fingers: Array
    levers: Array
    margin: float

    @property
    def seen_m(self) -> float:
        """Up to which distance in m pairs of geoms are reported."""
        return self.margin + SEEN_BEYOND_M


@lru_cache(maxsize=16)
def build_collision_model(assembly: ArmAssembly, scenery: Scenery) -> CollisionModel:
    """Return the model; ValueError if the model of an arm has no site `flange`, or that of a gripper no site `tcp`."""
    spec, arm = mujoco.MjSpec(), _moving_model(assembly.model)
    spec.option.timestep, spec.option.integrator = arm.option.timestep, arm.option.integrator
    _add_scenery(spec, scenery)
    spec.attach(arm, prefix=ARM, frame=spec.worldbody.add_frame())
    joints = len(spec.joints)
    if assembly.hand is not None:
        _add_hand(spec, assembly.hand)
    _exclude_touching(spec)
    model = spec.compile()
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_OVERRIDE)
    model.opt.o_margin = assembly.clearance_m + SEEN_BEYOND_M
    names = tuple(_name(model, geom, assembly, scenery) for geom in range(model.ngeom))
    fingers, levers = _fingers(model, joints, assembly.hand), _levers(model, joints)
    links, palm = _geoms(model, ARM), _geoms(model, HAND)
    return CollisionModel(model, names, links, palm, joints, fingers, levers, assembly.clearance_m)


def _moving_model(path: str) -> Any:
    """Return a moving model without sensors and motors."""
    model = _passive_model(path)
    for geom in model.geoms:
        geom.contype, geom.conaffinity = MOVES, MOVES | STANDS
    return model


def _passive_model(path: str) -> Any:
    model = mujoco.MjSpec.from_file(path)
    for part in (*model.actuators, *model.sensors, *model.keys):
        model.delete(part)
    return model


def _add_hand(spec: Any, hand: Hand) -> None:
    """Attach the gripper to the flange, and held objects to its palm."""
    spec.attach(_moving_model(hand.model), prefix=HAND, site=spec.site(ARM + "flange"))
    centre = spec.site(HAND + "tcp")
    for index, block in enumerate(hand.held):
        solid = block.solid_at(Pose.of(centre.pos, centre.quat))
        geom = add_solid(spec, centre.parent, f"{HELD}{index}", solid)
        geom.contype, geom.conaffinity = MOVES, MOVES | STANDS


def _exclude_touching(spec: Any) -> None:
    """Exclude pairs that always touch: parts of the hand, and the arm's first link with its base."""
    hand = [body.name for body in spec.bodies if body.name.startswith(HAND)]
    first = next(body for body in spec.bodies if body.joints and body.name.startswith(ARM))
    feet = [body.name for body in spec.bodies if body.name.startswith(ARM)]
    feet = feet[: feet.index(first.name)]
    for one, other in (*combinations(hand, 2), *product(feet, [first.name])):
        spec.add_exclude(bodyname1=one, bodyname2=other)


def _add_scenery(spec: Any, scenery: Scenery) -> None:
    floor = spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[10.0, 10.0, 0.1])
    floor.pos, floor.quat = scenery.floor.position, scenery.floor.quaternion
    _set_static(floor)
    for index, block in enumerate(scenery.blocks):
        _set_static(add_solid(spec, spec.worldbody, f"block/{index}", block.solid_at(ORIGIN)))
    for index, thing in enumerate(scenery.modelled):
        model = _passive_model(thing.model)
        for joint in model.joints:
            model.delete(joint)
        for geom in model.geoms:
            _set_static(geom)
        frame = spec.worldbody.add_frame(pos=thing.place.position, quat=thing.place.quaternion)
        spec.attach(model, prefix=f"thing/{index}/", frame=frame)


def _set_static(geom: Any) -> None:
    geom.contype, geom.conaffinity = STANDS, 0


def _fingers(model: Any, joints: int, hand: Hand | None) -> Array:
    """Return the positions of the finger joints: each has its share of the opening."""
    fingers = np.zeros(model.nq)
    if hand is not None:
        tendon = model.tendon(HAND + "opening").id
        span = slice(model.tendon_adr[tendon], model.tendon_adr[tendon] + model.tendon_num[tendon])
        shares = model.wrap_prm[span]
        fingers[model.jnt_qposadr[model.wrap_objid[span]]] = hand.opening_m / shares.sum()
    return fingers[joints:]


def _geoms(model: Any, prefix: str) -> frozenset[int]:
    """Return the geoms of an arm, or those of a gripper that its joints do not move, without what it holds."""
    return frozenset(
        geom
        for geom in range(model.ngeom)
        if model.body(model.geom_bodyid[geom]).name.startswith(prefix)
        and not (prefix == HAND and model.body_jntnum[model.geom_bodyid[geom]])
        and not model.geom(geom).name.startswith(HELD)
    )


def _levers(model: Any, joints: int) -> Array:
    """Return the greatest distance (joints,) in m of a point from each joint that moves it, all links aligned."""
    levers = np.zeros(joints)
    for geom in np.flatnonzero(model.geom_contype == MOVES).tolist():
        for joint, far in joints_of(model, geom):
            if joint < joints:
                levers[joint] = max(levers[joint], far)
    return levers


def joints_of(model: Any, geom: int) -> Iterator[tuple[int, float]]:
    """Yield each joint that moves a geom, and the greatest distance in m of the geom from it."""
    far = float(np.linalg.norm(model.geom_pos[geom]) + model.geom_rbound[geom])
    for link in _chain(model, int(model.geom_bodyid[geom])):
        first = int(model.body_jntadr[link])
        for joint in range(first, first + int(model.body_jntnum[link])):
            yield joint, far + float(np.linalg.norm(model.jnt_pos[joint]))
        far += float(np.linalg.norm(model.body_pos[link]))


def _chain(model: Any, link: int) -> Iterator[int]:
    """Yield a link and its ancestors, without the world."""
    while link > 0:
        yield link
        link = int(model.body_parentid[link])


def _name(model: Any, geom: int, assembly: ArmAssembly, scenery: Scenery) -> str:
    """Return the name of a geom for messages: of a link, the gripper, a held object or an obstacle."""
    own, link = model.geom(geom).name, model.body(model.geom_bodyid[geom]).name
    kind, _, index = (own if own.startswith(("block/", HELD)) else link).partition("/")
    match kind:
        case "arm":
            return f"{assembly.name} {index}"
        case "hand" if assembly.hand is not None:
            return assembly.hand.name
        case "held" if assembly.hand is not None:
            return assembly.hand.held[int(index)].name
        case "block":
            return scenery.blocks[int(index)].name
        case "thing":
            return scenery.modelled[int(index.partition("/")[0])].name
        case _:
            return "the floor"
