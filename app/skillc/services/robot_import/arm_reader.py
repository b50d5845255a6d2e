"""Reads an arm from a specification of MuJoCo that is cut to its chain: links, inertia, flange."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.chain import Chain, list_some
from skillc.services.robot_import.comparison import Mechanism, MujocoMechanism, compare
from skillc.services.robot_import.possible_inertia import restate_inertia
from skillc.services.robot_import.robot_model import Base, Inertia, Joint, RobotLink, RobotModel, Shape
from skillc_runtime.motion.pose import Array, Pose, rotation_from_angles

FindShapes: TypeAlias = Callable[[Sequence[int]], Iterable[tuple[int, Shape]]]
"""Returns the shapes of bodies that are fixed to each other, each with the number of the body in whose frame it is."""

STAND_IN_M = 0.04
"""Radius of the capsule or cylinder that stands for a link without shape; shorter links get none."""


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """Which part of a file is the arm: the names of its ends, which are found if they are None.

    tip_turn: roll, pitch and yaw in degrees of the flange in the frame of the tip; correct_inertia: whether moments of
    inertia that no body can have are raised.
    """

    base: str | None = None
    tip: str | None = None
    tip_turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    correct_inertia: bool = False

    @property
    def turn(self) -> Array:
        """The rotation (3, 3) from the flange to the tip."""
        return rotation_from_angles(*np.radians(self.tip_turn).tolist())


@dataclass(frozen=True, slots=True)
class Reading:
    """A model, the file as a mechanism in MuJoCo, and what a user should know, as sentences."""

    model: RobotModel
    source: Mechanism
    notes: tuple[str, ...]

    def with_notes(self, *notes: str) -> Reading:
        """Return the reading with further notes."""
        return replace(self, notes=(*self.notes, *notes))


def compile_model(path: Path, spec: Any) -> Any:
    """Return the compiled model of a specification. RequestError if MuJoCo refuses it."""
    try:
        return spec.compile()
    except ValueError as error:
        first, _, rest = str(error).strip().partition("\n")
        where = next((f" {line.rpartition(', id')[0]}" for line in rest.splitlines() if "name" in line), "")
        hint = (
            "; no real body has such moments of inertia: correct the `<inertia>` of this link in the file, or use "
            "--correct-inertia"
        )
        said = first.removeprefix("Error: ") + where + hint * ("inertia" in first)
        raise RequestError(f"{path} is refused by MuJoCo: {said}") from error


class ArmReader:
    """The arm in its zero posture; link 0 is the base, the others are those that the joints move.

    stated: moments of inertia in the file that were corrected, (3,) in kg m^2 by body.
    """

    def __init__(self, path: Path, spec: Any, chain: Chain, options: ReadOptions, stated: Mapping[str, Array]) -> None:
        self._chain, self._options, self._stated = chain, options, stated
        self.model: Any = compile_model(path, spec)
        self.model.dof_armature[:] = 0.0
        self._data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, self._data)
        self.joints: list[int] = [self.model.joint(name).id for name in chain.joints]
        self._moved = [int(self.model.jnt_bodyid[joint]) for joint in self.joints]
        root = int(self.model.body(chain.base).id)
        self._base = self._body(root)
        anchors = [Pose(self.model.jnt_pos[joint].copy(), np.eye(3)) for joint in self.joints]
        moved = [self._body(body) @ at for body, at in zip(self._moved, anchors, strict=True)]
        self._frames = [self._base, *moved]
        self._owner = self._owners(root)

    def read(
        self, joints: Sequence[Joint], find_shapes: FindShapes, armature: float | None, notes: list[str]
    ) -> Reading:
        """Return the arm with its joints, and with notes."""
        links = tuple(self._links(joints, find_shapes, notes))
        base, flange = Base(self._chain.base, tuple(self._shapes_of(0, find_shapes))), self._flange()
        model = RobotModel(base, links, flange, self._chain.tip, armature)
        source = MujocoMechanism(self.model, self.joints, flange, self._base)
        if self._stated:
            before = MujocoMechanism(restate_inertia(self.model, self._stated), self.joints, flange, self._base)
            notes.append(
                f"no body has the moments of inertia of {list_some(list(self._stated))}: the smaller ones are raised, "
                f"which changes the mass matrix by at most {100 * compare(model, before, source).mass_matrices:.2g} %"
            )
        return Reading(model, source, tuple(notes))

    def _links(self, joints: Sequence[Joint], find_shapes: FindShapes, notes: list[str]) -> Iterator[RobotLink]:
        """Yield the links from the base on; one without a shape has one to the next joint, or the flange."""
        bare, unseen = list[str](), list[str]()
        for number, joint in enumerate(joints, 1):
            name = self.model.body(self._moved[number - 1]).name
            own = tuple(self._shapes_of(number, find_shapes))
            if not own:
                own = tuple(self._stand_in(number))
                (bare if own else unseen).append(f"`{name}`")
            placement = self._frames[number - 1].inverse() @ self._frames[number]
            yield RobotLink(name, placement, joint, self._inertia(number), own)
        if bare:
            taken = "a capsule to the next joint is taken, or a cylinder to the flange"
            notes.append(f"{list_some(bare)}: no shape in the file that can be read; {taken}")
        if unseen:
            why = f"and shorter than {1e3 * STAND_IN_M:.0f} mm: nothing looks whether they touch anything"
            notes.append(f"{list_some(unseen)}: no shape in the file that can be read, {why}")

    def _stand_in(self, number: int) -> Iterator[Shape]:
        """Yield what stands for a link of a number without any shape, if it is long enough, in its frame."""
        last = number == len(self._frames) - 1
        ahead = self._flange() if last else self._frames[number].inverse() @ self._frames[number + 1]
        yield from _reach_to(ahead.position, "cylinder" if last else "capsule")

    def _flange(self) -> Pose:
        """Return the flange in the frame of the last link."""
        at = self._data.site(self._chain.tip) if self._chain.tip_is_site else self._data.body(self._chain.tip)
        here = self._frames[-1].inverse() @ Pose(at.xpos.copy(), at.xmat.reshape(3, 3).copy())
        return Pose(here.position, here.rotation @ self._options.turn)

    def _shapes_of(self, number: int, find_shapes: FindShapes) -> Iterator[Shape]:
        """Yield the shapes of a link with all that is fixed to it, in its frame."""
        home = self._frames[number].inverse()
        for body, shape in find_shapes(self._bodies(number)):
            yield Shape(shape.kind, home @ self._body(body) @ shape.pose, shape.size)

    def _inertia(self, number: int) -> Inertia:
        """Return the inertia of all bodies of a link together, in its frame."""
        model, home, bodies = self.model, self._frames[number].inverse(), self._bodies(number)
        masses = model.body_mass[bodies]
        total = float(masses.sum())
        centres = np.array([home.apply(self._data.xipos[body]) for body in bodies])
        centre = masses @ centres / total
        matrix = np.zeros((3, 3))
        for body, mass, at in zip(bodies, masses, centres - centre, strict=True):
            axes = home.rotation @ self._data.ximat[body].reshape(3, 3)
            matrix += axes * model.body_inertia[body] @ axes.T + mass * (at @ at * np.eye(3) - np.outer(at, at))
        return Inertia(total, centre, matrix)

    def _bodies(self, number: int) -> list[int]:
        return [body for body, owner in self._owner.items() if owner == number]

    def _owners(self, root: int) -> dict[int, int]:
        """Return for each body of the arm the number of the link that it is fixed to."""
        found = {root: 0} | {body: number for number, body in enumerate(self._moved, 1)}
        for body in range(1, self.model.nbody):
            parent = int(self.model.body_parentid[body])
            if body not in found and parent in found and (parent, root) != (0, 0):
                found[body] = found[parent]
        return found

    def _body(self, body: int) -> Pose:
        return Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())


def _reach_to(ahead: Array, kind: Literal["capsule", "cylinder"]) -> Iterator[Shape]:
    """Yield a shape from the origin of a link to a point (3,) in m in its frame, unless that is too near."""
    length = float(np.linalg.norm(ahead))
    if length >= STAND_IN_M:
        z = ahead / length
        x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
        x /= np.linalg.norm(x)
        pose = Pose(ahead / 2, np.column_stack([x, np.cross(z, x), z]))
        yield Shape(kind, pose, (STAND_IN_M, length / 2))
