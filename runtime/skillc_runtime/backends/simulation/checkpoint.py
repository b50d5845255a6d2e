"""The true state of a simulated cell as plain data, from which the same cell is built again in another process."""

from __future__ import annotations

import msgspec

from skillc_runtime.devices.backend import BackendStart
from skillc_runtime.devices.checkpoints import CheckpointError
from skillc_runtime.motion.pose import Pose, PoseNumbers

"""A pose: position in m, then the unit quaternion (w, x, y, z)."""


class SavedGrip(msgspec.Struct, frozen=True):
    """How friction holds a thing; see `Grip` of the cell with physics."""

    pressing: tuple[float, float, float]
    force_n: float
    bears_n: float


class SavedGripper(msgspec.Struct, frozen=True):
    """A gripper: its opening in m, what really moves with its palm and how, and what counts as held.

    Empty names stand for nothing. centre (3,): m, of the mass of what counts as held, in its own frame; None if it is
    as the model has it.
    """

    opening_m: float
    force_n: float
    carried: str
    in_palm: PoseNumbers
    grip: SavedGrip | None
    counted: str
    counted_at_m: float
    in_tool_centre: PoseNumbers
    mass_kg: float
    centre: tuple[float, float, float] | None = None


class Checkpoint(msgspec.Struct, frozen=True):
    """The true state of a cell at `time_s` of its clock, at rest; things are named by IRI, joints as in the model.

    places: where things were believed to be when the cell was first built, from which the true differences follow;
    joints: coordinates in m, rad and quaternions; bases: poses in the world; worked: for how long, in s, tools have
    worked on each cell of a surface, as compressed float32; clean: which cells had been clean before, as compressed
    bytes.
    """

    places: dict[str, PoseNumbers]
    joints: dict[str, tuple[float, ...]]
    bases: dict[str, PoseNumbers]
    grippers: dict[str, SavedGripper]
    worked: dict[str, bytes]
    time_s: float = 0.0
    clean: dict[str, bytes] = {}


def encode_checkpoint(checkpoint: Checkpoint) -> bytes:
    """Return a checkpoint as MessagePack."""
    return msgspec.msgpack.encode(checkpoint)


def decode_checkpoint(encoded: bytes) -> Checkpoint:
    """Read what `encode_checkpoint` returned; CheckpointError if it cannot be read."""
    try:
        return msgspec.msgpack.decode(encoded, type=Checkpoint)
    except msgspec.MsgspecError as error:
        raise CheckpointError(str(error)) from error


def read_checkpoint(start: BackendStart) -> Checkpoint | None:
    """Return from where a cell goes on; CheckpointError if that cannot be read."""
    return None if start.saved is None else decode_checkpoint(start.saved)


def make_pose(numbers: PoseNumbers) -> Pose:
    """Return the pose of some numbers."""
    return Pose.of(numbers[:3], numbers[3:])
