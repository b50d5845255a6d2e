"""Chooses the chain of a URDF that is the arm: from its base to the link on which a gripper is mounted."""

from __future__ import annotations

import re
from dataclasses import dataclass

from skillc.errors import RequestError
from skillc.services.robot_import.urdf_tree import UrdfJoint, UrdfTree
from skillc_dsl.spelling import did_you_mean

FEWEST_JOINTS, MOST_JOINTS = 6, 10
FLANGES = ("tool0", "flange")
"""Names of the link on which tools are mounted, the best first; x of ROS's `flange` points out, z of `tool0`."""
WORLDS = ("world", "map")
"""Names of roots that are no part of an arm."""
_GRIPPER = re.compile("gripper|finger|knuckle|jaw|claw", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Chain:
    """The links `base` and `tip`, and the joints between them that move."""

    base: str
    tip: str
    joints: tuple[UrdfJoint, ...]


def choose_chain(tree: UrdfTree, base: str | None, tip: str | None) -> Chain:
    """Return the chain between two links, which are found if they are not named.

    RequestError if they do not exist, are ambiguous, or are not joined by an arm.
    """
    for option, link in (("--base", base), ("--tip", tip)):
        if link is not None and link not in tree.links:
            raise RequestError(f"{tree.path} has no link `{link}` ({option}); {did_you_mean(link, list(tree.links))}")
    start = base or _default_base(tree)
    end = tip or _default_tip(tree, start)
    way = tree.path_to(end)
    if start != tree.root:
        above = [number for number, joint in enumerate(way) if joint.child == start]
        if not above:
            raise RequestError(f"{tree.path}: link `{end}` is not below `{start}`; name others with --base and --tip")
        way = way[above[0] + 1 :]
    chain = Chain(start, end, tuple(joint for joint in way if joint.moves))
    _check_joints(tree, chain)
    if tip is None:
        last = chain.joints[-1]
        check_last_joint(str(tree.path), last.name, last.child, last.kind == "prismatic", last.parent)
    return chain


def _default_base(tree: UrdfTree) -> str:
    below = tree.children(tree.root)
    skipped = tree.root.lower() in WORLDS and len(below) == 1 and not below[0].moves
    return below[0].child if skipped else tree.root


def _default_tip(tree: UrdfTree, start: str) -> str:
    """Follow what moves from the base on, to a frame with the name of a flange, or one fixed to the last link."""
    moving = {joint.parent for joint in tree.above.values() if joint.moves}
    leads = {link for last in moving for link in (last, *(joint.parent for joint in tree.path_to(last)))}
    link = start
    while True:
        if (
            sum(joint.moves for joint in tree.path_to(link)) >= FEWEST_JOINTS
            and (flange := _flange_on([link, *tree.fixed_to(link)])) is not None
        ):
            return flange
        onward = [joint for joint in tree.children(link) if joint.moves or joint.child in leads]
        if len(onward) > 1:
            raise _several(tree, link, onward)
        if not onward:
            return _frame_on(tree, link)
        link = onward[0].child


def _flange_on(links: list[str]) -> str | None:
    """Return the one of some links that has the name of a flange; None if none or several have."""
    for name in FLANGES:
        found = [each for each in links if each.endswith(name)]
        if len(found) == 1:
            return found[0]
    return None


def _frame_on(tree: UrdfTree, last: str) -> str:
    fixed = [last, *tree.below(last)]
    if (flange := _flange_on(fixed)) is not None:
        return flange
    leaves = [each for each in fixed if not tree.children(each)]
    if len(leaves) == 1:
        return leaves[0]
    raise RequestError(
        f"{tree.path}: several frames are fixed to the last link `{last}`: {', '.join(fixed)}; name the one on which a "
        "gripper is mounted, whose z axis points out, with --tip LINK"
    )


def _several(tree: UrdfTree, link: str, onward: list[UrdfJoint]) -> RequestError:
    way = [link]
    for joint in reversed(tree.path_to(link)):
        if joint.moves:
            break
        way.append(joint.parent)
    names = ", ".join(f"`{joint.name}`" for joint in onward)
    options = " or ".join(f"`{each}`" for each in reversed(way))
    return RequestError(
        f"{tree.path}: at link `{link}` the model goes on in {len(onward)} ways, with joints {names}; name the link "
        f"on which a gripper is mounted with --tip LINK, such as {options} if "
        "these are fingers"
    )


def _check_joints(tree: UrdfTree, chain: Chain) -> None:
    between = f"between `{chain.base}` and `{chain.tip}`"
    for joint in chain.joints:
        if joint.kind in ("floating", "planar"):
            raise RequestError(
                f"{tree.path}: joint `{joint.name}` {between} is {joint.kind}: no motor moves it; "
                "start below it with --base LINK"
            )
        if joint.mimics:
            raise RequestError(
                f"{tree.path}: joint `{joint.name}` {between} follows another one (`<mimic>`); every joint "
                "of an arm needs its own motor"
            )
    check_count(str(tree.path), [joint.name for joint in chain.joints], between)


def check_last_joint(file: str, joint: str, link: str, slides: bool, above: str) -> None:
    """Refuse a chain whose last joint, which moves `link` on `above`, seems to be a gripper. RequestError."""
    if not (slides or _GRIPPER.search(joint) or _GRIPPER.search(link)):
        return
    raise RequestError(
        f"{file}: the last joint, `{joint}`, {'slides' if slides else f'moves `{link}`'}, as a gripper does and no "
        f"wrist: name the link on which a gripper is mounted with --tip LINK, such as `{above}`, or --tip {link} if "
        "this joint is a part of the arm"
    )


def check_count(file: str, joints: list[str], between: str) -> None:
    """Refuse arms with too few joints to move a tool freely, and chains that are no arm. RequestError."""
    if FEWEST_JOINTS <= len(joints) <= MOST_JOINTS:
        return
    count = f"{len(joints)} joint{'s' * (len(joints) != 1)}" if joints else "no joint"
    listed = f" ({', '.join(joints[:12])})" if joints else ""
    raise RequestError(
        f"{file}: {count} move{'s' * (len(joints) < 2)} {between}{listed}; an arm that skills can use "
        f"has {FEWEST_JOINTS} to {MOST_JOINTS}. "
        "Name other links with --base and --tip if these are the wrong ones"
    )
