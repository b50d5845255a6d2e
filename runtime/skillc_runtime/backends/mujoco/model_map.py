"""Which parts of two models of one scene are the same, when what is held in one lies free in the other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Any, Literal, assert_never

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.int64]

Part = Literal["bodies", "geoms", "sites", "mocaps", "dofs", "coordinates", "actuators", "sensors"]

OF_JOINT = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
"""Transmissions of actuators that act on a joint."""

OF_GEOMS = ("contype", "conaffinity", "condim", "priority", "friction", "solmix", "solref", "solimp", "margin", "gap")
OF_DOFS = ("armature", "damping", "frictionloss", "solref", "solimp")
OF_JOINTS = ("stiffness", "range", "solref", "solimp", "margin")
OF_ACTUATORS = ("gainprm", "biasprm", "ctrlrange", "forcerange")
OF_BODIES = ("mass", "inertia", "pos", "quat")
OF_OPTIONS = (
    "gravity",
    "timestep",
    "integrator",
    "cone",
    "iterations",
    "impratio",
    "disableflags",
)
"""What may be changed in a model after it was built."""


class ModelMap(msgspec.Struct, frozen=True):
    """The parts of a model in which things are held (`tight`) by their numbers in the one in which all is free.

    bodies, geoms, sites: by number in the free model, the number in the tight one. joints, dofs, coordinates,
    actuators, equalities: by number in the tight model, the number in the free one, which has more of them. sensors:
    the numbers of what they measure, the same in both. fixed: the bodies in the free model that are no parts of a hand
    in the tight one only.
    """

    bodies: Rows
    geoms: Rows
    sites: Rows
    mocaps: Rows
    joints: Rows
    dofs: Rows
    coordinates: Rows
    actuators: Rows
    equalities: Rows
    sensors: Rows
    fixed: Rows

    def of(self, part: Part) -> tuple[Rows, Rows]:
        """Return the numbers of the same parts in the free model and in the tight one."""
        found: Rows = getattr(self, part)
        match part:
            case "bodies" | "geoms" | "sites" | "mocaps":
                return np.arange(found.size), found
            case "dofs" | "coordinates" | "actuators" | "sensors":
                return found, np.arange(found.size)
            case _:
                assert_never(part)

    def renew(self, free: Any, tight: Any) -> None:
        """Let the tight model have what was changed in the free one since it was built."""
        for name in (f"body_{each}" for each in OF_BODIES):
            rows = self.fixed if name in ("body_pos", "body_quat") else np.arange(free.nbody)
            getattr(tight, name)[self.bodies[rows]] = getattr(free, name)[rows]
        mujoco.mj_setConst(tight, mujoco.MjData(tight))
        for name in OF_GEOMS:
            getattr(tight, f"geom_{name}")[self.geoms] = getattr(free, f"geom_{name}")
        kinds = ("dof", OF_DOFS, self.dofs), ("jnt", OF_JOINTS, self.joints), ("actuator", OF_ACTUATORS, self.actuators)
        for kind, names, rows in kinds:
            for name in (f"{kind}_{each}" for each in names):
                getattr(tight, name)[:] = getattr(free, name)[rows]
        tight.eq_data[:] = free.eq_data[self.equalities]
        for name in OF_OPTIONS:
            setattr(tight.opt, name, getattr(free.opt, name))


def map_models(free: Any, tight: Any) -> ModelMap:
    """Compare two models of the same scene by the names of bodies and the order of the parts of each.

    ValueError if the parts of the tight one are not in the other, or sensors differ.
    """
    numbers = {tight.body(body).name: body for body in range(tight.nbody)}
    bodies = np.array([numbers[free.body(body).name] for body in range(free.nbody)])
    if len(set(bodies.tolist())) != tight.nbody or not np.array_equal(free.sensor_adr, tight.sensor_adr):
        raise ValueError("the models have different bodies or sensors")
    joints = _rows(_by_name(free, "jnt"), _by_name(tight, "jnt"))
    return ModelMap(
        bodies,
        _parts(free.geom_bodyid, tight.geom_bodyid, bodies),
        _parts(free.site_bodyid, tight.site_bodyid, bodies),
        np.array([tight.body_mocapid[bodies[body]] for body in np.flatnonzero(free.body_mocapid >= 0)], dtype=np.int64),
        joints,
        _spread(joints, free.jnt_dofadr, free.nv, tight.jnt_dofadr, tight.nv),
        _spread(joints, free.jnt_qposadr, free.nq, tight.jnt_qposadr, tight.nq),
        _rows(_by_name(free, "actuator"), _by_name(tight, "actuator")),
        _rows(_by_name(free, "eq"), _by_name(tight, "eq")),
        np.arange(free.nsensordata),
        np.flatnonzero(free.body_jntnum == tight.body_jntnum[bodies]),
    )


def _parts(free_owners: Rows, tight_owners: Rows, bodies: Rows) -> Rows:
    """Return, by number in the free model, the numbers of parts that bodies have in the same order in both."""
    found = np.empty(free_owners.size, dtype=np.int64)
    for body, other in enumerate(bodies):
        found[free_owners == body] = np.flatnonzero(tight_owners == other)
    return found


def _by_name(model: Any, kind: str) -> list[str]:
    """Return the names of all parts of a kind; those without a name are known by what they belong to or act on."""
    match kind:
        case "jnt":
            return list(_name_joints(model))
        case "actuator":
            return list(_name_actuators(model))
        case _:
            return list(_name_equalities(model))


def _name_joints(model: Any) -> Iterator[str]:
    for number in range(model.njnt):
        body = int(model.jnt_bodyid[number])
        yield model.joint(number).name or f"{model.body(body).name}#{number - int(model.body_jntadr[body])}"


def _name_actuators(model: Any) -> Iterator[str]:
    joints, unnamed = list(_name_joints(model)), Counter[str]()
    for number in range(model.nu):
        kind, target = int(model.actuator_trntype[number]), int(model.actuator_trnid[number, 0])
        driven = joints[target] if kind in OF_JOINT else f"{kind}/{target}"
        yield model.actuator(number).name or f"{driven}#{unnamed[driven]}"
        unnamed[driven] += 1


def _name_equalities(model: Any) -> Iterator[str]:
    unnamed = Counter[str]()
    for number in range(model.neq):
        kind, ends = int(model.eq_objtype[number]), (model.eq_obj1id[number], model.eq_obj2id[number])
        joined = "/".join(mujoco.mj_id2name(model, kind, int(end)) or "" for end in ends)
        yield model.equality(number).name or f"{joined}#{unnamed[joined]}"
        unnamed[joined] += 1


def _rows(free: list[str], tight: list[str]) -> Rows:
    """Return the place of each of the tight names among the free ones."""
    places = {name: place for place, name in enumerate(free)}
    return np.array([places[name] for name in tight], dtype=np.int64)


def _spread(joints: Rows, free_first: Rows, free_count: int, tight_first: Rows, tight_count: int) -> Rows:
    """Return the rows of numbers of joints, of which each has several."""
    ends = [*tight_first[1:].tolist(), tight_count]
    widths = [end - first for first, end in zip(tight_first.tolist(), ends, strict=True)]
    rows = [int(free_first[joint]) + step for joint, width in zip(joints, widths, strict=True) for step in range(width)]
    assert max(rows, default=0) < free_count
    return np.array(rows, dtype=np.int64)
