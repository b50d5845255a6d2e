"""Taking hold of things and letting go of them."""

from __future__ import annotations

from skillc_runtime.motion.pose import Pose, quaternion_of
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.robots.tools import working_face
from skillc_runtime.world.changes import Change, SetProperty
from skillc_runtime.world.frames import WORLD_FRAME, pose, size
from skillc_runtime.world.terms import BASE_FRAME_ID, GRASP_WIDTH, ORIENTATION, POSITION

OPEN_BY_M = 0.04
"""How much farther than the thing's width the fingers open when they let go."""


class Grasp(Primitive):
    """Takes hold of what the closed fingers touch from both sides; from then on the arm carries and works with it.

    The thing is believed to be in the hand as its grasping pose says.
    """

    def __init__(self, cell: Cell, *, gripper: str, object: str, grasp: str, **_others: str) -> None:
        super().__init__(cell)
        self._gripper, self._object, self._grasp = gripper, object, grasp

    def start(self) -> None:
        """Take hold; SkillFailure when the fingers do not touch the thing from both sides."""
        gripper, state = self.cell.gripper(self._gripper), self.cell.world.snapshot()
        if not gripper.touches(self._object):
            hand, thing = map(state.vocabulary.short, (self._gripper, self._object))
            raise SkillFailure(
                f"the fingers of {hand} do not touch {thing} from both sides: "
                f"they stand {1000 * gripper.opening_m:.0f} mm open"
            )
        in_hand = pose(state, self._grasp).inverse() @ pose(state, self._object)
        gripper.attach(self._object, in_hand)

    def tick(self) -> Status:
        """Succeed: taking hold happens at once."""
        return Status.SUCCESS


class Release(Primitive):
    """Opens the fingers and notes in the world model where the thing now is: where the arm had brought it."""

    def __init__(self, cell: Cell, *, arm: str, gripper: str, object: str, **_others: object) -> None:
        super().__init__(cell)
        self._arm, self._gripper, self._object = cell.arm(arm), cell.gripper(gripper), object
        self._left_at: Pose | None = None

    def start(self) -> None:
        """Let go and begin to open; SkillFailure when something else or nothing is held."""
        state = self.cell.world.snapshot()
        held, short = self._gripper.holding, state.vocabulary.short
        if held != self._object:
            raise SkillFailure(f"the gripper holds {short(held) if held else 'nothing'}, not {short(self._object)}")
        self._left_at = self._arm.pose @ working_face(size(state, self._object)).inverse()
        self._gripper.detach()
        width = state.value(self._object, GRASP_WIDTH)
        opening = OPEN_BY_M + (width if isinstance(width, float) else self._gripper.opening_m)
        self._gripper.move(min(opening, self._gripper.max_opening_m), self._gripper.max_force_n)

    def tick(self) -> Status:
        """Wait until the fingers are open, then note the thing's place."""
        if self._gripper.moving:
            return Status.RUNNING
        if self._left_at is not None:
            self.cell.world.commit(placed(self._object, self._left_at), "Release")
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Keep the fingers where they are."""
        self._gripper.stop()


def placed(thing: str, at: Pose) -> list[Change]:
    """Return the changes that say where in the world a thing is."""
    values = zip((*POSITION, *ORIENTATION), (*at.position, *quaternion_of(at.rotation)), strict=True)
    numbers = [SetProperty(thing, name, float(value)) for name, value in values]
    return [SetProperty(thing, BASE_FRAME_ID, WORLD_FRAME), *numbers]
