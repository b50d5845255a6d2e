"""Chooses the chain of a model that is the arm: from its base to the link or site on which a gripper is mounted."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

import mujoco

from skillc.errors import RequestError
from skillc_dsl.spelling import did_you_mean

FEWEST_JOINTS, MOST_JOINTS = 6, 10
FLANGES = ("tool0", "flange")
"""Names of the link on which tools are mounted, the best first; x of ROS's `flange` points out, z of `tool0`."""
SITES = ("flange", "attachment_site", "ee_site", "tool0", "attachment")
"""Names of the site on which tools are mounted, the best first."""
WORLDS = ("world", "map")
"""Names of roots that are no part of an arm."""
_GRIPPER = re.compile("gripper|finger|knuckle|jaw|claw", re.IGNORECASE)

Noun: TypeAlias = Literal["link", "body"]
"""What a part of a model is called in its format; a `link` that is fixed to the last one may be a flange."""


@dataclass(frozen=True, slots=True)
class Chain:
    """The arm in a MuJoCo specification: the bodies from its base to the one that is its tip, or has the site `tip`."""

    bodies: tuple[Any, ...]
    tip: str
    tip_is_site: bool

    @property
    def base(self) -> str:
        """The name of the base."""
        return str(self.bodies[0].name)

    @property
    def moved(self) -> tuple[Any, ...]:
        """The bodies that joints of the chain move, from the base on."""
        return tuple(body for body in self.bodies[1:] if body.joints)

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the first joints of these."""
        return tuple(body.joints[0].name for body in self.moved)


def choose_chain(path: Path, spec: Any, noun: Noun, base: str | None, tip: str | None) -> Chain:
    """Return the chain of a specification between two of its parts, which are found if they are not named.

    RequestError if they do not exist, are ambiguous, or are not joined by as many joints as an arm has.
    """
    bodies = {body.name: body for body in spec.bodies[1:] if body.name}
    sites = {site.name: site for site in spec.sites if site.name}
    for option, name, known in (("--base", base, bodies), ("--tip", tip, {**sites, **bodies})):
        if name is not None and name not in (*known, *WORLDS[: noun == "link"]):
            kind = f"site or {noun}" if sites and option == "--tip" else noun
            raise RequestError(f"{path} has no {kind} `{name}` ({option}); {did_you_mean(name, list(known))}")
    top = spec.worldbody if base is None else spec.body(base)
    end = tip or next((name for name in SITES if name in sites), None) or _find_tip(path, top, noun)
    way = _find_way(sites[end].parent if end in sites else spec.body(end))
    if base is not None:
        if top not in way:
            raise RequestError(f"{path}: `{end}` is not below {noun} `{base}`; name others with --base and --tip")
        way = way[way.index(top) :]
    while base is None and len(way) > 1 and way[0].name.lower() in WORLDS and not way[1].joints:
        way = way[1:]
    chain = Chain(tuple(way), end, end in sites)
    _check_count(path, chain)
    if not all((*chain.joints, *(body.name for body in way))):
        raise RequestError(f"{path}: the bodies and joints from the base to `{end}` must have names")
    if tip is None and end not in sites:
        _check_last_joint(path, chain)
    return chain


def other_joints(spec: Any, chain: Chain) -> list[Any]:
    """Return the joints that are not of the chain."""
    moved = set(chain.moved)
    return [joint for body in spec.bodies if body not in moved for joint in body.joints]


def cut_to_chain(spec: Any, chain: Chain, fixed_at: str) -> Iterator[str]:
    """Remove what is mounted on the tip, all motors, and joints that are not of the chain; yield notes about that.

    fixed_at: where those joints are.
    """
    for kind in ("keys", "sensors", "actuators", "tendons", "equalities", "excludes", "pairs"):
        for each in list(getattr(spec, kind)):
            spec.delete(each)
    tip = chain.bodies[-1]
    beyond = [body for body in tip.bodies if not chain.tip_is_site or body.find_all("joint")]
    if beyond:
        names = [each.name for body in beyond for each in (body, *body.find_all("body"))]
        yield f"what is beyond `{chain.tip}` is left out ({list_some(names)}); the scene mounts a gripper there"
    for body in beyond:
        spec.delete(body)
    others = other_joints(spec, chain)
    beside = [joint.name for body in chain.bodies[0].find_all("body") for joint in body.joints if joint in others]
    if beside:
        yield f"{list_some(beside)} do not belong to the chain: they are fixed at {fixed_at}"
    for joint in others:
        spec.delete(joint)


def list_some(names: Sequence[str]) -> str:
    """Return the first of some names, and how many more there are."""
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def _find_way(body: Any) -> list[Any]:
    """Return the bodies from the world to a body."""
    way = [body]
    while (above := way[-1].parent) is not None:
        way.append(above)
    return way[::-1]


def _find_tip(path: Path, top: Any, noun: Noun) -> str:
    """Follow what moves from a body on, to a frame with the name of a flange, or where it ends."""
    body, joints = top, 0
    while True:
        joints += len(body.joints[:1])
        if joints >= FEWEST_JOINTS and (flange := _flange_on([body, *fixed_to(body)])) is not None:
            return flange
        onward = [each for each in body.bodies if each.find_all("joint")]
        if len(onward) > 1:
            raise _several(path, body, onward, noun)
        if not onward:
            return _frame_on(path, body) if noun == "link" else str(body.name)
        body = onward[0]


def fixed_to(body: Any) -> Iterator[Any]:
    """Yield the bodies that are fixed to a body, also by others."""
    beside = list(body.bodies)
    while beside:
        each = beside.pop()
        if not each.joints:
            yield each
            beside += each.bodies


def _flange_on(bodies: Sequence[Any]) -> str | None:
    """Return the one of some bodies that has the name of a flange; None if none or several have."""
    for name in FLANGES:
        found = [each.name for each in bodies if each.name.endswith(name)]
        if len(found) == 1:
            return str(found[0])
    return None


def _frame_on(path: Path, last: Any) -> str:
    fixed = [last, *fixed_to(last)]
    if (flange := _flange_on(fixed)) is not None:
        return flange
    leaves = [each.name for each in fixed if not each.bodies]
    if len(leaves) == 1:
        return str(leaves[0])
    raise RequestError(
        f"{path}: several frames are fixed to the last link `{last.name}`: {', '.join(each.name for each in fixed)}; "
        "name the one on which a gripper is mounted, whose z axis points out, with --tip LINK"
    )


def _several(path: Path, body: Any, onward: list[Any], noun: Noun) -> RequestError:
    names = ", ".join(f"`{each.find_all('joint')[0].name}`" for each in onward)
    way = _find_way(body)
    moved = [number for number, each in enumerate(way) if each.joints]
    options = " or ".join(f"`{each.name}`" for each in (way[moved[-1] :] if moved else way[1:] or way))
    return RequestError(
        f"{path}: at {noun} `{body.name}` the model goes on in {len(onward)} ways, with joints {names}; name the "
        f"{noun} on which a gripper is mounted with --tip {noun.upper()}, such as {options} if these are fingers"
    )


def _check_last_joint(path: Path, chain: Chain) -> None:
    """Refuse a chain whose last joint seems to be a gripper. RequestError."""
    body = chain.moved[-1]
    joint, slides = body.joints[0].name, body.joints[0].type == mujoco.mjtJoint.mjJNT_SLIDE
    if not (slides or _GRIPPER.search(joint) or _GRIPPER.search(body.name)):
        return
    raise RequestError(
        f"{path}: the last joint, `{joint}`, {'slides' if slides else f'moves `{body.name}`'}, as a gripper does and "
        f"no wrist: name the link on which a gripper is mounted with --tip LINK, such as `{body.parent.name}`, or "
        f"--tip {body.name} if this joint is a part of the arm"
    )


def _check_count(path: Path, chain: Chain) -> None:
    """Refuse arms with too few joints to move a tool freely, and chains that are no arm. RequestError."""
    joints = chain.joints
    if FEWEST_JOINTS <= len(joints) <= MOST_JOINTS:
        return
    count = f"{len(joints)} joint{'s' * (len(joints) != 1)}" if joints else "no joint"
    listed = f" ({', '.join(joints[:12])})" if joints else ""
    raise RequestError(
        f"{path}: {count} move{'s' * (len(joints) < 2)} between `{chain.base}` and `{chain.tip}`{listed}; an arm that "
        f"skills can use has {FEWEST_JOINTS} to {MOST_JOINTS}. Name other links with --base and --tip if these are the "
        "wrong ones"
    )
