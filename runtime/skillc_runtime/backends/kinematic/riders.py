"""What stands on a held thing, such as a tray, and moves with it: without physics there is no friction to do that."""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.simulation.bases.standing import find_standing
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation


class Riders:
    """The things that stand on what one hand holds, from when it takes hold until it lets go."""

    def __init__(self, scene: SceneSpec, model: Any, data: Any) -> None:
        self._model, self._data = model, data
        blocks = {each.individual: part_name(scene.names[each.individual], "block") for each in scene.graspable}
        self._blocks = {individual: int(model.body(name).id) for individual, name in blocks.items()}
        self._held: str | None = None
        self._riders: dict[str, Pose] = {}

    def follow(self, held: str | None) -> tuple[str, ...]:
        """Move what stands on the thing that is held now, None for nothing, with it; return that."""
        if held != self._held:
            self._held = held
            self._riders = {} if held is None else self._find(held)
        if held is not None and self._riders:
            place = self._pose(self._blocks[held])
            for rider, on_held in self._riders.items():
                moved = place @ on_held
                q = self._position(self._blocks[rider])
                q[:3], q[3:] = moved.position, quaternion_from_rotation(moved.rotation)
        return tuple(self._riders)

    def _find(self, held: str) -> dict[str, Pose]:
        """Return what stands on a thing, with its pose in the frame of that."""
        carrier = self._blocks[held]
        place = self._pose(carrier).inverse()
        found = find_standing(self._model, self._data, carrier, self._blocks.values())
        names = {block: individual for individual, block in self._blocks.items()}
        return {names[block]: place @ self._pose(block) for block in found}

    def _pose(self, block: int) -> Pose:
        q = self._position(block)
        return Pose.of(q[:3], q[3:])

    def _position(self, block: int) -> Any:
        """Return the coordinates (7,) of a thing, which change with the cell."""
        first = self._model.jnt_qposadr[self._model.body_jntadr[block]]
        return self._data.qpos[first : first + 7]
