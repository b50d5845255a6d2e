"""Reads an arm from a file of either format."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi, radians
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.robot_import.reading import Reading, ReadOptions
from skillc.services.robot_import.robot_model import Joint
from skillc.services.robot_import.xml_file import read_xml

FARTHEST_RAD, FARTHEST_M = 4 * pi, 100.0
"""No joint turns or slides farther than this from 0; the language warns of angles above two turns, too."""
FASTEST_RAD_S = 20.0
"""No joint of an arm turns faster."""
ASKEW = 0.99
"""Least cosine of the angle between the z axis of the flange and the axis of a last joint that turns."""


def read_robot(path: Path, options: ReadOptions | None = None) -> Reading:
    """Return the arm in a URDF or MJCF file; RequestError if there is no arm that can be used."""
    form, root = read_xml(path)
    if form == "urdf":
        from skillc.services.robot_import.urdf_reader import read_urdf

        reading = read_urdf(path, root, options or ReadOptions())
    else:
        from skillc.services.robot_import.mjcf_reader import read_mjcf

        reading = read_mjcf(path, options or ReadOptions())
    for link in reading.model.links:
        _check_range(path, link.joint)
    return reading.with_notes(*_flange_notes(reading), *_speed_notes(reading))


def _check_range(path: Path, joint: Joint) -> None:
    """Refuse a range that no joint has: it is stated in another unit. RequestError."""
    far = max(abs(joint.low), abs(joint.high))
    if joint.slides and far > FARTHEST_M:
        raise RequestError(f"{path}: joint `{joint.name}` slides by {far:g} m: ranges of joints that slide are in m")
    if not joint.slides and far > FARTHEST_RAD:
        raise RequestError(
            f"{path}: joint `{joint.name}` turns by {far:g} rad, which is {far / (2 * pi):.0f} turns: ranges are in "
            f"rad. Write {radians(far):.4g} if these are degrees, or the type `continuous` if the joint has no end"
        )


def _speed_notes(reading: Reading) -> Iterator[str]:
    """Yield a doubt about speeds that are stated in another unit."""
    joints = [link.joint for link in reading.model.links if not link.joint.slides]
    fast = [each.name for each in joints if each.speed is not None and each.speed > FASTEST_RAD_S]
    if fast:
        yield (
            f"speeds of more than {FASTEST_RAD_S:g} rad/s, {degrees(FASTEST_RAD_S):.0f} deg/s: {', '.join(fast)}; "
            'state those of the maker with --set "jointSpeeds=.."'
        )


def _flange_notes(reading: Reading) -> tuple[str, ...]:
    """Return a doubt about a flange whose z axis is not that of the last joint."""
    model = reading.model
    last = model.links[-1].joint
    if last.slides or float(model.flange.rotation[:, 2] @ last.axis) ** 2 > ASKEW**2:
        return ()
    return (
        f"the z axis of `{model.tip}` is not along the axis of the last joint, and should point out of the flange: "
        "turn it with --tip-turn ROLL PITCH YAW, in degrees, if it does not",
    )
