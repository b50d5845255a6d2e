"""Names of the parts of a simulated cell in its MuJoCo model, from the short names of individuals."""

from __future__ import annotations


def part_name(device: str, name: str) -> str:
    """Return the name of a part of a device's own model."""
    return f"{device}/{name}"


def base_body_name(robot: str) -> str:
    """Return the name of a mobile base's body."""
    return f"{robot}/base"


def mount_name(arm: str) -> str:
    """Return the name of the body that stands where the world model has the base of an arm that is elsewhere."""
    return f"mount/{arm}"


def box_geom_name(individual: str) -> str:
    """Return the name of the box of a surface."""
    return f"{individual}/box"


def solid_geom_name(individual: str, number: int) -> str:
    """Return the name of a solid of a body, by its number; that of the first is `box_geom_name`."""
    return f"{individual}/box/{number}" if number else box_geom_name(individual)


def obstacle_name(surface: str) -> str:
    """Return the name of an obstacle on a surface that the world model does not have."""
    return f"{surface}/obstacle"


def hole_name(surface: str, number: int) -> str:
    """Return the name of the mark or protrusion of a hole of a surface."""
    return f"{surface}/hole/{number}"


def weld_name(gripper: str, tool: str) -> str:
    """Return the name of the weld that holds a tool in a gripper."""
    return f"{gripper}/holds/{tool}"


def wrist_sensor_name(gripper: str, quantity: str) -> str:
    """Return the name of a gripper's wrist sensor for `force`, `torque` or `acceleration`."""
    return f"{gripper}/wrist/{quantity}"


def contact_sensor_name(tool: str) -> str:
    """Return the name of the sensor of all contacts of a tool together."""
    return f"{tool}/contact"


def pressing_sensor_name(tool: str, surface: str) -> str:
    """Return the name of the sensor of the contacts of a tool with a surface itself."""
    return f"{tool}/presses/{surface}"


def face_sensor_name(tool: str, quantity: str) -> str:
    """Return the name of a sensor at a tool's working face."""
    return f"{tool}/face/{quantity}"
