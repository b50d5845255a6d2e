"""The numbers of each kind of work as rows of a table: a name and a value."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias, assert_never

from skillc_runtime.evaluation.report.work_result import (
    DriveResult,
    GraspResult,
    GuidanceResult,
    PushResult,
    SearchResult,
    WorkResult,
)

Row: TypeAlias = tuple[str, str]

MOST_ROWS = 24
"""Of longer lists the first rows are shown, and how many more there are."""


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
