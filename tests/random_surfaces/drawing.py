"""Draws surfaces that an arm shall wipe, wherever they are: many are too large, too far, or turned away from it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, radians, sin
from random import Random
from typing import Final, get_args

import numpy as np

from random_cells.drawing import ArmName, Point
from random_cells.writing import ARMS, HANDS
from skillc_runtime.motion.pose import Array, exp

ARM_NAMES: Final[tuple[ArmName, ...]] = get_args(ArmName)

THICK_M: Final = 0.04

TOOL_M: Final = (0.10, 0.05, 0.03)
"""The size of the eraser in m; there is a model of this one alone."""

GRASP_M: Final = 0.03
"""How far above the middle of the eraser it is grasped."""

SHOULDER_M: Final = (0.0, 0.0, 0.9)

FAR_M, FAR_SHARE = 0.85, 0.15
"""How far from the shoulder the corners of a surface are at most, but of a share of them."""

TAKEN: Final = (
    ((-0.22, -0.22, 0.0), (0.22, 0.22, 1.4)),
    ((0.15, -0.75, 0.0), (0.65, -0.25, 1.1)),
)
"""The least and the greatest corner in m of where no surface is: around the arm, and around the eraser's table."""

SCENE = """@prefix lab:    <http://example.org/lab#> .
@prefix wiping: <https://w3id.org/skillc/wiping#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .

lab:Cell a skillc:Workstation ; skillc:on lab:Scene-1 ;
    skiros:contain lab:Pedestal, lab:SideTable, lab:Eraser-1, lab:Desk-1{boxes} .

lab:Pedestal a skillc:Furniture ; skillc:on lab:Cell ;
    skiros:SizeX 0.30 ; skiros:SizeY 0.30 ; skiros:SizeZ 0.60 .

lab:SideTable a skillc:Furniture ; skillc:on lab:Cell ; skillc:atX 0.4 ; skillc:atY -0.5 ;
    skiros:SizeX 0.30 ; skiros:SizeY 0.30 ; skiros:SizeZ 0.70 .

lab:Robot-1 a skillc:FixedRobot ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-1 .

{arm}    skillc:on lab:Pedestal ; skillc:deviceState "Idle" .

lab:Hand-1 a {hand} ; skiros:FrameId "hand" ; skillc:deviceState "Idle" .

lab:Eraser-1 a wiping:Eraser ; skillc:hasSheet wiping:eraser-sheet ;
    skiros:SizeX {tool[0]} ; skiros:SizeY {tool[1]} ; skiros:SizeZ {tool[2]} ; skiros:Weight 0.12 ;
    skillc:graspWidth 0.025 ; skillc:graspForce 30.0 ;
    skiros:FrameId "eraser" ; skillc:on lab:SideTable ; skillc:atY 0.05 ;
    skiros:hasA lab:Eraser-1-grasp, lab:Eraser-1-approach .

lab:Eraser-1-grasp a skiros:GraspingPose ; skiros:BaseFrameId "eraser" ;
    skiros:PositionX 0.0 ; skiros:PositionY 0.0 ; skiros:PositionZ {grasp} ; skillc:roll 180 ; skillc:yaw {held} .

lab:Eraser-1-approach a skiros:ApproachPose ; skiros:BaseFrameId "eraser" ;
    skiros:PositionX 0.0 ; skiros:PositionY 0.0 ; skiros:PositionZ 0.15 ; skillc:roll 180 ; skillc:yaw {held} .

lab:Desk-1 a wiping:TableTop ;
    skiros:SizeX {size[0]} ; skiros:SizeY {size[1]} ; skiros:SizeZ {thick} ;
    skiros:FrameId "desk" ; skiros:BaseFrameId "map" ;
    skiros:PositionX {at[0]} ; skiros:PositionY {at[1]} ; skiros:PositionZ {at[2]} ;
    skillc:roll {turn[0]} ; skillc:pitch {turn[1]} ; skillc:yaw {turn[2]} ;
    wiping:isClean false ; wiping:normalForce {force} ; skillc:leastForce {least} ; wiping:cleanThreshold 0.99 ;
    skillc:friction 0.4 .
"""


BOX = """
lab:Box-{number} a skillc:Furniture ; skiros:FrameId "box{number}" ; skiros:BaseFrameId "map" ;
    skiros:SizeX {size[0]} ; skiros:SizeY {size[1]} ; skiros:SizeZ {size[2]} ;
    skiros:PositionX {at[0]} ; skiros:PositionY {at[1]} ; skiros:PositionZ {at[2]} .
"""


@dataclass(frozen=True, slots=True)
class Box:
    """A box that cannot be moved: its size (3,) and the position (3,) of the middle of its top in m in the world."""

    size: Point
    at: Point


@dataclass(frozen=True, slots=True)
class Surface:
    """A surface: its size (2,) in m, the middle (3,) of its face in m, roll, pitch and yaw in degrees, the force in N.

    `held_deg` is how the hand around the eraser is turned about the vertical, in degrees; `boxes` stand around.
    """

    arm: ArmName
    size: tuple[float, float]
    at: tuple[float, float, float]
    turn: tuple[float, float, float]
    force_n: float
    held_deg: int
    boxes: tuple[Box, ...] = ()

    @property
    def rotation(self) -> Array:
        """Its axes (3, 3) in the world: turned about x, then y, then z of the world."""
        roll, pitch, yaw = np.radians(self.turn)
        return np.asarray(exp(np.array([0, 0, yaw])) @ exp(np.array([0, pitch, 0])) @ exp(np.array([roll, 0, 0])))


def draw_surface(seed: int, arm: ArmName) -> Surface:
    """Draw the surface of a seed for an arm: lying, or standing with its face to the arm, each tilted, 0.2 to 0.8 m."""
    rng = Random(f"surfaces:{arm}:{seed}")
    may_be_far = rng.random() < FAR_SHARE
    while True:
        found = _draw(rng, arm)
        if _is_free(found) and (may_be_far or _greatest_distance(found) < FAR_M):
            return found


def draw_crowded_surface(seed: int) -> Surface:
    """Draw the surface of a seed, in reach of an arm, with boxes before and beside it that may be in the way."""
    rng = Random(f"crowded surfaces:{seed}")
    arm = rng.choice(ARM_NAMES)
    while True:
        found = _draw(rng, arm)
        if _is_free(found) and _greatest_distance(found) < FAR_M:
            boxes = [_draw_box(rng, found) for _ in range(rng.randint(1, 3))]
            return replace(found, boxes=tuple(boxes))


def _draw_box(rng: Random, surface: Surface) -> Box:
    """Draw a box near a surface, which neither lies in that nor where no surface may be."""
    while True:
        size = (rng.uniform(0.04, 0.2), rng.uniform(0.04, 0.2), rng.uniform(0.04, 0.4))
        aside = [rng.uniform(-each / 2 - 0.2, each / 2 + 0.2) for each in surface.size]
        x, y, z = surface.rotation @ np.array([*aside, rng.uniform(-0.2, 0.4)]) + surface.at
        box = Box((round(size[0], 3), round(size[1], 3), round(size[2], 3)), (round(x, 3), round(y, 3), round(z, 3)))
        low = np.array([x - size[0] / 2, y - size[1] / 2, z - size[2]]) - 0.01
        high = np.array([x + size[0] / 2, y + size[1] / 2, z]) + 0.01
        taken = any((low < most).all() and (high > least).all() for least, most in TAKEN)
        if low[2] > 0.0 and not taken and not _meets(surface, low, high):
            return box


def _meets(surface: Surface, low: Array, high: Array) -> bool:
    """Whether the body of a surface, seen at points 1 cm apart, lies between two corners (3,) in m."""
    sides = [np.linspace(-each / 2, each / 2, round(each / 0.01) + 1) for each in (*surface.size, THICK_M)]
    x, y, z = np.meshgrid(*sides)
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel() - THICK_M / 2]) @ surface.rotation.T + surface.at
    return bool(((points > low) & (points < high)).all(axis=1).any())


def format_scene(surface: Surface) -> str:
    """Return the scene of a surface as Turtle, in which nothing is other than it says."""
    sensor = " ; skillc:forceNoise 0.5 ; skillc:torqueNoise 0.02"
    force = surface.force_n
    boxes = "".join(
        BOX.format(number=number, size=each.size, at=each.at) for number, each in enumerate(surface.boxes, 1)
    )
    text = SCENE.format(
        arm=ARMS[surface.arm].replace(sensor, ""),
        hand=HANDS[surface.arm],
        tool=TOOL_M,
        grasp=GRASP_M,
        held=surface.held_deg,
        size=surface.size,
        thick=THICK_M,
        at=surface.at,
        turn=surface.turn,
        force=force,
        least=force / 2,
        boxes="".join(f", lab:Box-{number + 1}" for number in range(len(surface.boxes))),
    )
    return text + boxes


def _draw(rng: Random, arm: ArmName) -> Surface:
    around, far, high = rng.uniform(-25, 90), rng.uniform(0.25, 0.75), rng.uniform(0.35, 1.15)
    if rng.random() < 0.5:
        turn = (rng.gauss(0, 15), rng.gauss(0, 15), rng.uniform(-180, 180))
    else:
        turn = (rng.gauss(0, 8), rng.gauss(-90, 15), around + rng.gauss(0, 12))
    x, y = far * cos(radians(around)), far * sin(radians(around))
    size = (round(rng.triangular(0.2, 0.8, 0.2), 2), round(rng.triangular(0.2, 0.8, 0.2), 2))
    return Surface(
        arm,
        size,
        (round(x, 3), round(y, 3), round(high, 3)),
        (round(turn[0], 1), round(turn[1], 1), round(turn[2], 1)),
        round(rng.uniform(5, 18), 1),
        rng.choice((0, 180)),
    )


def _greatest_distance(surface: Surface) -> float:
    """Return how far the corners of a surface are from the shoulder of an arm at most, in m."""
    half = np.array([*surface.size, 0.0]) / 2
    corners = np.array([(x, y, 0.0) for x in (-1, 1) for y in (-1, 1)]) * half
    return float(np.linalg.norm(corners @ surface.rotation.T + surface.at - SHOULDER_M, axis=1).max())


def _is_free(surface: Surface) -> bool:
    """Whether a surface, and a hand's breadth before it, are away from the arm, from the eraser and from the floor."""
    x, y, z = np.meshgrid(*(np.linspace(-each / 2, each / 2, 9) for each in surface.size), [-THICK_M, 0.0, 0.1])
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel()]) @ surface.rotation.T + surface.at
    inside = (np.all((points > low) & (points < high), axis=1).any() for low, high in TAKEN)
    return bool((points[:, 2] > 0.03).all()) and not any(inside)
