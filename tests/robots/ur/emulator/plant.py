"""The arm of the emulator: the simulated cell of a scene, moved by servos of the emulated controller."""

from __future__ import annotations

import mujoco
import numpy as np

from backends.backend import Wall
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.button import SimulatedButton
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.devices.arm import JointPosition
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

STEP_S = 0.002
"""The cycle of an e-Series controller, and of the physics behind it."""


HANDLE_M = 0.03
"""The way in m from the middle of a tool's block to its handle, which fingers grasp."""

AWAY = (-3.0, -3.0, 1.0)
"""Where things are, in m in the world, that a person has taken away."""

UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])
"""A tool's axes in those of the hand that holds it."""


class Plant(SimulatedCell):
    """A scene with one arm, which follows the controller instead of the drivers of the cell."""

    def __init__(self, scene: WorldState, seed: int = 0) -> None:
        """Build the arm in its first posture."""
        super().__init__(WorldModel(scene), seed, timestep_s=STEP_S)
        (self.arm_iri, self.body), *others = self.arms.items()
        assert not others, "the emulator has one arm"
        self.hand = next(iter(self._hands.values()), None)
        self._flange_site = self.model.site(part_name(self.scene.names[self.arm_iri], "flange")).id
        self._offered = ""
        self.wall: Wall | None = None

    @property
    def q(self) -> Array:
        """The joint angles (6,) in rad."""
        return self.body._q.copy()

    @property
    def dq(self) -> Array:
        """The joint speeds (6,) in rad/s."""
        return self.body._dq.copy()

    @property
    def effort(self) -> Array:
        """The torques (6,) of the motors in N m."""
        data, dofs = self.data, self.body._dofs
        return data.qfrc_actuator[dofs] + data.qfrc_applied[dofs]

    @property
    def tool_speed(self) -> float:
        """The speed of the flange in m/s."""
        return float(np.linalg.norm(self.body.state().jacobian[:3] @ self.dq))

    @property
    def buttons(self) -> list[SimulatedButton]:
        """The buttons of the scene."""
        return list(self._buttons.values())

    @property
    def movable(self) -> list[str]:
        """The IRIs of what lies free."""
        return [each.individual for each in self.scene.graspable]

    def where(self, thing: str) -> list[float]:
        """Return where a thing is in the world, (3,) in m."""
        block = part_name(self.scene.names[thing], "block")
        return [float(each) for each in self.data.body(block).xpos]

    def wrench_on_flange(self) -> tuple[Array, Array]:
        """Return the wrench (6,) that pulls at the flange, weight included, and gravity (3,), along the flange."""
        readings = self.body._readings
        rotation = self.data.site_xmat[self._flange_site].reshape(3, 3)
        return -readings[:6].copy(), rotation.T @ self.model.opt.gravity

    def servo_to(self, q: Array) -> None:
        """Let the servos of the joints follow q (6,) in rad."""
        self.body.command(JointPosition(q))

    def put_between_fingers(self, thing: str) -> None:
        """Let a person hold a thing, by IRI, between the fingers, or take away what is there if it is empty."""
        hand = self.hand
        assert hand is not None
        if not thing and self._offered:
            if hand.carries is not None:
                hand.lose()
            hand._place(self._offered)[:3] = AWAY
        self._offered = thing

    def put_wall(self, gap_m: float) -> Array:
        """Put a soft wall before the tool, along its z, as conformance tests do; return the unit vector out of it."""
        assert self.hand is not None
        self.wall = Wall(self, self.body, part_name(self.hand._name, "palm"), gap_m)
        return self.wall.normal

    def remove_wall(self) -> None:
        """Take it away."""
        if self.wall is not None:
            self.wall = None
            self.push_hand(self.arm_iri, np.zeros(3))

    def pass_cycle(self) -> None:
        """Move everything for one cycle of the controller."""
        self.body.state()
        if self.wall is not None:
            self.wall.step(self.now)
        self._grip_what_is_touched()
        self._offer()
        self.steps_without_control.run(self.now, 1)

    def _offer(self) -> None:
        """Keep what a person holds where the fingers close, upright along them, until they have it."""
        hand = self.hand
        if hand is None or not self._offered or hand.carries is not None:
            return
        place, tool = hand._place(self._offered), self.data.site(part_name(hand._name, "tcp"))
        axes, turn = tool.xmat.reshape(3, 3), np.empty(4)
        mujoco.mju_mat2Quat(turn, (axes @ UPSIDE_DOWN).ravel())
        place[:3], place[3:] = tool.xpos + HANDLE_M * axes[:, 2], turn
        free = self.model.joint(part_name(self.scene.names[self._offered], "free"))
        self.data.qvel[free.dofadr[0] : free.dofadr[0] + 6] = 0.0

    def _grip_what_is_touched(self) -> None:
        """Let what is between closed fingers move with the palm, and what opening fingers leave stay behind."""
        hand = self.hand
        if hand is None:
            return
        if hand.carries is not None and hand._goal > hand._true_opening_m + 1e-4 and not hand._idle:
            hand.drop()
        elif hand.carries is None and hand._idle and hand._is_at_force_limit():
            touched = next((each for each in hand._things if hand.touches(each)), None)
            if touched is not None:
                hand._carry(touched)
