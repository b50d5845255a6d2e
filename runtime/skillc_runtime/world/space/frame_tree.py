"""The tree of frames of a version of the world: what moves with what, and the poses in the world, computed once.

Versions that agree in all facts about space share one tree, so other writes cause no new computation.
"""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from typing import TypeAlias
from weakref import WeakKeyDictionary, ref

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose, rotation_from_angles, rotation_from_quaternion
from skillc_runtime.world.space.floors import bin_floor, shelf_board
from skillc_runtime.world.space.shape.extents import LocalBox, Spot, contact_pose
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.shapes import BIN_WALL_M, SHELF_BOARDS, SHELF_WALL_M, Bin, ShapeError, Shelf
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    ARM_DEVICE,
    AT,
    BASE_FRAME_ID,
    BOARD,
    BOARDS,
    CONTAIN,
    CONTAINER,
    FACE,
    FRAME_ID,
    HAS_A,
    LOCATION,
    OFFSET,
    ON,
    OPENING,
    ORIENTATION,
    POSITION,
    SCENE,
    SHAPE,
    SIZE,
    WALL_THICKNESS,
)
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.versioned import PairIndex, VersionedMap
from skillc_runtime.world.state.world_state import WorldState

WORLD_FRAME = "map"

Values: TypeAlias = "VersionedMap[str, Value | None]"

_NO_VALUES: Values = VersionedMap(None)
_NO_LINKS = PairIndex.empty()
_SHAPED = (SHAPE, BOARDS, WALL_THICKNESS)
_STATED = (FRAME_ID, BASE_FRAME_ID, *POSITION, *ORIENTATION, *ANGLES, *OFFSET, ANCHOR, FACE, BOARD, OPENING)
_VALUES = (*_STATED, *SIZE, *_SHAPED)
_LINKS = (ON, AT, CONTAIN, HAS_A)


class FrameError(ValueError):
    """A pose that the world model does not have; the message names the object and the reason."""


class Unplaced(FrameError, InsufficientFacts):
    """The facts are consistent but not enough to compute the pose or size of an object."""


class MissingFact(Unplaced):
    """A number that `individual` lacks; `property` is the IRI of the property."""

    def __init__(self, message: str, individual: str, property_: str) -> None:
        super().__init__(message)
        self.individual, self.property = individual, property_


class FrameTree:
    """The poses of all objects in the world. An object moves with its carrier.

    The carrier is the object whose FrameId its BaseFrameId names, or whose IRI if that has none; else the object that
    it is `on`. Without either it is the place that the object is `at`, else what contains it, else what it is a part
    of, and the object has the carrier's pose. A whole scene that states its pose has it in the world. The pose of an
    object that an arm carries is not known.
    """

    def __init__(self, state: WorldState, former: FrameTree | None = None) -> None:
        """Create the tree of a version; it shares the names of frames with the `former` tree if they are equal."""
        self._short, self._classes = state.vocabulary.short, state.classes
        self._values = {name: state.stored.get(name, _NO_VALUES) for name in _VALUES}
        self._links = {name: state.facts.get(name, _NO_LINKS) for name in _LINKS}
        self._poses: dict[str, Pose] = {}
        self.boxes: dict[str, OrientedBox] = {}
        renamed = former is None or former._values[FRAME_ID] is not self._values[FRAME_ID]
        self._owners: dict[str, list[str]] | None = None if former is None or renamed else former._owners

    def is_valid_for(self, state: WorldState) -> bool:
        """Whether all poses and sizes are the same in a version."""
        return (
            state.classes is self._classes
            and all(state.stored.get(name, _NO_VALUES) is values for name, values in self._values.items())
            and all(state.facts.get(name, _NO_LINKS) is links for name, links in self._links.items())
        )

    def pose(self, individual: str) -> Pose:
        """Return the pose of an object in the world, as read-only arrays; FrameError when unknown or contradictory."""
        poses, chain = self._poses, list[str]()
        while individual not in poses:
            if individual in chain:
                circle = " and ".join(map(self._short, chain[chain.index(individual) :]))
                raise FrameError(f"the frames of {circle} form a circle")
            chain.append(individual)
            carrier = self.carrier(individual)
            if carrier is None:
                poses[individual] = self.own_pose(individual)
            else:
                individual = carrier
        pose = poses[individual]
        for each in reversed(chain):
            if each != individual:
                placed = self._values[BASE_FRAME_ID].get(each) is not None or self._support(each) is not None
                pose = poses[each] = _frozen(pose @ self.own_pose(each)) if placed else pose
        return pose

    def carrier(self, individual: str) -> str | None:
        """Return the carrier of an object, None for the world itself; FrameError when unknown or ambiguous."""
        base = self._values[BASE_FRAME_ID].get(individual)
        if base == WORLD_FRAME:
            return None
        if base is not None:
            return self._owner(str(base), individual)
        support = self._support(individual)
        if support is not None:
            return None if self._is_floor(support) else support
        for holders in (
            self._links[AT].forward.get(individual),
            self._links[CONTAIN].backward.get(individual),
            self._links[HAS_A].backward.get(individual),
        ):
            if holders:
                return self._moved_with(min(holders), individual)
        if SCENE in self._classes.get(individual) and self._values[POSITION[0]].get(individual) is not None:
            return None
        raise Unplaced(
            f"the world model does not say where {self._short(individual)} is: "
            "it has neither a BaseFrameId nor a place it is at, and it is on nothing"
        )

    def number(self, individual: str, name: str) -> float:
        """Return a number of a pose or a size in m, or unitless for a quaternion; MissingFact when there is none."""
        value = self._values[name].get(individual)
        if isinstance(value, int | float):
            return float(value)
        message = f"{self._short(individual)} has no {self._short(name)} in the world model"
        raise MissingFact(message, individual, name)

    def own_pose(self, individual: str) -> Pose:
        """Return the pose of an object in the frame of its carrier, or in the world if nothing carries it.

        That of a drawer is the stated pose, moved by as far as it is open. FrameError when it is contradictory,
        MissingFact when a number is missing.
        """
        opening = self._number_or(individual, OPENING, 0.0)
        stated = self._stated_pose(individual)
        return _frozen(stated @ Pose.of((0.0, -opening, 0.0)) if opening else stated)

    def frame_pose(self, frame: str, individual: str) -> Pose:
        """Return the pose in the world of the frame with a FrameId, in which an individual has its place."""
        return Pose.of((0.0, 0.0, 0.0)) if frame == WORLD_FRAME else self.pose(self._owner(frame, individual))

    def _stated_pose(self, individual: str) -> Pose:
        support = self._support(individual)
        if self._values[BASE_FRAME_ID].get(individual) is None and support is not None:
            return self._pose_on(individual, support)
        position = [self.number(individual, name) for name in POSITION]
        return Pose(np.array(position), self._rotation(individual))

    def _moved_with(self, holder: str, individual: str) -> str:
        if ARM_DEVICE not in self._classes.get(holder):
            return holder
        raise Unplaced(
            f"the world model does not say where {self._short(individual)} is: "
            f"{self._short(holder)} carries it, and nothing tells in what posture the arm is"
        )

    def _owner(self, frame: str, individual: str) -> str:
        if self._owners is None:
            self._owners = {}
            for owner, name in self._values[FRAME_ID].items():
                self._owners.setdefault(str(name), []).append(owner)
        owners = self._owners.get(frame, [])
        if len(owners) == 1:
            return owners[0]
        if not owners and self._is_unnamed(frame):
            return frame
        found = f"{len(owners)} things have" if owners else "nothing has"
        raise FrameError(f"{self._short(individual)} is placed in the frame `{frame}`, but {found} this FrameId")

    def _is_unnamed(self, frame: str) -> bool:
        """Whether a name of a frame is the IRI of an object without a FrameId."""
        return bool(self._classes.get(frame)) and self._values[FRAME_ID].get(frame) is None

    def _support(self, individual: str) -> str | None:
        """Return what an object is stated to be on, None if it is not."""
        return min(self._links[ON].forward.get(individual), default=None)

    def _is_floor(self, support: str) -> bool:
        """Whether an object is the whole scene, whose floor is the plane z = 0 of the world."""
        stated = self._values[BASE_FRAME_ID].get(support) is not None or self._support(support) is not None
        return SCENE in self._classes.get(support) and not stated

    def _pose_on(self, individual: str, support: str) -> Pose:
        is_place = any(cls in self._classes.get(support) for cls in (LOCATION, SCENE))
        face = self._values[FACE].get(individual) or "top"
        corner = self._values[ANCHOR].get(individual) == "corner"
        x, y, z = (self._number_or(individual, name, 0.0) for name in OFFSET)
        box = self._extent(support, optional=is_place and not corner and face == "top")
        return contact_pose(
            self._inner_box(individual, support, box),
            self._extent(individual, optional=True),
            self._rotation(individual),
            Spot(str(face), corner, (x, y, z)),
        )

    def _inner_box(self, individual: str, support: str, box: LocalBox) -> LocalBox:
        """Return the box on whose face an object is: the floor of a bin, a board of a shelf, else the whole support.

        FrameError if there is no such board.
        """
        kind = self._values[SHAPE].get(support) or ("bin" if CONTAINER in self._classes.get(support) else "box")
        x, y, z = (2 * box.half).tolist()
        try:
            if self._values[BOARD].get(individual) is not None:
                boards = int(self._number_or(support, BOARDS, SHELF_BOARDS)) if kind == "shelf" else 0
                shelf = Shelf((x, y, z), self._number_or(support, WALL_THICKNESS, SHELF_WALL_M), boards)
                inner = shelf_board(shelf, int(self.number(individual, BOARD)))
            elif kind == "bin" and self._values[FACE].get(individual) is None and box.half.all():
                inner = bin_floor(Bin((x, y, z), self._number_or(support, WALL_THICKNESS, BIN_WALL_M)))
            else:
                return box
        except ShapeError as error:
            raise FrameError(f"{self._short(individual)} is on {self._short(support)}, which {error}") from error
        return LocalBox(inner.half, box.middle + inner.middle)

    def _extent(self, individual: str, *, optional: bool) -> LocalBox:
        """Return the box of an object; a point if it is optional and no size is stated, else MissingFact."""
        if optional and all(self._values[name].get(individual) is None for name in SIZE):
            return LocalBox(np.zeros(3), np.zeros(3))
        half = np.array([self.number(individual, name) for name in SIZE]) / 2
        return LocalBox.of(half, self._classes.get(individual))

    def _rotation(self, individual: str) -> Array:
        """Return the rotation of an object in its parent frame, from its quaternion or else its angles in degrees."""
        if all(self._values[name].get(individual) is None for name in ORIENTATION):
            roll, pitch, yaw = (radians(self._number_or(individual, name, 0.0)) for name in ANGLES)
            return rotation_from_angles(roll, pitch, yaw)
        quaternion = [self.number(individual, name) for name in ORIENTATION]
        if not any(quaternion):
            raise FrameError(f"the orientation of {self._short(individual)} is no rotation: all of it is 0")
        return rotation_from_quaternion(np.array(quaternion))

    def _number_or(self, individual: str, name: str, default: float) -> float:
        return default if self._values[name].get(individual) is None else self.number(individual, name)


class _FrameTrees:
    """The trees of the versions that are still in use; each is dropped with the last of its versions."""

    def __init__(self) -> None:
        self._known: WeakKeyDictionary[WorldState, FrameTree] = WeakKeyDictionary()
        self._latest: Callable[[], FrameTree | None] = lambda: None

    def of(self, state: WorldState) -> FrameTree:
        """Return the tree of a version, if possible the one that was used last."""
        space = self._known.get(state)
        if space is None:
            latest = self._latest() or next(iter(self._known.values()), None)
            space = latest if latest is not None and latest.is_valid_for(state) else FrameTree(state, latest)
            self._known[state] = space
            self._latest = ref(space)
        return space


frame_tree_of = _FrameTrees().of
"""Return the tree of frames of a version of the world."""


def _frozen(pose: Pose) -> Pose:
    pose.position.setflags(write=False)
    pose.rotation.setflags(write=False)
    return pose
