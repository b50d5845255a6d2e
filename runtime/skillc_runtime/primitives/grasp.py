"""Taking hold of things and letting go of them."""

from __future__ import annotations

from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.robots.tools import working_face
from skillc_runtime.world.space.frames import placed, pose, size
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation
from skillc_runtime.world.state.terms import CONTAIN, FRAME_ID, GRASP_WIDTH

FREE_BY_M = 0.005
"""How much farther than they held a thing the fingers must stand open for it to be free."""

OPEN_BY_M = 0.04
"""How much farther than the thing's width the fingers open when they let go."""


class Grasp(Primitive):
    """Takes hold of what the closed fingers touch from both sides; from then on the arm carries and works with it.

    The thing is believed to be in the hand as its grasping pose says. While it is held the world model has its pose
    relative to the gripper, whose frame is its tool centre point.
    """

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, grasp: str, place: str) -> None:
        super().__init__(cell)
        self._gripper, self._object, self._grasp = gripper, object, grasp

    def start(self) -> None:
        """Take hold; SkillFailure when the fingers do not touch the thing from both sides."""
        gripper, state = self.cell.gripper(self._gripper), self.cell.world.snapshot()
        hand, thing = map(state.vocabulary.short, (self._gripper, self._object))
        frame = state.value(self._gripper, FRAME_ID)
        if not isinstance(frame, str):
            raise SkillFailure(f"{hand} has no skiros:FrameId in the world model, so nothing can be placed in it")
        if not gripper.touches(self._object):
            raise SkillFailure(
                f"the fingers of {hand} do not touch {thing} from both sides: "
                f"they stand {1000 * gripper.opening_m:.0f} mm open"
            )
        self._frame = frame
        self._in_hand = pose(state, self._grasp).inverse() @ pose(state, self._object)
        gripper.attach(self._object, self._in_hand)

    def tick(self) -> Status:
        """Note that the fingers hold the thing, and where it is believed to be in the hand; it happens at once."""
        self.cell.world.commit([AddRelation(self._gripper, CONTAIN, self._object)], "Grasp", "sensed")
        self.cell.world.commit(placed(self._object, self._in_hand, self._frame), "Grasp", "assumed")
        return Status.SUCCESS


class Release(Primitive):
    """Opens the fingers; as soon as the thing is free, the world model says that it is where the arm had brought it."""

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, to: str) -> None:
        super().__init__(cell)
        self._arm, self._gripper = cell.arm(arm), cell.gripper(gripper)
        self._hand, self._object, self._to = gripper, object, to
        self._free_at_m, self._face, self._freed = 0.0, Pose.of((0.0, 0.0, 0.0)), False

    def start(self) -> None:
        """Begin to open; SkillFailure when something else or nothing is held."""
        state = self.cell.world.snapshot()
        held, short = self._gripper.holding, state.vocabulary.short
        if held != self._object:
            raise SkillFailure(f"the gripper holds {short(held) if held else 'nothing'}, not {short(self._object)}")
        self._face = working_face(size(state, self._object))
        self._free_at_m = self._gripper.opening_m + FREE_BY_M
        width = state.value(self._object, GRASP_WIDTH)
        opening = OPEN_BY_M + (width if isinstance(width, float) else self._gripper.opening_m)
        self._gripper.move(min(opening, self._gripper.max_opening_m), self._gripper.max_force_n)

    def tick(self) -> Status:
        """Let go once the thing is free, then wait until the fingers are open."""
        if not self._freed and self._gripper.opening_m >= self._free_at_m:
            self._let_go()
        if self._gripper.moving:
            return Status.RUNNING
        if not self._freed:
            short = self.cell.world.snapshot().vocabulary.short
            raise SkillFailure(
                f"the fingers of {short(self._hand)} came to rest {1000 * self._gripper.opening_m:.0f} mm open: "
                f"{short(self._object)} is not free"
            )
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Keep the fingers where they are."""
        self._gripper.stop()

    def _let_go(self) -> None:
        """Count the thing as free, and say so: whatever happens from now on, the hand no longer has it.

        That is sensed, by the fingers. That the thing stays where the arm had brought it is not.
        """
        left_at = self._arm.pose @ self._face.inverse()
        self._gripper.detach()
        self._freed = True
        world = self.cell.world
        world.commit([RemoveRelation(self._hand, CONTAIN, self._object)], "Release", "sensed")
        world.commit(
            (*placed(self._object, left_at), AddRelation(self._to, CONTAIN, self._object)), "Release", "assumed"
        )
