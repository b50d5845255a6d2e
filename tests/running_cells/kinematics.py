"""Postures of cells with the poses that MuJoCo computes for their bodies: the page of the studio must find the same.

`python tests/accept.py` writes them again for the tests of the page.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import mujoco
import numpy as np

from running_cells.test_reality import BOARD, SORTING, make_settings, reality
from skillc.cells.geometry_reader import read_geometry
from skillc.cells.opening import open_cell
from skillc.contract.geometry import CellModel
from skillc.contract.sample import ArmSample, PoseNumbers, Sample
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.motion.pose import Pose

FILE = Path(__file__).parents[2] / "studio" / "test" / "scene3d" / "kinematics.json"
CASES = {"whiteboard": BOARD, "sorting": SORTING}
SAMPLES = 3


class KinematicsCase(msgspec.Struct, frozen=True):
    """A cell in some postures, with the pose of each body in each of them."""

    name: str
    model: CellModel
    samples: tuple[Sample, ...]
    poses: tuple[tuple[PoseNumbers, ...], ...]


def make_cases() -> tuple[KinematicsCase, ...]:
    """Return the cases, always the same."""
    return tuple(_make_case(name) for name in CASES)


def format_cases() -> str:
    """Return the cases as the text of the file."""
    return msgspec.json.encode(make_cases()).decode() + "\n"


def _make_case(name: str) -> KinematicsCase:
    with (
        tempfile.TemporaryDirectory() as folder,
        open_cell(make_settings(Path(folder), CASES[name], "kinematic"), SilentReporter()) as host,
    ):
        model, geometry = reality(host).drawing.model, read_geometry(reality(host))
    rng, data = np.random.default_rng(7), mujoco.MjData(model)
    postures = [_place(model, data, geometry, rng) for _ in range(SAMPLES)]
    return KinematicsCase(name, geometry, *(tuple(each) for each in zip(*postures, strict=True)))


def _place(model: Any, data: Any, geometry: CellModel, rng: np.random.Generator) -> tuple[Sample, Any]:
    """Place everything that can move by chance; return a sample of that, and the poses of all bodies."""
    data.qpos[:] = rng.uniform(-1.0, 1.0, model.nq)
    data.mocap_pos[:], data.mocap_quat[:] = rng.uniform(-1.0, 1.0, (model.nmocap, 3)), rng.uniform(0.1, 1.0, 4)
    mujoco.mj_normalizeQuat(model, data.qpos)
    data.mocap_quat /= np.linalg.norm(data.mocap_quat, axis=1, keepdims=True)
    mujoco.mj_kinematics(model, data)
    poses = tuple(Pose.of(data.xpos[each], data.xquat[each]).numbers for each in range(model.nbody))
    return _sample(model, data, geometry), poses


def _sample(model: Any, data: Any, geometry: CellModel) -> Sample:
    own = {name for arm in geometry.arms.values() for name in arm.joints}
    placed = {iri: pose.numbers for iri, pose in _find_poses(data, geometry)}
    angles = dict(_find_angles(model, data))
    arms = {
        iri: ArmSample(tuple(angles[each] for each in arm.joints), (), placed[iri], placed[iri])
        for iri, arm in geometry.arms.items()
    }
    kinds = {iri: each.kind for iri, each in geometry.individuals.items()}
    return Sample(
        cell="cell",
        time_s=0.0,
        arms=arms,
        things={iri: pose for iri, pose in placed.items() if kinds[iri] in ("base", "tool", "body")},
        joints={name: angle for name, angle in angles.items() if name not in own},
    )


def _find_poses(data: Any, geometry: CellModel) -> Iterator[tuple[str, Pose]]:
    for iri, each in geometry.individuals.items():
        x, y, z, *quaternion = each.frame
        body = Pose.of(data.xpos[each.body], data.xquat[each.body])
        yield iri, body @ Pose.of((x, y, z), tuple(quaternion))


def _find_angles(model: Any, data: Any) -> Iterator[tuple[str, float]]:
    for number in range(model.njnt):
        joint = model.joint(number)
        if len(joint.qpos0) == 1:
            yield joint.name, float(data.qpos[int(joint.qposadr[0])])
