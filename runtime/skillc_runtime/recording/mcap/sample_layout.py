"""What the copies of memory mean that a tap makes of a cell: which numbers they have, and the signals these are."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import msgspec
import numpy as np

from skillc_runtime.devices.live import LiveArm, LiveSignals
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import ROTATION, TWIST
from skillc_runtime.recording.signals.channels import COMMANDED_FORCE, WORLD, XYZ, Columns
from skillc_runtime.recording.signals.signal import Signal


class SampledBlock(msgspec.Struct, frozen=True):
    """Copies of memory: `rows` samples from `first_s` on, in s of the cell; the base of each arm at their end.

    `poses` are the positions (n, 3) in m and quaternions (n, 4) of all bodies at times in s.
    """

    first_s: float
    rows: int
    content: bytes | bytearray
    bases: tuple[Pose, ...]
    poses: tuple[tuple[float, bytes, bytes], ...]


class SampleLayout:
    """What the copies of a tap mean: `signals` are the columns of `rows_of`."""

    def __init__(self, live: LiveSignals) -> None:
        self.period_ns = round(live.period_s * 1e9)
        self._arms, self._sensors = tuple(live.arms), live.sensors
        self._width = sum(_width(arm) for arm in self._arms) + live.sensors.count

    @property
    def row_bytes(self) -> int:
        """The memory of one sample."""
        return 8 * self._width

    def describe(self, names: Callable[[str], str]) -> tuple[Signal, ...]:
        """Return the signals; `names` are those of devices in columns, by IRI."""
        signals: list[Signal] = []
        for arm in self._arms:
            signals += _describe_arm(Columns(names(arm.individual), arm.individual), arm)
        for tool, _ in self._sensors.faces:
            signals += _describe_tool(Columns(names(tool), tool))
        return tuple(signals)

    def rows_of(self, block: SampledBlock) -> Array:
        """Return the samples (n, m) of a block."""
        content = np.frombuffer(block.content).reshape(block.rows, self._width)
        columns: list[Array] = []
        start = 0
        for arm, base in zip(self._arms, block.bases, strict=True):
            columns += _convert_arm(arm, base, content[:, start : start + _width(arm)])
            start += _width(arm)
        faces = content[:, start:]
        for _, first in self._sensors.faces:
            columns += (faces[:, first : first + 4], faces[:, first + 8 : first + 11])
        return np.concatenate([np.empty((block.rows, 0)), *columns], axis=1)

    def faces_of(self, block: SampledBlock) -> Iterator[tuple[str, Array]]:
        """Yield each tool, by IRI, with its face in each sample (n, 8): force in N, position in m, quaternion."""
        content = np.frombuffer(block.content).reshape(block.rows, self._width)
        start = self._width - self._sensors.count
        for tool, first in self._sensors.faces:
            yield tool, content[:, start + first : start + first + 8]


def list_reads(arm: LiveArm) -> Iterator[Callable[[], bytes]]:
    yield arm.measured
    yield arm.reference
    if arm.wrench is not None:
        yield arm.wrench
    if arm.velocity is not None:
        yield arm.velocity
    if arm.force is not None:
        yield arm.force
    if arm.stamp is not None:
        yield arm.stamp
    if arm.timing is not None:
        yield arm.timing


def _widths(arm: LiveArm) -> tuple[int, ...]:
    """Return how many numbers each of `list_reads` has; 0 for those that the arm does not offer."""
    optional = ((arm.wrench, 6), (arm.velocity, 3), (arm.force, 3), (arm.stamp, 1), (arm.timing, 2))
    return (2 * arm.joints, 24, *(0 if read is None else width for read, width in optional))


def _width(arm: LiveArm) -> int:
    return sum(_widths(arm))


def _convert_arm(arm: LiveArm, base: Pose, content: Array) -> Iterator[Array]:
    """Yield the columns of an arm with its base at this pose; those of what it does not offer are empty."""
    measured, rows, wrench, velocity, force, stamp, timing = np.split(content, np.cumsum(_widths(arm))[:-1], axis=1)
    reference = rows.reshape(-1, 8, 3)
    yield measured
    yield reference[:, 0] @ base.rotation.T + base.position
    yield reference[:, TWIST][:, 0] @ base.rotation.T
    yield _rotate(wrench, base.rotation)
    yield _rotate(velocity, base.rotation)
    yield _rotate(_find_commanded(force, reference), base.rotation)
    yield stamp
    yield timing


def _rotate(vectors: Array, rotation: Array) -> Array:
    """Return rows of some vectors (3,) each in the parent frame of a frame with this rotation."""
    return (vectors.reshape(-1, 3) @ rotation.T).reshape(vectors.shape)


def _find_commanded(exerted: Array, reference: Array) -> Array:
    """Return the forces (n, 3) in N on the tool, in base, that are commanded; NaN without a push.

    exerted (n, 3): N, along the axes of the reference, whose rows are (n, 8, 3). The result is empty if it is.
    """
    if not exerted.size:
        return exerted
    forces = -np.einsum("nij,nj->ni", reference[:, ROTATION], exerted)
    return np.where(exerted.any(axis=1, keepdims=True), forces, np.nan)


def _describe_arm(columns: Columns, arm: LiveArm) -> Iterator[Signal]:
    joints = [f"joint_{number}" for number in range(1, arm.joints + 1)]
    yield from columns.make("sensor", joints, "rad", "", "angle of a joint")
    yield from columns.make("sensor", joints, "rad/s", "", "speed of a joint")
    what = "position of the tool's reference; not known while the joints are controlled"
    yield from columns.make("command", [f"tool_{axis}" for axis in XYZ], "m", WORLD, what)
    what = "velocity of the tool's reference; not known while the joints are controlled"
    yield from columns.make("command", [f"tool_v{axis}" for axis in XYZ], "m/s", WORLD, what)
    if arm.wrench is not None:
        what = "on the tool, by the force-torque sensor"
        yield from columns.make("sensor", [f"force_{axis}" for axis in XYZ], "N", WORLD, f"force {what}")
        yield from columns.make("sensor", [f"torque_{axis}" for axis in XYZ], "N m", WORLD, f"torque {what}")
    if arm.velocity is not None:
        what = "velocity of the tool centre point, as measured"
        yield from columns.make("estimate", [f"tool_v{axis}" for axis in XYZ], "m/s", WORLD, what)
    if arm.force is not None:
        yield from columns.make("command", [f"force_{axis}" for axis in XYZ], "N", WORLD, COMMANDED_FORCE)
    if arm.stamp is not None:
        yield from columns.make("sensor", ["measured"], "s", "", "when that was measured, by the arm's own clock")
    if arm.timing is not None:
        yield from columns.make("sensor", ["lost_periods"], "", "", "control periods that were lost so far")
        yield from columns.make("sensor", ["late"], "s", "", "by how much the control period began late")


def _describe_tool(columns: Columns) -> Iterator[Signal]:
    yield from columns.make("truth", ["contact_force"], "N", "", "normal force of the contacts of the working face")
    yield from columns.make("truth", [f"face_{axis}" for axis in XYZ], "m", WORLD, "middle of the working face")
    what = "velocity of the middle of the working face"
    yield from columns.make("truth", [f"face_v{axis}" for axis in XYZ], "m/s", WORLD, what)
