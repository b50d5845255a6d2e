"""Messages of ROS 2 made of what a server sends: joint states, wrenches, and markers for RViz."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from skillc.contract.geometry import CellModel, ModelGeom
from skillc.contract.sample import ArmSample, ForceSample, PoseNumbers, Sample
from skillc_runtime.backends.ros2.pose_message import write_pose
from skillc_runtime.backends.ros2.session import find_message
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frame_tree import WORLD_FRAME

ARROW_M_N, ARROW_WIDTH_M = 0.01, 0.01
"""How long the arrow of a force is for each N, and how thick."""


def joint_state(sample: Sample, names: Mapping[str, Sequence[str]], stamp: Any) -> Any:
    """Return the joints of all arms, by the names that `names` has of each arm, then those of fingers and drawers."""
    message = find_message("sensor_msgs/msg/JointState")()
    message.header.stamp = stamp
    for arm, found in sample.arms.items():
        message.name.extend(names.get(arm, ()))
        message.position.extend(found.joints)
        message.velocity.extend(found.speeds)
    message.name.extend(sample.joints)
    message.position.extend(sample.joints.values())
    message.velocity.extend([0.0] * len(sample.joints))
    return message


def wrench(arm: ArmSample, frame: str, stamp: Any) -> Any:
    """Return what the sensor of an arm measures, along the axes of the frame of the arm's base."""
    message = find_message("geometry_msgs/msg/WrenchStamped")()
    message.header.frame_id, message.header.stamp = frame, stamp
    fx, fy, fz, tx, ty, tz = arm.wrench or (0.0,) * 6
    message.wrench.force.x, message.wrench.force.y, message.wrench.force.z = fx, fy, fz
    message.wrench.torque.x, message.wrench.torque.y, message.wrench.torque.z = tx, ty, tz
    return message


def markers(sample: Sample, model: CellModel, stamp: Any) -> Any:
    """Return the shapes of things where they are, and an arrow for each force on a tool."""
    message = find_message("visualization_msgs/msg/MarkerArray")()
    for individual, numbers in sample.things.items():
        if individual in model.individuals:
            message.markers.extend(_shapes(individual, numbers, model, stamp))
    message.markers.extend(_arrow(tool, force, stamp) for tool, force in sample.forces.items())
    return message


def _shapes(individual: str, numbers: PoseNumbers, model: CellModel, stamp: Any) -> Iterator[Any]:
    drawn = model.individuals[individual]
    body = _pose(numbers) @ _pose(drawn.frame).inverse()
    for number, geom in enumerate(model.bodies[drawn.body].geoms):
        if (kind := _kind(geom)) is None:
            continue
        marker = _marker(drawn.label, number, stamp)
        marker.type, scale = kind
        marker.scale.x, marker.scale.y, marker.scale.z = scale
        write_pose(body @ _pose(geom.pose), marker.pose)
        marker.color.r, marker.color.g, marker.color.b, marker.color.a = geom.colour
        yield marker


def _kind(geom: ModelGeom) -> tuple[int, tuple[float, float, float]] | None:
    """Return type and size of a marker for a shape; None for one that is no simple shape."""
    cube, sphere, cylinder = 1, 2, 3
    x, y, z = geom.size
    match geom.shape:
        case "box":
            return cube, (2 * x, 2 * y, 2 * z)
        case "sphere":
            return sphere, (2 * x, 2 * x, 2 * x)
        case "ellipsoid":
            return sphere, (2 * x, 2 * y, 2 * z)
        case "cylinder" | "capsule":
            return cylinder, (2 * x, 2 * x, 2 * y)
        case _:
            return None


def _arrow(tool: str, force: ForceSample, stamp: Any) -> Any:
    marker, point = _marker(f"force on {tool.rpartition('#')[2]}", 0, stamp), find_message("geometry_msgs/msg/Point")
    marker.type = 0
    marker.scale.x, marker.scale.y, marker.scale.z = ARROW_WIDTH_M, 2 * ARROW_WIDTH_M, 0.0
    marker.color.r = marker.color.a = 1.0
    start = np.array(force.point)
    ends = (start, start + ARROW_M_N * np.array(force.force))
    marker.points = [point(x=float(x), y=float(y), z=float(z)) for x, y, z in ends]
    marker.pose.orientation.w = 1.0
    return marker


def _marker(namespace: str, number: int, stamp: Any) -> Any:
    marker = find_message("visualization_msgs/msg/Marker")()
    marker.header.frame_id, marker.header.stamp, marker.ns, marker.id = WORLD_FRAME, stamp, namespace, number
    marker.lifetime.sec = 1
    return marker


def _pose(numbers: PoseNumbers) -> Pose:
    return Pose.of(numbers[:3], numbers[3:])
