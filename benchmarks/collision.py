"""What it costs to keep clear of obstacles: a look at a posture, a straight way, a way around a pillar."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import mujoco

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace, NoPath, plan_joint_path
from skillc_runtime.collision.scenery import PoseKey, SolidObstacle, read_scenery
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER

PILLARS = {"iiwa_table": (0.42, 0.33), "ur5e_whiteboard": (0.34, 0.3)}
"""Where in the arm's base frame a pillar stands in the way, m."""

REPEATS = 200


def situation(scene: str) -> tuple[CollisionChecker, Array, JointSpace]:
    """Return what an arm with a pillar before it can touch, its home posture, and what is known of it."""
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    state = load_scene(catalogue.scene_path(scene), vocabulary)
    arm = min(state.instances(ARM_DEVICE))
    pillar = SolidObstacle("pillar", PoseKey((*PILLARS[scene], 0.0), (1.0, 0.0, 0.0, 0.0)), (0.06, 0.06, 0.55))
    around = read_scenery(state, pose(state, arm))
    around = replace(around, blocks=(*around.blocks, pillar))
    shape = build_collision_model(
        read_arm_assembly(state, arm, dict.fromkeys(state.objects(arm, HAS_GRIPPER), 0.05)), around
    )
    home = sheet_of(state, arm).posture("home")
    return CollisionChecker(shape, home), home, JointSpace(shape.compiled.jnt_range[: shape.joints], (home,))


def least(call: Callable[[], object]) -> float:
    """Return the seconds that a call takes when nothing else runs."""
    found = []
    for _ in range(REPEATS):
        began = perf_counter()
        call()
        found.append(perf_counter() - began)
    return min(found)


def measure(scene: str) -> str:
    """Return what it costs in one scene, as ratios."""
    contacts, home, known = situation(scene)
    data = mujoco.MjData(contacts.model.compiled)
    bare = least(lambda: mujoco.mj_kinematics(contacts.model.compiled, data))
    look = least(lambda: contacts.find_collision(home)) / bare
    aside, away = home.copy(), home.copy()
    aside[0], away[0] = 1.4, -0.9
    before = contacts.checks
    plan_joint_path(contacts, home, [away], known)
    straight, before = contacts.checks - before, contacts.checks
    try:
        pieces = len(plan_joint_path(contacts, home, [aside], known))
        around = f"{contacts.checks - before} looks for a way of {pieces} pieces around a pillar"
    except NoPath as why:
        around = str(why)
    return f"{scene}: a look costs {look:.1f} x mj_kinematics; {straight} looks for a straight way, {around}"


if __name__ == "__main__":
    for scene in PILLARS:
        print(measure(scene))
