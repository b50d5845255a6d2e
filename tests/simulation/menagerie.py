"""A collection of models as others publish them: the same arms with other frames, their base turned, and meshes."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as Xml

import mujoco
import numpy as np

from skillc_ontology import catalogue
from skillc_runtime.motion.pose import Array, Pose, exp, quaternion_from_rotation

CORNERS = ((0.01, 0.02, 0.03), (0.11, 0.02, 0.03), (0.01, 0.22, 0.03), (0.01, 0.02, 0.33))
FACES = ((1, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4))
SCALE = 0.3
COLOUR = "0.1 0.6 0.3 1"
OURS = {
    "universal_robots_ur5e/ur5e.xml": "robots/ur5e.xml",
    "kuka_iiwa_14/iiwa14.xml": "robots/iiwa14.xml",
    "franka_emika_panda/panda_nohand.xml": "robots/panda.xml",
    "franka_emika_panda/hand.xml": "grippers/panda_hand.xml",
}
QUARTERS = {"robots/ur5e.xml": 1, "grippers/panda_hand.xml": 2}
"""By how many quarter turns ours are turned against theirs."""


def write_collection(root: Path) -> None:
    """Write every model of the collection, with a tetrahedron on each link."""
    for name, ours in OURS.items():
        _write_model(root / name, catalogue.model_path(ours), QUARTERS.get(ours, 0))


def tetrahedron(file: Path) -> None:
    """Write a mesh; its frame is neither in its middle nor along its axes."""
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS)
    file.write_text(points + "".join("f {} {} {}\n".format(*face) for face in FACES), "utf-8")


def _write_model(file: Path, ours: Path, quarters: int) -> None:
    own = mujoco.MjModel.from_xml_path(str(ours))
    data = mujoco.MjData(own)
    mujoco.mj_kinematics(own, data)
    chance = np.random.default_rng(quarters + 1)
    turned = Pose(np.zeros(3), exp(np.array([0.0, 0.0, -quarters * np.pi / 2])))
    model = Xml.Element("mujoco", model=file.stem)
    Xml.SubElement(model, "compiler", angle="radian", meshdir="assets")
    asset, world = Xml.SubElement(model, "asset"), Xml.SubElement(model, "worldbody")
    Xml.SubElement(asset, "material", name="paint", rgba=COLOUR)
    root = int(own.body_parentid[own.jnt_bodyid[0]])
    base = turned @ _place(data, root)
    bodies = {root: (_body(world, "base", base), base)}
    for joint, body in enumerate(map(int, own.jnt_bodyid)):
        parent, there = bodies[int(own.body_parentid[body])]
        link = turned @ _place(data, body)
        here = link @ Pose(chance.uniform(-0.1, 0.1, 3), exp(chance.uniform(-1.0, 1.0, 3)))
        element, inside = _body(parent, f"link{joint}", there.inverse() @ here), here.inverse() @ link
        kind = "slide" if own.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE else "hinge"
        axis = _text(inside.rotation @ own.jnt_axis[joint])
        Xml.SubElement(element, "joint", type=kind, axis=axis, pos=_text(inside.position))
        bodies[body] = element, here
    (file.parent / "assets").mkdir(parents=True, exist_ok=True)
    for number, (element, _) in enumerate(bodies.values()):
        _add_shapes(asset, element, file, number)
    file.write_bytes(Xml.tostring(model))


def _add_shapes(asset: Xml.Element, body: Xml.Element, file: Path, number: int) -> None:
    name = f"{file.stem}_{number}"
    tetrahedron(file.parent / "assets" / f"{name}.obj")
    Xml.SubElement(asset, "mesh", file=f"{name}.obj", scale=_text(np.full(3, SCALE)))
    seen = {"type": "mesh", "mesh": name, "material": "paint", "contype": "0", "conaffinity": "0", "group": "2"}
    Xml.SubElement(body, "geom", seen, pos=f"0 {0.01 * number} 0", euler="0.3 0 0.1")
    Xml.SubElement(body, "geom", size="0.05", group="3")


def _place(data: mujoco.MjData, body: int) -> Pose:
    return Pose(data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy())


def _body(parent: Xml.Element, name: str, pose: Pose) -> Xml.Element:
    quaternion = _text(quaternion_from_rotation(pose.rotation))
    return Xml.SubElement(parent, "body", name=name, pos=_text(pose.position), quat=quaternion)


def _text(numbers: Array) -> str:
    return " ".join(repr(float(number)) for number in numbers)
