"""The drawing of a cell of real devices: things are in the hand that holds them, or where the world model has them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from simulation.cells import ARM, LAB, world
from skillc_runtime.backends.control_process.ghost import Ghost
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.model import WorldModel

SCENE, ERASER, TABLE = "iiwa_table", LAB + "Eraser-1", LAB + "Table-1"
IN_HAND = Pose(np.array([0.0, 0.01, 0.02]), np.diag([1.0, -1.0, -1.0]))


@dataclass
class Arm:
    """What a control process tells of an arm."""

    joints: Array
    held: tuple[str, Pose] | None = None


class Drawn:
    """A drawing, and where its bodies are."""

    def __init__(self) -> None:
        self.world = WorldModel(world(SCENE))
        scene = read_scene_spec(self.world.snapshot())
        self.arm = Arm(scene.arms[0].home.copy())
        self.ghost = Ghost(scene, {ARM[SCENE]: self.arm}, {}, {}, self.world.snapshot)

    def place(self, individual: str) -> Pose:
        """Return where an individual is drawn."""
        positions = np.frombuffer(self.ghost.bodies.positions()).reshape(-1, 3)
        quaternions = np.frombuffer(self.ghost.bodies.quaternions()).reshape(-1, 4)
        number = self.ghost.model.body(self.ghost.individuals[individual].body).id
        return Pose.of(positions[number], quaternions[number])

    def hand(self) -> Pose:
        """Return the tool centre point of the empty hand."""
        self.ghost.posture()
        site = self.ghost._ghost.site("lab:Robotiq-1/tcp")
        return Pose(site.xpos.copy(), site.xmat.reshape(3, 3).copy())


def test_what_is_held_moves_with_the_hand_and_stays_where_it_was_put() -> None:
    drawn = Drawn()
    before = drawn.place(ERASER)
    drawn.arm.held = ERASER, IN_HAND
    for turn in (0.0, 0.4):
        drawn.arm.joints[0] += turn
        expected = drawn.hand() @ IN_HAND
        np.testing.assert_allclose(drawn.place(ERASER).position, expected.position, atol=1e-9)
        np.testing.assert_allclose(drawn.place(ERASER).rotation, expected.rotation, atol=1e-9)
    assert np.linalg.norm(drawn.place(ERASER).position - before.position) > 0.1
    put = Pose(np.array([0.5, 0.1, 0.9]), np.eye(3))
    drawn.world.commit(placement_changes(ERASER, put))
    drawn.arm.held = None
    np.testing.assert_allclose(drawn.place(ERASER).position, put.position, atol=1e-9)


def test_what_the_world_model_has_learnt_is_drawn_where_it_is_now_known_to_be() -> None:
    drawn = Drawn()
    for individual in (ERASER, TABLE):
        there = drawn.place(individual)
        moved = Pose(there.position + np.array([0.03, -0.02, 0.01]), there.rotation)
        drawn.world.commit(placement_changes(individual, moved))
        np.testing.assert_allclose(drawn.place(individual).position, moved.position, atol=1e-9)
