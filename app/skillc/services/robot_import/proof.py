"""Proves that a written model is the arm of the file that was read, with the library that did not read the file."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.comparison import TOLERANCE, Differences, compare
from skillc.services.robot_import.mechanism import MujocoMechanism, PinocchioMechanism
from skillc.services.robot_import.reading import Reading
from skillc_runtime.motion.pose import Pose

ORIGIN = Pose(np.zeros(3), np.eye(3))


def prove_same(reading: Reading, mjcf: Path) -> Differences:
    """Return how little the MJCF file differs from what was read. RequestError if it differs more than by rounding."""
    try:
        model = mujoco.MjModel.from_xml_path(str(mjcf))
    except ValueError as error:
        raise RequestError(_invalid(str(error))) from error
    if reading.other == "MuJoCo":
        written = MujocoMechanism(model, range(model.njnt), reading.model.flange, ORIGIN)
        found = compare(reading.model, reading.source, written)
    else:
        import pinocchio

        read = pinocchio.buildModelFromMJCF(str(mjcf))
        found = compare(reading.model, reading.source, PinocchioMechanism(read, reading.model.flange))
    if not found.agree:
        raise RequestError(
            f"the model that was made differs from the file: {found.worst} by {found.largest:.1e}, and {TOLERANCE:g} "
            "is allowed; nothing was written"
        )
    return found


def _invalid(message: str) -> str:
    """Return a sentence about a model that MuJoCo refuses, because of numbers of the file."""
    first, _, rest = message.strip().partition("\n")
    where = next((line for line in rest.splitlines() if "name" in line), "")
    hint = ""
    if "inertia" in first:
        hint = (
            "; no real body has such moments of inertia: correct the `<inertia>` of this "
            "link in the file, or use --correct-inertia"
        )
    return f"MuJoCo refuses the model: {first.removeprefix('Error: ')} {where}".strip() + hint
