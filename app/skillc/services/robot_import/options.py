"""Reads what a user says about an arm: efforts, home posture and values of the data sheet."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.mjcf_writer import ControlKind
from skillc.services.robot_import.robot_model import RobotModel
from skillc.services.robot_import.sheet_writer import TEXTS, settable
from skillc_dsl.spelling import did_you_mean
from skillc_runtime.motion.pose import Array

MAY_BE_ZERO = ("armature", "servoDamping", "forceTorqueTime", "dampingFloor", "rotationalDampingFloor", "commandTime")
"""Values that may be 0; all others but the height of the shoulder are above 0."""


def read_efforts(model: RobotModel, text: str | None, file: Path) -> list[float]:
    """Return the greatest effort of each joint in N m, or N. RequestError if neither file nor user states it."""
    if text is not None:
        return list(map(float, _above_zero("--efforts", _for_each_joint("--efforts", text, len(model.links)))))
    lost = [link.joint.name for link in model.links if link.joint.effort is None]
    if lost:
        raise RequestError(
            f"{file} states no effort, or 0, for {', '.join(lost)}: say how strong the motors are, from the maker's "
            f'data sheet, with --efforts "{" ".join(["N"] * len(model.links))}", in N m from the base on'
        )
    return [float(link.joint.effort or 0.0) for link in model.links]


def read_home(model: RobotModel, text: str) -> Array:
    """Return a home posture (n,) in rad. RequestError if it is not a number for each joint within its range."""
    q = _for_each_joint("--home", text, len(model.links))
    for link, value in zip(model.links, q.tolist(), strict=True):
        if not link.joint.low <= value <= link.joint.high:
            span = f"{link.joint.low:g} to {link.joint.high:g}"
            raise RequestError(f"--home: {value:g} is not in the range of joint {link.joint.name}, {span}")
    return q


def read_settings(settings: Mapping[str, str], control: ControlKind, joints: int) -> dict[str, str]:
    """Return values of the data sheet by property. RequestError for others, and for invalid numbers."""
    known = settable(control)
    found: dict[str, str] = {}
    for name, text in settings.items():
        option = f"--set {name}"
        if name not in known:
            raise RequestError(
                f"{option}: an arm with {control} commands has no such property; {did_you_mean(name, known)}"
            )
        if name in TEXTS:
            _above_zero(option, _for_each_joint(option, text, joints))
            found[name] = " ".join(text.split())
            continue
        value = _numbers(option, text)
        if value.size != 1:
            raise RequestError(f"{option}: write one number in SI units, not `{text}`")
        if name != "shoulderHeight" and (value[0] < 0 if name in MAY_BE_ZERO else value[0] <= 0):
            raise RequestError(f"{option}: {text} must be {'at least' if name in MAY_BE_ZERO else 'above'} 0")
        found[name] = f"{value[0]:.12g}"
    return found


def _for_each_joint(option: str, text: str, joints: int) -> Array:
    found = _numbers(option, text)
    if found.size != joints:
        raise RequestError(
            f"{option}: write {joints} numbers separated by spaces, one for each joint; these are {found.size}"
        )
    return found


def _above_zero(option: str, values: Array) -> Array:
    if not (values > 0).all():
        raise RequestError(f"{option}: every number must be above 0")
    return values


def _numbers(option: str, text: str) -> Array:
    try:
        found = np.array([float(part) for part in text.split()])
    except ValueError:
        found = np.array([np.nan])
    if not np.isfinite(found).all():
        raise RequestError(f"{option}: `{text}` is not numbers separated by spaces")
    return found
