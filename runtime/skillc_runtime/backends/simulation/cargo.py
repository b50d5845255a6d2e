"""What drives with a mobile base: the things that its arms hold, and those that stand on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from skillc_runtime.backends.simulation.bases.base import BaseStep
from skillc_runtime.backends.simulation.bases.standing import find_standing
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import base_body_name, part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation


class Cargo:
    """The cargo of one mobile base: what touches it, or other cargo, when it starts to drive. It stays where it is."""

    def __init__(
        self, scene: SceneSpec, robot: str, hands: Mapping[str, ModelledGripper], model: Any, data: Any,
        contacts: Contacts,
    ) -> None:  # fmt: skip
        """Prepare the cargo of a robot; `hands` are all grippers of the cell, by the IRI of their arm."""
        self._model, self._data, self._contacts, self._all = model, data, contacts, tuple(hands.values())
        self._own = [hands[arm.individual] for arm in scene.arms if arm.robot == robot and arm.individual in hands]
        self._base = int(model.body(base_body_name(scene.names[robot])).id)
        blocks = {each.individual: part_name(scene.names[each.individual], "block") for each in scene.graspable}
        self._blocks = {individual: int(model.body(name).id) for individual, name in blocks.items()}
        self._loaded: list[int] | None = None

    @property
    def at_rest(self) -> bool:
        """Whether nothing is left to be done while the base is at rest."""
        return self._loaded is None

    @property
    def is_empty(self) -> bool:
        """Whether the base drives, and nothing has to be moved with it before the next look at what stands on it."""
        return self._loaded == [] and not self._hands_carry

    @property
    def _hands_carry(self) -> bool:
        return any(hand.needs_base_motion for hand in self._own)

    def move(self, step: BaseStep | None) -> None:
        """Move the cargo with the base; None while that is at rest."""
        if step is None:
            self._loaded = None
            return
        if self._loaded is None:
            self._loaded = find_standing(self._model, self._data, self._base, self._free_blocks())
        for hand in self._own:
            hand.move_with_base(step)
        for block in self._loaded:
            self._carry(block, step.motion)

    def _carry(self, block: int, motion: Pose) -> None:
        """Move a thing, by the number of its body, with the base."""
        first = self._model.jnt_qposadr[self._model.body_jntadr[block]]
        q = self._data.qpos[first : first + 7]
        moved = motion @ Pose.of(q[:3], q[3:])
        q[:3], q[3:] = moved.position, quaternion_from_rotation(moved.rotation)

    def _free_blocks(self) -> list[int]:
        """Return the numbers of the bodies of things that no hand carries."""
        carried = {hand.carries for hand in self._all}
        return [block for each, block in self._blocks.items() if each not in carried]
