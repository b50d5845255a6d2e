"""The specification of cameras that estimate poses, read from the facts, and what follows from it and a seed."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.imperfections import Bias, Dropout, Imperfection, WhiteNoise
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.field_of_view import FieldOfView, read_field_of_view
from skillc_runtime.world.space.frames import moves_with, pose
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import CAMERA, MOBILE_ROBOT, SKILLC
from skillc_runtime.world.state.world_state import WorldState

LEAST_VISIBLE = 0.3
"""Which share of an object must be visible, unless the data sheet states it."""


class CameraErrors(msgspec.Struct, frozen=True):
    """The errors of a camera: m and rad for each axis, shares of the images for the others."""

    position_bias_m: float = 0.0
    angle_bias_rad: float = 0.0
    position_noise_m: float = 0.0
    angle_noise_rad: float = 0.0
    dropout: float = 0.0
    miss: float = 0.0
    false_alarm: float = 0.0


class CameraSpec(msgspec.Struct, frozen=True):
    """A camera that does not move: its pose in the world, what it sees, and how it errs.

    It takes an image each `period_s`, whose estimate arrives `delay_s` later, if the share `least_visible` of an object
    is visible.
    """

    individual: str
    pose: Pose
    view: FieldOfView
    period_s: float
    delay_s: float
    least_visible: float
    errors: CameraErrors


def read_cameras(state: WorldState) -> tuple[CameraSpec, ...]:
    """Read all cameras in order of IRI; SheetError or FrameError if a fact is missing, or if a robot moves one."""
    if CAMERA not in state.vocabulary.classes:
        return ()
    return tuple(_camera(state, each) for each in sorted(state.instances(CAMERA)))


def _camera(state: WorldState, camera: str) -> CameraSpec:
    _refuse_moving(state, camera)
    sheet = sheet_of(state, camera)

    def number(name: str, default: float = 0.0) -> float:
        return number_of(state, sheet.individual, SKILLC + name, default=default)

    return CameraSpec(
        individual=camera,
        pose=pose(state, camera),
        view=read_field_of_view(sheet),
        period_s=number("sensingPeriod"),
        delay_s=number("sensingDelay"),
        least_visible=number("leastVisible", LEAST_VISIBLE),
        errors=CameraErrors(
            number("positionBias"),
            number("angleBias"),
            number("positionNoise"),
            number("angleNoise"),
            number("dropoutRate"),
            number("missRate"),
            number("falseAlarmRate"),
        ),
    )


def _refuse_moving(state: WorldState, camera: str) -> None:
    short = state.vocabulary.short
    for carrier in sorted(state.instances(MOBILE_ROBOT)):
        if moves_with(state, camera, carrier):
            raise SheetError(
                f"{short(camera)} moves with {short(carrier)}; only cameras that stand still can be simulated: "
                "place it in the frame of something that does not move"
            )


def make_imperfections(errors: CameraErrors, individual: str, seed: int) -> tuple[Imperfection, ...]:
    """Return the errors of an estimate (6,): position in m, rotation vector in rad, in the frame of the camera."""
    rng = rng_for(individual, seed)
    bias = np.repeat([errors.position_bias_m, errors.angle_bias_rad], 3) * rng.uniform(-1.0, 1.0, 6)
    deviation = np.repeat([errors.position_noise_m, errors.angle_noise_rad], 3)
    return (Dropout(errors.dropout, rng), Dropout(errors.miss, rng), Bias(bias), WhiteNoise(deviation, rng))
