"""The result of a task: what every report, table and JSON document says."""

from __future__ import annotations

from typing import Literal

import msgspec

from skillc_runtime.recording.failure import Rejection
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.world.state.labelled import LabelledValue


class StepResult(msgspec.Struct, frozen=True, kw_only=True):
    """A step that was planned or asked for, with its arguments by parameter name and the line it comes from.

    `implementation` is empty where the step never started; `alternatives` counts the skill's other implementations,
    of which `rejected` are those that did not fit.
    """

    skill: str
    implementation: str
    arguments: dict[str, LabelledValue]
    source: str
    status: str
    alternatives: int = 0
    rejected: tuple[Rejection, ...] = ()


class ChoiceResult(msgspec.Struct, frozen=True, kw_only=True):
    """Which of several implementations a skill got somewhere in a task, and which were not taken."""

    skill: str
    implementation: str
    rejected: tuple[Rejection, ...] = ()


class WipingResult(msgspec.Struct, frozen=True, kw_only=True):
    """How well a surface was wiped, measured by the simulator and not by the controller.

    `lane_dwell_s` is the time lost at each corner of the lanes, None where there is none; an overlay hides what the
    tool did there, so that it is then the dwell of the path that the tool was asked for.
    """

    surface: str
    coverage: float
    force_command_n: float
    force_mean_n: float
    force_rmse_n: float
    contact_lost: float
    vibration_mm_s: float
    tilt_rms_deg: float
    first_impact_n: float
    tracking_rms_mm: float
    lane_dwell_s: float | None = None
    lane_dwell_of: Literal["tool", "path"] = "tool"


class TaskResult(msgspec.Struct, frozen=True, kw_only=True):
    """How a task went. `plan_optimal` is None where nothing was planned; `failure` says why a task did not succeed.

    `plan_quality` says in words how good the plan is known to be, and for what problem.
    `facts` are those that a success rests on; it is `verified` when none of them is only assumed.
    `plan` is the last one; `replanned` says why each one before it was given up. `wipings` has one entry for each
    surface that was wiped, `wiping` is the first of them.
    """

    task: str
    status: Literal["success", "failure", "halted", "refused"]
    verified: bool | None = None
    facts: tuple[KnownFact, ...] = ()
    plan: tuple[StepResult, ...] = ()
    choices: tuple[ChoiceResult, ...] = ()
    plan_optimal: bool | None = None
    plan_quality: str = ""
    planner: str = ""
    robot: str = ""
    controller: str = ""
    sim_time_s: float = 0.0
    wall_time_s: float = 0.0
    real_time_factor: float = 0.0
    seed: int = 0
    variation: str = ""
    wiping: WipingResult | None = None
    wipings: tuple[WipingResult, ...] = ()
    replanned: tuple[str, ...] = ()
    failure: str | None = None
