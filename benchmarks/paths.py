"""Collision-free joint paths: random queries in random cells that are unlike the shipped ones, by processor time.

A cell has an arm on a pedestal, and shelves, walls with a gap, bins, pillars, beams and blocks on a table around it. A
query leads from one posture of the hand to another, both free: pointing down, ahead or aside. Some have no path: those
that a search with three times as many samples does not solve either do not count.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import mean, median, quantiles
from time import process_time

import numpy as np

from skillc_ontology import catalogue
from skillc_runtime.collision import path_planning
from skillc_runtime.collision.arm_assembly import ArmAssembly, Hand
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace, NoPath, is_path_free, plan_joint_path
from skillc_runtime.collision.scenery import PoseKey, Scenery, SolidObstacle, pose_key
from skillc_runtime.kinematics.chain import read_chain
from skillc_runtime.kinematics.inverse import find_postures
from skillc_runtime.motion.pose import Array, Pose, exp

FOLDER = Path(catalogue.__file__).parent
ARMS = {"panda": "panda_hand", "iiwa14": "robotiq_3f", "ur5e": "wsg50"}
HOMES = {
    "panda": (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785),
    "iiwa14": (0.0, 0.45, 0.0, -1.5, 0.0, 1.2, 0.0),
    "ur5e": (0.0, -1.4, 1.8, -1.97, -1.57, 0.0),
}
CLEARANCE_M = 0.02
QUERIES_A_CELL = 5

Draw = np.random.Generator


def block(name: str, middle: tuple[float, ...], half: tuple[float, ...], turn: float = 0.0) -> SolidObstacle:
    """Return a box in the base frame of the arm, turned about the vertical."""
    place: PoseKey = pose_key(Pose(np.array(middle), exp(np.array([0.0, 0.0, turn]))))
    return SolidObstacle(name, place, half)


def shelf(draw: Draw) -> Iterator[SolidObstacle]:
    """Yield two to three boards between two sides, before the arm."""
    x, y, wide, deep = draw.uniform(0.55, 0.7), draw.uniform(-0.35, 0.35), draw.uniform(0.25, 0.4), 0.14
    for height in np.cumsum(draw.uniform(0.26, 0.36, draw.integers(2, 4))) - 0.2:
        yield block("board", (x, y, height), (deep, wide, 0.01))
    for side in (-1, 1):
        yield block("side", (x, y + side * wide, 0.35), (deep, 0.01, 0.45))


def gap(draw: Draw) -> Iterator[SolidObstacle]:
    """Yield a wall with a gap beside the arm."""
    y, x = draw.choice([-1, 1]) * draw.uniform(0.25, 0.4), draw.uniform(0.2, 0.5)
    yield block("wall", (x - 0.5, y, 0.3), (0.3, 0.01, 0.3))
    yield block("wall", (x + 0.5, y, 0.3), (0.3, 0.01, 0.3))


def bins(draw: Draw) -> Iterator[SolidObstacle]:
    """Yield two open boxes on the table."""
    for y in (draw.uniform(-0.5, -0.2), draw.uniform(0.2, 0.5)):
        x, wide, high = draw.uniform(0.4, 0.6), draw.uniform(0.1, 0.16), draw.uniform(0.04, 0.12)
        for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            half = (0.006, wide, high) if a else (wide, 0.006, high)
            yield block("bin", (x + a * wide, y + b * wide, high), half)


def pillars(draw: Draw) -> Iterator[SolidObstacle]:
    """Yield upright boxes around the arm."""
    for _ in range(draw.integers(2, 5)):
        angle, far, high = draw.uniform(-2.0, 2.0), draw.uniform(0.4, 0.7), draw.uniform(0.15, 0.5)
        x, y = far * np.cos(angle), far * np.sin(angle)
        yield block("pillar", (x, y, high), (*draw.uniform(0.02, 0.07, 2), high), draw.uniform(0, 3))


def beams(draw: Draw) -> Iterator[SolidObstacle]:
    """Yield a beam over the table, and blocks that lie on it."""
    yield block("beam", (draw.uniform(0.3, 0.6), 0.0, draw.uniform(0.55, 0.9)), (0.03, 0.7, 0.03))
    for _ in range(draw.integers(3, 9)):
        half = draw.uniform(0.02, 0.06, 3)
        x, y = draw.uniform(0.3, 0.75), draw.uniform(-0.6, 0.6)
        yield block("block", (x, y, half[2]), tuple(half.tolist()), draw.uniform(0, 3))


KINDS = (shelf, gap, bins, pillars, beams)


def draw_cell(seed: int) -> tuple[str, Scenery]:
    """Return the name of an arm and what is around it: two kinds of things, on a table."""
    draw = np.random.default_rng(seed)
    arm = tuple(ARMS)[seed % len(ARMS)]
    one, other = draw.choice(len(KINDS), 2, replace=False)
    table = block("table", (0.75, 0.0, -0.03), (0.6, 0.8, 0.02))
    found = (table, *KINDS[one](draw), *KINDS[other](draw))
    return arm, Scenery(PoseKey((0.0, 0.0, -0.7), (1.0, 0.0, 0.0, 0.0)), found, ())


class Cell:
    """A drawn cell with the arm that can move in it, and how postures in it are drawn."""

    def __init__(self, seed: int) -> None:
        self.arm, scenery = draw_cell(seed)
        model, hand = str(FOLDER / "robots" / f"{self.arm}.xml"), str(FOLDER / "grippers" / f"{ARMS[self.arm]}.xml")
        assembly = ArmAssembly(self.arm, model, Hand("hand", hand, 0.05, ()), CLEARANCE_M)
        self.shape, self.home = build_collision_model(assembly, scenery), np.array(HOMES[self.arm])
        self.draw = np.random.default_rng(10_000 + seed)
        self.range: Array = self.shape.compiled.jnt_range[: self.shape.joints].copy()
        self.chain = read_chain(self.shape.compiled, "hand/tcp")

    def checker(self) -> CollisionChecker:
        """Return a new checker of collisions."""
        return CollisionChecker(self.shape, self.home)

    def posture(self) -> Array:
        """Return a posture (nv,) in rad that is free and keeps its clearance."""
        contacts = self.checker()
        while True:
            angle, far = self.draw.uniform(-1.6, 1.6), self.draw.uniform(0.35, 0.75)
            place = np.array([far * np.cos(angle), far * np.sin(angle), self.draw.uniform(0.05, 0.7)])
            lean = self.draw.choice([0.0, np.pi / 2, 0.6])
            ahead = exp(np.array([0.0, 0.0, angle + self.draw.uniform(-0.5, 0.5)]))
            turn = ahead @ exp(np.array([0.0, -lean, 0.0])) @ np.diag([1.0, -1.0, -1.0])
            found = find_postures(self.chain, Pose(place, turn), self.range, self.home)
            free = [q for q in found if contacts.find_collision(q) is None]
            if free:
                return np.asarray(free[int(self.draw.integers(min(3, len(free))))])


def is_solvable(contacts: CollisionChecker, start: Array, goal: Array, space: JointSpace) -> bool:
    """Whether a search with three times as many samples finds a path."""
    before = path_planning.SEARCHES
    path_planning.SEARCHES = tuple((around, 3 * rounds) for around, rounds in before)
    try:
        plan_joint_path(contacts, start, [goal], space)
    except NoPath:
        return False
    finally:
        path_planning.SEARCHES = before
    return True


def measure(queries: int) -> str:
    """Return the figures of as many queries."""
    times, lengths, straight, looks = list[float](), list[float](), 0, list[int]()
    failed: dict[str, list[str]] = {"missed": [], "impossible": []}
    for seed in range(-(-queries // QUERIES_A_CELL)):
        cell = Cell(seed)
        space = JointSpace(cell.range, (cell.home,))
        for number in range(QUERIES_A_CELL):
            start, goal = cell.posture(), cell.posture()
            contacts = cell.checker()
            began = process_time()
            try:
                way = plan_joint_path(contacts, start, [goal], space)
            except NoPath as why:
                times.append(process_time() - began)
                kind = "missed" if is_solvable(contacts, start, goal, space) else "impossible"
                failed[kind].append(f"{kind}: {seed}/{number} {cell.arm}: {why}")
                continue
            times.append(process_time() - began)
            looks.append(contacts.checks)
            straight += len(way) == 1
            lengths.append(float(sum(np.abs(b - a).sum() for a, b in zip((start, *way), way, strict=False))))
            assert is_path_free(contacts, (start, *way))
    found, possible = len(looks), len(times) - len(failed["impossible"])
    shares = quantiles(times, n=20)
    print(*failed["missed"], *failed["impossible"], sep="\n", file=sys.stderr)
    return (
        f"{found} of {possible} paths found ({100 * found / possible:.1f} %), {straight} straight; "
        f"{1e3 * median(times):.1f} ms in the median, {1e3 * mean(times):.1f} in the mean, {1e3 * shares[-1]:.0f} at "
        f"95 %; {median(looks):.0f} looks in the median; length {mean(lengths):.2f} rad in the mean"
    )


if __name__ == "__main__":
    print(measure(int(sys.argv[1]) if len(sys.argv) > 1 else 1000))
