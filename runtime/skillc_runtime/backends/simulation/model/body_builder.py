"""Adds bodies to a model under construction: fixed ones to the world or a base, movable ones with a free joint."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.model.contact_bits import CARRIES, MOVABLE, WORKS
from skillc_runtime.backends.simulation.model.hold import Hold, add_mount
from skillc_runtime.backends.simulation.names import part_name, solid_geom_name
from skillc_runtime.collision.solid_geoms import add_solid
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.drawers import Slide
from skillc_runtime.world.space.shape.solids import centre_of

TORSION_M, ROLLING_M = 0.005, 0.0002
"""Friction against spinning and against rolling: a ball on a table comes to rest."""

SOLREF, SOLIMP = (0.006, 1.0), (0.95, 0.99, 0.001, 0.5, 2.0)
"""Contact of movable bodies: as stiff as that of fingers, whose pads yield by less than 0.1 mm."""

SLIDE_DAMPING = 5.0
"""Damping of drawers in N s/m: one that is pushed hard comes to rest."""

STICKING = (0.004, 1.0), (0.99, 0.999, 0.001, 0.5, 2.0)
"""Friction of drawers: one that is pulled with less than its friction creeps by less than 0.1 mm/s."""

OWN_CONTACT = 1
"""Priority of movable bodies: in their contacts, their friction counts, whatever they touch."""


def add_fixed_body(spec: Any, parent: Any, name: str, body: RigidBody, place: Pose) -> None:
    """Add a fixed body, or a drawer, which slides, to a parent, in whose frame it has a pose."""
    added = parent.add_body(name=name, pos=place.position, quat=quaternion_from_rotation(place.rotation))
    for geom in _add_solids(spec, added, name, body):
        set_support(geom, body.friction)
    if body.slide is not None:
        _add_slide(added, name, body.slide)


def _add_slide(added: Any, name: str, slide: Slide) -> None:
    """Let a body slide along -y of its frame, from where it is."""
    joint = added.add_joint(name=part_name(name, "slide"), type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0.0, -1.0, 0.0])
    joint.ref, joint.range, joint.limited = slide.opening_m, [0.0, slide.travel_m], True
    joint.frictionloss, joint.damping[0] = slide.friction_n, SLIDE_DAMPING
    joint.solref_friction, joint.solimp_friction = STICKING


def add_movable_body(spec: Any, name: str, body: RigidBody, hold: Hold | None = None) -> None:
    """Add a body, free to move or a part of the hand that holds it, with its mass and its own friction."""
    frame = add_mount(spec, body.pose, hold)
    added = frame.parent.add_body(name=part_name(name, "block"))
    added.set_frame(frame)
    if hold is None:
        added.add_freejoint(name=part_name(name, "free"))
    for geom in _add_solids(spec, added, name, body):
        geom.contype, geom.conaffinity = MOVABLE
        geom.condim, geom.priority = 6, OWN_CONTACT
        geom.friction, geom.solref, geom.solimp = [body.friction, TORSION_M, ROLLING_M], SOLREF, SOLIMP
    if not np.allclose(body.centre, centre_of(body.solids)):
        _set_centre(added, body)


def set_support(geom: Any, friction: float) -> None:
    """Let tools and bodies touch the geom; their own softness applies (solmix 0), and the greater friction of both."""
    geom.contype, geom.conaffinity = CARRIES, WORKS
    geom.friction = [friction, 0.005, 0.0001]
    geom.solmix = 0.0


def _set_centre(added: Any, body: RigidBody) -> None:
    """Set a centre of mass other than that of the solids; the moments of inertia about it are those of the solids."""
    alone = mujoco.MjSpec()
    list(_add_solids(alone, alone.worldbody.add_body(name="alone"), "alone", body))
    model = alone.compile()
    added.explicitinertial, added.mass, added.ipos = True, body.mass_kg, body.centre
    added.inertia, added.iquat = model.body_inertia[1], model.body_iquat[1]


def _add_solids(spec: Any, parent: Any, name: str, body: RigidBody) -> Iterator[Any]:
    """Add the solids of a body with their shares of its mass, and yield their geoms."""
    volume = sum(each.volume for each in body.solids)
    for number, solid in enumerate(body.solids):
        geom = add_solid(spec, parent, solid_geom_name(name, number), solid)
        geom.rgba, geom.mass = list(body.colour), body.mass_kg * solid.volume / volume
        yield geom
