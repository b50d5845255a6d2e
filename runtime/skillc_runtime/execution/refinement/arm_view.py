"""An arm in a situation, as kinematics and collisions see it."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

import mujoco
import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly, read_arm_assembly
from skillc_runtime.collision.arm_parts import read_other_arms
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import ARM, HAND, build_collision_model
from skillc_runtime.collision.path_planning import JointSpace
from skillc_runtime.collision.scenery import Scenery, read_scenery
from skillc_runtime.execution.refinement.situation import RefinedMotion, Situation
from skillc_runtime.kinematics.chain import Chain, read_chain
from skillc_runtime.kinematics.sweep import JointLoad
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.frame_tree import MissingFact, frame_tree_of
from skillc_runtime.world.space.frames import frame_name, pose, size
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import BASE_FRAME_ID, CONTAIN, HAS_GRIPPER, MANIPULATABLE
from skillc_runtime.world.state.world_state import WorldState

ROOM_RAD, ROOM_SHARE = 0.05, 0.1
"""How far joints keep from the ends of their ranges, where they are pushed back; at most this share of their range."""

T = TypeVar("T")

MOST_KEPT = 64
"""How many models and views of arms are kept, the newest."""

GRAVITY = np.array([0.0, 0.0, -9.81])


@dataclass(frozen=True, slots=True, eq=False)
class ArmView:
    """An arm: its base in the world, its chain of joints to the tool that it has now, and what it may touch.

    `held` is what its gripper holds, whose working face is its tool then; None for nothing.
    home, q (nv,): rad; `movable` are the names of things that the palm may touch on the way of a tool. slack_rad: as of
    `Situation`.
    """

    arm: str
    base: Pose
    chain: Chain
    space: JointSpace
    free_range: Array
    effort: Array
    home: Array
    q: Array
    checker: CollisionChecker
    movable: frozenset[str]
    assembly: ArmAssembly
    held: str | None = None
    slack_rad: float = 0.0

    @property
    def tool(self) -> Pose:
        """Where its tool is in the world."""
        return self.base @ self.chain.place_tool(self.q)

    @property
    def flange_chain(self) -> Chain:
        """Its chain of joints to its flange."""
        return read_chain(self.checker.model.compiled, f"{ARM}flange")

    def move(self, postures: Sequence[Array], along: bool, tool: Pose | None = None) -> RefinedMotion:
        """Return its motion from where it is through postures (nv,) in rad; `tool` is as in `RefinedMotion`."""
        return RefinedMotion(self.arm, self.q, tuple(postures), self.base, self.assembly, along, tool)

    def load(self, force: Array) -> JointLoad:
        """Return what its joints bear while the tool exerts a force (3,) in N in the world."""
        inward = self.base.rotation.T
        limits = self.space.range + np.array([-self.slack_rad, self.slack_rad])
        return JointLoad(limits, self.effort, inward @ force, inward @ GRAVITY)


def view_arm(here: Situation, arm: str) -> ArmView:
    """Return an arm in a situation; SheetError or FrameError if facts about it are missing.

    Where only its own posture differs, situations share it but for that.
    """
    if arm not in here.postures:
        raise SheetError(f"{here.state.vocabulary.short(arm)} has no posture `home`")
    others = tuple((other, q.tobytes()) for other, q in here.postures.items() if other != arm)
    key = (here.state, arm, others, tuple(here.openings.items()))
    view = recall(here, key, lambda: _read_view(here, arm))
    return replace(view, q=np.asarray(here.postures[arm], dtype=float), slack_rad=here.slack_rad)


def _read_view(here: Situation, arm: str) -> ArmView:
    state, base = here.state, pose(here.state, arm)
    assembly = read_arm_assembly(state, arm, dict(here.openings))
    others = read_other_arms(state, arm, base, here.postures, here.openings)
    sheet, scenery = sheet_of(state, arm), read_scenery(state, base).with_blocks(others)
    home = sheet.posture("home")
    chain, checker = recall(here, (assembly, scenery), lambda: _read_model(assembly, scenery, home))
    held, face = _find_held(state, arm)
    if face is not None:
        chain = chain.with_tool(chain.place_tool(np.zeros(chain.joints)) @ face)
    limits = checker.model.compiled.jnt_range[: checker.model.joints].copy()
    room = np.minimum(ROOM_RAD, ROOM_SHARE * (limits[:, 1] - limits[:, 0]))
    return ArmView(
        arm=arm,
        base=base,
        chain=chain,
        space=JointSpace(limits, tuple(sheet.posture(name) for name in sheet.posture_names)),
        free_range=np.column_stack([limits[:, 0] + room, limits[:, 1] - room]),
        effort=_read_effort(assembly.model),
        home=home,
        q=home,
        checker=checker,
        assembly=assembly,
        held=held,
        movable=frozenset(map(state.vocabulary.short, state.instances(MANIPULATABLE))),
    )


def _read_model(assembly: ArmAssembly, scenery: Scenery, home: Array) -> tuple[Chain, CollisionChecker]:
    """Return the chain of an arm to its hand, and what checks it; home (nv,) in rad."""
    model = build_collision_model(assembly, scenery)
    chain = read_chain(model.compiled, f"{ARM}flange" if assembly.hand is None else f"{HAND}tcp")
    return chain, CollisionChecker(model, home)


def recall(here: Situation, key: Hashable, read: Callable[[], T]) -> T:
    """Return what was read in a situation that shares its models with this one; else read it."""
    models = here.models
    if key in models:
        found: T = models[key]
        return found
    found = read()
    if len(models) >= MOST_KEPT:
        del models[next(iter(models))]
    models[key] = found
    return found


def _find_held(state: WorldState, arm: str) -> tuple[str | None, Pose | None]:
    """Return what the arm's gripper holds, and its working face in the frame of the hand; None for nothing."""
    held = (
        thing
        for gripper in sorted(state.objects(arm, HAS_GRIPPER))
        for thing in sorted(state.objects(gripper, CONTAIN))
        if state.value(thing, BASE_FRAME_ID) == frame_name(state, gripper)
    )
    thing = next(held, None)
    try:
        face = None if thing is None else frame_tree_of(state).own_pose(thing) @ working_face(size(state, thing))
    except MissingFact:
        return None, None
    return thing, face


@lru_cache(maxsize=16)
def _read_effort(model: str) -> Array:
    """Return the greatest torques (nv,) in N m of the motors in an arm's MJCF; infinite if it does not limit them."""
    loaded = mujoco.MjModel.from_xml_path(model)
    force, control = loaded.actuator_forcerange[:, 1], loaded.actuator_ctrlrange[:, 1]
    most = np.where(loaded.actuator_forcelimited > 0, force, control)
    return np.where(most[: loaded.nv] > 0.0, most[: loaded.nv], np.inf) if loaded.nu else np.full(loaded.nv, np.inf)
