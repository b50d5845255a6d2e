"""Proves that a model that was written is the arm of the file: both are compared in random postures."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree import ElementTree

import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.mechanism import Kinetics, Mechanism, PinocchioMechanism
from skillc.services.robot_import.reading import Reading
from skillc.services.robot_import.robot_model import RobotModel
from skillc_runtime.motion.pose import Array

POSTURES, SEED = 200, 1
TOLERANCE = 1e-8
"""Largest difference of models that agree: of poses and Jacobians in m and rad, else relative to the largest entry."""


@dataclass(frozen=True, slots=True)
class Differences:
    """The largest difference over all postures: of poses and Jacobians absolute, of masses and weights relative."""

    pose: float
    jacobian: float
    mass_matrix: float
    weight: float

    @property
    def largest(self) -> float:
        """The largest of all."""
        return max(self.pose, self.jacobian, self.mass_matrix, self.weight)

    @property
    def agree(self) -> bool:
        """Whether the models are the same but for rounding."""
        return self.largest <= TOLERANCE

    @property
    def worst(self) -> str:
        """What differs most."""
        named = {
            "poses": self.pose,
            "Jacobians": self.jacobian,
            "mass matrices": self.mass_matrix,
            "weights": self.weight,
        }
        return max(named, key=lambda name: named[name])


def prove_same(reading: Reading, mjcf: Path) -> Differences:
    """Return how little an MJCF file, read by pinocchio, differs from what MuJoCo read.

    RequestError if it differs more than by rounding.
    """
    import pinocchio

    root = ElementTree.fromstring(mjcf.read_bytes())
    for number, element in enumerate((*root.iter("body"), *root.iter("joint"))):
        element.set("name", f"{element.tag}{number}")  # Some names are pinocchio's own: it ends the process.
    for motors in root.findall("actuator"):
        root.remove(motors)
    with TemporaryDirectory() as folder:
        renamed = Path(folder, mjcf.name)
        ElementTree.ElementTree(root).write(renamed, "utf-8")
        written = pinocchio.buildModelFromMJCF(str(renamed))
    found = compare(reading.model, reading.source, PinocchioMechanism(written, reading.model.flange))
    if not found.agree:
        raise RequestError(
            f"the model that was made differs from the file: {found.worst} by {found.largest:.1e}, and {TOLERANCE:g} "
            "is allowed; nothing was written"
        )
    return found


def compare(model: RobotModel, one: Mechanism, other: Mechanism) -> Differences:
    """Return how much two mechanisms with the joints of a model differ in `POSTURES` postures within its limits."""
    low = np.array([link.joint.low for link in model.links])
    high = np.array([link.joint.high for link in model.links])
    postures = np.random.default_rng(SEED).uniform(low, high, (POSTURES, low.size))
    return Differences(*np.max([_difference(one.at(q), other.at(q)) for q in postures], axis=0).tolist())


def _difference(one: Kinetics, other: Kinetics) -> tuple[float, float, float, float]:
    return (
        float(np.abs(one.poses - other.poses).max()),
        float(np.abs(one.jacobian - other.jacobian).max()),
        _relative(one.mass_matrix, other.mass_matrix),
        _relative(one.weight, other.weight),
    )


def _relative(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / max(np.abs(one).max(), 1e-9))
