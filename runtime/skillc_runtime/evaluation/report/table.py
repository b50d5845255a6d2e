"""The result of a task as text: the rows of a table, for the terminal and the report."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias, assert_never

from skillc_runtime.evaluation.metrics.coverage_text import format_coverage
from skillc_runtime.evaluation.report.result import (
    ChoiceResult,
    CommandsResult,
    DriveResult,
    GraspResult,
    GuidanceResult,
    PlacementResult,
    PushResult,
    SearchResult,
    StepResult,
    TaskResult,
    WipingResult,
    WorkResult,
)
from skillc_runtime.recording.failure_text import list_details
from skillc_runtime.recording.known_facts import format_evidence
from skillc_runtime.world.state.labels.labelled_text import format_fact

Row: TypeAlias = tuple[str, str]

MOST_ROWS = 24
"""Of longer lists the first rows are shown, and how many more there are."""


def list_failure_details(result: TaskResult) -> list[str]:
    """Return the causes of a failure, each below what it explains, and the calls that led to it, one a line."""
    details = list(list_details(result.cause)) if result.cause is not None else []
    calls = " > ".join(f"{call.name} ({call.source})" for call in result.failed_calls)
    return [*details, f"in {calls}"] if calls else details


def format_choice_reason(taken: StepResult | ChoiceResult) -> str:
    """Return why an implementation was chosen."""
    if taken.rejected:
        return "; ".join(f"not {each.implementation}: {each.reason}" for each in taken.rejected)
    if isinstance(taken, StepResult) and taken.fixed:
        return "named by the call"
    return "the only one" if isinstance(taken, StepResult) and not taken.alternatives else "the first that fits"


def format_step(step: StepResult) -> str:
    """Return how a step was done, in which rounds of loops, and why it failed; or why it was not done."""
    match step.status:
        case "skipped":
            return "achieved already"
        case "not started":
            return "not reached"
        case _:
            done = ", ".join((step.implementation or "did not start", *map(str, step.rounds)))
            return f"{done}: {step.failure}" if step.failure else done


def list_table_rows(result: TaskResult) -> list[tuple[str, str]]:
    """Return the rows about a run as names and values."""
    planned = [] if result.plan_optimal is None else [("plan", _describe_plan(result))]
    return [
        *planned,
        *shorten_rows([(format_fact(fact.fact), format_evidence(fact)) for fact in result.facts]),
        *_robot_rows(result),
        *_reality_rows(result),
        *shorten_rows([("unwanted contact", str(touch)) for touch in result.touches]),
        *shorten_rows([("planned again", why) for why in result.replanned if why not in result.sensed]),
        *shorten_rows([("sensed", what) for what in result.sensed]),
        *(row for wiping in result.wipings for row in _wiping_rows(wiping, len(result.wipings) > 1)),
        *list_work_rows(result.works),
        *shorten_rows([(str(each.thing), format_placement(each)) for each in result.placements]),
        *(("would be sent", _describe_commands(each)) for each in result.commands),
        *_time_rows(result),
    ]


def _describe_commands(sent: CommandsResult) -> str:
    of = "torque" if sent.kind == "torque" else "speed"
    altered = f", {sent.altered} of them altered by the limits" if sent.altered else ""
    greatest = f"{sent.joint} reaches {100 * sent.greatest_share:.0f} % of its {of}"
    return f"{sent.arm}: {sent.count} commands of {sent.kind}{altered}; {greatest}"


def _reality_rows(result: TaskResult) -> list[tuple[str, str]]:
    """Return a row about how a simulation differed from the facts."""
    differs = f"{result.variation} (seed {result.seed})" if result.variation else "as the facts say"
    return [("reality", differs)] if result.simulated else []


def _time_rows(result: TaskResult) -> list[tuple[str, str]]:
    """Return rows about how long a run took; a real cell has no speed of its own."""
    slowed = [("motions", f"with {100.0 * result.speed:.3g} % of their speeds")] if result.speed < 1.0 else []
    if not result.simulated:
        return [("time", f"{result.sim_time_s:.1f} s"), *slowed]
    return [
        ("time", f"{result.sim_time_s:.1f} s simulated in {result.wall_time_s:.1f} s"),
        ("speed", f"{result.real_time_factor:.1f} x real time"),
        *slowed,
    ]


def _robot_rows(result: TaskResult) -> list[tuple[str, str]]:
    """Return a row about robots and controllers; none for a cell without arms."""
    robots = ", ".join(map(str, result.robots))
    controllers = f", controller {', '.join(result.controllers)}" if result.controllers else ""
    return [("robot" if len(result.robots) == 1 else "robots", robots + controllers)] if robots else []


def _describe_plan(result: TaskResult) -> str:
    steps = f"{result.planned_steps} step{'s' * (result.planned_steps != 1)} by {result.planner}"
    known = [] if result.plan_in_space is None else [result.plan_in_space.summary]
    return ", ".join([steps, result.plan_quality, *known])


def format_placement(placed: PlacementResult) -> str:
    """Return where a thing ended up, how that is known, and how far from there it really is."""
    parts = [] if placed.holder is None else [f"{'held by' if placed.is_held else 'in'} {placed.holder}"]
    if placed.believed_m is None or placed.error_m is None or placed.turned_deg is None:
        return ", ".join((*parts, placed.holder_known)) if parts else placed.known
    if placed.holder_known not in ("", placed.known):
        parts.append(placed.holder_known)
    parts += [] if placed.moved_with is None else [f"moved with {placed.moved_with}"]
    parts.append(f"at {' '.join(f'{each:.3f}' for each in placed.believed_m)} m, {placed.known}")
    really = f"really {placed.error_m * 1e3:.0f} mm and {placed.turned_deg:.0f} deg from there"
    missed = "" if placed.missed_m is None else f", {placed.missed_m * 1e3:.0f} mm from where it should be"
    return f"{', '.join(parts)}; {really}{missed}"


PLACEMENT_COLUMNS = (
    "should be at x, y", "believed at x, y, z", "how that is known", "really at x, y, z: simulator truth",
    "off the believed place", "off where it should be",
)  # fmt: skip
"""The names of what `split_placement` returns."""


def split_placement(placed: PlacementResult) -> tuple[str, ...]:
    """Return where a thing should be, is believed to be, how that is known, where it is, and both errors, as text."""
    where = "" if placed.holder is None else f"{'held by' if placed.is_held else 'in'} {placed.holder}"
    along = "" if placed.moved_with is None else f"moved with {placed.moved_with}"
    believed = ", ".join(part for part in (where, along, _millimetres(placed.believed_m)) if part)
    known = ", ".join(dict.fromkeys(part for part in (placed.holder_known, placed.known) if part))
    error, turned = placed.error_m, placed.turned_deg
    off = "not known" if error is None or turned is None else f"{error * 1e3:.1f} mm, {turned:.1f} deg"
    missed = "not known" if placed.missed_m is None else f"{placed.missed_m * 1e3:.1f} mm"
    return (_millimetres(placed.intended_m) or "not stated", believed, known, _millimetres(placed.true_m), off, missed)


def _millimetres(place: tuple[float, ...] | None) -> str:
    return "" if place is None else " ".join(f"{each * 1e3:.0f}" for each in place)


def _wiping_rows(wiping: WipingResult, one_of_several: bool) -> list[tuple[str, str]]:
    share = wiping.force_rmse_n / wiping.force_command_n
    return [
        *([("surface", str(wiping.surface))] if one_of_several else []),
        ("coverage", f"{format_coverage(wiping.coverage)}%"),
        ("force", f"{wiping.force_mean_n:.2f} N mean of {wiping.force_command_n:g} N"),
        ("force RMSE", f"{wiping.force_rmse_n:.2f} N, {share:.1%}"),
        ("contact lost", f"{wiping.contact_lost:.2%}"),
        ("first impact", f"{wiping.first_impact_n:.1f} N"),
        ("vibration", f"{wiping.vibration_mm_s:.2f} mm/s"),
        ("tilt", f"{wiping.tilt_rms_deg:.2f} deg rms"),
        ("tracking", f"{wiping.tracking_rms_mm:.1f} mm rms behind the reference, in the plane"),
        *_dwell_rows(wiping),
    ]


def _dwell_rows(wiping: WipingResult) -> list[tuple[str, str]]:
    if wiping.lane_dwell_s is None:
        return []
    whose = "" if wiping.lane_dwell_of == "tool" else ", of the path: an overlay hides the tool's"
    return [("lane-end dwell", f"{wiping.lane_dwell_s:.3f} s a corner{whose}")]


def list_work_rows(works: Iterable[WorkResult]) -> list[Row]:
    """Return a row for each piece of work."""
    return shorten_rows([_make_row(each) for each in works])


def shorten_rows(rows: list[Row]) -> list[Row]:
    """Return rows, and in place of those beyond MOST_ROWS how many they are."""
    left = len(rows) - MOST_ROWS
    return rows if left <= 1 else [*rows[:MOST_ROWS], ("", f"and {left} more, which are in result.json")]


def _make_row(work: WorkResult) -> Row:
    match work:
        case PushResult():
            return f"{work.skill} {' '.join(map(str, work.on))}".strip(), _describe_push(work)
        case SearchResult():
            return f"search of {work.skill}", _describe_search(work)
        case GuidanceResult():
            return f"{work.arm} guided", _describe_guidance(work)
        case GraspResult():
            return f"grasp of {work.thing}", _describe_grasp(work)
        case DriveResult():
            return f"{work.robot} drove", f"{work.path_m:.2f} m"
        case _:
            assert_never(work)


def _describe_push(work: PushResult) -> str:
    if work.contact_s is None or work.force_mean_n is None or work.force_greatest_n is None:
        return f"nothing touched in {work.end_s - work.start_s:.1f} s, {work.force_command_n:g} N commanded"
    force = f"{work.force_mean_n:.1f} N mean, {work.force_greatest_n:.1f} N greatest by {_article(work.force_source)}"
    if work.true_mean_n is not None and work.true_greatest_n is not None:
        force += f", really {work.true_mean_n:.1f} and {work.true_greatest_n:.1f} N"
    travel = "" if work.travel_mm is None else f"; {work.travel_mm:.1f} mm travel after contact"
    return f"{work.force_command_n:g} N commanded; {force}{travel}"


def _article(source: str) -> str:
    return "estimate" if source == "estimate" else "the sensor"


def _describe_search(work: SearchResult) -> str:
    found = "nothing gave way" if work.found_mm is None else f"gave way {work.found_mm:.1f} mm from its start"
    went = f"{work.path_mm:.0f} mm of path in {work.end_s - work.start_s:.1f} s, up to {work.radius_mm:.1f} mm away"
    return f"{found}; {went}; sank by {work.depth_mm:.1f} mm"


def _describe_guidance(work: GuidanceResult) -> str:
    by = "by nobody"
    if work.person_mean_n is not None and work.person_greatest_n is not None:
        by = f"with {work.person_mean_n:.1f} N mean, {work.person_greatest_n:.1f} N greatest"
    moved = f"{work.path_mm:.0f} mm of path to {work.moved_mm:.0f} mm from its start"
    return f"{moved} in {work.end_s - work.start_s:.1f} s {by}, up to {work.greatest_speed_mm_s:.0f} mm/s"


def _describe_grasp(work: GraspResult) -> str:
    force = "" if work.force_n is None else f"{work.force_n:.1f} N a finger"
    opening = "" if work.opening_mm is None else f"{work.opening_mm:.1f} mm open by its sensor"
    until = "to the end" if work.released_s is None else f"for {work.released_s - work.grasped_s:.1f} s"
    return ", ".join(part for part in (force, opening, f"held {until}") if part)
