"""What a hand holds firmly is a part of it in the physics, which nobody notices: all is as if a weld held it."""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy

import mujoco
import numpy as np
import pytest
from cells import ARM, ERASER, GRIPPER, HANDS, at_the_eraser, grasp, lift, reach_for_eraser, run

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.mirror import Mirror
from skillc_runtime.backends.mujoco.momentum import join, part
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.move import MoveLinear

pytestmark = pytest.mark.skipif(not COMPILES, reason="without compiled functions nothing becomes a part of a hand")

SAME = 1e-9


def holding(scene: str, tightens: bool = True) -> SimulatedCell:
    there = at_the_eraser(scene)
    there.physics.tightens = tightens
    reach_for_eraser(there, scene)
    grasp(there, scene)
    lift(there, scene)
    return there


def mirror_of(there: SimulatedCell) -> Mirror:
    found = there.physics._mirror
    assert found is not None
    return found


def mass(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    found = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, found)
    return found


def energy(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    return float(data.qvel @ mass(model, data) @ data.qvel) / 2


@pytest.mark.parametrize("scene", HANDS)
def test_a_grasp_keeps_places_and_momentum_and_only_loses_energy(scene: str) -> None:
    there = holding(scene)
    mirror, model = mirror_of(there), there.model
    free, tight, blocks = mujoco.MjData(model), mujoco.MjData(mirror.tight_model), there.physics._blocks()
    free.qpos[:], free.mocap_pos[:], free.mocap_quat[:] = there.data.qpos, there.data.mocap_pos, there.data.mocap_quat
    free.qvel[:] = np.random.default_rng(1).normal(0.0, 0.2, model.nv)
    mujoco.mj_forward(model, free)
    before = energy(model, free)
    join(mirror.rows, model, free, mirror.tight_model, tight, blocks)
    mujoco.mj_forward(mirror.tight_model, tight)
    assert np.abs(tight.xpos[mirror.rows.bodies] - free.xpos).max() < SAME
    assert np.abs(tight.geom_xmat[mirror.rows.geoms] - free.geom_xmat).max() < SAME
    after = energy(mirror.tight_model, tight)
    assert 0.0 < after < before
    momentum = mass(mirror.tight_model, tight) @ tight.qvel
    part(mirror.rows, model, free, mirror.tight_model, tight, blocks)
    mujoco.mj_forward(model, free)
    assert energy(model, free) == pytest.approx(after, rel=SAME), "a release changes no speed"
    join(mirror.rows, model, free, mirror.tight_model, tight, blocks)
    assert np.abs(mass(mirror.tight_model, tight) @ tight.qvel - momentum).max() < SAME


@pytest.mark.parametrize("scene", HANDS)
def test_an_arm_measures_itself_without_what_it_holds(scene: str) -> None:
    """Weight and inertia of the load are those that the arm was told, so they must not be in its own."""
    there = holding(scene)
    model, data, alone = there.model, there.data, mujoco.MjData(there.model)
    run(there, MoveLinear(there, arm=ARM[scene], target=raised(there, scene), speed=0.2))
    alone.qpos[:], alone.mocap_pos[:], alone.mocap_quat[:] = data.qpos, data.mocap_pos, data.mocap_quat
    alone.qvel[:] = data.qvel
    mujoco.mj_forward(model, alone)
    arm = there.arms[ARM[scene]]
    own = arm._dofs
    assert np.abs(data.qfrc_bias[own] - alone.qfrc_bias[own]).max() < SAME
    arm._update_mass_matrix()
    assert np.abs(there.physics.mass.matrix - mass(model, alone)).max() < SAME
    for name in ("xpos", "xmat", "xipos", "geom_xpos", "geom_xmat", "site_xpos", "site_xmat", "cdof"):
        assert np.abs(getattr(data, name) - getattr(alone, name)).max() < SAME, name
    tight = mirror_of(there).tight
    assert data.time == tight.time > 0.0
    assert np.array_equal(data.sensordata, tight.sensordata)


def raised(there: SimulatedCell, scene: str) -> Pose:
    at = there.arm(ARM[scene]).motion.stopping_pose()
    return Pose(at.position + np.array([0.0, 0.05, 0.05]), at.rotation)


@pytest.mark.parametrize("scene", HANDS)
def test_a_load_moves_and_is_felt_as_if_a_weld_held_it(scene: str) -> None:
    with_weld, as_part = (holding(scene, tightens) for tightens in (False, True))
    states = [each.arms[ARM[scene]].state() for each in (with_weld, as_part)]
    assert np.abs(states[0].tool.position - states[1].tool.position).max() < 1e-4
    assert np.abs(states[0].wrench - states[1].wrench).max() < 0.2
    bodies = [each.ground_truth.body_pose(ERASER).position for each in (with_weld, as_part)]
    assert np.abs(bodies[0] - bodies[1]).max() < 1e-4
    pulls = [mean_pull(each, scene) for each in (with_weld, as_part)]
    assert np.abs(pulls[0] - pulls[1]).max() < 0.05 * float(np.linalg.norm(pulls[0]))


def mean_pull(there: SimulatedCell, scene: str) -> Array:
    """Return the mean pull (3,) in N of a hand that noise makes tremble."""
    pulls = []
    for _ in range(20):
        there.advance(0.005)
        hand = there.gripper(GRIPPER[scene])
        pull = there.physics.pull_on(ERASER)
        pulls.append(hand._pull_of_weld() if pull is None else pull.force.copy())
    return np.mean(pulls, axis=0)


def touching(model: mujoco.MjModel, data: mujoco.MjData, numbers: Array) -> set[tuple[int, ...]]:
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    return {tuple(sorted(numbers[pair].tolist())) for pair in data.contact.geom[: data.ncon].tolist()}


def postures(there: SimulatedCell, scene: str, count: int) -> Iterator[Array]:
    """Yield coordinates of the tight model with the arm anywhere within its limits."""
    mirror, rng = mirror_of(there), np.random.default_rng(2)
    prefix, model = there.scene.names[ARM[scene]], mirror.tight_model
    joints = [joint for joint in range(model.njnt) if model.joint(joint).name.startswith(prefix)]
    for _ in range(count):
        coordinates = mirror.tight.qpos.copy()
        coordinates[model.jnt_qposadr[joints]] = rng.uniform(*np.clip(model.jnt_range[joints], -np.pi, np.pi).T)
        yield coordinates


@pytest.mark.parametrize("scene", HANDS)
def test_what_touches_with_all_free_touches_with_the_tool_in_the_hand(scene: str) -> None:
    there = holding(scene)
    mirror, free, found = mirror_of(there), mujoco.MjData(there.model), 0
    free.qpos[:], free.mocap_pos[:], free.mocap_quat[:] = there.data.qpos, there.data.mocap_pos, there.data.mocap_quat
    for tight_qpos in postures(there, scene, 500):
        mirror.tight.qpos[:] = tight_qpos
        ours = touching(mirror.tight_model, mirror.tight, np.argsort(mirror.rows.geoms))
        part(mirror.rows, there.model, free, mirror.tight_model, mirror.tight, there.physics._blocks())
        assert touching(there.model, free, np.arange(there.model.ngeom)) == ours
        found += len(ours)
    assert found > 50


def test_what_is_held_slides_with_the_forces_of_an_exact_solver() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    there.advance(0.01)
    model, data = copy(mirror_of(there).tight_model), copy(mirror_of(there).tight)
    block, exactly = model.body(there.scene.names[ERASER] + "/block").id, copy(model)
    exactly.opt.solver, exactly.opt.tolerance = mujoco.mjtSolver.mjSOL_NEWTON, 1e-15
    sliding, errors = 0, list[float]()
    for _ in range(200):
        data.xfrc_applied[block, :3] = data.xmat[block].reshape(3, 3) @ [12.0, 0.0, -18.0]
        exact = copy(data)
        mujoco.mj_step(exactly, exact)
        mujoco.mj_step(model, data)
        forces = total_force(model, data), total_force(exactly, exact)
        errors.append(np.linalg.norm(forces[0] - forces[1]) / np.linalg.norm(forces[1]))
        sliding += mujoco.mjtConstraintState.mjCNSTRSTATE_CONE in exact.efc_state
    assert sliding > 20
    assert max(errors) < 5e-3
    assert np.median(errors) < 5e-4


def total_force(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    contacts = Contacts(model, data)
    return np.sum([contacts.force(number) for number in range(data.ncon)], axis=0)


def test_fingers_that_open_let_go_and_what_they_held_falls() -> None:
    scene = "iiwa_table"
    there = holding(scene)
    hand, before = there.gripper(GRIPPER[scene]), there.ground_truth.body_pose(ERASER).position
    hand.move(0.06, 40.0)
    assert there.physics._mirror is None, "fingers that move are free"
    there.advance(0.5)
    there_still = there.ground_truth.body_pose(ERASER).position
    assert np.abs(there_still - before).max() < 1e-3, "a weld holds it until it is let go"
    hand.detach()
    there.advance(0.2)
    assert there.ground_truth.body_pose(ERASER).position[2] < before[2] - 0.05, "it falls"


def pulled_out_after(share: float, runs_program: bool) -> int | None:
    """Return how many ms a hand holds a tool at which somebody pulls with a share of what friction bears."""
    there = holding("iiwa_table")
    hand, there.steps.runs_program = there.gripper(GRIPPER["iiwa_table"]), runs_program
    assert there.physics.pull_on(ERASER) is not None and hand._grip is not None
    there.data.body(there.scene.names[ERASER] + "/block").xfrc_applied[2] = -share * hand._grip.bears_n
    for number in range(100):
        if hand.carries is None:
            return number
        there.advance(0.001)
    return None


@pytest.mark.slow
def test_what_friction_does_not_bear_slips_out_of_the_hand_in_machine_code_as_in_python() -> None:
    by_program, by_python = (pulled_out_after(1.5, runs_program) for runs_program in (True, False))
    assert by_program == by_python
    assert by_program is not None and 30 <= by_program < 60, "an impact does not count"
    assert pulled_out_after(0.5, True) is None


def test_what_is_drawn_is_where_the_held_thing_is() -> None:
    there = holding("iiwa_table")
    drawn = mujoco.MjData(there.model)
    drawn.qpos[:] = there.drawing.posture().joints
    mujoco.mj_kinematics(there.model, drawn)
    block = there.model.body(there.scene.names[ERASER] + "/block").id
    assert np.abs(drawn.xpos[block] - there.ground_truth.body_pose(ERASER).position).max() < SAME
