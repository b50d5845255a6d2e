"""Writes an arm as the MJCF that a cell is built of: as shipped models are, with a motor or servo for each joint."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, TypeAlias
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from skillc.services.robot_import.robot_model import Base, Inertia, Joint, RobotLink, RobotModel, Shape
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation

ControlKind: TypeAlias = Literal["torque", "position", "velocity"]

_HEAD = """\
<!--
{comment}
-->
<mujoco model={name}>
  <compiler angle="radian" autolimits="true"/>
  <option timestep="0.001" integrator="implicitfast"/>

  <default>
    <geom contype="0" conaffinity="0" group="1" rgba="0.78 0.79 0.82 1"/>
  </default>

  <worldbody>
"""


def write_mjcf(model: RobotModel, name: str, source: str, control: ControlKind, efforts: Sequence[float]) -> str:
    """Return the MJCF of an arm called `name`, read from the file `source`; efforts (n,) in N m, or N."""
    comment = "\n".join(
        f"  {line}"
        for line in (
            f"{name}: kinematics, masses and inertias of {source}, from {model.base.name} to {model.tip}; "
            "simple shapes.",
            "",
            "Limits of effort stand here only. Armature and servo gains are those of the data sheet.",
        )
    )
    lines = [*_base(model.base)]
    for depth, link in enumerate(model.links, 3):
        lines += [*_indented(depth, _link(link))]
    depth = 3 + len(model.links)
    lines += _indented(depth, [f'<site name="flange"{_pose(model.flange)}/>'])
    lines += ["  " * level + "</body>" for level in range(depth - 1, 1, -1)]
    motors = [_actuator(link.joint, control, effort) for link, effort in zip(model.links, efforts, strict=True)]
    tail = ["  </worldbody>", "", "  <actuator>", *_indented(2, motors), "  </actuator>", "</mujoco>", ""]
    return _HEAD.format(comment=escape(comment.replace("--", "- -")), name=quoteattr(name)) + "\n".join((*lines, *tail))


def format_number(value: float) -> str:
    """Return a number with 12 digits, without rounding errors near 0."""
    return f"{0.0 if abs(value) < 1e-14 else value:.12g}"


def format_numbers(values: Array | Sequence[float]) -> str:
    """Return numbers separated by spaces."""
    return " ".join(format_number(float(each)) for each in values)


def _base(base: Base) -> Iterator[str]:
    yield f"    <body name={quoteattr(_body_name(base.name))}>"
    yield from _indented(3, [_geom(shape) for shape in base.shapes])


def _link(link: RobotLink) -> Iterator[str]:
    joint = link.joint
    kind = ' type="slide"' if joint.slides else ""
    yield f"<body name={quoteattr(_body_name(link.name))}{_pose(link.placement)}>"
    yield "  " + _inertia(link.inertia)
    span = format_numbers((joint.low, joint.high))
    yield f'  <joint name={quoteattr(joint.name)}{kind} axis="{format_numbers(joint.axis)}" range="{span}"/>'
    yield from ("  " + _geom(shape) for shape in link.shapes)


def _body_name(name: str) -> str:
    """Return a name that MJCF allows for a body: `world` is taken."""
    return "base" if name == "world" else name


def _inertia(inertia: Inertia) -> str:
    full = format_numbers(inertia.matrix[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]])
    mass, centre = format_number(inertia.mass_kg), format_numbers(inertia.centre)
    return f'<inertial mass="{mass}" pos="{centre}" fullinertia="{full}"/>'


def _geom(shape: Shape) -> str:
    rounded = Pose(np.round(shape.pose.position, 5), shape.pose.rotation)
    return f'<geom type="{shape.kind}" size="{format_numbers(np.round(shape.size, 5))}"{_pose(rounded, 6)}/>'


def _pose(pose: Pose, digits: int = 12) -> str:
    """Return the attributes of a pose, only what is not the identity."""
    position, turn = pose.position, np.round(quaternion_from_rotation(pose.rotation), digits)
    there = f' pos="{format_numbers(position)}"' if np.abs(position).max() > 1e-12 else ""
    return there + (f' quat="{format_numbers(turn)}"' if np.abs(turn[1:]).max() > 0 else "")


def _actuator(joint: Joint, control: ControlKind, effort: float) -> str:
    name, span = quoteattr(joint.name), format_numbers((-effort, effort))
    if control == "torque":
        return f'<motor name={name} joint={name} ctrlrange="{span}"/>'
    return f'<position name={name} joint={name} kp="1000" forcerange="{span}" inheritrange="1"/>'


def _indented(depth: int, lines: Iterator[str] | Sequence[str]) -> list[str]:
    return ["  " * depth + line for line in lines]
