"""Chooses the chain of an MJCF model that is the arm, and removes what does not belong to it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco

from skillc.errors import RequestError
from skillc.services.robot_import.chain import check_last_joint
from skillc_dsl.spelling import did_you_mean

FLANGES = ("flange", "attachment_site", "ee_site", "tool0", "attachment")
"""Names of the site or body on which tools are mounted, the best first."""
_MOVING = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))


@dataclass(frozen=True, slots=True)
class MjcfChain:
    """The body `base`, the body or site `tip`, and the names of the joints between them; `bodies` are on the way."""

    base: str
    tip: str
    tip_is_site: bool
    tip_body: str
    joints: tuple[str, ...]
    bodies: tuple[str, ...]


def choose_chain(path: Path, model: Any, base: str | None, tip: str | None) -> MjcfChain:
    """Return the chain between a body and a body or site, which are found if not named.

    RequestError if they do not exist, are ambiguous, or joints between them are not those of an arm.
    """
    sites = [name for each in range(model.nsite) if (name := model.site(each).name)]
    bodies = [name for each in range(1, model.nbody) if (name := model.body(each).name)]
    if base is not None and base not in bodies:
        raise RequestError(f"{path} has no body `{base}` (--base); {did_you_mean(base, bodies)}")
    if tip is not None and tip not in (*sites, *bodies):
        raise RequestError(f"{path} has no site or body `{tip}` (--tip); {did_you_mean(tip, [*sites, *bodies])}")
    named = tip or next((name for name in FLANGES if name in sites), None)
    end = named or _last_body(path, model)
    at = int(model.site(end).bodyid[0]) if end in sites else int(model.body(end).id)
    way = _way(model, at)
    if base is not None:
        if model.body(base).id not in way:
            raise RequestError(f"{path}: `{end}` is not below body `{base}`; name others with --base and --tip")
        way = way[way.index(model.body(base).id) :]
    first = [] if base is None and model.body_jntnum[way[0]] else way[:1]
    moved = [body for body in way if body not in first and model.body_jntnum[body]]
    joints = tuple(_joint(path, model, body) for body in moved)
    start = model.body(first[0]).name if first else "world"
    names = tuple(model.body(body).name for body in way)
    if not all(names) or not all(joints):
        raise RequestError(f"{path}: the bodies and joints from the base to `{end}` must have names")
    if named is None:
        kind = int(model.jnt_type[model.body_jntadr[moved[-1]]])
        above = model.body(model.body_parentid[moved[-1]]).name
        check_last_joint(str(path), joints[-1], end, kind == int(mujoco.mjtJoint.mjJNT_SLIDE), above)
    return MjcfChain(start, end, end in sites, names[-1], joints, names)


def cut_to_chain(spec: Any, chain: MjcfChain) -> list[str]:
    """Remove what is mounted on the tip, all motors, and joints that are not of the chain; return notes about that."""
    for kind in ("keys", "sensors", "actuators", "tendons", "equalities", "excludes", "pairs"):
        for each in list(getattr(spec, kind)):
            spec.delete(each)
    tip = spec.body(chain.tip_body)
    beyond = [body for body in tip.bodies if not chain.tip_is_site or body.find_all("joint")]
    notes = []
    if beyond:
        names = ", ".join(f"`{body.name}`" for body in beyond)
        notes.append(f"{names} beyond `{chain.tip}` are left out; a gripper is mounted there by the scene")
    for body in beyond:
        spec.delete(body)
    others = [joint for joint in spec.joints if joint.name not in chain.joints]
    if others:
        notes.append(f"{len(others)} joint(s) that do not belong to the chain are fixed at their zero position")
    for joint in others:
        spec.delete(joint)
    return notes


def _way(model: Any, body: int) -> list[int]:
    """Return the bodies from the world, without it, to a body."""
    found = []
    while body:
        found.append(body)
        body = int(model.body_parentid[body])
    return found[::-1]


def _last_body(path: Path, model: Any) -> str:
    """Return the body at which what moves ends, if it is one chain."""
    moving = [body for body in range(1, model.nbody) if model.body_jntnum[body]]
    above = {each for body in moving for each in _way(model, body)[:-1]}
    ends = [model.body(body).name for body in moving if body not in above]
    if len(ends) == 1:
        return str(ends[0])
    listed = ", ".join(f"`{name}`" for name in ends[:4])
    raise RequestError(
        f"{path}: what moves ends in {len(ends)} bodies ({listed}); name the site or body on which a gripper is "
        "mounted with --tip"
    )


def _joint(path: Path, model: Any, body: int) -> str:
    """Return the name of the only joint of a body. RequestError if it has others, or one that no motor moves."""
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    name = model.body(body).name
    if count > 1:
        raise RequestError(f"{path}: body `{name}` has {count} joints; give each a body of its own")
    if int(model.jnt_type[first]) not in _MOVING:
        raise RequestError(f"{path}: the joint of body `{name}` is free or a ball, and an arm's joints turn or slide")
    return str(model.joint(first).name)
