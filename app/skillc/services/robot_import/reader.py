"""Reads an arm from a file of either format."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi, radians
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

from skillc.errors import RequestError
from skillc.services.robot_import.arm_reader import Reading, ReadOptions
from skillc.services.robot_import.robot_model import Joint

LARGEST_BYTES = 20_000_000
"""Larger files are not read; models without their meshes have some 10 kB."""

FARTHEST_RAD, FARTHEST_M = 4 * pi, 100.0
"""No joint turns or slides farther than this from 0; the language warns of angles above two turns, too."""
FASTEST_RAD_S = 20.0
"""No joint of an arm turns faster."""
ASKEW = 0.99
"""Least cosine of the angle between the z axis of the flange and the axis of a last joint that turns."""


def read_robot(path: Path, options: ReadOptions | None = None) -> Reading:
    """Return the arm in a URDF or MJCF file; RequestError if there is no arm that can be used."""
    form, root = _read_xml(path)
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


def _read_xml(path: Path) -> tuple[Literal["urdf", "mjcf"], ElementTree.Element]:
    """Return the format of a robot's model and its root element. RequestError if it is not URDF or MJCF."""
    root = _parse(path)
    tag = _local_tag(root)
    if path.suffix == ".xacro" or any("xacro" in each.tag for each in root.iter() if isinstance(each.tag, str)):
        raise RequestError(
            f"{path} has xacro macros, which have to be expanded first: `pip install xacro`, then "
            f"`xacro {path.name} > {path.name.split('.')[0]}_expanded.urdf`, with the arguments of the file as "
            "NAME:=VALUE"
        )
    if tag == "robot":
        return "urdf", root
    if tag == "mujoco":
        return "mjcf", root
    hint = "; SDF can be converted with `gz sdf`, or export URDF" if tag == "sdf" else ""
    raise RequestError(f"{path} is neither URDF (`<robot>`) nor MJCF (`<mujoco>`): it begins with `<{tag}>`{hint}")


def _local_tag(element: ElementTree.Element) -> str:
    """Return the tag of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def _parse(path: Path) -> ElementTree.Element:
    try:
        if path.is_dir():
            raise RequestError(f"{path} is a folder; name the URDF or MJCF file in it")
        if path.stat().st_size > LARGEST_BYTES:
            raise RequestError(
                f"{path} has more than {LARGEST_BYTES // 1_000_000} MB; a model has its meshes in other files"
            )
        return ElementTree.fromstring(path.read_bytes())
    except OSError as error:
        raise RequestError(f"{path} cannot be read: {error.strerror}") from error
    except ElementTree.ParseError as error:
        line, column = error.position
        what = str(error).partition(":")[0]
        raise RequestError(f"{path}:{line}:{column + 1}: this is not XML: {what}") from error
    except (ValueError, LookupError) as error:
        raise RequestError(f"{path} is not XML: {error}") from error
