"""What one arm shall do: move its tool or its joints, yield and push; and how it hands over from one to the other.

Skills speak of the world; inside, all is in the arm's base frame, so that an arm on a driving base comes along.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import dist, inf

import numpy as np

from skillc_runtime.motion.joint import JointTrajectory
from skillc_runtime.motion.joint_guide import JointGuide
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory
from skillc_runtime.robots.arm import ArmState
from skillc_runtime.robots.measured import Measured
from skillc_runtime.robots.reach import JOINT_RAMP_S, Reach
from skillc_runtime.robots.setup import Setup
from skillc_runtime.robots.tool_task import ToolTask

TOOL_JUMP_M_S = 3.0
"""No tool moves this fast; one that seems to was moved on the hand."""


class ArmTask(Measured):
    """Either the tool is moved or the joints are. Poses, directions and wrenches are in world axes, SI units.

    A new motion starts where the one before it comes to rest (`anchor`), never at the measured pose.
    """

    def __init__(self, setup: Setup) -> None:
        """Hold the joints where they are; joint motions keep the tool below the speed that is safe."""
        self.gains, self.limits, self.period = setup.gains, setup.limits, setup.period
        state = setup.arm.state()
        super().__init__(setup.base, state)
        self._arm, self._place = setup.arm, state.tool.position.tolist()
        self._laws = setup.gains.law.laws(setup.gains, setup.limits, setup.virtual, state, setup.period)
        self._reach, self._tool = Reach(setup.virtual), ToolTask(setup.gains, self._laws.tool, state.tool)
        self._tool_speed_m_s, self._now = setup.safety.tool_speed_m_s, 0.0
        self._joints: JointGuide | None = self._joint_guide(state.q, np.zeros_like(state.q))

    @property
    def wrench(self) -> Array:
        """What the environment does to the tool (6,), N and N m; measured at the wrist, else estimated by the law."""
        return self._in_world(self.wrench_in_base)

    @property
    def wrench_in_base(self) -> Array:
        """The same in the arm's base axes."""
        return self._state.wrench if self._joints is not None else self._tool.contact_wrench

    @property
    def commanded_stiffness(self) -> Array:
        """The stiffness (6,) that skills want along the axes of the compliance frame, N/m and N m/rad."""
        return self._tool.yielding.wanted.stiffness.copy()

    @property
    def commanded_wrench(self) -> Array:
        """The wrench (6,) that skills want exerted along the axes of the compliance frame, N and N m."""
        return np.concatenate([self._tool.yielding.wanted.force, np.zeros(3)])

    @property
    def reference(self) -> Reference:
        """Where the tool shall be, as of the last control period."""
        if self._joints is None:
            return self._tool.reference.moved(self._base())
        reference = self._joints.sample(self._now)
        tool, jacobian = self._reach.tool_at(reference.q, self._state)
        return Reference.of(tool, jacobian @ reference.dq, jacobian @ reference.ddq).moved(self._base())

    @property
    def path(self) -> Reference:
        """The same, overlays aside."""
        return self._tool.guide.path.moved(self._base()) if self._joints is None else self.reference

    @property
    def anchor(self) -> Pose:
        """Where a new motion of the tool starts: where its reference rests when stopped now."""
        self._move_tool()
        return self._base() @ self._tool.guide.anchor(self._now)

    @property
    def joint_anchor(self) -> Array:
        """Where a new motion of the joints starts, (nv,) in rad; asking moves nothing."""
        return (self._joints or self._joints_as_they_move()).anchor(self._now)

    @property
    def done(self) -> bool:
        """Whether the reference rests."""
        return (self._joints or self._tool.guide).done(self._now)

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves or pushes any more: neither the reference nor what skills want, nor the arm."""
        still = (self._joints or self._tool.guide).at_rest(self._now) and not self._tool.yielding.pushing
        return still and self.still

    @property
    def behind(self) -> str | None:
        """How far the arm is from its reference along what it is to hold; None when near enough."""
        if self._joints is not None:
            return self._reach.away(self._joints.sample(self._now).q, self._state.q)
        return self._tool.behind(self._state, self._now)

    def move_along(self, trajectory: Trajectory) -> None:
        """Move the tool along a trajectory, which must start at `anchor`, more slowly where a joint would be too fast.

        ValueError where it does not start there; Infeasible where the arm cannot follow.
        """
        self._move_tool()
        q, local = self._laws.joints_now(self._state), trajectory.moved(self._base().inverse())
        self._tool.guide.follow(self._reach.feasible(local, q, self.limits, self._state), self._now)

    def move_joints(self, goal: Array, share: float) -> None:
        """Move the joints to `goal` (nv,) with a share, above 0 to 1, of their greatest speeds, or the tool's."""
        self.follow_joints(self.joint_motion((goal,), share))

    def joint_motion(self, way: Sequence[Array], share: float, blend: float = 0.0) -> JointTrajectory:
        """Return the motion of the joints from where they come to rest through all of `way`, each (nv,), to its end.

        Speed as for `move_joints`; on the way it goes past postures without stopping if `blend` > 0, to 1 at most.
        """
        postures, calm = (self.joint_anchor, *way), (share, self._tool_speed_m_s)
        return self._reach.joint_path(postures, self.limits, *calm, blend, self._state)

    def follow_joints(self, motion: JointTrajectory) -> None:
        """Move the joints as a motion says, which must start at `joint_anchor`, else ValueError."""
        self._move_joints().follow(motion, self._now)

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays stay."""
        (self._joints or self._tool.guide).stop(self._now)

    def hold_position(self) -> None:
        """Come to rest and hold the tool, with springs on a compliant arm, from now on."""
        self._move_tool()
        self._tool.guide.stop(self._now)

    def pause(self) -> None:
        """Slow down to a standstill on the way."""
        (self._joints or self._tool.guide).pause(self._now)

    def resume(self) -> None:
        """Go on where `pause` stopped."""
        (self._joints or self._tool.guide).resume(self._now)

    def add_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add a motion along `axes` (3, 3) to whatever the tool does, growing for `fade` s; return its handle.

        Infeasible where a joint would be too fast.
        """
        self._move_tool()
        axes = self._base().rotation.T @ axes
        self._reach.bearable(overlay, axes, self.limits, self._state)
        return self._tool.guide.add(overlay, axes, fade, self._now)

    def remove_overlay(self, handle: int) -> None:
        """Let an overlay fade out."""
        self._tool.guide.remove(handle, self._now)

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) within limits that put the tool at a pose, near `seed` (nv,); None if there are none."""
        return self._reach.joints_for(self._base().inverse() @ target, seed, self.limits.range, self._state)

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Let the tool yield along a unit direction (3,), fixed to the reference tool frame from now on.

        Without a push the tool stays where it is; pushed with F it moves with about F / gains.release_damping.
        Nested releases must be parallel or at right angles to the first, else ValueError.
        """
        self._move_tool()
        self._tool.yielding.release(self._in_tool(axis), stiffness)

    def restore(self) -> None:
        """Undo the last release: hold the tool, along what it has yielded, where it is now. Gives up a motion."""
        if self._joints is not None:
            self._tool.yielding.restore(np.zeros(3))
        else:
            self._tool.restore(self._now)

    def yields_along(self, axis: Array) -> bool:
        """Tell whether the tool was released along a direction (3,)."""
        return self._joints is None and self._tool.yielding.yields(self._in_tool(axis))

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Press against what lies opposite to `axis` (3,), along which the tool must yield; else ValueError.

        The tool is braked where it goes faster that way, whoever pushes it.
        """
        self._move_tool()
        self._tool.push(-self.in_base(axis), force_n, fastest_m_s, self._now)

    def push_off(self) -> None:
        """Let the push fade."""
        self._tool.yielding.push_off()

    def release_rotation(self) -> None:
        """Let the tool turn about the two axes across the released one."""
        self._move_tool()
        self._tool.yielding.turn_freely(True)

    def restore_rotation(self) -> None:
        """Hold the tool in the rotation that it has now. Gives up a motion."""
        if self._joints is not None:
            self._tool.yielding.turn_freely(False)
        else:
            self._tool.restore_rotation(self._now)

    def _take_in(self, state: ArmState) -> None:
        """Remember a state; a tool centre point that jumps was moved on the hand, say by taking hold of a tool."""
        before, self._place = self._place, state.tool.position.tolist()
        self._state = state
        if self._joints is None and dist(self._place, before) > TOOL_JUMP_M_S * self.period:
            self._tool.retake(state, self._laws.joints_now(state), self._now)

    def _in_tool(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the reference tool frame."""
        return self._tool.in_tool(self.in_base(direction), self._now)

    def _move_tool(self) -> None:
        """Hand over from joint to tool control: the tool goes on as the joints moved it."""
        self._take_in(self._arm.state())
        if self._joints is None:
            return
        reference = self._joints.sample(self._now)
        tool, jacobian = self._reach.tool_at(reference.q, self._state)
        self._tool.take_up(self._state, reference, tool, jacobian @ reference.dq, self._now)
        self._joints = None

    def _move_joints(self) -> JointGuide:
        """Hand over from tool to joint control: the joints go on as the tool moved them."""
        if self._joints is None:
            self._joints = self._joints_as_they_move()
        return self._joints

    def _joints_as_they_move(self) -> JointGuide:
        return self._joint_guide(self._laws.joints_now(self._state), self._laws.speeds_now(self._state))

    def _joint_guide(self, q: Array, dq: Array) -> JointGuide:
        return JointGuide(q, dq, float(self.limits.velocity.min()) / JOINT_RAMP_S, self._now)
