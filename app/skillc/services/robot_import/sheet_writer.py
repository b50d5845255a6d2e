"""Writes the data sheet of an arm: what its model states, what the user says, and what is still to be stated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillc.services.robot_import.mjcf_writer import ControlKind

COMMON = (
    *("armature", "linearStiffness", "rotationalStiffness", "dampingRatio", "commandTime"),
    *("forceLimit", "speedLimit", "accelerationLimit", "contactForceLimit", "collisionTorque", "toolSpeedLimit"),
    "clearance",
)
"""Properties of every arm that no model states."""
_ADMITTANCE = ("admittance", "rotationalAdmittance", "admittanceTime")
_SERVOS = ("servoStiffness", "servoDamping", "forceTorqueTime", *_ADMITTANCE)
GAINS: Mapping[ControlKind, tuple[str, ...]] = {
    "torque": ("dampingFloor", "rotationalDampingFloor", "nullspaceStiffness", "torqueRate"),
    "position": _SERVOS,
    "velocity": (*_SERVOS, "trackingRate", "trackingTime"),
}
"""Properties that the controller of each kind of arm needs besides."""
CLASSES: Mapping[ControlKind, str] = {
    "torque": "TorqueControlledArm",
    "position": "PositionControlledArm",
    "velocity": "VelocityControlledArm",
}
CONTROLLERS: Mapping[ControlKind, str] = {
    "torque": "impedance",
    "position": "forward_dynamics",
    "velocity": "forward_dynamics_velocity",
}
"""The controller of each kind of arm, which a scene names."""
TEXTS = ("jointSpeeds", "jointAccelerations", "jointJerks")
"""Properties that are texts: a number for each joint, separated by spaces."""
MODELLED = ("reach", "shoulderHeight", *TEXTS, "jerkLimit")
"""Further properties that a user may state; the first three come from the model otherwise."""


@dataclass(frozen=True, slots=True)
class SheetFacts:
    """What a data sheet says. `name` is that of the arm, `cls` its class; both get the prefix of the project.

    values: numbers and texts by property; unstated: the properties that are still to be stated; home: joint values.
    """

    name: str
    cls: str
    comment: str
    control: ControlKind
    source: str
    values: Mapping[str, str]
    unstated: Sequence[str]
    home: str | None


def settable(control: ControlKind) -> tuple[str, ...]:
    """Return the properties that a user may state for an arm of a kind."""
    return (*MODELLED, *COMMON, *GAINS[control])


def write_sheet(facts: SheetFacts, prefix: str, namespace: str) -> str:
    """Return the Turtle of a data sheet, in the order in which a person would write it."""
    return "\n".join((*_head(facts, prefix, namespace), *_sheet(facts, prefix), *_posture(facts, prefix), ""))


def _head(facts: SheetFacts, prefix: str, namespace: str) -> Iterator[str]:
    width = max(len(prefix), len("skillc")) + 1
    yield f"# {facts.comment}"
    for name, iri in (
        (prefix, namespace),
        ("skillc", "https://w3id.org/skillc/core#"),
        ("owl", "http://www.w3.org/2002/07/owl#"),
        ("rdfs", "http://www.w3.org/2000/01/rdf-schema#"),
    ):
        yield f"@prefix {(name + ':').ljust(width)} <{iri}> ."
    yield ""
    kind, comment = CLASSES[facts.control], _quoted(facts.comment)
    yield f"{prefix}:{facts.cls} a owl:Class ; rdfs:subClassOf skillc:{kind} ; rdfs:comment {comment} ."
    yield ""


def _sheet(facts: SheetFacts, prefix: str) -> Iterator[str]:
    lines = [f"skillc:source {_quoted(facts.source)}", f'skillc:model "robots/{facts.name}.xml"']
    for group in _groups(facts.control):
        stated = [f"skillc:{name} {_value(name, facts.values[name])}" for name in group if name in facts.values]
        lines += [" ; ".join(stated)] if stated else []
    if facts.home is not None:
        lines.append(f"skillc:hasPosture {prefix}:{facts.name}-home")
    yield f"{prefix}:{facts.name}-sheet a skillc:ArmSheet ;"
    if facts.unstated:
        yield "    # State these properties, with their source, and remove them here; `skillc check` lists them."
        yield f"    skillc:toBeStated {_quoted(' '.join(facts.unstated))} ;"
    yield from (f"    {line} ;" for line in lines[:-1])
    yield f"    {lines[-1]} ."


def _groups(control: ControlKind) -> tuple[tuple[str, ...], ...]:
    """Return the properties that stand in one line each."""
    return (
        ("reach", "shoulderHeight"),
        ("jointSpeeds",),
        ("jointAccelerations",),
        ("jointJerks",),
        ("armature", "servoStiffness", "servoDamping", "forceTorqueTime"),
        COMMON[1:5],
        tuple(name for name in GAINS[control] if not name.startswith(("servo", "forceTorque"))),
        (*COMMON[5:8], "jerkLimit"),
        COMMON[8:],
    )


def _posture(facts: SheetFacts, prefix: str) -> Iterator[str]:
    if facts.home is not None:
        name = f"{prefix}:{facts.name}-home"
        yield ""
        yield f'{name} a skillc:Posture ; skillc:postureName "home" ; skillc:jointValues "{facts.home}" .'


def _value(name: str, value: str) -> str:
    return _quoted(value) if name in TEXTS else value


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{" ".join(escaped.split())}"'
