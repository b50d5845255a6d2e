"""The data for the figure of one push: what was pressed, how its force is known, when a button switched."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.evaluation.report.pushes import PushRecord, find_force_source
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.work_result import ForceSource
from skillc_runtime.world.state.terms import BUTTON


@dataclass(frozen=True, slots=True)
class PushDrawing:
    """A push to draw: where the arm knows its force from, and when a button in it switched, None if none did."""

    push: PushRecord
    source: ForceSource
    switched_s: float | None


def make_push_drawing(push: PushRecord, record: RunRecord) -> PushDrawing:
    """Return what is drawn of a push."""
    return PushDrawing(push, find_force_source(push.arm, record), _find_switching(push, record))


def _find_switching(push: PushRecord, record: RunRecord) -> float | None:
    if record.truth is None:
        return None
    for button in (each for each in push.on if record.state.is_a(each, BUTTON)):
        rows = record.truth.pressing(button)
        switched = rows[(rows[:, 2] > 0) & (rows[:, 0] >= push.start_s) & (rows[:, 0] <= push.end_s), 0]
        if switched.size:
            return float(switched[0])
    return None
