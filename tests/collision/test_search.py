"""The search for a path among discs in the plane: it is free, short, the same for the same seed, and it ends."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from skillc_runtime.collision.rrt_connect import sample_path, shorten
from skillc_runtime.motion.pose import Array

BOUNDS = np.array([[-3.0, 3.0], [-3.0, 3.0]])
START, GOAL = np.array([-2.0, 0.0]), np.array([2.0, 0.0])


def length(points: list[Array]) -> float:
    return float(sum(np.linalg.norm(after - before) for before, after in pairwise(points)))


class Discs:
    """Discs (n, 3): x, y, radius; the share of a way that is free, and how often it was asked for."""

    def __init__(self, *discs: tuple[float, float, float]) -> None:
        self.discs, self.asked = np.array(discs), 0

    def __call__(self, one: Array, other: Array) -> float:
        self.asked += 1
        shares = np.linspace(0.0, 1.0, 400)
        points = one + shares[:, None] * (other - one)
        away = np.linalg.norm(points[:, None] - self.discs[:, :2], axis=2) - self.discs[:, 2]
        hit = np.flatnonzero(away.min(axis=1) < 0.0)
        share = 1.0 if hit.size == 0 else float(shares[max(hit[0] - 1, 0)])
        return share if share >= 0.5 else 0.0


@pytest.mark.parametrize("seed", range(5))
def test_a_path_around_a_disc_is_nearly_the_shortest_one(seed: int) -> None:
    reach = Discs((0.0, 0.0, 1.0))
    found = sample_path(reach, START, GOAL, BOUNDS, 500, seed)
    assert found is not None and found[0] is START and found[-1] is GOAL
    assert all(reach(one, other) == 1.0 for one, other in pairwise(found))
    shortest = 2 * np.sqrt(3.0) + np.pi / 3
    assert shortest <= length(found) < 1.3 * shortest
    again = sample_path(reach, START, GOAL, BOUNDS, 500, seed)
    assert again is not None and np.array_equal(found, again)


def test_without_a_way_it_ends_after_so_many_points() -> None:
    wall = Discs(*((0.0, y, 0.4) for y in np.linspace(-3.0, 3.0, 13)))
    assert sample_path(wall, START, GOAL, BOUNDS, 50, 0) is None
    assert wall.asked < 2000


def test_what_is_not_needed_of_a_path_is_left_out() -> None:
    around = [START, np.array([-1.0, 2.5]), np.array([1.0, 2.5]), GOAL]
    assert [point.tolist() for point in shorten(around, Discs((9.0, 9.0, 0.1)))] == [START.tolist(), GOAL.tolist()]
    cut = shorten(around, Discs((0.0, 0.0, 1.0)))
    assert length(cut) < length(around)
