"""What pictures show besides the model stands on the floor and holds up surfaces, wherever these are."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from skillc_runtime.film.props import LEG_M, Prop, make_props
from skillc_runtime.motion.pose import Pose, exp

SIZE = np.array([0.4, 0.3, 0.03])
TILT = exp(np.array([0.05, -0.04, 0.0]))
STANDING = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def corners(prop: Prop) -> np.ndarray:
    return np.array([prop.pose.apply(np.array(side) * prop.size / 2) for side in product((-1, 1), (-1, 1), (-1, 1))])


@pytest.mark.parametrize("tilt", [np.eye(3), TILT], ids=["even", "tilted"])
def test_a_table_has_four_legs_under_it(tilt: np.ndarray) -> None:
    table = Pose(np.array([1.0, 2.0, 0.8]), tilt)
    legs = make_props(table, SIZE)
    assert len(legs) == 4
    for leg in legs:
        seen = np.array([table.inverse().apply(corner) for corner in corners(leg)])
        assert corners(leg)[:, 2].min() == pytest.approx(0.0)
        assert seen[:, 2].max() == pytest.approx(-SIZE[2], abs=LEG_M * 0.1), "it ends under the table"
        assert (np.abs(seen[seen[:, 2] > -0.1][:, :2]) <= SIZE[:2] / 2 + LEG_M * 0.1).all()


@pytest.mark.parametrize("tilt", [np.eye(3), TILT], ids=["even", "tilted"])
def test_a_board_has_a_wall_behind_it(tilt: np.ndarray) -> None:
    board = Pose(np.array([1.0, 2.0, 1.2]), STANDING @ tilt)
    (wall,) = make_props(board, SIZE)
    sides = np.array(list(product((-1, 1), (-1, 1), (-2, 0)))) / 2
    seen = np.array([wall.pose.inverse().apply(board.apply(side * SIZE)) for side in sides])
    assert np.linalg.det(wall.pose.rotation) == pytest.approx(1.0)
    assert corners(wall)[:, 2].min() == pytest.approx(0.0)
    assert (seen[:, 2] > wall.size[2] / 2).all(), "the board is before the wall"
    assert (np.abs(seen[:, :2]) < wall.size[:2] / 2).all(), "the wall reaches beyond the board"


def test_a_table_on_the_floor_needs_no_legs() -> None:
    assert make_props(Pose(np.array([0.0, 0.0, 0.02]), np.eye(3)), SIZE) == ()
