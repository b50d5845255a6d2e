"""Locates objects with a camera, and confirms that they are where they were put."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from skillc_runtime.devices.camera import PoseEstimate
from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.contradiction import contradict, contradict_place
from skillc_runtime.primitives.pose_consensus import agreeing_estimates, mean_pose
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.touched_obstacles import find_explained
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import move_changes, pose
from skillc_runtime.world.space.lying import lying_problem
from skillc_runtime.world.space.whereabouts import holders_of, search_changes
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CONTAIN, LOCATED
from skillc_runtime.world.state.world_state import WorldState

BEHIND_M = 0.005
"""How far behind a point inside an object a camera must see to know that the object is not there."""

INNER = 0.5
"""How far from the middle to the corners of its box a point is that is inside an object, whatever its shape."""

IMAGES = 5
"""How many estimates are averaged."""

AGREEING = 3
"""How many estimates must agree for an object to count as located."""

RECENT = 0.5
"""Estimates that are older than this share of the patience do not count: the object may lie elsewhere by now."""


class Locate(Primitive):
    """Writes the pose of an object on which several images of a camera agree, the newest among them.

    That something contains it is withdrawn if it was believed to lie in there and does not. If too few agree, and the
    camera sees past where the object is believed to be, it is withdrawn where it is.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, camera: str, object: str, patience: float) -> None:
        super().__init__(cell)
        self._camera, self._object, self._patience_s = camera, object, patience
        self._device = cell.pose_camera(camera)
        self._estimates: list[PoseEstimate] = []
        self._ends = self._since_s = 0.0

    def start(self) -> None:
        """Use images from now on."""
        self._ends, self._since_s, self._estimates = self.cell.now + self._patience_s, self._device.clock_s, []

    def resume(self) -> None:
        """Start again: meanwhile the object may have been moved."""
        self.start()

    def tick(self) -> Status:
        """Return SUCCESS once the pose is written; SkillFailure if too few images agree on one in time."""
        self._take_estimate()
        late = self.cell.now > self._ends
        if len(self._estimates) < IMAGES and not late:
            return Status.RUNNING
        agreeing = agreeing_estimates(self._estimates)
        enough = len(agreeing) >= AGREEING and 2 * len(agreeing) > len(self._estimates)
        if enough and agreeing[-1] is self._estimates[-1]:  # else it may just have been moved
            self._conclude(mean_pose(agreeing))
            return Status.SUCCESS
        if late:
            raise self._gone() if self._sees_that_it_is_gone() else self._unseen(len(agreeing))
        return Status.RUNNING

    def _take_estimate(self) -> None:
        """Add an estimate from a newer image, if there is one; forget the old ones."""
        estimate = self._device.locate(self._object, self._since_s)
        if estimate is not None and all(estimate.taken_s > each.taken_s for each in self._estimates):
            self._estimates.append(estimate)
        oldest = self._device.clock_s - RECENT * self._patience_s
        self._estimates = [each for each in self._estimates if each.taken_s >= oldest]

    def _sees_that_it_is_gone(self) -> bool:
        """Whether the camera sees past where the middle of the object should be.

        If something stands before the middle, past another point inside it, but nothing where the object should be.
        """
        state = self.cell.world.snapshot()
        try:
            box, eye = bounding_box(state, self._object), pose(state, self._camera).inverse()
        except FrameError:
            return False
        middle, deep_m = box.middle.position, 2 * float(np.linalg.norm(box.half))
        behind_m = self._depth_behind_m(eye.apply(middle))
        if behind_m is not None and -deep_m < behind_m:
            return behind_m > BEHIND_M
        inner = (self._depth_behind_m(eye.apply(middle + INNER * (each - middle))) for each in box.corners)
        seen_m = [each for each in inner if each is not None and each > -deep_m]
        return bool(seen_m) and min(seen_m) > BEHIND_M

    def _depth_behind_m(self, point: Array) -> float | None:
        """Return how far behind a point (3,) in m in its frame the camera sees, below 0 before it; None if not."""
        depths = (self._device.depth_m(point) for _ in range(IMAGES))
        depth_m = next((each for each in depths if each is not None), None)
        return None if depth_m is None else depth_m - float(np.linalg.norm(point))

    def _conclude(self, in_camera: Pose) -> None:
        """Write where the object was seen, and what follows from that."""
        world = self.cell.world
        before = world.snapshot()
        self._write_place(in_camera)
        left = self._places_left(before)
        if left:
            world.commit(left, type(self).__name__, "sensed")
            self._assume_near(holders_of(before, self._object))

    def _places_left(self, before: WorldState) -> list[RemoveRelation]:
        """Return that what contains the object does not, if it lay there `before` it was seen and does not now."""
        now, thing = self.cell.world.snapshot(), self._object
        found = list[RemoveRelation]()
        for each in holders_of(now, thing):
            with suppress(FrameError):  # the extent of a place need not be known
                if lying_problem(before, thing, each) is None and lying_problem(now, thing, each) is not None:
                    found.append(RemoveRelation(each, CONTAIN, thing))
        return found

    def _assume_near(self, places: Sequence[str]) -> None:
        """Assume the object in the area around places, so that it can be picked up again, if nothing contains it."""
        assumed = search_changes(self.cell.world.snapshot(), self._object, places)
        if assumed:
            self.cell.world.commit(assumed, type(self).__name__, "assumed")

    def _write_place(self, in_camera: Pose) -> None:
        """Write where the object is, and that nothing else was touched there; SkillFailure as of `_placement`."""
        world = self.cell.world
        world.commit(self._placement(in_camera), type(self).__name__, "sensed")
        if explained := find_explained(world.snapshot(), self._object):
            world.commit(explained, type(self).__name__, "sensed")

    def _placement(self, in_camera: Pose) -> list[Change]:
        """Return the changes that place the object; SkillFailure if the world model cannot say where that is."""
        try:
            moved = move_changes(self.cell.world.snapshot(), self._object, in_camera, self._camera)
        except FrameError as error:
            raise SkillFailure(str(error)) from error
        return [*moved, SetProperty(self._object, LOCATED, True)]

    def _gone(self) -> SkillFailure:
        """Withdraw where the object is; return the failure."""
        return contradict_place(
            self.cell.world,
            type(self).__name__,
            self._object,
            SkillFailure(
                "{camera} sees that {object} is not where it is believed to be, and does not find it elsewhere",
                camera=self._label(self._camera),
                object=self._label(self._object),
            ),
            self._asked_place,
        )

    @property
    def _asked_place(self) -> str | None:
        """The place that is looked at, if the question is whether it contains the object."""
        return None

    def _unseen(self, agreeing: int) -> SkillFailure:
        return SkillFailure(
            "{camera} does not find {object} within {patience:.1f}: of {images} estimates {agreeing} agree, "
            "and {needed} must; it is hidden, out of view or elsewhere",
            camera=self._label(self._camera),
            object=self._label(self._object),
            patience=LabelledQuantity(self._patience_s, "s"),
            images=len(self._estimates),
            agreeing=agreeing,
            needed=AGREEING,
        )

    def _label(self, individual: str) -> LabelledIri:
        return label(individual, self.cell.world.snapshot().vocabulary)


class ConfirmPlaced(Locate):
    """Locates an object, and writes that a place contains it if it lies there; else it fails and says where it lies."""

    def __init__(self, cell: Cell, *, camera: str, object: str, place: str, patience: float) -> None:
        super().__init__(cell, camera=camera, object=object, patience=patience)
        self._place = place

    @property
    def _asked_place(self) -> str | None:
        return self._place

    def _conclude(self, in_camera: Pose) -> None:
        world = self.cell.world
        before = world.snapshot()
        self._write_place(in_camera)
        try:
            problem = lying_problem(world.snapshot(), self._object, self._place)
        except FrameError as error:
            raise SkillFailure(str(error)) from error
        if problem is not None:
            raise self._elsewhere(problem, before)
        world.commit([AddRelation(self._place, CONTAIN, self._object)], "ConfirmPlaced", "sensed")

    def _elsewhere(self, problem: str, before: WorldState) -> SkillFailure:
        """Withdraw that the place contains the object; return the failure."""
        failure = contradict(
            self.cell.world,
            "ConfirmPlaced",
            [RemoveRelation(self._place, CONTAIN, self._object), *self._places_left(before)],
            SkillFailure(
                "{camera} sees that {object} is not where it was put: {problem}",
                camera=self._label(self._camera),
                object=self._label(self._object),
                problem=problem,
            ),
        )
        self._assume_near([self._place])
        return failure
