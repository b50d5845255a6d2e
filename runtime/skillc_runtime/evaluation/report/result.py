"""The result of a task, for all reports, tables and JSON documents."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.history.history import LoopRound
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledValue

RESULT, REPORT = "result.json", "report.html"
"""The files in the folder of a run that have its result and its report."""


class StepResult(msgspec.Struct, frozen=True, kw_only=True):
    """One call that a plan or a given body made, or was to make, with its arguments by parameter name and its line.

    `number` is that by which `skillc why` knows it; `rounds` are those of the loops around it, the outermost first.
    `implementation` is empty if it never started, and `fixed` if the call names it; `alternatives` is the number of
    others that it could have been, of which `rejected` could not be used. Times in s; `failure` is why it did not
    succeed.
    """

    skill: str
    implementation: str
    arguments: dict[str, LabelledValue]
    source: str
    status: str
    number: str = ""
    rounds: tuple[LoopRound, ...] = ()
    start_s: float | None = None
    end_s: float | None = None
    failure: str | None = None
    fixed: bool = False
    alternatives: int = 0
    rejected: tuple[Rejection, ...] = ()


class ChoiceResult(msgspec.Struct, frozen=True, kw_only=True):
    """The implementation that was chosen among several for a skill, and those that were rejected."""

    skill: str
    implementation: str
    rejected: tuple[Rejection, ...] = ()


class WipingResult(msgspec.Struct, frozen=True, kw_only=True):
    """The quality of one wiping of a surface, measured by the simulator and not by the controller.

    `start_s` and `end_s` are those of its path, in s.

    `lane_dwell_s` is the time lost at each corner of the lanes, None without corners; if an overlay hides the dwell of
    the tool, it is the dwell of the commanded path.
    """

    surface: LabelledIri
    start_s: float
    end_s: float
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


class PlacementResult(msgspec.Struct, frozen=True, kw_only=True):
    """Where a thing that the run moved is at its end, in m in the world: believed, and as the simulator has it.

    `holder` is what is believed to contain it, None for nothing; it is held if that is a gripper. `holder_known` and
    `known` are the evidence for that and for the believed place. `error_m` and `turned_deg` are how far the true pose
    is from the believed one. `intended_m` is where (x, y) its middle should be, to which it was last carried, and
    `missed_m` how far from there it really is in the plane. What is not known is None: a held thing is believed to be
    where the hand is. `moved_with` is what carried it along after it was put there, whose place `known` is about.
    """

    thing: LabelledIri
    holder: LabelledIri | None
    is_held: bool
    holder_known: str
    known: str
    believed_m: tuple[float, float, float] | None
    true_m: tuple[float, float, float] | None
    error_m: float | None
    turned_deg: float | None
    intended_m: tuple[float, float] | None = None
    missed_m: float | None = None
    moved_with: LabelledIri | None = None


class TouchResult(msgspec.Struct, frozen=True, kw_only=True):
    """What a part of a robot touched that it should not, as the simulator saw it, as texts.

    Times in s, the greatest force in N, None where the simulation does not compute it.
    """

    part: str
    other: str
    start_s: float
    end_s: float
    peak_force_n: float | None = None

    def __str__(self) -> str:
        force = "" if self.peak_force_n is None else f" with up to {self.peak_force_n:.0f} N"
        return f"{self.part} touched {self.other}{force} at {self.start_s:.1f} s"


class CommandsResult(msgspec.Struct, frozen=True, kw_only=True):
    """What an arm would have been sent in a dry run: `count` commands, of which the limits have altered some.

    `greatest_share` is that of a joint's limit of torque, or of speed, which `joint` was commanded.
    """

    arm: str
    kind: Literal["torque", "position", "velocity"]
    count: int
    altered: int
    joint: str
    greatest_share: float


class FailedCall(msgspec.Struct, frozen=True, kw_only=True):
    """A call that failed, with its implementation, and its source line."""

    name: str
    source: Position


ForceSource: TypeAlias = Literal["sensor", "estimate"]
"""What an arm knows a force from: a force-torque sensor, or an estimate from its motors."""


class PushResult(msgspec.Struct, frozen=True, kw_only=True, tag="push"):
    """A tool was pressed on something: times in s, forces in N opposite to the push, travel in mm after contact.

    `skill` is the innermost skill around the push, `on` what its parameters name besides devices. The mean and the
    greatest force are those that the arm knew, from `force_source`, while there was contact; `true_` ones are those of
    the simulator, None where it has none. `contact_s` is when something was touched, by the simulator if it has the
    force, None if nothing was.
    """

    skill: str
    arm: LabelledIri
    on: tuple[LabelledIri, ...]
    start_s: float
    end_s: float
    contact_s: float | None
    force_command_n: float
    force_mean_n: float | None
    force_greatest_n: float | None
    force_source: ForceSource
    true_mean_n: float | None
    true_greatest_n: float | None
    travel_mm: float | None


class SearchResult(msgspec.Struct, frozen=True, kw_only=True, tag="search"):
    """Something was searched for with a pressed tool, as the arm measured it: times in s, lengths in mm.

    `path_mm` is how far the tool went across the push, `radius_mm` how far from where the search began it came,
    `found_mm` how far from there it was when something gave way, None if nothing did. `depth_mm` is how far it then
    sank below where it had searched, to the end of the push.
    """

    skill: str
    arm: LabelledIri
    on: tuple[LabelledIri, ...]
    start_s: float
    end_s: float
    path_mm: float
    radius_mm: float
    found_mm: float | None
    depth_mm: float


class GuidanceResult(msgspec.Struct, frozen=True, kw_only=True, tag="guidance"):
    """An arm yielded in all directions, so that it could be guided: times in s, lengths in mm, speed in mm/s.

    The forces in N of whoever guided it are those of the simulator; None if nobody did.
    """

    arm: LabelledIri
    start_s: float
    end_s: float
    path_mm: float
    moved_mm: float
    greatest_speed_mm_s: float
    person_mean_n: float | None
    person_greatest_n: float | None


class GraspResult(msgspec.Struct, frozen=True, kw_only=True, tag="grasp"):
    """A thing was grasped by a gripper: times in s, None if it was held to the end, and the grip 0.2 s after the grasp.

    force_n: with which each finger presses, by the simulator, None where it computes none; opening_mm: by the sensor of
    the fingers.
    """

    thing: LabelledIri
    gripper: LabelledIri
    grasped_s: float
    released_s: float | None
    force_n: float | None
    opening_mm: float | None


class DriveResult(msgspec.Struct, frozen=True, kw_only=True, tag="drive"):
    """A mobile base drove during the run: the length of its path in m, by the simulator."""

    robot: LabelledIri
    path_m: float


WorkResult: TypeAlias = PushResult | SearchResult | GuidanceResult | GraspResult | DriveResult


class TaskResult(msgspec.Struct, frozen=True, kw_only=True):
    """The result of a task; one that did not start is `refused`, and `failure` is why it did not succeed.

    `cause` is the same with all details, None if the task did not begin; `failed_calls` lead to it, outermost first.

    `plan_optimal` is None if nothing was planned; `plan_quality` describes how good the plan is known to be, and for
    which problem, `plan_in_space` what is known of it in space, None if nobody has looked. `facts` are those that a
    success rests on; it is `verified` if none of them is only assumed, and no claim is false. `false_claims` are
    sentences about what the world model claims of things at the end that is not so in the simulator. `plan` has the
    steps that abandoned plans have started, then those of the last plan or of the body, in order of time;
    `planned_steps` is how many the last plan has, `replanned` why it replaced each other one, among them what was
    `sensed` that decided how a policy went on. `wipings` has one entry
    for each time a surface was wiped, `wiping` is the first of them; `placements` has one for each thing that was
    moved, `works` one for each other piece of work, `touches` one for each contact of a link, hand or base. What only
    a simulator knows is left out if the cell was not `simulated`; `sim_time_s` is the time of its clock. Arms and
    bases had the share `speed` of their speeds. After a `dry` run `commands` are what would have been sent; nothing
    was sent, all other results are of the simulation, and `verified` is None.
    """

    task: str
    status: EndState | Literal["refused"]
    verified: bool | None = None
    facts: tuple[KnownFact, ...] = ()
    false_claims: tuple[str, ...] = ()
    plan: tuple[StepResult, ...] = ()
    choices: tuple[ChoiceResult, ...] = ()
    planned_steps: int = 0
    plan_optimal: bool | None = None
    plan_quality: str = ""
    plan_in_space: SpaceClaim | None = None
    planner: str = ""
    robots: tuple[LabelledIri, ...] = ()
    controllers: tuple[str, ...] = ()
    sim_time_s: float = 0.0
    wall_time_s: float = 0.0
    real_time_factor: float = 0.0
    speed: float = 1.0
    dry: bool = False
    commands: tuple[CommandsResult, ...] = ()
    seed: int = 0
    variation: str = ""
    simulated: bool = True
    wiping: WipingResult | None = None
    wipings: tuple[WipingResult, ...] = ()
    placements: tuple[PlacementResult, ...] = ()
    works: tuple[WorkResult, ...] = ()
    touches: tuple[TouchResult, ...] = ()
    replanned: tuple[str, ...] = ()
    sensed: tuple[str, ...] = ()
    failure: str | None = None
    cause: Failure | None = None
    failed_calls: tuple[FailedCall, ...] = ()

    @property
    def is_sound(self) -> bool:
        """Whether the task succeeded, and the simulator contradicts nothing that the world model claims."""
        return self.status == "succeeded" and not self.false_claims
