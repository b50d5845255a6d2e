"""The tree of links and joints of a URDF, checked: every joint joins two links, and one link is the root of all."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from skillc.errors import RequestError
from skillc_runtime.motion.pose import Array, Pose, rotation_from_angles

MOST_LINKS = 1000
KINDS = ("revolute", "continuous", "prismatic", "floating", "planar", "fixed")


@dataclass(frozen=True, slots=True)
class UrdfJoint:
    """A joint with its element; `kind` is one of `KINDS`."""

    name: str
    kind: str
    parent: str
    child: str
    element: ElementTree.Element


@dataclass(frozen=True, slots=True)
class UrdfTree:
    """The links by name, and the joints by the name of their child."""

    path: Path
    links: Mapping[str, ElementTree.Element]
    above: Mapping[str, UrdfJoint]


def read_tree(path: Path, robot: ElementTree.Element) -> UrdfTree:
    """Return the tree of a `<robot>`. RequestError with the first thing that is wrong."""
    links = _named(path, robot, "link")
    joints = {name: _joint(path, name, each) for name, each in _named(path, robot, "joint").items()}
    if not links:
        raise RequestError(f"{path} has no link")
    if len(links) > MOST_LINKS:
        raise RequestError(f"{path} has {len(links)} links; an arm has fewer than {MOST_LINKS}")
    above: dict[str, UrdfJoint] = {}
    for joint in joints.values():
        for role, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                raise RequestError(f"{path}: the {role} of joint `{joint.name}`, `{link}`, is no link of the file")
        if joint.child in above:
            first = above[joint.child].name
            raise RequestError(
                f"{path}: link `{joint.child}` is the child of two joints, `{first}` and `{joint.name}`; links must "
                "be a tree"
            )
        above[joint.child] = joint
    _check_root(path, links, above)
    return UrdfTree(path, links, above)


def numbers(path: Path, element: ElementTree.Element | None, attribute: str, default: tuple[float, ...]) -> Array:
    """Return an attribute with as many finite numbers as the default has, which is taken if there is none."""
    text = None if element is None else element.get(attribute)
    if text is None:
        return np.array(default)
    try:
        found = np.array([float(part) for part in text.split()])
    except ValueError:
        found = np.array([])
    if found.size != len(default) or not np.isfinite(found).all():
        tag = "" if element is None else str(element.tag)
        raise RequestError(f'{path}: `<{tag} {attribute}="{text}">` must have {len(default)} number(s)')
    return found


def origin(path: Path, element: ElementTree.Element) -> Pose:
    """Return the pose in the `<origin>` of an element, the identity without one."""
    there = element.find("origin")
    turn = numbers(path, there, "rpy", (0.0, 0.0, 0.0))
    return Pose(numbers(path, there, "xyz", (0.0, 0.0, 0.0)), rotation_from_angles(*turn.tolist()))


def _named(path: Path, robot: ElementTree.Element, tag: str) -> dict[str, ElementTree.Element]:
    found = robot.findall(tag)
    names = [each.get("name") or "" for each in found]
    if "" in names:
        raise RequestError(f"{path}: a `<{tag}>` has no name")
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise RequestError(f"{path}: there are two {tag}s called `{twice[0]}`")
    return dict(zip(names, found, strict=True))


def _joint(path: Path, name: str, element: ElementTree.Element) -> UrdfJoint:
    kind, ends = element.get("type"), {}
    if kind not in KINDS:
        raise RequestError(f"{path}: joint `{name}` is of type `{kind}`, and there are only {', '.join(KINDS)}")
    for role in ("parent", "child"):
        end = element.find(role)
        link = None if end is None else end.get("link")
        if link is None:
            raise RequestError(f'{path}: joint `{name}` has no `<{role} link="..">`')
        ends[role] = link
    return UrdfJoint(name, kind, ends["parent"], ends["child"], element)


def _check_root(path: Path, links: Mapping[str, ElementTree.Element], above: Mapping[str, UrdfJoint]) -> None:
    """Refuse links without a joint above them but for one, and circles. RequestError."""
    roots = [link for link in links if link not in above]
    if len(roots) > 1:
        raise RequestError(
            f"{path}: {len(roots)} links have no parent ({', '.join(roots[:4])}); all but one need a joint"
        )
    reached, count = {*roots}, 0
    while count < len(reached):
        count = len(reached)
        reached |= {joint.child for joint in above.values() if joint.parent in reached}
    lost = [link for link in links if link not in reached]
    if lost:
        raise RequestError(f"{path}: the links {', '.join(lost[:4])} are joined in a circle; links must be a tree")
