"""The shape that is fitted to a mesh contains its vertices, and is of the kind that the vertices are of."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from robot_import.arms import six
from skillc.services.robot_import.reader import read_robot
from skillc.services.robot_import.shape_fitting import fit_shape
from skillc_runtime.motion.pose import exp

TURN = exp(np.array([0.3, -0.7, 1.1]))
DRAW = np.random.default_rng(4)


def _on_cylinder(radius: float, half: float) -> np.ndarray:
    angles, heights = np.meshgrid(np.linspace(0, 2 * np.pi, 24, endpoint=False), np.linspace(-half, half, 9))
    return np.column_stack([radius * np.cos(angles).ravel(), radius * np.sin(angles).ravel(), heights.ravel()])


def _on_capsule(radius: float, half: float) -> np.ndarray:
    points = DRAW.normal(size=(900, 3))
    points *= radius / np.linalg.norm(points, axis=1)[:, None]
    return points + np.outer(np.sign(points[:, 2]), [0, 0, half])


def _corners(half: tuple[float, float, float]) -> np.ndarray:
    return np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * np.array(half)


@pytest.mark.parametrize(
    ("vertices", "kind", "size"),
    [
        (_corners((0.05, 0.1, 0.2)), "box", {0.05, 0.1, 0.2}),
        (_on_cylinder(0.05, 0.2), "cylinder", {0.05, 0.2}),
        (_on_capsule(0.05, 0.2), "capsule", {0.05, 0.2}),
    ],
)
@pytest.mark.parametrize("turn", [np.eye(3), TURN], ids=["along", "askew"])
def test_simple_meshes_become_what_they_are(
    vertices: np.ndarray, kind: str, size: set[float], turn: np.ndarray
) -> None:
    shape = fit_shape(vertices @ turn.T + np.array([0.1, 0.2, 0.3]))
    assert shape.kind == kind
    assert sorted(shape.size) == pytest.approx(sorted(size), rel=0.05)
    assert shape.pose.position == pytest.approx([0.1, 0.2, 0.3], abs=0.01)


def test_a_mesh_that_is_found_is_used(tmp_path: Path) -> None:
    mesh = (
        "".join(f"v {x} {y} {z}\n" for x, y, z in 1000 * _corners((0.05, 0.06, 0.07))) + "f 1 2 3\nf 5 6 7\nf 4 8 1\n"
    )
    (tmp_path / "six_description/urdf").mkdir(parents=True)
    (tmp_path / "six_description/part.obj").write_text(mesh, "utf-8")
    named = '<mesh filename="package://six_description/part.obj" scale="0.001 0.001 0.001"/>'
    text = six().replace('<cylinder radius="0.05" length="0.12"/>', named, 1)
    file = tmp_path / "six_description/urdf/six.urdf"
    file.write_text(text, "utf-8")
    reading = read_robot(file)
    (shape,) = reading.model.links[0].shapes
    assert shape.kind == "box" and sorted(shape.size) == pytest.approx([0.05, 0.06, 0.07])
    assert reading.notes == ()
