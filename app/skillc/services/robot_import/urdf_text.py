"""Writes the part of a URDF that is an arm, without looks, for pinocchio's reader, which needs every limit."""

from __future__ import annotations

from copy import deepcopy
from xml.etree import ElementTree

from skillc.services.robot_import.chain import Chain
from skillc.services.robot_import.urdf_tree import UrdfTree

LINK, JOINT = "link ", "joint "
"""Before the names of links and joints, which may be the same in a URDF, but not in pinocchio."""


def arm_text(tree: UrdfTree, chain: Chain) -> str:
    """Return a URDF with base, tip, and all links below the base but those below the tip, with inertia and joints.

    Names begin with `LINK` and `JOINT`.
    """
    beyond = set(tree.below(chain.tip))
    kept = [chain.base, *(link for link in tree.below(chain.base) if link not in beyond)]
    robot = ElementTree.Element("robot", name="arm")
    for link in kept:
        copied = ElementTree.SubElement(robot, "link", name=LINK + link)
        copied.extend(deepcopy(tree.links[link].findall("inertial")))
    for link in kept[1:]:
        robot.append(_joint(tree.above[link].element))
    return ElementTree.tostring(robot, "unicode")


def _joint(element: ElementTree.Element) -> ElementTree.Element:
    """Return a joint as it is, but one whose limits are not complete has 0 for what is missing."""
    copied = deepcopy(element)
    copied.set("name", JOINT + (element.get("name") or ""))
    for end in (*copied.findall("parent"), *copied.findall("child")):
        end.set("link", LINK + (end.get("link") or ""))
    for each in copied.findall("mimic"):
        copied.remove(each)
    if copied.get("type") in ("revolute", "continuous", "prismatic"):
        limit = copied.find("limit")
        limit = ElementTree.SubElement(copied, "limit") if limit is None else limit
        for name in ("lower", "upper", "effort", "velocity"):
            limit.set(name, limit.get(name) or "0")
    return copied
